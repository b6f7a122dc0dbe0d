//! How many operations a step of a formulation has, counted by running its passes with numbers that count.

use super::Counted;
use crate::field::{Quantity, Record, Source};
use crate::formulation::Formulation;
use crate::math::{Real, Vector};
use crate::neighbours::{Adjacency, SearchError};
use crate::particles::Particles;
use crate::pass::{ALL_WEIGHTS, Now, Pair, PairSum, Reduce, Update};
use crate::run::{Relist, Run};

/// Operations of one step, as the formulation is written: zeros of a stencil count, what a run does to find and move numbers
/// does not, nor do new lists, the limits of the step and time itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums over neighbours.
    pub sweeps: u64,
    /// Operations of a pair (a, b), in all sums together. Every pair is visited from both sides.
    pub pair: u64,
    /// Operations of a particle, in all updates together.
    pub particle: u64,
}

impl Operations {
    /// Operations of a particle with so many neighbours.
    #[must_use]
    pub fn with_neighbours(&self, neighbours: f64) -> f64 {
        self.pair as f64 * neighbours + self.particle as f64
    }
}

/// Counts a step of a formulation.
#[must_use]
pub fn operations<const D: usize>(formulation: &impl Formulation<D>) -> Operations {
    let mut tally =
        Tally { particles: Particles::new(0), adjacency: Adjacency::default(), done: Operations::default() };
    let now = Now { t: 0.0, dt: 1.0 };
    formulation.accelerate(&mut tally, now);
    formulation.rates(&mut tally, now);
    tally.done
}

/// A run that has no particles: every pass is computed once, of a particle and a neighbour whose numbers are all one, and what
/// comes out is forgotten. No branch depends on a value, so the count does not either.
struct Tally<const D: usize> {
    particles: Particles<D>,
    adjacency: Adjacency,
    done: Operations,
}

/// A record of ones.
struct Ones;

impl Source<Counted> for Ones {
    fn get(&self, _: usize) -> Counted {
        Counted::one()
    }
}

impl<const D: usize> Run<D> for Tally<D> {
    fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    fn particles_mut(&mut self) -> &mut Particles<D> {
        &mut self.particles
    }

    fn relist(&mut self, _: &Relist) -> Result<(), SearchError> {
        Ok(())
    }

    fn neighbours(&self) -> f64 {
        self.adjacency.mean()
    }

    fn pairs<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(&mut self, sum: &P, then: &U, now: Now<f64>) {
        let (a, now) = (P::Reads::read(&Ones), now.cast::<Counted>());
        let ones = Vector([Counted::one(); D]);
        let one = Counted::one();
        let ab = Pair::<Counted, D, ALL_WEIGHTS> { grad_w: ones, w: one, e: ones, x: ones, over_r: one };
        let mut total = P::Adds::nought();
        self.done.sweeps += 1;
        self.done.pair += Counted::during(|| sum.add(&mut total, (&a, &a), &ab, &now));
        self.done.particle += Counted::during(|| {
            then.at(&total, &U::Reads::read(&Ones), &now);
        });
    }

    fn each<U: Update<D, Sum = ()>>(&mut self, update: &U, now: Now<f64>) {
        self.done.particle += Counted::during(|| {
            update.at(&(), &U::Reads::read(&Ones), &now.cast());
        });
    }

    fn reduce<R: Reduce<D, K>, const K: usize>(&mut self, _: &R) -> [f64; K] {
        R::FOLDS.map(crate::pass::Fold::start)
    }

    fn word(&self, _: Quantity, _: usize, _: usize) -> f64 {
        1.0
    }

    fn set_word(&mut self, _: Quantity, _: usize, _: (usize, f64)) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formulation::total::{HourglassFree, Nested};
    use crate::material::{Moduli, NeoHookean, Plane};

    /// By hand, from the equations. Force: Q_a + Q_b is d^2 additions and its product with grad W d^2 multiply-adds (3 d^2);
    /// the pair force is u_a - u_b (d), s_a + s_b (1), times w (1), and d multiply-adds (3 d + 2). Rate: v_b - v_a (d) and d^2
    /// multiply-adds (2 d^2 + d).
    #[test]
    fn operations_of_a_pair_are_those_of_the_equations() {
        let material = NeoHookean { moduli: Moduli::from_young(1000.0, 2e6, 0.4), plane: Plane::Strain };
        let free = HourglassFree::new(material, 1.0);
        let nested = Nested::new(material, 1.0);
        let (two, three) = (operations::<2>(&free), operations::<3>(&free));
        assert_eq!((two.sweeps, two.pair), (2, 12 + 8 + 10));
        assert_eq!((three.sweeps, three.pair), (2, 27 + 11 + 21));
        assert_eq!(operations::<2>(&nested).pair, 12 + 10);
        assert_eq!(operations::<3>(&nested).pair, 27 + 21);
        assert!((200..800).contains(&three.particle), "{three:?}");
        assert!((three.with_neighbours(50.0) - (59.0 * 50.0 + three.particle as f64)).abs() < 1e-9);
    }
}
