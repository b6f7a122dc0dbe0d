//! The correction matrix, computed once from the reference configuration.

use crate::correction::Moment;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum};

record! {
    /// A reference point.
    Anchor { x: ReferencePosition }
}

/// M_a = sum_b (X_b - X_a) (x) grad W V_b, whose inverse is B (TL Eq. 21). It is positive definite and symmetric.
pub struct MomentSum;

impl<const D: usize> PairSum<D> for MomentSum {
    type Reads = Anchor<f64, D>;
    type Adds = Moment<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Moment<S, D>,
        (a, b): (&Anchor<S, D>, &Anchor<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.outer(&mut sum.m, b.x - a.x);
    }
}
