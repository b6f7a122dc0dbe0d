//! How a run begins: anew, or from a checkpoint.

use super::checkpoint::{self, Found};
use super::error::RunError;
use super::recorder::Due;
use super::writer::Writer;
use crate::Case;
use crate::build::{Built, ProbePoint};
use output::checkpoint::About;
use output::manifest::{Machine, Resumed};
use output::{Manifest, ResultDir};
use taut::run::InstructionSet;
use taut::simulation::{Numbers, Simulation, Totals};

/// Everything that the loop needs.
pub struct Setup<'a> {
    /// The simulation, begun if `remembered`.
    pub simulation: Simulation,
    /// Where the probes are.
    pub probes: Vec<ProbePoint>,
    /// The files.
    pub writer: Writer<'a>,
    /// What a checkpoint remembered.
    pub remembered: Option<(Due, Totals)>,
    /// Wall time before, s.
    pub before: f64,
    /// What is computed with.
    pub numbers: Numbers,
}

/// The machine, as a manifest says it.
fn machine() -> Machine {
    Machine::here(InstructionSet::best().name())
}

/// A run from the start: manifest, empty tables, particles as they are built.
///
/// # Errors
/// If something cannot be written.
pub fn anew<'a>(case: &'a Case, results: &ResultDir, built: Built) -> Result<Setup<'a>, RunError> {
    let (threads, precision) = (rayon::current_num_threads(), built.numbers.name());
    let manifest = Manifest::new(case.case_text_as_run(), machine(), threads, precision);
    manifest.write(results)?;
    let Built { solvers, drives, probes, watch, numbers, warnings, .. } = built;
    let writer = Writer::create(case, results, (watch, About::of(&manifest)), warnings)?;
    let simulation = Simulation::new(solvers, drives);
    Ok(Setup { simulation, probes, writer, remembered: None, before: 0.0, numbers })
}

/// A run from a checkpoint, which is no longer needed then. Nothing is written before everything fits.
///
/// # Errors
/// If the checkpoint does not fit the case, or something cannot be written.
pub fn again<'a>(
    (case, manifest): (&'a Case, Manifest),
    results: &ResultDir,
    found: Found,
    built: Built,
) -> Result<Setup<'a>, RunError> {
    let Built { solvers, drives, probes, watch, numbers, .. } = built;
    let unfit = |reason: String| {
        let hint = found.other(results.path(), (case, &manifest));
        RunError::Checkpoint { path: found.path.clone(), reason, hint }
    };
    let simulation =
        checkpoint::resume(solvers, drives, &found.checkpoint).map_err(|error| unfit(error.to_string()))?;
    let (due, start) = checkpoint::remembered(&found.checkpoint).map_err(unfit)?;
    if due.probes() != probes.len() {
        return Err(unfit("it has another number of probes".to_string()));
    }
    found.clear(results)?;
    let About { step, wall_seconds: before, .. } = found.checkpoint.about;
    let mut manifest = manifest;
    manifest.resumed.push(Resumed::now(step, machine(), rayon::current_num_threads()));
    manifest.write(results)?;
    let about = About { instruction_set: machine().instruction_set, ..About::of(&manifest) };
    let writer = Writer::reopen(case, results, (watch, about), (found.books, found.notes))?;
    Ok(Setup { simulation, probes, writer, remembered: Some((due, start)), before, numbers })
}
