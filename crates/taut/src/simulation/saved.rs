//! A simulation taken apart, and put together again.

use super::{Drive, Simulation, Solver};
use crate::particles::saved::{Part, RestoreError, Shelf};

impl Simulation {
    /// Everything that the next step depends on: clock, solvers, drives. Between two steps.
    #[must_use]
    pub fn save(&self) -> Vec<Part<'_>> {
        let mut parts = vec![Part::numbers("clock", &[self.time, self.dt, self.steps as f64])];
        for (i, solver) in self.solvers.iter().enumerate() {
            parts.extend(solver.save().into_iter().map(|part| part.within(&solver_level(i))));
        }
        for (i, drive) in self.drives.iter().enumerate() {
            parts.extend(drive.save().into_iter().map(|part| part.within(&drive_level(i))));
        }
        parts
    }

    /// The simulation that [`Simulation::save`] was taken from, made of solvers and drives that were built in the same way and have not
    /// begun. It goes on bit by bit, with any number of threads.
    ///
    /// # Errors
    /// If a part is not there or does not fit, or belongs to other particles.
    pub fn resume(
        solvers: Vec<Box<dyn Solver>>,
        drives: Vec<Box<dyn Drive>>,
        shelf: &mut Shelf<'_>,
    ) -> Result<Self, RestoreError> {
        let mut simulation = Self::new(solvers, drives);
        let [time, dt, steps] = shelf.numbers("clock")?;
        if !(dt > 0.0 && time >= 0.0) {
            return Err(shelf.unfit("clock", "no time or no step"));
        }
        (simulation.time, simulation.dt, simulation.steps) = (time, dt, shelf.count("clock", steps)?);
        for (i, solver) in simulation.solvers.iter_mut().enumerate() {
            shelf.enter(&solver_level(i));
            solver.restore(shelf)?;
        }
        for (i, drive) in simulation.drives.iter_mut().enumerate() {
            shelf.enter(&drive_level(i));
            drive.restore(shelf)?;
        }
        shelf.enter("");
        Ok(simulation)
    }
}

fn solver_level(i: usize) -> String {
    format!("solver-{i}")
}

fn drive_level(i: usize) -> String {
    format!("drive-{i}")
}
