//! What became of the increments of a quasi-static run.

use super::error::RunError;
use crate::Case;
use output::summary::Settled;
use output::{OutputError, ProbeTable, ResultDir};
use taut::simulation::{Balance, Increment};

/// The increments so far, and their table.
pub struct Convergence {
    table: ProbeTable,
    increments: Vec<Increment>,
    failed: Option<OutputError>,
}

impl Convergence {
    /// Opens `convergence.csv`.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn create(results: &ResultDir) -> Result<Self, RunError> {
        let columns =
            [("increment", "1"), ("steps", "1"), ("force", "1"), ("motion", "1"), ("converged", "1")];
        let table = ProbeTable::beside_summary(results, "convergence", &columns)?;
        Ok(Self { table, increments: Vec::new(), failed: None })
    }

    /// As it was when [`Convergence::saved`] gave these numbers; the table is written anew.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn again(results: &ResultDir, saved: &[f64]) -> Result<Self, RunError> {
        let mut new = Self::create(results)?;
        for &[number, time, steps, force, motion, converged] in saved.as_chunks::<6>().0 {
            let (number, steps) = (number as u32, steps as u64);
            let balance = Balance { force, motion };
            new.push(Increment { number, time, steps, balance, converged: converged != 0.0 });
        }
        Ok(new)
    }

    /// The increments so far, as numbers.
    pub fn saved(&self) -> Vec<f64> {
        let one = |i: &Increment| {
            let converged = f64::from(u8::from(i.converged));
            [f64::from(i.number), i.time, i.steps as f64, i.balance.force, i.balance.motion, converged]
        };
        self.increments.iter().flat_map(one).collect()
    }

    /// Notes an increment. What cannot be written is told at the end of the run.
    pub fn push(&mut self, i: Increment) {
        let converged = f64::from(u8::from(i.converged));
        let row = [f64::from(i.number), i.steps as f64, i.balance.force, i.balance.motion, converged];
        let written = self.table.push(i.time, &row).and_then(|()| self.table.flush());
        self.failed = self.failed.take().or(written.err());
        self.increments.push(i);
    }

    /// What the summary says of it, and a warning if an increment did not come to rest.
    ///
    /// # Errors
    /// If its table could not be written.
    pub fn settled(self, case: &Case) -> Result<(Settled, Option<String>), RunError> {
        if let Some(cause) = self.failed {
            return Err(cause.into());
        }
        let settings =
            case.quasi_static.unwrap_or(crate::Statics { increments: 0, tolerance: 0.0, max_steps: 0 });
        let converged = self.increments.iter().filter(|i| i.converged).count() as u32;
        let worst = |of: fn(&Increment) -> f64| self.increments.iter().map(of).fold(0.0, f64::max);
        let settled = Settled {
            increments: settings.increments,
            converged,
            tolerance: settings.tolerance,
            worst_force: worst(|i| i.balance.force),
            worst_motion: worst(|i| i.balance.motion),
            history: self.increments.iter().map(|i| [i.time, i.steps as f64, i.balance.force]).collect(),
        };
        let first = self.increments.iter().find(|i| !i.converged);
        let warning = first.map(|i| {
            let count = self.increments.len() - converged as usize;
            format!(
                "{count} of {} increments did not come to rest in {} steps; the first is number {} (t = {:.6} s), with unbalanced forces of {:.2e} of the stress: take more increments or max_steps, or [damping]",
                settings.increments, settings.max_steps, i.number, i.time, i.balance.force
            )
        });
        Ok((settled, warning))
    }
}
