//! Correction of kernel gradients, so that they are exact for linear fields: B is the inverse of the moment matrix
//! M_a = sum_b (x_b - x_a) (x) grad W V_b (TL Eq. 21, UL Eq. 27). Which positions, and which neighbours, is for the family to say.

use crate::field::Of;
use crate::math::{Real, Tensor};
use crate::pass::{Now, Update};

record! {
    /// The matrix to invert.
    Moment { m: MomentMatrix }
    /// The inverse.
    Corrected { b: Correction }
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

/// The inverse of a moment matrix, or the unit tensor where its determinant is below 1e-6 of what a full
/// neighbourhood has (1).
#[inline(always)]
fn inverse_or_unit<S: Real, const D: usize>(m: Tensor<S, D>) -> Tensor<S, D> {
    let regular = S::of(1e-6).lt(m.det().abs());
    let inverse = m.inverse();
    Tensor::from_fn(|i, j| S::select(regular, inverse[i][j], S::of(f64::from(u8::from(i == j)))))
}
