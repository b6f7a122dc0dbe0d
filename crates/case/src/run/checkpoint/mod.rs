//! Checkpoints of a run, and going on from one.
//!
//! A checkpoint goes through the writer like everything else: the run packs the state of the simulation and what it has to remember
//! itself, the writer adds its books and how long the tables are at that moment, and writes the file. So a checkpoint always fits what
//! is on disk before it.
//!
//! To write one now, from wherever the run's [`Recorder`](super::recorder::Recorder) is at hand: `recorder.checkpoint(&simulation, wall)`.
//! It is written in the order of the sheets, between two steps of the simulation only.
//!
//! Who adds state: a solver or a drive gives it in its `save` and takes it in `restore`; the recorder and the writer beside their
//! other state, in [`books`]. The property tests of `taut` and the tests of the program compare the bits.

mod books;
mod interrupted;
mod schedule;
mod state;
mod stop;

pub use interrupted::{Interrupted, ResumeError};
pub use schedule::Schedule;
pub use stop::Stop;

pub(super) use interrupted::Found;

pub(super) use books::{Books, Notes, Settling, TOTALS, of_totals, remember, remembered, totals};
pub(super) use state::{Saving, draft, resume};

use std::time::Duration;

/// Wall time between two checkpoints, unless said otherwise. It becomes longer where they would take more than a hundredth of the run.
pub const INTERVAL: Duration = Duration::from_secs(300);

/// When checkpoints are written.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    /// Wall time between two of them; [`INTERVAL`] if `None`.
    pub every: Option<Duration>,
    /// Asks the run to write one and to stop.
    pub stop: Stop,
}
