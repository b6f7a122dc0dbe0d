//! A simulation: bodies that share one clock.

// Unit tests have no use for all combinations of formulation, material, dimension and numbers, which take minutes to compile.
#[cfg(not(test))]
mod body;
mod damping;
mod particles;
mod quasi_static;
mod snapshot;

#[cfg(not(test))]
pub use body::{
    Calibration, InSpace, Law, Numbers, Points, TotalForm, UpdatedForm, total_body, updated_bodies,
};
pub use damping::{Damping, Kinetic, Splitting};
pub use particles::{Point, total, updated};
pub use quasi_static::{Balance, Increment, Increments, QuasiStatic};
pub use snapshot::{Snapshot, Totals};

pub use crate::integrator::{Seen, Solver};

use crate::integrator::Diverged;
use crate::pass::Now;
use quasi_static::Load;

/// Something outside that acts on the bodies before every step: prescribed motion, body force in time.
pub trait Drive: Send {
    /// Sets fields for the step that begins at `now.t` and lasts `now.dt`.
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>);
}

/// Bodies, what drives them, and the clock.
pub struct Simulation {
    solvers: Vec<Box<dyn Solver>>,
    drives: Vec<Box<dyn Drive>>,
    damping: Option<Box<dyn Damping>>,
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
        Self { solvers, drives, damping: None, time: 0.0, dt: 0.0, steps: 0 }
    }

    /// The same with its motion damped.
    #[must_use]
    pub fn damped(self, damping: Option<Box<dyn Damping>>) -> Self {
        Self { damping, ..self }
    }

    /// Prepares the first step; once.
    ///
    /// # Errors
    /// If the initial state is not finite. It can be looked at all the same.
    pub fn begin(&mut self) -> Result<(), Diverged> {
        for solver in &mut self.solvers {
            solver.start()?;
        }
        self.dt = self.stable_step();
        for solver in &mut self.solvers {
            solver.begin(self.dt);
        }
        Ok(())
    }

    fn stable_step(&self) -> f64 {
        self.solvers.iter().map(|s| s.stable_step()).fold(f64::INFINITY, f64::min)
    }

    /// One step of all bodies.
    ///
    /// # Errors
    /// If a body has left its bounds; names particle, field, time and the likely cause.
    pub fn step(&mut self) -> Result<(), Diverged> {
        self.step_with(None, None)
    }

    /// One step in which the load has a clock of its own, which is then that of the simulation.
    fn step_with(&mut self, load: Option<Load>, kinetic: Option<&mut Kinetic>) -> Result<(), Diverged> {
        let (before, dt) = (self.time, self.dt);
        self.halves(Now { t: before, dt }, load, kinetic).map_err(|diverged| Diverged {
            time: load.map_or(before + dt, |_| before),
            step: self.steps + 1,
            ..diverged
        })
    }

    fn drive(&mut self, now: Now<f64>) {
        for drive in &mut self.drives {
            drive.apply(&mut self.solvers, now);
        }
    }

    /// Moves the load on by what grips may move in a step of `dt`; what that is on the load's clock, s.
    fn drive_slowly(&mut self, dt: f64, load: Load) -> f64 {
        let mut pace = load.most.min(load.left / dt);
        // A clock that stands still has no differences: they are taken over a moment of the load and multiplied by nothing.
        let moment = |pace: f64| if pace > 0.0 { pace * dt } else { 1e-9 * self.time.max(dt) };
        let now = Now { t: self.time, dt: moment(pace) };
        self.drive(now);
        let mut bodies = self.solvers.iter_mut().filter_map(|solver| solver.relax());
        let driven = bodies.by_ref().map(|body| body.unrest().driven).fold(0.0, f64::max);
        if pace * driven > load.fastest {
            pace = load.fastest / driven;
            self.drive(Now { t: self.time, dt: pace * dt });
        }
        if driven > 0.0 {
            self.solvers.iter_mut().filter_map(|solver| solver.relax()).for_each(|body| body.pace(pace));
        }
        pace * dt
    }

    fn halves(
        &mut self,
        now: Now<f64>,
        load: Option<Load>,
        kinetic: Option<&mut Kinetic>,
    ) -> Result<(), Diverged> {
        let passed = match load {
            None => {
                self.drive(now);
                now.dt
            }
            Some(load) => self.drive_slowly(now.dt, load),
        };
        for solver in &mut self.solvers {
            solver.advance(now)?;
        }
        if let Some(damping) = &mut self.damping {
            damping.damp(&mut self.solvers, now, self.steps);
        }
        if let Some(kinetic) = kinetic {
            kinetic.damp(&mut self.solvers, now, self.steps);
        }
        let next = self.stable_step();
        for solver in &mut self.solvers {
            solver.finish(now, next)?;
        }
        self.time =
            load.filter(|load| passed >= load.left).map_or(self.time + passed, |load| self.time + load.left);
        self.steps += 1;
        self.dt = next;
        Ok(())
    }

    /// The bodies.
    #[must_use]
    pub fn solvers(&self) -> &[Box<dyn Solver>] {
        &self.solvers
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
