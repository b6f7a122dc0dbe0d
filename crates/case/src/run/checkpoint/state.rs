//! The state of a simulation, packed for a file and unpacked again.

use output::checkpoint::{Checkpoint, Draft, Numbers, Packed};
use rayon::prelude::*;
use taut::particles::saved::{Part, RestoreError, Shelf, Values};
use taut::simulation::Simulation;

/// A checkpoint on its way to the writer.
#[derive(Debug)]
pub struct Saving {
    /// What the run has put into it.
    pub draft: Draft,
    /// Steps taken.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// Wall time of the run so far, s.
    pub wall: f64,
}

/// The state of a simulation, packed by all threads of the pool.
pub fn draft(simulation: &Simulation) -> Draft {
    let packed = |part: Part<'_>| {
        let numbers = match part.values {
            Values::Double(values) => Numbers::F64(values),
            Values::Single(values) => Numbers::F32(values),
            Values::Whole(values) => Numbers::U32(values),
        };
        (part.name, Packed::planes(&numbers))
    };
    Draft::new(simulation.save().into_par_iter().map(packed).collect())
}

/// Takes a simulation that has not begun to where it was at a checkpoint.
///
/// # Errors
/// What does not fit.
pub fn resume(simulation: &mut Simulation, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
    let mut source = |name: &str, most: usize| {
        Ok(match checkpoint.take(name, most)? {
            Numbers::F64(values) => Values::Double(values),
            Numbers::F32(values) => Values::Single(values),
            Numbers::U32(values) => Values::Whole(values),
        })
    };
    simulation.resume(&mut Shelf::new(&mut source))
}
