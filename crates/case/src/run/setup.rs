//! How a run begins: anew, or from a checkpoint.

use super::checkpoint::{self, Found, Settling};
use super::error::RunError;
use super::kept;
use super::recorder::Remembered;
use super::writer::Writer;
use crate::Case;
use crate::build::{Built, ProbePoint, Watch};
use output::checkpoint::About;
use output::manifest::{Machine, Resumed};
use output::{Manifest, ResultDir};
use taut::run::InstructionSet;
use taut::simulation::{Numbers, Simulation};

/// Everything that the loop needs.
pub struct Setup<'a> {
    /// The simulation, begun if `remembered`.
    pub simulation: Simulation,
    /// Where the probes are.
    pub probes: Vec<ProbePoint>,
    /// The files.
    pub writer: Writer<'a>,
    /// What a checkpoint remembered.
    pub remembered: Option<Remembered>,
    /// Where a quasi-static run stood there.
    pub settling: Option<Settling>,
    /// Wall time before, s.
    pub before: f64,
    /// What is computed with.
    pub numbers: Numbers,
    /// Particles across the thinnest part of each body.
    pub across: Vec<usize>,
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
    let mut manifest = Manifest::new(case.case_text_as_run(), machine(), threads, precision);
    manifest.files = kept::keep(case, results)?;
    manifest.write(results)?;
    let (simulation, rest) = simulation(built);
    let Rest { probes, watch, numbers, warnings, across } = rest;
    let writer = Writer::create(case, results, (watch, About::of(&manifest)), warnings)?;
    Ok(Setup { simulation, probes, writer, remembered: None, settling: None, before: 0.0, numbers, across })
}

/// What is built beside the simulation.
struct Rest {
    probes: Vec<ProbePoint>,
    watch: Box<dyn Watch>,
    numbers: Numbers,
    warnings: Vec<String>,
    across: Vec<usize>,
}

/// The simulation as it is built, not begun.
fn simulation(built: Built) -> (Simulation, Rest) {
    let Built { solvers, contact, drives, grips, damping, probes, watch, numbers, warnings, across, .. } =
        built;
    let mut simulation = Simulation::new(solvers, drives).damped(damping).touching(contact);
    simulation.hold(grips);
    (simulation, Rest { probes, watch, numbers, warnings, across })
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
    let (mut simulation, rest) = simulation(built);
    let Rest { probes, watch, numbers, across, .. } = rest;
    let unfit = |reason: String| {
        let hint = found.other(results.path(), (case, &manifest));
        RunError::Checkpoint { path: found.path.clone(), reason, hint }
    };
    checkpoint::resume(&mut simulation, &found.checkpoint).map_err(|error| unfit(error.to_string()))?;
    let remembered = checkpoint::remembered(&found.checkpoint).map_err(unfit)?;
    let settles = case.quasi_static.map(|_| Settling::of(&found.checkpoint));
    let settling = settles.transpose().map_err(unfit)?;
    if !remembered.fits(probes.len(), case.boundaries.len()) {
        return Err(unfit("it has another number of probes or boundaries".to_string()));
    }
    found.clear(results)?;
    let About { step, wall_seconds: before, .. } = found.checkpoint.about;
    let mut manifest = manifest;
    manifest.resumed.push(Resumed::now(step, machine(), rayon::current_num_threads()));
    manifest.write(results)?;
    let about = About { instruction_set: machine().instruction_set, ..About::of(&manifest) };
    let writer = Writer::reopen(case, results, (watch, about), (found.books, found.notes))?;
    Ok(Setup { simulation, probes, writer, remembered: Some(remembered), settling, before, numbers, across })
}
