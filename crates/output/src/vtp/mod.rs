//! One frame as a VTK XML PolyData file (`.vtp`): a small XML head, then all numbers as one binary
//! section of zlib blocks, little endian.
//!
//! Positions and the time are stored as `Float64`, since small displacements of a body far from the
//! origin must survive; all other real quantities as `Float32`: 7 digits are more than a picture shows or
//! a particle method promises, and the files are half as large. Numbers that must be exact stand in the
//! probe tables and in the summary. Identities are whole numbers, `Int32` or `Int64`.
//!
//! Frames that follow each other within a few steps are not compressed: that would cost more than a hundredth of the run. Their zlib
//! blocks are stored as they are, so that it is one format all the same.
//!
//! What stays the same from frame to frame (cells, identities, bodies, spacings) is compressed once.
//!
//! Every particle is a vertex cell of its own, so that ParaView can pick and threshold particles. The unit
//! of a quantity is stored as VTK's own `UNITS_LABEL` of the array.
//!
//! Format: <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

mod blocks;
mod head;
mod read;

pub use read::FrameFile;

use std::io;
use std::path::Path;
use std::sync::Arc;

use flate2::Compression;
use rayon::prelude::*;

use crate::{Array, Frame, OutputError, Values};
use blocks::compress;
use head::{Element, Kind};

/// Fewest steps since the frame before that make compression worth its time, in space: it costs as much as five steps.
const APART: u64 = 500;

/// The same in the plane, where a step takes less: as much as 25 of them.
const APART_IN_PLANE: u64 = 2500;

/// How to compress what changes with every frame, so many steps after the one before: such that it costs no more than a hundredth of them.
fn changing(frame: &Frame, steps: u64) -> Compression {
    let in_plane = frame.points.iter().all(|x| x[2] == 0.0);
    let apart = if in_plane { APART_IN_PLANE } else { APART };
    if steps < apart { Compression::none() } else { Compression::fast() }
}

/// What is compressed once for many frames.
const LASTING: Compression = Compression::best();

/// Makes frames as a run would, and keeps no file: to know how large they are, and how long they take.
#[derive(Debug, Default)]
pub struct Rehearsal(Encoder);

impl Rehearsal {
    /// Size of the file of a frame that follows the one before after so many steps, bytes.
    ///
    /// # Errors
    /// If the numbers cannot be compressed.
    pub fn size(&mut self, frame: &Frame, steps: u64) -> Result<usize, OutputError> {
        let bytes = self.0.encode_with(frame, changing(frame, steps));
        bytes.map(|bytes| bytes.len()).map_err(|cause| OutputError::inconsistent("a frame", cause))
    }
}

/// Writes one frame as a file of its own.
///
/// # Errors
/// [`OutputError`] if the frame is inconsistent or the file cannot be written.
pub fn write_frame(path: &Path, frame: &Frame) -> Result<(), OutputError> {
    frame.check()?;
    let bytes = Encoder::default().encode(frame).map_err(|cause| OutputError::write(path, cause))?;
    crate::write_atomically(path, &bytes)
}

/// Makes the bytes of files; keeps the compressed bytes of arrays that last.
#[derive(Debug, Default)]
pub(crate) struct Encoder {
    kept: Vec<Kept>,
    /// Steps of the frame before.
    last: Option<u64>,
}

/// The compressed bytes of an array that many frames share.
#[derive(Debug)]
struct Kept {
    key: Key,
    compressed: Arc<Vec<u8>>,
}

