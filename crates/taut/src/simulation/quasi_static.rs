//! Loads in increments, each held until the bodies are in equilibrium.

use super::Simulation;
use super::damping::Kinetic;
use crate::integrator::{Diverged, Unrest};

/// Speed of the fastest grip while a load grows, over the wave speed at rest.
const GRIP: f64 = 0.01;
/// While a load grows waves cross the bodies so often.
const CROSSINGS: f64 = 2.0;

/// How loads are put on.
#[derive(Clone, Copy, Debug)]
pub struct Increments {
    /// Time of the full load, s.
    pub end: f64,
    /// How many increments.
    pub count: u32,
    /// Share that unbalanced forces may have: [`Balance`].
    pub tolerance: f64,
    /// Most steps that an increment is held.
    pub most: u64,
}

/// How far from equilibrium, relative to the stress that there is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// L rms(rho0 a) / rms(Q): the share by which unbalanced forces could change the stress over the length L of the bodies.
    pub force: f64,
    /// Root of the kinetic over the elastic energy.
    pub motion: f64,
}

/// An increment that is over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Which one, from 1 on.
    pub number: u32,
    /// Time of its load, s.
    pub time: f64,
    /// Steps it took.
    pub steps: u64,
    /// How far from equilibrium it was left.
    pub balance: Balance,
    /// Whether that is within the tolerance.
    pub converged: bool,
}

/// Takes a simulation from equilibrium to equilibrium. The clock of the simulation is that of the load.
pub struct QuasiStatic {
    increments: Increments,
    /// Damping while a load is held; kinetic if there is no other in the simulation.
    kinetic: Option<Kinetic>,
    length: f64,
    wave_speed: f64,
    number: u32,
    held: u64,
    began: u64,
}

impl QuasiStatic {
    /// Before the first increment of a simulation that has begun. With `own` damping the simulation's is left alone and velocities are
    /// stopped at maxima of the kinetic energy, and masses scaled where nothing may touch; without, the simulation's damping has to do it.
    pub fn new(simulation: &mut Simulation, increments: Increments, own: bool) -> Self {
        let mut new = Self {
            increments,
            kinetic: own.then(Kinetic::default),
            length: 0.0,
            wave_speed: f64::INFINITY,
            number: 1,
            held: 0,
            began: 0,
        };
        let touching = simulation.contact.is_some();
        for body in simulation.solvers.iter_mut().filter_map(|solver| solver.relax()) {
            new.length = new.length.max(body.extent());
            new.wave_speed = new.wave_speed.min(body.wave_speed());
            // Contact kicks masses as they are.
            if own && !touching {
                body.even_out();
            }
        }
        new
    }

    /// What it remembers from step to step, as numbers.
    #[must_use]
    pub fn saved(&self) -> [f64; 5] {
        let (before, stopped) = self.kinetic.as_ref().map_or((0.0, false), Kinetic::saved);
        [f64::from(self.number), self.held as f64, self.began as f64, before, f64::from(u8::from(stopped))]
    }

    /// Takes back what [`QuasiStatic::saved`] gave, of the same simulation.
    #[must_use]
    pub fn at(mut self, [number, held, began, before, stopped]: [f64; 5]) -> Self {
        (self.number, self.held, self.began) = (number as u32, held as u64, began as u64);
        if let Some(kinetic) = &mut self.kinetic {
            *kinetic = Kinetic::restored(before, stopped != 0.0);
        }
        self
    }

    /// Whether all increments are over.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.number > self.increments.count
    }

    /// Time of the load of the present increment, s.
    fn target(&self) -> f64 {
        self.increments.end * f64::from(self.number) / f64::from(self.increments.count)
    }

    /// One step; the increment, if it ended with it.
    ///
    /// # Errors
    /// If a body has left its bounds.
    pub fn step(&mut self, simulation: &mut Simulation) -> Result<Option<Increment>, Diverged> {
        let left = self.target() - simulation.time();
        if left > 0.0 {
            let most = self.increments.end / f64::from(self.increments.count) * self.wave_speed
                / (CROSSINGS * self.length);
            let load = Load { most, left, fastest: GRIP * self.wave_speed };
            simulation.step_with(Some(load), None)?;
            self.held = 0;
            return Ok(None);
        }
        // Forces tell of equilibrium only when velocities do not: the step after a stop is the first one that shows the forces of a
        // body at rest.
        let shows = self.kinetic.as_ref().is_none_or(|kinetic| kinetic.stopped);
        simulation.step_with(Some(Load::default()), self.kinetic.as_mut())?;
        self.held += 1;
        Ok(self.judged(simulation, shows))
    }

    /// The increment, if it is over.
    fn judged(&mut self, simulation: &mut Simulation, shows: bool) -> Option<Increment> {
        let balance = shows.then(|| self.balance(simulation));
        let tolerance = self.increments.tolerance;
        let converged = balance.is_some_and(|b| b.force <= tolerance && b.motion <= tolerance);
        if !converged && self.held < self.increments.most {
            return None;
        }
        let balance = balance.unwrap_or_else(|| self.balance(simulation));
        let steps = simulation.steps - self.began;
        let increment = Increment { number: self.number, time: self.target(), steps, balance, converged };
        (self.number, self.began, self.held) = (self.number + 1, simulation.steps, 0);
        if let Some(kinetic) = &mut self.kinetic {
            *kinetic = Kinetic::default();
        }
        Some(increment)
    }

    /// How far from equilibrium.
    fn balance(&self, simulation: &mut Simulation) -> Balance {
        let mut sum = Unrest::default();
        for body in simulation.solvers.iter_mut().filter_map(|solver| solver.relax()) {
            let one = body.unrest();
            sum.force += one.force;
            sum.stress += one.stress;
            sum.kinetic += one.kinetic;
            sum.elastic += one.elastic;
        }
        if let Some(contact) = &simulation.contact {
            sum.force += contact.felt(&simulation.solvers);
        }
        let share = |part: f64, whole: f64| if part > 0.0 { (part / whole).sqrt() } else { 0.0 };
        Balance { force: self.length * share(sum.force, sum.stress), motion: share(sum.kinetic, sum.elastic) }
    }
}

/// How the load goes on during a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Load {
    /// Seconds of the load's clock in a second of motion, at most.
    pub most: f64,
    /// Seconds left on the load's clock.
    pub left: f64,
    /// Largest speed of grips, m/s.
    pub fastest: f64,
}
