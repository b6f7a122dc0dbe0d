//! An exchange between the two particles of a pair.

use super::Both;
use crate::field::{Of, Record};

/// The states of two particles.
pub type Two<R, const D: usize> = (Of<R, f64, D>, Of<R, f64, D>);

/// What two neighbours exchange, one pair after the other, each seeing what the pairs before it have left: implicit steps that a
/// gather cannot express. Always in double precision; the order of the pairs is that of [`Sweeper`](crate::run::Sweeper).
pub trait PairSweep<const D: usize>: Sync {
    /// What is read of a particle and does not change.
    type Given: Record<D>;
    /// What the exchange changes.
    type State: Record<D>;

    /// The new states of a and b; `w = W'(r) / r` of the pair, 1/m^(D+2), not positive.
    fn exchange(
        &self,
        given: Both<'_, Self::Given, f64, D>,
        state: Two<Self::State, D>,
        w: f64,
    ) -> Two<Self::State, D>;
}
