//! Taking a checkpoint apart, without believing it.

use super::column::unpacked;
use super::{About, CHECK, Entry, FIXED, FORMAT, Head, MAGIC, Numbers};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use xxhash_rust::xxh3::xxh3_128;

/// Why a file is not a checkpoint that can be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Damage {
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// It does not begin as one.
    #[error("it is no checkpoint")]
    Other,
    /// It is of another format.
    #[error("its format is number {0}, and this version of taut reads number {FORMAT}")]
    Format(u32),
    /// Its end is missing.
    #[error("it is cut off: {found} bytes are left of {stated}")]
    CutOff {
        /// Bytes there.
        found: u64,
        /// Bytes that there should be.
        stated: u64,
    },
    /// The checksum does not fit.
    #[error("it is damaged: its checksum does not fit its contents")]
    Checksum,
    /// Its parts do not fit together, although the checksum does.
    #[error("its contents make no sense: {0}")]
    Nonsense(String),
}

/// A checkpoint in memory, as it is in the file.
#[derive(Debug)]
pub struct Checkpoint {
    /// What it was taken from.
    pub about: About,
    /// Notes of whoever wrote it.
    pub notes: serde_json::Value,
    columns: BTreeMap<String, (Entry, Range<usize>)>,
    bytes: Vec<u8>,
}

impl Checkpoint {
    /// Reads a file.
    ///
    /// # Errors
    /// Whatever is wrong with it.
    pub fn read(path: &Path) -> Result<Self, Damage> {
        let unreadable = |error: std::io::Error| Damage::Unreadable(error.to_string());
        // A device or a pipe may have no end.
        if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
            return Err(Damage::Other);
        }
        Self::of(std::fs::read(path).map_err(unreadable)?)
    }

    /// Takes the bytes of a file.
    ///
    /// # Errors
    /// Whatever is wrong with them.
    pub fn of(bytes: Vec<u8>) -> Result<Self, Damage> {
        let head_end = checked(&bytes)?;
        let head = &bytes[FIXED..head_end];
        let head: Head = serde_json::from_slice(head).map_err(|error| Damage::Nonsense(error.to_string()))?;
        let mut columns = BTreeMap::new();
        let (mut at, end) = (head_end, bytes.len() - CHECK);
        for entry in head.columns {
            let stated = usize::try_from(entry.bytes).ok().and_then(|n| at.checked_add(n));
            let next = stated.filter(|&next| next <= end).ok_or_else(|| beyond(&entry.name))?;
            let plain = (entry.kind.size() as u64).checked_mul(entry.count);
            if !entry.planes && plain != Some(entry.bytes) {
                return Err(beyond(&entry.name));
            }
            if columns.insert(entry.name.clone(), (entry, at..next)).is_some() {
                return Err(Damage::Nonsense("a name is there twice".to_string()));
            }
            at = next;
        }
        if at != end {
            return Err(Damage::Nonsense("there are bytes that belong to no column".to_string()));
        }
        Ok(Self { about: head.about, notes: head.notes, columns, bytes })
    }

    /// The column of a name, if it has at most so many numbers.
    ///
    /// # Errors
    /// If it is not there, is longer, or cannot be unpacked.
    pub fn take(&self, name: &str, most: usize) -> Result<Numbers<'static>, String> {
        let (entry, range) = self.columns.get(name).ok_or_else(|| "it is not there".to_string())?;
        let count = usize::try_from(entry.count).ok().filter(|&count| count <= most);
        let count = count.ok_or_else(|| format!("{} numbers instead of {most}", entry.count))?;
        unpacked(entry.kind, count, entry.planes, &self.bytes[range.clone()])
    }

    /// The numbers that [`Draft::add`](super::Draft::add) wrote, however many.
    ///
    /// # Errors
    /// As [`Checkpoint::take`]; numbers that are not as they are in memory are not taken.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, String> {
        let plain = self.columns.get(name).filter(|(entry, _)| !entry.planes);
        let most = plain.map_or(0, |(_, range)| range.len() / 8);
        match self.take(name, most)? {
            Numbers::F64(values) => Ok(values.into_owned()),
            _ => Err("it is not in double precision".to_string()),
        }
    }
}

fn beyond(name: &str) -> Damage {
    Damage::Nonsense(format!("`{name}` is not as long as its head says"))
}

/// Compares the fixed part and the checksum; the end of the head.
fn checked(bytes: &[u8]) -> Result<usize, Damage> {
    if !bytes.starts_with(&MAGIC) {
        // Nothing at all is what a disk leaves that lost power.
        return Err(if bytes.is_empty() {
            Damage::CutOff { found: 0, stated: FIXED as u64 }
        } else {
            Damage::Other
        });
    }
    let found = bytes.len() as u64;
    let short = Damage::CutOff { found, stated: FIXED as u64 };
    let word = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let (Some(format), Some(head), Some(low), Some(high)) = (word(8), word(12), word(16), word(20)) else {
        return Err(short);
    };
    if format != FORMAT {
        return Err(Damage::Format(format));
    }
    let stated = u64::from(high) << 32 | u64::from(low);
    if found < stated {
        return Err(Damage::CutOff { found, stated });
    }
    let end = bytes.len().checked_sub(CHECK).filter(|&end| end >= FIXED).ok_or(short)?;
    if found > stated || xxh3_128(&bytes[..end]).to_le_bytes() != bytes[end..] {
        return Err(Damage::Checksum);
    }
    let head_end = FIXED + head as usize;
    if head_end > end {
        Err(Damage::Nonsense("its head is longer than itself".to_string()))
    } else {
        Ok(head_end)
    }
}
