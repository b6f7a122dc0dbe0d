//! Checkpoints: the whole state of a run in one file, from which it goes on.
//!
//! ```text
//! 8 bytes    magic: a bit that text loses, letters, an end of line
//! u32        number of the format
//! u32        length of the head
//! u64        length of the file
//! head       JSON: about the run, notes, name and size of every column
//! columns    one after the other
//! u128       XXH3 of everything before
//! ```
//!
//! Numbers stand as they are in memory, lowest byte first. Large columns are cut into planes (the first bytes of all numbers, the second
//! bytes, ...), and planes that have a pattern are deflated. A reader believes nothing: the checksum is compared first, and nothing is
//! allocated beyond what the file is long or the caller asked for.

mod column;
mod folder;
mod read;
mod write;

pub use column::{Numbers, Packed};
pub use folder::{Keeper, kept, set_aside};
pub use read::{Checkpoint, Damage};
pub use write::Draft;

use crate::Manifest;
use crate::manifest::hash;
use serde::{Deserialize, Serialize};

/// Changes whenever older files can no longer be read.
pub const FORMAT: u32 = 1;
/// Version of taut.
const VERSION: &str = env!("CARGO_PKG_VERSION");
const MAGIC: [u8; 8] = *b"\x89TAUTck\n";
/// Bytes before the head.
const FIXED: usize = 24;
/// Bytes of the checksum.
const CHECK: usize = 16;

/// What a checkpoint was taken from, and when.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Version of taut.
    pub taut: String,
    /// [`hash`] of the case as run.
    pub case_hash: String,
    /// `double` or `single`.
    pub precision: String,
    /// Vector instructions that the run used: only on the same the run goes on bit by bit.
    pub instruction_set: String,
    /// Steps taken.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// Wall time of the run so far, s.
    pub wall_seconds: f64,
    /// When it was written, UTC.
    pub written: String,
}

impl About {
    /// What checkpoints of the run of a manifest say; no step is taken yet.
    #[must_use]
    pub fn of(manifest: &Manifest) -> Self {
        Self {
            taut: VERSION.to_string(),
            case_hash: hash(manifest.case.as_bytes()),
            precision: manifest.precision.clone(),
            instruction_set: manifest.machine.instruction_set.clone(),
            step: 0,
            time: 0.0,
            wall_seconds: 0.0,
            written: String::new(),
        }
    }

    /// Why the run of a manifest cannot go on from this, if it cannot.
    #[must_use]
    pub fn foreign(&self, manifest: &Manifest) -> Option<String> {
        let run = Self::of(manifest);
        if self.taut != run.taut {
            return Some(format!("it was written by taut {}, and this is taut {}", self.taut, run.taut));
        }
        if self.case_hash != run.case_hash {
            return Some("it belongs to another case than the one in manifest.json".to_string());
        }
        (self.precision != run.precision).then(|| {
            format!("it holds numbers in {} precision, and the run is in {}", self.precision, run.precision)
        })
    }
}

#[derive(Debug, Serialize, Deserialize)]
struct Head {
    about: About,
    notes: serde_json::Value,
    columns: Vec<Entry>,
}

/// A column in the head.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Entry {
    name: String,
    kind: column::Kind,
    /// Numbers.
    count: u64,
    /// Whether it is cut into planes.
    planes: bool,
    /// Bytes in the file.
    bytes: u64,
}
