//! A simulation: bodies that share one clock.

mod body;
mod particles;
mod snapshot;

pub use body::{InSpace, Law, Numbers, Points, TotalForm, UpdatedForm, total_body, updated_bodies};
pub use particles::{Point, total, updated};
pub use snapshot::{Snapshot, Totals};

pub use crate::integrator::{Motion, Pose, Rigid, Seen, Solver};

use crate::contact::Contact;
use crate::integrator::Diverged;
use crate::pass::Now;

/// Something outside that acts on the bodies before every step: prescribed motion, body force in time.
pub trait Drive: Send {
    /// Sets fields for the step that begins at `now.t` and lasts `now.dt`.
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>);
}

/// Bodies, what drives them, and the clock.
pub struct Simulation {
    solvers: Vec<Box<dyn Solver>>,
    drives: Vec<Box<dyn Drive>>,
    contact: Option<Contact>,
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
        Self { solvers, drives, contact: None, time: 0.0, dt: 0.0, steps: 0 }
    }

    /// The same with bodies that touch.
    #[must_use]
    pub fn touching(self, contact: Option<Contact>) -> Self {
        Self { contact, ..self }
    }

    /// Prepares the first step; once.
    ///
    /// # Errors
    /// If the initial state is not finite. It can be looked at all the same.
    pub fn begin(&mut self) -> Result<(), Diverged> {
        for solver in &mut self.solvers {
            solver.start()?;
        }
        if let Some(contact) = &mut self.contact {
            contact.begin(&self.solvers)?;
        }
        self.dt = self.stable_step();
        for solver in &mut self.solvers {
            solver.begin(self.dt);
        }
        Ok(())
    }

    /// Stiffnesses of bodies and contact add up, so squares of frequencies do at most: 1/dt^2 = 1/dt_bodies^2 + 1/dt_contact^2.
    fn stable_step(&self) -> f64 {
        let bodies = self.solvers.iter().map(|s| s.stable_step()).fold(f64::INFINITY, f64::min);
        let contact = self.contact.as_ref().map_or(f64::INFINITY, Contact::stable_step);
        bodies / (1.0 + (bodies / contact).powi(2)).sqrt()
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
        if let Some(contact) = &mut self.contact {
            contact.apply(&mut self.solvers, now)?;
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

    /// What bodies do to each other, if they touch.
    #[must_use]
    pub fn contact(&self) -> Option<&Contact> {
        self.contact.as_ref()
    }

    /// The same, to put back what it remembers.
    pub fn contact_mut(&mut self) -> Option<&mut Contact> {
        self.contact.as_mut()
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
