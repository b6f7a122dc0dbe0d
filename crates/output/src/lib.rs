//! What a run leaves behind: ParaView files, probe tables, summary and manifest.
//!
//! Everything here takes plain data (numbers, names, units) and writes files; it knows no physics. The
//! promise of this crate is that a result directory is readable at any moment, also when the run was
//! killed or the disk filled up: every file but the probe tables is written beside its place and moved
//! there in one step, and probe tables only grow at their end. A [`checkpoint`] holds how long they were, so that a run that goes on
//! drops what came after it.
//!
//! ```
//! use output::{Array, Frame, ResultDir, Series, Values};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let scratch = tempfile::tempdir()?;
//! let results = ResultDir::create(&scratch.path().join("plate"))?;
//! let mut series = Series::create(&results)?;
//! series.write(&Frame {
//!     time: 0.0,
//!     step: 0,
//!     points: vec![[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]],
//!     arrays: vec![Array::scalar("Pressure", "Pa", Values::F64(vec![1.0, 2.0]))],
//! })?;
//! assert!(results.path().join("particles/particles_000000.vtp").exists());
//! # Ok(())
//! # }
//! ```

mod directory;
mod error;
mod frame;
mod listing;
mod nullable;
mod probe;
mod reference;
mod series;
mod vtp;

pub mod checkpoint;
pub mod limited;
pub mod manifest;
pub mod summary;

pub use directory::{ResultDir, write_atomically};
pub use error::OutputError;
pub use frame::{Array, Frame, Values};
pub use listing::{Listed, Listing};
pub use manifest::Manifest;
pub use probe::{Column, Mark, ProbeTable, Table, table_beside, table_path};
pub use reference::Reference;
pub use series::Series;
pub use summary::Summary;
pub use vtp::{FrameFile, Rehearsal, write_frame};
