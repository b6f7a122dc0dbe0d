//! A simulation: bodies that share one clock.

mod audit;
// Unit tests have no use for all combinations of formulation, material, dimension and numbers, which take minutes to compile.
#[cfg(not(test))]
mod body;
mod guard;
mod history;
mod particles;
mod snapshot;

pub use audit::{Audit, Grip};
#[cfg(not(test))]
pub use body::{InSpace, Law, Numbers, Points, TotalForm, UpdatedForm, total_body, updated_bodies};
pub use guard::{COLLAPSE, GAIN, Guard};
pub use history::{History, Step};
pub use particles::{Point, total, updated};
pub use snapshot::{Snapshot, Totals};

pub use crate::integrator::{Seen, Solver};

use crate::integrator::Diverged;
use crate::pass::Now;

/// Something outside that acts on the bodies before every step: prescribed motion, body force in time.
pub trait Drive: Send {
    /// Sets fields for the step that begins at `now.t` and lasts `now.dt`.
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>);

    /// Calls `mark(solver, id)` for every particle whose body force it changes.
    fn pulls(&self, _mark: &mut dyn FnMut(usize, u32)) {}
}

/// Bodies, what drives them, and the clock.
pub struct Simulation {
    solvers: Vec<Box<dyn Solver>>,
    drives: Vec<Box<dyn Drive>>,
    audit: Audit,
    guard: Guard,
    history: History,
    time: f64,
    dt: f64,
    steps: u64,
}

impl Simulation {
    /// Prepares the first step.
    ///
    /// # Errors
    /// If the initial state is not finite.
    pub fn start(solvers: Vec<Box<dyn Solver>>, drives: Vec<Box<dyn Drive>>) -> Result<Self, Diverged> {
        let mut simulation = Self::new(solvers, drives);
        simulation.begin()?;
        Ok(simulation)
    }

    /// A simulation that has yet to [`begin`](Self::begin).
    #[must_use]
    pub fn new(solvers: Vec<Box<dyn Solver>>, drives: Vec<Box<dyn Drive>>) -> Self {
        let (audit, guard, history) = (Audit::default(), Guard::default(), History::new());
        Self { solvers, drives, audit, guard, history, time: 0.0, dt: 0.0, steps: 0 }
    }

    /// Names the constraints whose reactions are wanted one by one, before the start.
    pub fn hold(&mut self, grips: Vec<Grip>) {
        self.audit.name(grips);
    }

    /// Prepares the first step; once.
    ///
    /// # Errors
    /// If the initial state is not finite. It can be looked at all the same.
    pub fn begin(&mut self) -> Result<(), Diverged> {
        let mut first = 0;
        for solver in &mut self.solvers {
            solver.start().map_err(|diverged| diverged.after(first))?;
            first += solver.len() as u32;
        }
        self.audit.start(&self.solvers, &self.drives);
        let (at_bound, dt) = self.stable_step();
        self.dt = dt;
        self.guard = Guard::start(&self.solvers, dt);
        self.remember((at_bound, dt));
        for solver in &mut self.solvers {
            solver.begin(self.dt);
        }
        Ok(())
    }

    /// The solver that asks for the shortest step, and that step.
    fn stable_step(&self) -> (usize, f64) {
        let steps = self.solvers.iter().map(|s| s.stable_step()).enumerate();
        steps.fold((0, f64::INFINITY), |least, step| if step.1 < least.1 { step } else { least })
    }

    /// Takes down the step that comes next, which a solver asked for.
    fn remember(&mut self, (solver, dt): (usize, f64)) {
        let Some(at_bound) = self.solvers.get(solver) else { return };
        let bounding = at_bound.bounding();
        let step = Step { number: self.steps + 1, time: self.time, dt, solver, bounding, particle: None };
        self.history.note(step, at_bound.as_ref());
    }

    /// One step of all bodies.
    ///
    /// # Errors
    /// If a body has left its bounds; names particle, field, time and the likely cause.
    pub fn step(&mut self) -> Result<(), Diverged> {
        let (now, step) = (Now { t: self.time, dt: self.dt }, self.steps + 1);
        self.halves(now).map_err(|diverged| Diverged { time: now.t + now.dt, step, ..diverged })
    }

    fn halves(&mut self, now: Now<f64>) -> Result<(), Diverged> {
        for drive in &mut self.drives {
            drive.apply(&mut self.solvers, now);
        }
        let mut first = 0;
        for (index, solver) in self.solvers.iter_mut().enumerate() {
            solver.advance(now).map_err(|diverged| diverged.after(first))?;
            self.audit.advanced(index, solver.as_ref(), now.dt);
            first += solver.len() as u32;
        }
        let (at_bound, next) = self.stable_step();
        self.guard.step(&self.solvers, (at_bound, next))?;
        for solver in &mut self.solvers {
            solver.finish(now, next)?;
        }
        self.time += now.dt;
        self.steps += 1;
        self.dt = next;
        self.remember((at_bound, next));
        self.guard.look(self.steps, &self.solvers)
    }

    /// The bodies.
    #[must_use]
    pub fn solvers(&self) -> &[Box<dyn Solver>] {
        &self.solvers
    }

    /// The steps that were taken last, and the one that comes next.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// What has come from outside.
    #[must_use]
    pub fn audit(&self) -> &Audit {
        &self.audit
    }

    /// Time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The step that comes next, s.
    #[must_use]
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }
}
