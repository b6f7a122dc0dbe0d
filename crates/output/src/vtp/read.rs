//! Reading our own `.vtp` files back. What is in a file is not trusted: a file that is damaged, or made to do harm, is an error, and
//! no more memory is asked for than the file can fill (deflate makes at most 1032 bytes out of one).

use std::path::{Path, PathBuf};

use super::blocks::{self, MOST_RATIO};
use super::head::{Element, Head, Kind};
use crate::{Array, Frame, OutputError, Values};

/// Begins the binary section.
const MARK: &[u8] = b"<AppendedData encoding=\"raw\">";

/// A frame's file, whose head is read; numbers are when they are asked for.
#[derive(Debug)]
pub struct FrameFile {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Where the binary section begins.
    data: usize,
    head: Head,
}

impl FrameFile {
    /// Opens a file that [`Series`](crate::Series) wrote.
    ///
    /// # Errors
    /// [`OutputError::Read`] if it is not there or is no such file.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let regular = std::fs::metadata(path).map_err(|cause| OutputError::read(path, cause))?.is_file();
        if !regular {
            return Err(OutputError::read(path, "it is no ordinary file"));
        }
        let bytes = std::fs::read(path).map_err(|cause| OutputError::read(path, cause))?;
        Self::of(path, bytes)
    }

    /// The same of the bytes of a file, which is called so.
    ///
    /// # Errors
    /// [`OutputError::Read`] if it is no such file.
    pub fn of(path: &Path, bytes: Vec<u8>) -> Result<Self, OutputError> {
        Self::parse(path, bytes).map_err(|problem| OutputError::read(path, problem))
    }

    fn parse(path: &Path, bytes: Vec<u8>) -> Result<Self, String> {
        let mark =
            bytes.windows(MARK.len()).position(|window| window == MARK).ok_or("it is no whole .vtp file")?;
        let start = mark + MARK.len();
        let blank = bytes[start..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        if bytes.get(start + blank) != Some(&b'_') {
            return Err("its binary section is missing".to_string());
        }
        let text = std::str::from_utf8(&bytes[..start]).map_err(|_| "its head is damaged: no UTF-8")?;
        let head = Head::parse(text)?;
        if head.particles > MOST_RATIO * bytes.len() as u64 {
            return Err(format!("it cannot hold {} particles", head.particles));
        }
        Ok(Self { path: path.to_path_buf(), data: start + blank + 1, bytes, head })
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.head.time
    }

    /// Number of particles that it says it holds.
    pub fn particles(&self) -> u64 {
        self.head.particles
    }

    /// Names of the quantities, with the number of components of each.
    pub fn arrays(&self) -> impl Iterator<Item = (&str, usize)> {
        self.head.arrays.iter().map(|array| (array.name.as_str(), array.components))
    }

    /// The frame, with those of its quantities that are wanted.
    ///
    /// # Errors
    /// [`OutputError::Read`] if numbers are damaged.
    pub fn frame(&self, wanted: impl Fn(&str) -> bool) -> Result<Frame, OutputError> {
        self.decoded(wanted).map_err(|problem| OutputError::read(&self.path, problem))
    }

    fn decoded(&self, wanted: impl Fn(&str) -> bool) -> Result<Frame, String> {
        let points = match (self.head.points.components, self.values(&self.head.points)?) {
            (3, Values::F64(values)) => values.as_chunks::<3>().0.to_vec(),
            _ => return Err("its positions are no vectors in double precision".to_string()),
        };
        let mut arrays = Vec::new();
        for element in self.head.arrays.iter().filter(|element| wanted(&element.name)) {
            let Element { name, unit, components, .. } = element;
            let unit = unit.clone().unwrap_or_default();
            arrays.push(Array {
                name: name.clone(),
                unit,
                components: *components,
                values: self.values(element)?,
            });
        }
        let frame = Frame { time: self.head.time, step: self.head.step, points, arrays };
        frame.check().map_err(|error| error.to_string())?;
        Ok(frame)
    }

    fn values(&self, element: &Element) -> Result<Values, String> {
        let Element { kind, name, components, offset, .. } = element;
        let damaged = |problem: String| format!("{name} is damaged: {problem}");
        let expected = self.head.particles * *components as u64 * kind.size();
        let data =
            usize::try_from(*offset).ok().and_then(|offset| self.bytes.get(self.data..)?.get(offset..));
        let data = data.ok_or_else(|| damaged("it begins beyond the end of the file".to_string()))?;
        let decode = if self.head.compressed { blocks::decompress } else { blocks::plain };
        let bytes = decode(data, expected).map_err(damaged)?;
        Ok(match kind {
            Kind::Float64 => Values::F64(numbers(&bytes, f64::from_le_bytes)),
            Kind::Float32 => Values::F32(numbers(&bytes, f32::from_le_bytes)),
            Kind::Int64 => Values::I64(numbers(&bytes, i64::from_le_bytes)),
            Kind::Int32 => Values::I64(numbers(&bytes, |four| i64::from(i32::from_le_bytes(four)))),
        })
    }
}

fn numbers<T, const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks::<N>().0.iter().map(|&chunk| number(chunk)).collect()
}
