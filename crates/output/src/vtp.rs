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
use std::fmt::Write as _;
use std::io::{self, Write as _};

use flate2::{Compression, write::ZlibEncoder};

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
    /// The bytes of the file.
    pub(crate) fn encode(&mut self, frame: &Frame) -> io::Result<Vec<u8>> {
        let mut appended = Appended { kept: &mut self.kept, bytes: Vec::new() };
        let points = appended.array("Float64", "Points", 3, &le_bytes(frame.points.as_flattened()))?;
        let points = format!("{points}/>");
        let verts = vertices(&mut appended, frame.points.len())?;
        let mut quantities = String::new();
        for array in &frame.arrays {
            quantities += &quantity(&mut appended, array)?;
        }
        let mut file = head(frame, &points, &verts, &quantities).into_bytes();
        file.extend_from_slice(&appended.bytes);
        file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        Ok(file)
    }
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

/// The cells: particle `i` is vertex cell `i`.
fn vertices(appended: &mut Appended<'_>, n: usize) -> io::Result<String> {
    let mut xml = String::new();
    for (name, first) in [("connectivity", 0), ("offsets", 1)] {
        let indices: Vec<u8> = (first..first + n as i64).flat_map(i64::to_le_bytes).collect();
        let _ = writeln!(xml, "{}/>", appended.array("Int64", name, 1, &indices)?);
    }
    Ok(xml)
}

fn quantity(appended: &mut Appended<'_>, array: &Array) -> io::Result<String> {
    let (kind, bytes) = match &array.values {
        Values::F64(values) => ("Float32", values.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect()),
        Values::I64(values) => ("Int64", values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()),
    };
    let element = appended.array(kind, &escape(&array.name), array.components, &bytes)?;
    let unit = escape(&array.unit);
    Ok(format!(
        "{element}><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{unit}</InformationKey></DataArray>\n"
    ))
}

fn le_bytes(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// The binary section as it grows.
struct Appended<'a> {
    kept: &'a mut HashMap<String, Kept>,
    bytes: Vec<u8>,
}

impl Appended<'_> {
    /// Appends the numbers and returns the XML element that points at them, still open.
    fn array(&mut self, kind: &str, name: &str, components: usize, bytes: &[u8]) -> io::Result<String> {
        let offset = self.bytes.len();
        if kind == "Int64" {
            let kept = self.kept.entry(name.to_string()).or_default();
            if kept.compressed.is_empty() || kept.plain != bytes {
                *kept = Kept { plain: bytes.to_vec(), compressed: Vec::new() };
                compress(bytes, &mut kept.compressed)?;
            }
            self.bytes.extend_from_slice(&kept.compressed);
        } else {
            compress(bytes, &mut self.bytes)?;
        }
        Ok(format!(
            r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{offset}""#
        ))
    }
}

/// Appends number of blocks, block size, size of the last block if it is a part of one (else 0), compressed sizes;
/// then the blocks.
fn compress(bytes: &[u8], to: &mut Vec<u8>) -> io::Result<()> {
    let mut header = vec![bytes.len().div_ceil(BLOCK), BLOCK, bytes.len() % BLOCK];
    let mut body = Vec::new();
    for block in bytes.chunks(BLOCK) {
        let start = body.len();
        let mut encoder = ZlibEncoder::new(&mut body, Compression::fast());
        encoder.write_all(block)?;
        encoder.finish()?;
        header.push(body.len() - start);
    }
    to.extend(header.iter().flat_map(|&n| (n as u64).to_le_bytes()));
    to.append(&mut body);
    Ok(())
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
            let mut bytes = Vec::new();
            compress(&vec![7; length], &mut bytes).unwrap();
            let number = |i: usize| u64::from_le_bytes(bytes[8 * i..8 * i + 8].try_into().unwrap());
            assert_eq!([number(0), number(2)], expected, "{length} bytes");
            let blocks: u64 = (0..number(0)).map(|block| number(3 + block as usize)).sum();
            assert_eq!(bytes.len() as u64, 8 * (3 + number(0)) + blocks);
        }
    }
}
