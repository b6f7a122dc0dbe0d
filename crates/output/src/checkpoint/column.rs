//! A column of numbers as bytes.

use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io::{Read, Write};

/// Bytes that are tried before a plane is deflated, at each of three places.
const SAMPLE: usize = 4096;
/// A plane that does not get smaller than this share is stored as it is.
const WORTH: f64 = 0.95;
/// Marks of planes.
const STORED: u8 = 0;
const DEFLATED: u8 = 1;

/// A column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers<'a> {
    /// Double precision.
    F64(Cow<'a, [f64]>),
    /// Single precision.
    F32(Cow<'a, [f32]>),
    /// Whole numbers.
    U32(Cow<'a, [u32]>),
}

/// The kind of numbers of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    F64,
    F32,
    U32,
}

impl Kind {
    /// Bytes of one number.
    pub(super) fn size(self) -> usize {
        if self == Self::F64 { 8 } else { 4 }
    }
}

impl Numbers<'_> {
    pub(super) fn kind(&self) -> Kind {
        match self {
            Self::F64(_) => Kind::F64,
            Self::F32(_) => Kind::F32,
            Self::U32(_) => Kind::U32,
        }
    }

    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::U32(values) => values.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Byte `k` of every number.
    fn plane(&self, k: usize) -> Vec<u8> {
        match self {
            Self::F64(values) => values.iter().map(|x| (x.to_bits() >> (8 * k)) as u8).collect(),
            Self::F32(values) => values.iter().map(|x| (x.to_bits() >> (8 * k)) as u8).collect(),
            Self::U32(values) => values.iter().map(|x| (x >> (8 * k)) as u8).collect(),
        }
    }

    fn plain(&self) -> Vec<u8> {
        match self {
            Self::F64(values) => values.iter().flat_map(|x| x.to_le_bytes()).collect(),
            Self::F32(values) => values.iter().flat_map(|x| x.to_le_bytes()).collect(),
            Self::U32(values) => values.iter().flat_map(|x| x.to_le_bytes()).collect(),
        }
    }

    fn of_bits(kind: Kind, bits: &[u64]) -> Numbers<'static> {
        match kind {
            Kind::F64 => Numbers::F64(bits.iter().map(|&b| f64::from_bits(b)).collect()),
            Kind::F32 => Numbers::F32(bits.iter().map(|&b| f32::from_bits(b as u32)).collect()),
            Kind::U32 => Numbers::U32(bits.iter().map(|&b| b as u32).collect()),
        }
    }
}

/// A column as the bytes of a file; packing is the part that computes, and columns may be packed at the same time.
#[derive(Debug, Clone)]
pub struct Packed {
    pub(super) kind: Kind,
    pub(super) count: usize,
    pub(super) planes: bool,
    pub(super) bytes: Vec<u8>,
}

impl Packed {
    /// A large column, cut into planes.
    #[must_use]
    pub fn planes(numbers: &Numbers<'_>) -> Self {
        let mut bytes = Vec::new();
        for k in 0..numbers.kind().size() {
            let plane = numbers.plane(k);
            let deflated = if is_worth_it(&plane) { deflated(&plane) } else { None };
            let (mark, body) = match deflated.filter(|smaller| smaller.len() < plane.len()) {
                Some(smaller) => (DEFLATED, smaller),
                None => (STORED, plane),
            };
            bytes.push(mark);
            bytes.extend((body.len() as u64).to_le_bytes());
            bytes.extend(body);
        }
        Self { kind: numbers.kind(), count: numbers.len(), planes: true, bytes }
    }

    /// A small column, as it is.
    #[must_use]
    pub fn plain(numbers: &Numbers<'_>) -> Self {
        Self { kind: numbers.kind(), count: numbers.len(), planes: false, bytes: numbers.plain() }
    }
}

/// Whether samples of a plane get smaller.
fn is_worth_it(plane: &[u8]) -> bool {
    if plane.len() < 8 * SAMPLE {
        return true;
    }
    let starts = [0, plane.len() / 2, plane.len() - SAMPLE];
    let sampled = starts.iter().filter_map(|&at| deflated(&plane[at..at + SAMPLE]));
    (sampled.map(|s| s.len()).sum::<usize>() as f64) < WORTH * (starts.len() * SAMPLE) as f64
}