/// Tells arrays apart without looking at their numbers. It owns the numbers, so that their place cannot be taken by others.
#[derive(Debug, Clone)]
enum Key {
    /// The whole numbers from `first` on, so many of them.
    Counting(i32, usize),
    Shared(Arc<Vec<f32>>),
    Whole(Arc<Vec<i32>>),
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Counting(first, n), Self::Counting(other, m)) => (first, n) == (other, m),
            (Self::Shared(one), Self::Shared(other)) => Arc::ptr_eq(one, other),
            (Self::Whole(one), Self::Whole(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

/// An array on its way into a file.
struct Plain<'a> {
    element: Element,
    numbers: Numbers<'a>,
}

/// Its numbers.
enum Numbers<'a> {
    F64(&'a [f64]),
    /// Rounded to single precision.
    Rounded(&'a [f64]),
    F32(&'a [f32]),
    I64(&'a [i64]),
    Lasting(Key),
}

impl Encoder {
    /// An encoder that goes on after a frame at so many steps.
    pub(crate) fn after(last: Option<u64>) -> Self {
        Self { last, ..Self::default() }
    }

    /// Steps of the last frame.
    pub(crate) fn last(&self) -> Option<u64> {
        self.last
    }

    /// The bytes of the file of the next frame.
    pub(crate) fn encode(&mut self, frame: &Frame) -> io::Result<Vec<u8>> {
        let steps = self.last.map_or(u64::MAX, |last| frame.step.saturating_sub(last));
        self.last = Some(frame.step);
        self.encode_with(frame, changing(frame, steps))
    }

    /// The bytes of the file; arrays are compressed in parallel.
    fn encode_with(&mut self, frame: &Frame, level: Compression) -> io::Result<Vec<u8>> {
        let n = frame.points.len();
        let mut arrays = vec![
            Plain::new(Kind::Float64, ("Points", None, 3), Numbers::F64(frame.points.as_flattened())),
            Plain::new(Kind::Int32, ("connectivity", None, 1), Numbers::Lasting(Key::Counting(0, n))),
            Plain::new(Kind::Int32, ("offsets", None, 1), Numbers::Lasting(Key::Counting(1, n))),
        ];
        arrays.extend(frame.arrays.iter().map(Plain::quantity));
        let compressed: io::Result<Vec<Arc<Vec<u8>>>> =
            arrays.par_iter().map(|array| self.compressed(&array.numbers, level)).collect();
        let compressed = compressed?;
        let mut at = 0;
        for (array, bytes) in arrays.iter_mut().zip(&compressed) {
            array.element.offset = at;
            at += bytes.len() as u64;
        }
        let mut file = Vec::with_capacity(at as usize + 4096);
        file.extend_from_slice(head::text(frame, arrays.iter().map(|array| &array.element)).as_bytes());
        compressed.iter().for_each(|bytes| file.extend_from_slice(bytes));
        file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        self.keep(&arrays, compressed);
        Ok(file)
    }

    /// The compressed bytes of an array, from the frame before if they are kept.
    fn compressed(&self, numbers: &Numbers, level: Compression) -> io::Result<Arc<Vec<u8>>> {
        if let Numbers::Lasting(key) = numbers {
            if let Some(kept) = self.kept.iter().find(|kept| kept.key == *key) {
                return Ok(Arc::clone(&kept.compressed));
            }
            return compress(&key.bytes(), LASTING).map(Arc::new);
        }
        compress(&numbers.bytes(), level).map(Arc::new)
    }

    /// Keeps what may come again, and nothing else.
    fn keep(&mut self, arrays: &[Plain], compressed: Vec<Arc<Vec<u8>>>) {
        self.kept.clear();
        for (array, compressed) in arrays.iter().zip(compressed) {
            if let Numbers::Lasting(key) = &array.numbers {
                self.kept.push(Kept { key: key.clone(), compressed });
            }
        }
    }
}

impl<'a> Plain<'a> {
    fn new(kind: Kind, (name, unit, components): (&str, Option<&str>, usize), numbers: Numbers<'a>) -> Self {
        let unit = unit.map(str::to_string);
        Self { element: Element { kind, name: name.to_string(), unit, components, offset: 0 }, numbers }
    }

    fn quantity(array: &'a Array) -> Self {
        let (kind, numbers) = match &array.values {
            Values::F64(values) => (Kind::Float32, Numbers::Rounded(values)),
            Values::Exact(values) => (Kind::Float64, Numbers::F64(values)),
            Values::F32(values) => (Kind::Float32, Numbers::F32(values)),
            Values::I64(values) => (Kind::Int64, Numbers::I64(values)),
            Values::Shared(values) => (Kind::Float32, Numbers::Lasting(Key::Shared(Arc::clone(values)))),
            Values::Whole(values) => (Kind::Int32, Numbers::Lasting(Key::Whole(Arc::clone(values)))),
        };
        Self::new(kind, (&array.name, Some(&array.unit), array.components), numbers)
    }
}

impl Numbers<'_> {
    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::F64(values) => little(values, |x| x.to_le_bytes()),
            Self::Rounded(values) => little(values, |x| (*x as f32).to_le_bytes()),
            Self::F32(values) => little(values, |x| x.to_le_bytes()),
            Self::I64(values) => little(values, |x| x.to_le_bytes()),
            Self::Lasting(key) => key.bytes(),
        }
    }
}

impl Key {
    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Counting(first, n) => {
                let all: Vec<i32> = (*first..).take(*n).collect();
                little(&all, |x| x.to_le_bytes())
            }
            Self::Shared(values) => little(values, |x| x.to_le_bytes()),
            Self::Whole(values) => little(values, |x| x.to_le_bytes()),
        }
    }
}

