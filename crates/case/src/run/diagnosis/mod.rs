//! What a run that stopped leaves to understand it by: `diagnosis.md`, and the neighbourhood of the culprit for ParaView.

mod culprit;
mod facts;
mod likely;
mod page;
mod tries;

use super::writer::Writer;
use crate::Case;
use culprit::Culprit;
use facts::Facts;
use output::{OutputError, ResultDir};
use taut::integrator::Diverged;
use taut::simulation::Simulation;

/// What a diagnosis is made of.
pub struct Evidence<'a> {
    /// The case.
    pub case: &'a Case,
    /// Particles across the thinnest part of each body.
    pub across: &'a [usize],
    /// The simulation, as it stopped.
    pub simulation: &'a Simulation,
    /// What was written.
    pub writer: &'a Writer<'a>,
    /// Why it stopped.
    pub diverged: &'a Diverged,
}

impl Evidence<'_> {
    /// Writes `diagnosis.md` and `culprit.vtp`.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn write(&self, results: &ResultDir) -> Result<(), OutputError> {
        let culprit = Culprit::find(self.simulation, self.diverged);
        let pictured = match &culprit {
            Some(culprit) => {
                results.write_frame("culprit.vtp", &culprit.frame(self.simulation))?;
                true
            }
            None => false,
        };
        let checkpoint =
            output::checkpoint::kept(results.path()).first().map(|path| path.display().to_string());
        let kept = page::Kept { pictured, checkpoint };
        let facts = Facts::gather(self, culprit.as_ref());
        results.write("diagnosis.md", page::page(self, &facts, &kept).as_bytes())?;
        Ok(())
    }
}
