//! One frame as a VTK XML PolyData file (`.vtp`): a small XML head, then all numbers as one binary
//! section of zlib blocks, little endian.
//!
//! Positions and the time are stored as `Float64`, since small displacements of a body far from the
//! origin must survive; all other real quantities as `Float32`: 7 digits are more than a picture shows or
//! a particle method promises, and the files are half as large. Numbers that must be exact stand in the
//! probe tables and in the summary. Identities are `Int64`.
//!
//! Every particle is a vertex cell of its own, so that ParaView can pick and threshold particles. The unit
//! of a quantity is stored as VTK's own `UNITS_LABEL` of the array.
//!
//! Format: <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

use std::collections::HashMap;
use std::io::{self, Write as _};

use flate2::{Compression, write::ZlibEncoder};
use rayon::prelude::*;

use crate::{Array, Frame, OutputError, Values};

/// Bytes per zlib block before compression: a multiple of every number's size.
const BLOCK: usize = 1 << 20;

/// Size of the file of a frame, bytes.
///
/// # Errors
/// If the numbers cannot be compressed.
pub fn encoded_size(frame: &Frame) -> Result<usize, OutputError> {
    let bytes = Encoder::default().encode(frame);
    bytes.map(|bytes| bytes.len()).map_err(|cause| OutputError::inconsistent("a frame", cause))
}

/// Makes the bytes of files. Whole numbers (identities, cells) are mostly those of the frame before, so their
/// compressed bytes are kept.
#[derive(Debug, Default)]
pub(crate) struct Encoder {
    kept: HashMap<String, Kept>,
}

/// An array as it was, and compressed.
#[derive(Debug, Default)]
struct Kept {
    plain: Vec<u8>,
    compressed: Vec<u8>,
}

impl Encoder {
    /// The bytes of the file; arrays are compressed in parallel.
    pub(crate) fn encode(&mut self, frame: &Frame) -> io::Result<Vec<u8>> {
        let arrays = arrays(frame);
        let compressed: Vec<io::Result<Vec<u8>>> =
            arrays.par_iter().map(|array| self.compressed(array)).collect();
        let mut bytes = Vec::new();
        let mut elements = Vec::with_capacity(arrays.len());
        for (array, compressed) in arrays.into_iter().zip(compressed) {
            let compressed = compressed?;
            elements.push(array.element(bytes.len()));
            bytes.extend_from_slice(&compressed);
            if array.kind == "Int64" {
                self.kept.insert(array.name, Kept { plain: array.bytes, compressed });
            }
        }
        let [points, cells, others @ ..] = elements.as_slice() else { return Ok(bytes) };
        let (offsets, quantities) =
            others.split_first().map_or(("", [].as_slice()), |(o, q)| (o.as_str(), q));
        let mut file = head(frame, points, &[cells, offsets].concat(), &quantities.concat()).into_bytes();
        file.extend_from_slice(&bytes);
        file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        Ok(file)
    }

    fn compressed(&self, array: &Plain) -> io::Result<Vec<u8>> {
        match self.kept.get(&array.name) {
            Some(kept) if kept.plain == array.bytes => Ok(kept.compressed.clone()),
            _ => compress(&array.bytes),
        }
    }
}

/// An array before it is compressed.
struct Plain {
    kind: &'static str,
    name: String,
    components: usize,
    /// What closes its XML element.
    close: String,
    bytes: Vec<u8>,
}

impl Plain {
    /// The XML element that points at the numbers.
    fn element(&self, offset: usize) -> String {
        let Self { kind, name, components, close, .. } = self;
        format!(
            r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{offset}"{close}"#
        )
    }
}