/// The bytes of numbers, one after the other.
fn little<T, const N: usize>(values: &[T], bytes: impl Fn(&T) -> [u8; N]) -> Vec<u8> {
    let mut all = vec![0; N * values.len()];
    for (place, value) in all.as_chunks_mut::<N>().0.iter_mut().zip(values) {
        *place = bytes(value);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_come_quickly_are_stored_and_others_compressed() {
        for (z, apart) in [(1.0, APART), (0.0, APART_IN_PLANE)] {
            let frame = |step| Frame { time: 0.0, step, points: vec![[1.0, 1.0, z]; 1000], arrays: vec![] };
            let mut encoder = Encoder::default();
            let sizes = [0, apart - 1, 2 * apart - 1].map(|step| encoder.encode(&frame(step)).unwrap().len());
            // 24 bytes a position; equal ones compress to less than nine.
            assert!(sizes[1] > sizes[0] + 15_000 && sizes[2] < sizes[0] + 1000, "{sizes:?}");
            // The head holds the number of the step.
            assert_eq!(Rehearsal::default().size(&frame(apart - 1), apart - 1).unwrap(), sizes[1]);
        }
    }

    #[test]
    fn what_is_kept_from_the_frame_before_changes_no_file() {
        let spacing = Arc::new(vec![0.1; 3]);
        // Far apart, so that all are compressed.
        let frame = |ids: &Arc<Vec<i32>>, step| Frame {
            time: 0.0,
            step,
            points: vec![[0.5; 3]; ids.len()],
            arrays: vec![
                Array::scalar("ParticleId", "1", Values::Whole(Arc::clone(ids))),
                Array::scalar(
                    "ParticleSpacing",
                    "m",
                    Values::Shared(Arc::new(spacing[..ids.len()].to_vec())),
                ),
            ],
        };
        let mut encoder = Encoder::default();
        let same = Arc::new(vec![0, 1, 2]);
        let all = [&same, &same, &Arc::new(vec![2, 1, 0]), &same, &Arc::new(vec![0, 1]), &Arc::default()];
        for (ids, step) in all.into_iter().zip((0..).step_by(APART_IN_PLANE as usize)) {
            let fresh = Encoder::default().encode(&frame(ids, step)).unwrap();
            assert_eq!(encoder.encode(&frame(ids, step)).unwrap(), fresh);
            assert_eq!(encoder.kept.len(), 4, "cells, identities and spacings");
        }
    }
}
