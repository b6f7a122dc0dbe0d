//! The correction matrix, computed once from the reference configuration.

use crate::correction::inverse_or_unit;
use crate::field::Of;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};

record! {
    /// A reference point.
    Anchor { x: ReferencePosition }
    /// The matrix to invert.
    Moment { m: MomentMatrix }
    /// The inverse.
    Corrected { b: Correction }
}

/// M_a = sum_b (X_b - X_a) (x) grad W V_b, whose inverse is B (TL Eq. 21). It is positive definite and symmetric.
pub struct MomentSum;

impl<const D: usize> PairSum<D> for MomentSum {
    type Reads = Anchor<f64, D>;
    type Adds = Moment<f64, D>;

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

/// B = M^-1; where M is singular (a particle alone, or all neighbours in one line) B is the unit tensor.
pub struct Invert;

impl<const D: usize> Update<D> for Invert {
    type Sum = Moment<f64, D>;
    type Reads = ();
    type Writes = Corrected<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Moment<S, D>, (): &(), _: &Now<S>) -> Of<Self::Writes, S, D> {
        Corrected { b: inverse_or_unit(sum.m) }
    }
}