/// Positions, cells (particle `i` is vertex cell `i`), and all quantities.
fn arrays(frame: &Frame) -> Vec<Plain> {
    let n = frame.points.len() as i64;
    let whole = |name: &str, first: i64| Plain {
        kind: "Int64",
        name: name.to_string(),
        components: 1,
        close: "/>\n".to_string(),
        bytes: (first..first + n).flat_map(i64::to_le_bytes).collect(),
    };
    let points = Plain {
        kind: "Float64",
        name: "Points".to_string(),
        components: 3,
        close: "/>".to_string(),
        bytes: frame.points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect(),
    };
    let mut arrays = vec![points, whole("connectivity", 0), whole("offsets", 1)];
    arrays.extend(frame.arrays.iter().map(quantity));
    arrays
}

fn head(frame: &Frame, points: &str, verts: &str, quantities: &str) -> String {
    let (time, step, n) = (frame.time, frame.step, frame.points.len());
    format!(
        r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<PolyData>
<FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{time:?}</DataArray>
<DataArray type="Int64" Name="Step" NumberOfTuples="1" format="ascii">{step}</DataArray>
</FieldData>
<Piece NumberOfPoints="{n}" NumberOfVerts="{n}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
<Points>
{points}
</Points>
<Verts>
{verts}</Verts>
<PointData>
{quantities}</PointData>
</Piece>
</PolyData>
<AppendedData encoding="raw">
_"#
    )
}

fn quantity(array: &Array) -> Plain {
    let (kind, bytes) = match &array.values {
        Values::F64(values) => ("Float32", values.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect()),
        Values::I64(values) => ("Int64", values.iter().flat_map(|x| x.to_le_bytes()).collect()),
    };
    let unit = escape(&array.unit);
    let close = format!(
        "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{unit}</InformationKey></DataArray>\n"
    );
    Plain { kind, name: escape(&array.name), components: array.components, close, bytes }
}

/// Number of blocks, block size, size of the last block if it is a part of one (else 0), compressed sizes;
/// then the blocks.
fn compress(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut header = vec![bytes.len().div_ceil(BLOCK), BLOCK, bytes.len() % BLOCK];
    let mut body = Vec::new();
    for block in bytes.chunks(BLOCK) {
        let start = body.len();
        let mut encoder = ZlibEncoder::new(&mut body, Compression::fast());
        encoder.write_all(block)?;
        encoder.finish()?;
        header.push(body.len() - start);
    }
    let mut all: Vec<u8> = header.iter().flat_map(|&n| (n as u64).to_le_bytes()).collect();
    all.append(&mut body);
    Ok(all)
}

/// `text` as it may stand in XML; control characters, which XML forbids, become spaces.
fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped() {
        assert_eq!(escape("a<\"b\">&\nc"), "a&lt;&quot;b&quot;&gt;&amp; c");
    }

    #[test]
    fn what_is_kept_from_the_frame_before_changes_no_file() {
        let frame = |ids: Vec<i64>| Frame {
            time: 0.0,
            step: 0,
            points: vec![[0.5; 3]; ids.len()],
            arrays: vec![Array::scalar("ParticleId", "1", Values::I64(ids))],
        };
        let mut encoder = Encoder::default();
        for ids in [vec![0, 1, 2], vec![0, 1, 2], vec![2, 1, 0], vec![0, 1], vec![]] {
            let fresh = Encoder::default().encode(&frame(ids.clone())).unwrap();
            assert_eq!(encoder.encode(&frame(ids)).unwrap(), fresh);
        }
    }

    #[test]
    fn the_header_counts_full_and_partial_blocks() {
        for (length, expected) in
            [(0, [0, 0]), (5, [1, 5]), (BLOCK, [1, 0]), (BLOCK + 8, [2, 8]), (2 * BLOCK, [2, 0])]
        {
            let bytes = compress(&vec![7; length]).unwrap();
            let number = |i: usize| u64::from_le_bytes(bytes[8 * i..8 * i + 8].try_into().unwrap());
            assert_eq!([number(0), number(2)], expected, "{length} bytes");
            let blocks: u64 = (0..number(0)).map(|block| number(3 + block as usize)).sum();
            assert_eq!(bytes.len() as u64, 8 * (3 + number(0)) + blocks);
        }
    }
}
