//! The time steps that a run took last, and what bounded each.

use super::Solver;
use crate::integrator::Bounding;

/// So many steps are remembered.
const REMEMBERED: usize = 64;
/// The particle at the bound is looked for again after so many steps, ...
const LOOKED: u64 = 256;
/// ... earlier if all were alike the last time, ...
const ALIKE: u64 = 64;
/// ... and at once when the step has fallen by this factor: the search reads all particles.
const FALL: f64 = 0.9;

/// A time step, and what bounded it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Its number, from 1.
    pub number: u64,
    /// When it begins, s.
    pub time: f64,
    /// Its length, s.
    pub dt: f64,
    /// The solver that asked for it.
    pub solver: usize,
    /// Why.
    pub bounding: Bounding,
    /// The particle, by id in its solver, that was at the bound when it was last looked for; `None` where all are alike.
    pub particle: Option<u32>,
}

/// The last steps, oldest first.
#[derive(Clone, Debug, Default)]
pub struct History {
    steps: Vec<Step>,
    /// Where the next one goes.
    next: usize,
    /// The last step for which the particle was looked for.
    looked: Option<Step>,
}

impl History {
    /// Room for all steps at once, so that taking one asks for no memory.
    pub(super) fn new() -> Self {
        Self { steps: Vec::with_capacity(REMEMBERED), ..Self::default() }
    }

    /// Takes down the step that comes next.
    pub(super) fn note(&mut self, step: Step, solver: &dyn Solver) {
        let fresh = |looked: &Step| {
            looked.solver == step.solver
                && looked.bounding.criterion == step.bounding.criterion
                && step.number < looked.number + if looked.particle.is_some() { LOOKED } else { ALIKE }
                && step.dt > FALL * looked.dt
        };
        let step = match self.looked.filter(fresh) {
            Some(looked) => Step { particle: looked.particle, ..step },
            None => {
                let found = Step { particle: solver.at_bound(&step.bounding), ..step };
                self.looked = Some(found);
                found
            }
        };
        match self.steps.get_mut(self.next) {
            Some(place) => *place = step,
            None => self.steps.push(step),
        }
        self.next = (self.next + 1) % REMEMBERED;
    }

    /// The last steps, oldest first; the last one may be the step that failed.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = &Step> + Clone {
        let first = if self.steps.len() < REMEMBERED { 0 } else { self.next };
        (0..self.steps.len()).map(move |i| &self.steps[(first + i) % self.steps.len()])
    }
}
