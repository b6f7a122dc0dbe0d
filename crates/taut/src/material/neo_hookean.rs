//! Neo-Hookean solid with volumetric-deviatoric split (TL Eqs. 10-14).

use super::{Hyperelastic, Moduli, PairShear, Split, largest_row};
use crate::math::{Real, Tensor};

/// What the deviator means in two dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Plane {
    /// Plane strain: F has a 1 on the third axis, d = 3. The right choice for a part.
    #[default]
    Strain,
    /// As printed in the papers: d = 2 and nothing on the third axis, but the three-dimensional bulk modulus. Up to 4
    /// per cent off plane strain; it is what reproduces the published tables.
    Papers,
}

impl Plane {
    /// The d of the deviator in `dimension` 2 or 3.
    #[must_use]
    pub const fn d(self, dimension: usize) -> f64 {
        match self {
            Self::Papers if dimension == 2 => 2.0,
            _ => 3.0,
        }
    }
}

/// W = K/2 [(J^2 - 1)/2 - ln J] + G/2 (J^(-2/d) tr b - d), tau = K/2 (J^2 - 1) 1 + G J^(-2/d) dev b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// The moduli.
    pub moduli: Moduli,
    /// The meaning of 2D.
    pub plane: Plane,
}

/// J, J^(-2/d) and tr b of a deformation gradient.
struct Measures<S> {
    j: S,
    isochoric: S,
    trace: S,
}

impl NeoHookean {
    #[inline(always)]
    fn d<const D: usize>(&self) -> f64 {
        self.plane.d(D)
    }

    #[inline(always)]
    fn measures<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> Measures<S> {
        let j = f.det();
        // In plane strain the third axis adds its 1 to the trace.
        let axis = S::of(self.d::<D>() - D as f64);
        Measures { j, isochoric: j.isochoric(self.d::<D>()), trace: f.double_dot(f) + axis }
    }

    #[inline(always)]
    fn volumetric<S: Real>(&self, j: S) -> S {
        (j * j - S::one()) * S::of(0.5 * self.moduli.bulk)
    }
}

impl Hyperelastic for NeoHookean {
    fn moduli(&self) -> Moduli {
        self.moduli
    }

    /// TL Eqs. (13), (14).
    #[inline(always)]
    fn kirchhoff<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> Tensor<S, 3> {
        let m = self.measures(f);
        let g = m.isochoric * S::of(self.moduli.shear);
        let mean = m.trace * S::of(1.0 / self.d::<D>());
        let pressure = self.volumetric(m.j);
        let spherical = pressure - g * mean;
        let in_plane = f.mul(f.transpose()).times(g).plus_diagonal(spherical);
        // On the third axis b is 1 in plane strain; the papers' deviator has no component there.
        let axial = if self.d::<D>() == 2.0 { pressure } else { spherical + g };
        in_plane.lift(axial)
    }

    fn energy<const D: usize>(&self, f: Tensor<f64, D>) -> f64 {
        let m = self.measures(f);
        let volumetric = 0.5 * (m.j * m.j - 1.0) - m.j.ln();
        0.5 * self.moduli.bulk * volumetric
            + 0.5 * self.moduli.shear * (m.isochoric * m.trace - self.d::<D>())
    }

    /// rho0 c^2 = lambda_max(J^2 C^-1) [K (1 + J^-2)/2 + (1/d)(1 + 2/d) G J^(-2/d-2) tr b] + (1 - 4/d) G J^(-2/d),
    /// the largest eigenvalue of the acoustic tensor, with lambda_max bounded by the largest row sum.
    #[inline(always)]
    fn stiffness<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> S {
        let (m, d) = (self.measures(f), self.d::<D>());
        let cofactor = f.cofactor();
        let largest = largest_row(cofactor.transpose().mul(cofactor));
        let inverse_square = S::one() / (m.j * m.j);
        let g = m.isochoric * S::of(self.moduli.shear);
        let bulk = (inverse_square + S::one()) * S::of(0.5 * self.moduli.bulk);
        let shear = g * inverse_square * m.trace * S::of((1.0 + 2.0 / d) / d);
        largest * (bulk + shear) + g * S::of(1.0 - 4.0 / d)
    }
}

impl PairShear for NeoHookean {
    /// TL Eqs. (27), (28): tau_r = [K/2 (J^2 - 1) - zeta/d J^(-2/d) G tr b] 1, pair stiffness zeta G J^(-2/d).
    #[inline(always)]
    fn split<S: Real, const D: usize>(&self, f: Tensor<S, D>, zeta: f64) -> Split<S> {
        let m = self.measures(f);
        Split {
            volumetric: self.volumetric(m.j),
            pair: m.isochoric * S::of(zeta * self.moduli.shear),
            ratio: m.trace * S::of(1.0 / self.d::<D>()),
        }
    }
}
