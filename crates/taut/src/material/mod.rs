//! Materials: parameters, stress, energy, wave speed. A material sees a deformation gradient and hands back stress in
//! three dimensions; 2D is lifted inside, so a material file knows no dimension.

mod linear_elastic;
mod moduli;
mod neo_hookean;
mod neo_hookean_log;
mod saint_venant_kirchhoff;

pub use linear_elastic::LinearElastic;
pub use moduli::Moduli;
pub use neo_hookean::{NeoHookean, Plane};
pub use neo_hookean_log::NeoHookeanLog;
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;

use crate::math::{Real, Tensor};

/// A hyperelastic material.
pub trait Hyperelastic: Copy + Send + Sync + 'static {
    /// The elastic moduli at rest.
    fn moduli(&self) -> Moduli;

    /// Kirchhoff stress tau = J sigma, Pa, in three dimensions.
    fn kirchhoff<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> Tensor<S, 3>;

    /// Strain energy per reference volume, J/m^3.
    fn energy<const D: usize>(&self, f: Tensor<f64, D>) -> f64;

    /// Upper bound of rho0 c^2, Pa, over all directions, where c is the speed of a small wave in the reference metric.
    fn stiffness<S: Real, const D: usize>(&self, f: Tensor<S, D>) -> S;
}

/// What the hourglass-free form needs (TL section 3.3): a material whose shear part of the first Piola-Kirchhoff
/// stress is a scalar times F, so that its divergence is a Laplacian of positions.
pub trait PairShear: Hyperelastic {
    /// The split of the stress, with the factor zeta of Eq. (27) in both parts.
    fn split<S: Real, const D: usize>(&self, f: Tensor<S, D>, zeta: f64) -> Split<S>;
}

/// Kirchhoff stress without its pair part: `tau_r = (pressure_part - pair * ratio) 1`. Kept in three pieces because at rest
/// `ratio` is exactly 1 and `pressure_part` exactly 0, so that what a particle hands over,
/// `tau_r F^-T + pair 1`, vanishes exactly.
#[derive(Clone, Copy, Debug)]
pub struct Split<S> {
    /// Volumetric Kirchhoff stress, Pa.
    pub volumetric: S,
    /// Stiffness of the pair force, Pa: zeta G J^(-2/d) for the neo-Hookean solid of Eqs. (10)-(14).
    pub pair: S,
    /// What the pair part leaves to the spherical stress, as a multiple of `pair`; 1 at rest.
    pub ratio: S,
}

/// The largest sum of magnitudes of a row: bounds the largest eigenvalue of a symmetric tensor from above, by at most
/// the factor sqrt(D) and usually much less.
#[inline(always)]
pub fn largest_row<S: Real, const D: usize>(t: Tensor<S, D>) -> S {
    let mut largest = S::zero();
    for i in 0..D {
        let mut row = S::zero();
        for j in 0..D {
            row = row + t[i][j].abs();
        }
        largest = largest.max(row);
    }
    largest
}

#[cfg(test)]
mod tests;
