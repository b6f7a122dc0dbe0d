//! A simulation taken apart, and put together again.

use super::{Guard, Simulation};
use crate::particles::saved::{Part, RestoreError, Shelf};

impl Simulation {
    /// Everything that the next step depends on, and what has come from outside so far: clock, solvers, drives, books. Between two
    /// steps. What a quasi-static run remembers beside it is not among it: [`QuasiStatic::saved`](super::QuasiStatic::saved).
    #[must_use]
    pub fn save(&self) -> Vec<Part<'_>> {
        let mut parts = vec![
            Part::numbers("clock", &[self.time, self.dt, self.steps as f64]),
            Part::numbers("guard", &self.guard.saved()),
            Part::numbers("audit", &self.audit.saved()),
        ];
        if let Some(contact) = &self.contact {
            let memory = contact.memory();
            parts.push(Part::numbers("contact-length", &[memory.len() as f64]));
            parts.push(Part::numbers("contact", &memory));
        }
        for (i, solver) in self.solvers.iter().enumerate() {
            parts.extend(solver.save().into_iter().map(|part| part.within(&solver_level(i))));
        }
        for (i, drive) in self.drives.iter().enumerate() {
            parts.extend(drive.save().into_iter().map(|part| part.within(&drive_level(i))));
        }
        parts
    }

    /// Takes up where the simulation was that [`Simulation::save`] was taken from, instead of [`begin`](Self::begin): this one has been
    /// made in the same way. It goes on bit by bit, with any number of threads. The history of its time steps is forgotten.
    ///
    /// # Errors
    /// If a part is not there or does not fit, or belongs to other particles.
    pub fn resume(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        // Lists of the reference configuration, and what the books find out about the start, come from there.
        for solver in &mut self.solvers {
            solver.start().map_err(|_| RestoreError::Foreign("they cannot be started"))?;
        }
        if let Some(contact) = &mut self.contact {
            contact.begin(&self.solvers).map_err(|_| RestoreError::Foreign("they cannot be started"))?;
        }
        self.audit.start(&self.solvers, &self.drives, self.contact.is_some());
        let [time, dt, steps] = shelf.numbers("clock")?;
        if !(dt > 0.0 && time >= 0.0) {
            return Err(shelf.unfit("clock", "no time or no step"));
        }
        (self.time, self.dt, self.steps) = (time, dt, shelf.count("clock", steps)?);
        self.guard = Guard::restored(shelf.numbers("guard")?);
        let audit = shelf.doubles("audit", self.audit.saved().len())?;
        if !self.audit.restore(&audit) {
            return Err(shelf.unfit("audit", "other grips"));
        }
        for (i, solver) in self.solvers.iter_mut().enumerate() {
            shelf.enter(&solver_level(i));
            solver.restore(shelf)?;
        }
        for (i, drive) in self.drives.iter_mut().enumerate() {
            shelf.enter(&drive_level(i));
            drive.restore(shelf)?;
        }
        shelf.enter("");
        self.touch_again(shelf)?;
        let (at_bound, _) = self.stable_step();
        self.remember((at_bound, dt));
        Ok(())
    }

    /// Contact between bodies that are where they were.
    fn touch_again(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        let Some(contact) = &mut self.contact else { return Ok(()) };
        contact.relocate(&self.solvers).map_err(|_| RestoreError::Foreign("they cannot be started"))?;
        let [length] = shelf.numbers("contact-length")?;
        let length = shelf.count("contact-length", length)? as usize;
        if contact.recall(&shelf.doubles("contact", length)?) {
            return Ok(());
        }
        Err(shelf.unfit("contact", "no memory of contact"))
    }
}

fn solver_level(i: usize) -> String {
    format!("solver-{i}")
}

fn drive_level(i: usize) -> String {
    format!("drive-{i}")
}
