//! Neo-Hookean solid with logarithmic volume term (TL Eqs. 7-8).

use super::{Hyperelastic, Moduli, PairShear, Split, largest_row};
use crate::math::{Real, Tensor};

/// W = mu tr E - mu ln J + lambda/2 (ln J)^2, tau = mu (b - 1) + lambda ln J 1; 2D is plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookeanLog {
    /// The moduli.
    pub moduli: Moduli,
}

impl Hyperelastic for NeoHookeanLog {
    fn moduli(&self) -> Moduli {
        self.moduli
    }

    /// F S F^T with S of TL Eq. (8).
    #[inline(always)]
    fn kirchhoff<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> Tensor<S, 3> {
        let mu = S::of(self.moduli.shear);
        let volumetric = f.det().ln() * S::of(self.moduli.lambda());
        f.mul(f.transpose()).times(mu).plus_diagonal(volumetric - mu).lift(volumetric)
    }

    fn energy<const D: usize>(&self, f: Tensor<f64, D>) -> f64 {
        let log = f.det().ln();
        let trace = 0.5 * (f.double_dot(f) - D as f64);
        self.moduli.shear * (trace - log) + 0.5 * self.moduli.lambda() * log * log
    }

    /// rho0 c^2 = mu + [mu + lambda (1 - ln J)] lambda_max(C^-1): the acoustic tensor has the unit tensor and the
    /// dyad of F^-T N.
    #[inline(always)]
    fn stiffness<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> S {
        let (mu, lambda) = (S::of(self.moduli.shear), S::of(self.moduli.lambda()));
        let inverse = f.inverse();
        let largest = largest_row(inverse.mul(inverse.transpose()));
        let slope = mu + lambda * (S::one() - f.det().ln());
        mu + slope.max(S::zero()) * largest
    }
}

impl PairShear for NeoHookeanLog {
    /// Q = (lambda ln J - zeta mu) F^-T and the pair term 2 zeta mu w x.
    #[inline(always)]
    fn split<S: Real, const D: usize>(&self, f: Tensor<S, D>, zeta: f64) -> Split<S> {
        Split {
            volumetric: f.det().ln() * S::of(self.moduli.lambda()),
            pair: S::of(zeta * self.moduli.shear),
            ratio: S::one(),
        }
    }
}
