//! Passes: what a formulation is made of. A pass is one function of a particle or of a pair, generic in the kind of
//! number; who runs it, and how pairs are stored and walked, is the business of a [`Run`](crate::run::Run).

mod pair;
mod sweep;

pub use pair::{ALL_WEIGHTS, Pair};
pub use sweep::{PairSweep, Two};

use crate::field::{Of, Record};
use crate::math::Real;

/// The moment: time and time step, in whatever number a pass is run in.
#[derive(Clone, Copy, Debug)]
pub struct Now<S> {
    /// Time at the beginning of the step, s.
    pub t: S,
    /// Time step, s.
    pub dt: S,
}

impl Now<f64> {
    /// The same moment in another kind of number.
    #[inline(always)]
    pub fn cast<S: Real>(self) -> Now<S> {
        Now { t: S::of(self.t), dt: S::of(self.dt) }
    }
}

/// What stands behind a sum over the neighbours b of particle a.
///
/// Gather only: every particle sums its own neighbours, so each pair is visited twice, nothing is shared, and the
/// result is the same for any number of threads. A term must be linear in the weights of [`Pair`] (grad W and w).
pub trait PairSum<const D: usize>: Sync {
    /// What is read of a and of b.
    type Reads: Record<D>;
    /// The sum.
    type Adds: Record<D>;
    /// Whether terms use the unit vector `e` of the pair: if none does, 1/r is not fetched.
    const DIRECTED: bool;

    /// Adds the contribution of b; `pair` is (a, b). `M` says which weights may be other than zero (see [`Pair`]).
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Of<Self::Adds, S, D>,
        pair: Both<'_, Self::Reads, S, D>,
        ab: &Pair<S, D, M>,
        now: &Now<S>,
    );
}

/// What happens to one particle; handed the sum it follows (`Sum = ()` for a plain one), so that a run may fuse both.
pub trait Update<const D: usize>: Sync {
    /// The sum it follows.
    type Sum: Record<D>;
    /// What is read of the particle.
    type Reads: Record<D>;
    /// What is written.
    type Writes: Record<D>;

    /// The new values.
    fn at<S: Real>(
        &self,
        sum: &Of<Self::Sum, S, D>,
        a: &Of<Self::Reads, S, D>,
        now: &Now<S>,
    ) -> Of<Self::Writes, S, D>;
}

/// The records of a and b.
pub type Both<'r, R, S, const D: usize> = (&'r Of<R, S, D>, &'r Of<R, S, D>);

/// How the values of a [`Reduce`] are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// The smallest.
    Min,
    /// The largest.
    Max,
    /// The sum.
    Sum,
}

impl Fold {
    /// The neutral element.
    #[must_use]
    pub const fn start(self) -> f64 {
        match self {
            Self::Min => f64::INFINITY,
            Self::Max => f64::NEG_INFINITY,
            Self::Sum => 0.0,
        }
    }

    /// Two values put together.
    #[inline(always)]
    pub fn join<S: Real>(self, a: S, b: S) -> S {
        match self {
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Sum => a + b,
        }
    }
}

/// `K` numbers of all particles.
pub trait Reduce<const D: usize, const K: usize>: Sync {
    /// What is read of a particle.
    type Reads: Record<D>;
    /// How each number is put together.
    const FOLDS: [Fold; K];

    /// The numbers of one particle.
    fn at<S: Real>(&self, a: &Of<Self::Reads, S, D>) -> [S; K];
}
