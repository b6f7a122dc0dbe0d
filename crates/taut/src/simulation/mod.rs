//! A simulation: bodies that share one clock.

mod particles;
mod snapshot;

pub use particles::{Point, total, updated};
pub use snapshot::{Snapshot, Totals};

use crate::field::Quantity;
use crate::formulation::State;
use crate::integrator::Diverged;
use crate::pass::Now;

/// Bodies that one formulation advances: one virtual call for each half of a step.
pub trait Solver: Send {
    /// 2 or 3.
    fn dimension(&self) -> usize;
    /// How many particles.
    fn len(&self) -> usize;
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The id of the particle stored at each place.
    fn ids(&self) -> &[u32];
    /// Mean number of neighbours.
    fn neighbours(&self) -> f64;

    /// Makes lists and first rates.
    ///
    /// # Errors
    /// If the initial state is not finite.
    fn start(&mut self) -> Result<(), Diverged>;
    /// Moves what runs half a step ahead, before the first step `dt`.
    fn begin(&mut self, dt: f64);
    /// The longest stable step now, s.
    fn stable_step(&self) -> f64;
    /// The step up to where the next one can be known.
    ///
    /// # Errors
    /// If the state has left its bounds.
    fn advance(&mut self, now: Now<f64>) -> Result<(), Diverged>;
    /// The rest of the step, when the next one is known.
    ///
    /// # Errors
    /// If the state has left its bounds.
    fn finish(&mut self, now: Now<f64>, next: f64) -> Result<(), Diverged>;

    /// A vector field of the particle stored at `place`, at the present time; components beyond the dimension are 0.
    fn read(&self, field: Quantity, place: usize) -> [f64; 3];
    /// Sets a vector field of the particle stored at `place`.
    fn write(&mut self, field: Quantity, place: usize, value: [f64; 3]);
    /// A scalar field of the particle stored at `place`.
    fn scalar(&self, field: Quantity, place: usize) -> f64;
    /// Stress and energy of the particle stored at `place`.
    fn state(&self, place: usize) -> State;
}

/// Something outside that acts on the bodies before every step: prescribed motion, body force in time.
pub trait Drive: Send {
    /// Sets fields for the step that begins at `now.t` and lasts `now.dt`.
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>);
}

/// Bodies, what drives them, and the clock.
pub struct Simulation {
    solvers: Vec<Box<dyn Solver>>,
    drives: Vec<Box<dyn Drive>>,
    time: f64,
    dt: f64,
    steps: u64,
}

impl Simulation {
    /// Prepares the first step.
    ///
    /// # Errors
    /// If the initial state is not finite.
    pub fn start(mut solvers: Vec<Box<dyn Solver>>, drives: Vec<Box<dyn Drive>>) -> Result<Self, Diverged> {
        for solver in &mut solvers {
            solver.start()?;
        }
        let mut simulation = Self { solvers, drives, time: 0.0, dt: 0.0, steps: 0 };
        simulation.dt = simulation.stable_step();
        for solver in &mut simulation.solvers {
            solver.begin(simulation.dt);
        }
        Ok(simulation)
    }

    fn stable_step(&self) -> f64 {
        self.solvers.iter().map(|s| s.stable_step()).fold(f64::INFINITY, f64::min)
    }

    /// One step of all bodies.
    ///
    /// # Errors
    /// If a body has left its bounds; names particle, field, time and the likely cause.
    pub fn step(&mut self) -> Result<(), Diverged> {
        let now = Now { t: self.time, dt: self.dt };
        self.halves(now).map_err(|diverged| Diverged {
            time: now.t + now.dt,
            step: self.steps + 1,
            ..diverged
        })
    }

    fn halves(&mut self, now: Now<f64>) -> Result<(), Diverged> {
        for drive in &mut self.drives {
            drive.apply(&mut self.solvers, now);
        }
        for solver in &mut self.solvers {
            solver.advance(now)?;
        }
        let next = self.stable_step();
        for solver in &mut self.solvers {
            solver.finish(now, next)?;
        }
        self.time += now.dt;
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