/// Writing to memory does not fail; if it does, the plane is stored.
fn deflated(plane: &[u8]) -> Option<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(plane).ok()?;
    encoder.finish().ok()
}

/// The numbers of a column of which the file says this; `count` has been found reasonable.
pub(super) fn unpacked(
    kind: Kind,
    count: usize,
    planes: bool,
    bytes: &[u8],
) -> Result<Numbers<'static>, String> {
    let mut bits = vec![0_u64; count];
    if planes {
        let mut rest = bytes;
        for k in 0..kind.size() {
            let plane = next_plane(&mut rest, count)?;
            for (bits, byte) in bits.iter_mut().zip(plane.iter()) {
                *bits |= u64::from(*byte) << (8 * k);
            }
        }
        if !rest.is_empty() {
            return Err("there are more planes than bytes in a number".to_string());
        }
    } else {
        for (bits, number) in bits.iter_mut().zip(bytes.chunks_exact(kind.size())) {
            *bits = number.iter().rev().fold(0, |bits, &byte| bits << 8 | u64::from(byte));
        }
    }
    Ok(Numbers::of_bits(kind, &bits))
}

/// Takes the next plane off the front.
fn next_plane<'a>(rest: &mut &'a [u8], count: usize) -> Result<Cow<'a, [u8]>, String> {
    let short = || "a plane is cut off".to_string();
    let (&mark, after) = rest.split_first().ok_or_else(short)?;
    let (length, after) = after.split_first_chunk::<8>().ok_or_else(short)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| short())?;
    let (body, after) = after.split_at_checked(length).ok_or_else(short)?;
    *rest = after;
    let plane = match mark {
        STORED => Cow::Borrowed(body),
        DEFLATED => {
            let mut plane = Vec::with_capacity(count);
            // One byte more than there should be, so that too many are seen.
            let inflated = ZlibDecoder::new(body).take(count as u64 + 1).read_to_end(&mut plane);
            inflated.map_err(|error| format!("a plane cannot be inflated: {error}"))?;
            Cow::Owned(plane)
        }
        other => return Err(format!("{other} is no kind of plane")),
    };
    if plane.len() == count { Ok(plane) } else { Err("a plane is not as long as its column".to_string()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn there_and_back(numbers: &Numbers<'_>) -> usize {
        for packed in [Packed::planes(numbers), Packed::plain(numbers)] {
            let back = unpacked(packed.kind, packed.count, packed.planes, &packed.bytes).unwrap();
            assert_eq!(back.plain(), numbers.plain());
        }
        Packed::planes(numbers).bytes.len()
    }

    #[test]
    fn every_bit_comes_back_and_what_has_a_pattern_gets_smaller() {
        let odd =
            [f64::NAN, -0.0, f64::INFINITY, f64::MIN_POSITIVE / 4.0, f64::from_bits(0x7ff0_0000_0000_0001)];
        there_and_back(&Numbers::F64(odd.as_slice().into()));
        there_and_back(&Numbers::F64(Vec::new().into()));
        let n = 100_000;
        let wave: Vec<f64> = (0..n).map(|i| (f64::from(i) * 1e-3).sin()).collect();
        let smooth = there_and_back(&Numbers::F64(wave.as_slice().into()));
        // The exponent and the first bits of the mantissa of a smooth column repeat: about two of eight planes go.
        assert!(smooth < 7 * n as usize, "{smooth}");
        let single: Vec<f32> = wave.iter().map(|&x| x as f32).collect();
        assert!(there_and_back(&Numbers::F32(single.into())) < 4 * n as usize);
        let ids: Vec<u32> = (0..n as u32).collect();
        assert!(there_and_back(&Numbers::U32(ids.into())) < 2 * n as usize);
        assert!(there_and_back(&Numbers::F64(vec![1.1; n as usize].into())) < 10_000);
    }
}
