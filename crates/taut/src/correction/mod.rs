//! Correction of kernel gradients, so that they are exact for linear fields.

use crate::math::{Real, Tensor};

/// The inverse of a moment matrix, or the unit tensor where its determinant is below 1e-6 of what a full
/// neighbourhood has (1).
#[inline(always)]
pub fn inverse_or_unit<S: Real, const D: usize>(m: Tensor<S, D>) -> Tensor<S, D> {
    let regular = S::of(1e-6).lt(m.det().abs());
    let inverse = m.inverse();
    Tensor::from_fn(|i, j| S::select(regular, inverse[i][j], S::of(f64::from(u8::from(i == j)))))
}
