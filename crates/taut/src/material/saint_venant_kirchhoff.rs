//! St. Venant-Kirchhoff solid (TL Eq. 5): linear in the Green-Lagrange strain.

use super::{Hyperelastic, Moduli, largest_row};
use crate::math::{Real, Tensor};

/// S = lambda tr E 1 + 2 mu E; 2D is plane strain. It has no hourglass-free split, because its shear stress is not a
/// scalar times F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaintVenantKirchhoff {
    /// The moduli.
    pub moduli: Moduli,
}

impl SaintVenantKirchhoff {
    /// E = (F^T F - 1) / 2.
    #[inline(always)]
    fn strain<S: Real, const D: usize>(f: Tensor<S, D>) -> Tensor<S, D> {
        f.transpose().mul(f).plus_diagonal(-S::one()).times(S::of(0.5))
    }

    #[inline(always)]
    fn second_piola<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> (Tensor<S, D>, S) {
        let e = Self::strain(f);
        let spherical = e.trace() * S::of(self.moduli.lambda());
        (e.times(S::of(2.0 * self.moduli.shear)).plus_diagonal(spherical), spherical)
    }
}

impl Hyperelastic for SaintVenantKirchhoff {
    fn moduli(&self) -> Moduli {
        self.moduli
    }

    /// F S F^T with S of TL Eq. (5).
    #[inline(always)]
    fn kirchhoff<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> Tensor<S, 3> {
        let (s, axial) = self.second_piola(f);
        f.mul(s).mul(f.transpose()).lift(axial)
    }

    fn energy<const D: usize>(&self, f: Tensor<f64, D>) -> f64 {
        let e = Self::strain(f);
        0.5 * self.moduli.lambda() * e.trace().powi(2) + self.moduli.shear * e.double_dot(e)
    }

    /// rho0 c^2 <= lambda_max(S) + (lambda + 2 mu) lambda_max(b): the geometric and the material part of the
    /// acoustic tensor.
    #[inline(always)]
    fn stiffness<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> S {
        let material = S::of(self.moduli.lambda() + 2.0 * self.moduli.shear);
        largest_row(self.second_piola(f).0) + material * largest_row(f.mul(f.transpose()))
    }
}
