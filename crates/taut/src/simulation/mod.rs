//! A simulation: bodies that share one clock.

mod audit;
// Unit tests have no use for all combinations of formulation, material, dimension and numbers, which take minutes to compile.
#[cfg(not(test))]
mod body;
mod damping;
mod guard;
mod history;
mod particles;
mod quasi_static;
mod saved;
mod snapshot;

pub use audit::{Audit, Grip};
#[cfg(not(test))]
pub use body::{
    Calibration, EdgeForm, InSpace, Law, Numbers, Points, TotalForm, TotalModel, UpdatedForm,
    small_strain_body, total_body, updated_bodies,
};
pub use damping::{Damping, Kinetic, Splitting, Viscous};
pub use guard::{COLLAPSE, GAIN, Guard};
pub use history::{History, Step};
pub use particles::{Point, total, updated};
pub use quasi_static::{Balance, Increment, Increments, QuasiStatic};
pub use snapshot::{Snapshot, Totals};

pub use crate::integrator::{Motion, Pose, Rigid, Seen, Solver};

use crate::contact::Contact;
use crate::integrator::{Diverged, Impulse};
use crate::particles::saved::{Part, RestoreError, Shelf};
use crate::pass::Now;
use quasi_static::Load;

/// Something outside that acts on the bodies before every step: prescribed motion, body force in time.
pub trait Drive: Send {
    /// Sets fields for the step that begins at `now.t` and lasts `now.dt`.
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>);

    /// What it remembers from step to step; nothing, if it is a function of time.
    fn save(&self) -> Vec<Part<'_>> {
        Vec::new()
    }

    /// Puts back what [`Drive::save`] gave.
    ///
    /// # Errors
    /// If a part is not there or does not fit.
    fn restore(&mut self, _: &mut Shelf<'_>) -> Result<(), RestoreError> {
        Ok(())
    }

    /// Calls `mark(solver, id)` for every particle whose body force it changes.
    fn pulls(&self, _mark: &mut dyn FnMut(usize, u32)) {}
}

/// Bodies, what drives them, and the clock.
pub struct Simulation {
    solvers: Vec<Box<dyn Solver>>,
    drives: Vec<Box<dyn Drive>>,
    contact: Option<Contact>,
    audit: Audit,
    guard: Guard,
    history: History,
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
        let (audit, guard, history) = (Audit::default(), Guard::default(), History::new());
        let (damping, contact) = (None, None);
        Self { solvers, drives, damping, contact, audit, guard, history, time: 0.0, dt: 0.0, steps: 0 }
    }

    /// The same with bodies that touch.
    #[must_use]
    pub fn touching(self, contact: Option<Contact>) -> Self {
        Self { contact, ..self }
    }

    /// The same with its motion damped.
    #[must_use]
    pub fn damped(self, damping: Option<Box<dyn Damping>>) -> Self {
        Self { damping, ..self }
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
        if let Some(contact) = &mut self.contact {
            contact.begin(&self.solvers)?;
        }
        self.audit.start(&self.solvers, &self.drives, self.contact.is_some());
        let (at_bound, dt) = self.stable_step();
        self.dt = dt;
        self.guard = Guard::start(&self.solvers, dt);
        self.remember((at_bound, dt));
        for solver in &mut self.solvers {
            solver.begin(self.dt);
        }
        Ok(())
    }

    /// The solver that asks for the shortest step, and that step. Stiffnesses of bodies and contact add up, so squares of frequencies do at
    /// most: 1/dt^2 = 1/dt_bodies^2 + 1/dt_contact^2.
    fn stable_step(&self) -> (usize, f64) {
        let steps = self.solvers.iter().map(|s| s.stable_step()).enumerate();
        let (solver, bodies) =
            steps.fold((0, f64::INFINITY), |least, step| if step.1 < least.1 { step } else { least });
        let contact = self.contact.as_ref().map_or(f64::INFINITY, Contact::stable_step);
        (solver, bodies / (1.0 + (bodies / contact).powi(2)).sqrt())
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
        self.step_with(None, None)
    }

    /// One step in which the load has a clock of its own, which is then that of the simulation.
    fn step_with(&mut self, load: Option<Load>, kinetic: Option<&mut Kinetic>) -> Result<(), Diverged> {
        let (before, dt, step) = (self.time, self.dt, self.steps + 1);
        let time = load.map_or(before + dt, |_| before);
        self.halves(Now { t: before, dt }, load, kinetic).map_err(|diverged| Diverged {
            time,
            step,
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
        let bodies = self.solvers.iter_mut().filter_map(|solver| solver.relax());
        let driven = bodies.map(|body| body.unrest().driven).fold(0.0, f64::max);
        let fastest = self.follow(dt, pace * dt).max(pace * driven);
        if fastest > load.fastest {
            pace *= load.fastest / fastest;
            self.drive(Now { t: self.time, dt: pace * dt });
            self.follow(dt, pace * dt);
        }
        if driven > 0.0 {
            self.solvers.iter_mut().filter_map(|solver| solver.relax()).for_each(|body| body.pace(pace));
        }
        pace * dt
    }

    /// Moves rigid bodies by what passes on the clock of the load in a step of `dt`; their largest speed, m/s.
    fn follow(&mut self, dt: f64, passed: f64) -> f64 {
        let now = Now { t: self.time, dt };
        self.solvers.iter_mut().map(|solver| solver.follow(now, passed)).fold(0.0, f64::max)
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
        if let Some(contact) = &mut self.contact {
            contact.apply(&mut self.solvers, now)?;
            self.audit.pressed(contact, now.dt);
        }
        let mut first = 0;
        for (index, solver) in self.solvers.iter_mut().enumerate() {
            solver.advance(now).map_err(|diverged| diverged.after(first))?;
            match load {
                None => self.audit.advanced(index, solver.as_ref(), now.dt),
                Some(_) => self.audit.weighed(index, solver.as_ref(), now.dt),
            }
            first += solver.len() as u32;
        }
        if let Some(damping) = &mut self.damping {
            let gave = damping.damp(&mut self.solvers, now, self.steps);
            self.audit.damped(if load.is_none() { gave } else { Impulse::default() });
        }
        if let Some(kinetic) = kinetic {
            kinetic.damp(&mut self.solvers, now, self.steps);
        }
        let (at_bound, next) = self.stable_step();
        self.guard.step(&self.solvers, (at_bound, next))?;
        for solver in &mut self.solvers {
            solver.finish(now, next)?;
        }
        self.time =
            load.filter(|load| passed >= load.left).map_or(self.time + passed, |load| self.time + load.left);
        self.steps += 1;
        self.dt = next;
        if load.is_some() {
            self.follow(next, 0.0);
        }
        self.remember((at_bound, next));
        // Masses that are scaled, as when loads have a clock of their own, keep another energy.
        if load.is_some() {
            Ok(())
        } else {
            self.guard.look(self.steps, &self.solvers, self.contact.as_ref())
        }
    }

    /// Brings up to date what is only looked at.
    pub fn look(&mut self) {
        self.solvers.iter_mut().for_each(|solver| solver.look());
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

    /// The bodies, to displace them between steps.
    pub fn solvers_mut(&mut self) -> &mut [Box<dyn Solver>] {
        &mut self.solvers
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
