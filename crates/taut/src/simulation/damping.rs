//! How the motion of a simulation is damped from outside of its formulations.

use super::Solver;
use crate::integrator::Impulse;
use crate::pass::Now;

/// Something that takes velocities in every step, after forces and constraints.
pub trait Damping: Send {
    /// Acts on the velocities at the end of step number `step`, which lasted `now.dt`; the impulse that this gave to the bodies.
    fn damp(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>, step: u64) -> Impulse;
}

/// Splitting damping by random choice (TL ref. 68): in a share of the steps, chosen at random, velocities are exchanged pair by pair
/// by an implicit viscosity, as strongly as if it had acted in all of them.
#[derive(Clone, Debug)]
pub struct Splitting {
    /// Viscosity for each solver, Pa s.
    pub viscosity: Vec<f64>,
    /// Probability that a step is chosen, in (0, 1].
    pub probability: f64,
    /// Which random choices.
    pub seed: u64,
}

impl Splitting {
    /// Whether a step is chosen: a function of its number, so that a run that is repeated, or goes on, chooses the same.
    fn chooses(&self, step: u64) -> bool {
        (scrambled(self.seed, step) >> 11) as f64 / ((1_u64 << 53) as f64) < self.probability
    }
}

/// A number that looks random: the output number `step` of the generator splitmix64 with this seed.
fn scrambled(seed: u64, step: u64) -> u64 {
    let z = seed.wrapping_add(step.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Damping for Splitting {
    fn damp(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>, step: u64) -> Impulse {
        let mut gave = Impulse::default();
        if self.chooses(step) {
            for (solver, &viscosity) in solvers.iter_mut().zip(&self.viscosity) {
                if let Some(body) = solver.relax() {
                    gave += body.exchange(viscosity, now.dt / self.probability);
                }
            }
        }
        gave
    }
}

/// Viscous damping, a -= xi v: by (1 - xi dt/2)/(1 + xi dt/2) in every step, so that what is at rest stays in balance exactly.
#[derive(Clone, Copy, Debug)]
pub struct Viscous {
    /// xi, 1/s.
    pub rate: f64,
}

impl Damping for Viscous {
    fn damp(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>, _: u64) -> Impulse {
        let half = 0.5 * self.rate * now.dt;
        let taken = (2.0 * half / (1.0 + half)).min(1.0);
        let mut gave = Impulse::default();
        solvers.iter_mut().filter_map(|solver| solver.relax()).for_each(|body| gave += body.slow(taken));
        gave
    }
}

/// Kinetic damping: whenever the kinetic energy of all bodies has passed a maximum, all free velocities are taken. It has no
/// parameter: near a maximum of the kinetic energy, a vibrating body passes through its equilibrium.
#[derive(Clone, Debug, Default)]
pub struct Kinetic {
    before: f64,
    /// Whether the last step has taken the velocities.
    pub stopped: bool,
}

impl Kinetic {
    /// The kinetic energy after the last step, J, and whether it was taken.
    pub(super) fn saved(&self) -> (f64, bool) {
        (self.before, self.stopped)
    }

    /// The other way round.
    pub(super) fn restored(before: f64, stopped: bool) -> Self {
        Self { before, stopped }
    }
}

impl Damping for Kinetic {
    fn damp(&mut self, solvers: &mut [Box<dyn Solver>], _: Now<f64>, _: u64) -> Impulse {
        let bodies = solvers.iter_mut().filter_map(|solver| solver.relax());
        let kinetic = bodies.map(|body| body.unrest().kinetic).sum::<f64>();
        self.stopped = kinetic < self.before;
        self.before = if self.stopped { 0.0 } else { kinetic };
        if self.stopped {
            solvers.iter_mut().filter_map(|solver| solver.relax()).for_each(|body| body.rest());
        }
        // It belongs to quasi-static runs, where momentum has no books.
        Impulse::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of splitmix64 with seed 1234567, as its author's program gives them.
    #[test]
    fn the_generator_is_the_published_one() {
        let first: Vec<u64> = (1..4).map(|step| scrambled(1_234_567, step)).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    /// 0.2 of 10 000 steps, within four standard deviations of 40.
    #[test]
    fn as_many_steps_are_chosen_as_wanted() {
        for seed in [1, 2, 77] {
            let splitting = Splitting { viscosity: vec![], probability: 0.2, seed };
            let chosen = (0..10_000).filter(|&step| splitting.chooses(step)).count();
            assert!((1840..2160).contains(&chosen), "{chosen}");
        }
        let always = Splitting { viscosity: vec![], probability: 1.0, seed: 3 };
        assert!((0..1000).all(|step| always.chooses(step)));
    }
}
