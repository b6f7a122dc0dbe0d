//! Updated Lagrangian formulations: the kernel follows the particles. One set of particles holds all bodies; they
//! touch through the pressure and dissipation of ordinary pairs, shear acts only inside a body.

mod accumulated;
mod artificial_stress;
mod corrected;
mod followed;
mod generalised;
mod integrated;
mod kick;
mod laplacian;
mod low_dissipation;
mod motion;
mod nested;
mod non_hourglass;
mod pressure;
mod repulsion;
mod shear_law;

pub use artificial_stress::ArtificialStress;
pub use corrected::CorrectedArtificialStress;
pub use followed::{Unwatched, Watch};
pub use generalised::Generalised;
pub use laplacian::Laplacian;
pub use low_dissipation::LowDissipation;
pub use nested::Nested;
pub use non_hourglass::NonHourglass;
pub use repulsion::Repulsion;
pub use shear_law::{NeoHookeanShear, ShearLaw};

use super::State;
use crate::field::Quantity;
use crate::material::Plane;
use crate::math::{Real, Tensor};
use crate::pass::Now;
use crate::run::Run;

/// Fields of every updated Lagrangian set.
pub(crate) const MOTION: &[Quantity] = &[
    Quantity::ReferencePosition,
    Quantity::Position,
    Quantity::Velocity,
    Quantity::Acceleration,
    Quantity::BodyForce,
    Quantity::Free,
    Quantity::PrescribedVelocity,
    Quantity::Mass,
    Quantity::Volume,
    Quantity::Body,
    Quantity::Density,
    Quantity::RestDensity,
    Quantity::DensityRate,
    Quantity::Pressure,
    Quantity::SoundSpeed,
    Quantity::Impedance,
    Quantity::ShearModulus,
    Quantity::ShearAcceleration,
    Quantity::Dissipated,
    Quantity::ShearWork,
    Quantity::ExternalWork,
];

/// These, and those of a shear stress.
pub(crate) const FIELDS: &[Quantity] = &joined::<{ MOTION.len() + 5 }>(
    MOTION,
    &[
        Quantity::Correction,
        Quantity::ShearStress,
        Quantity::ShearStressRate,
        Quantity::AxialShearStress,
        Quantity::AxialShearStressRate,
    ],
);

/// Two lists of fields as one; `N` is how many they are together.
pub(crate) const fn joined<const N: usize>(first: &[Quantity], more: &[Quantity]) -> [Quantity; N] {
    assert!(N == first.len() + more.len());
    let mut all = [Quantity::Position; N];
    let mut i = 0;
    while i < N {
        all[i] = if i < first.len() { first[i] } else { more[i - first.len()] };
        i += 1;
    }
    all
}

/// The shear stress of a linear elastic solid.
#[derive(Clone, Copy, Debug)]
pub struct Hypoelastic {
    /// The meaning of 2D.
    pub plane: Plane,
}

/// A shear stress, or its rate.
#[derive(Clone, Copy, Debug)]
pub struct ShearTensor<S, const D: usize> {
    /// In the plane.
    pub s: Tensor<S, D>,
    /// On the third axis (2D).
    pub axial: S,
}

impl Hypoelastic {
    /// ds/dt = 2G dev(sym L) + w.s - s.w with the spin w = antisym L (UL Eqs. 7, 8 with the Jaumann terms, which Eq. 7
    /// leaves out). The deviator takes 1/d of the trace with d = 2 in the papers' plane, else 1/3.
    #[inline(always)]
    pub fn rate<S: Real, const D: usize>(
        &self,
        gradient: Tensor<S, D>,
        s: Tensor<S, D>,
        shear: S,
    ) -> ShearTensor<S, D> {
        let spin = gradient.antisymmetric();
        let rate = self.of_strain(gradient.symmetric(), shear);
        ShearTensor { s: rate.s + spin.mul(s) - s.mul(spin), ..rate }
    }

    /// s after a displacement of gradient `h`, as [`Self::rate`] makes it of a steady one, to second order (Hughes and Winget 1980): half of the increment
    /// 2G dev sym h, then the rotation by antisym h, then the other half. A rotation makes no stress, however large.
    #[inline(always)]
    pub fn after<S: Real, const D: usize>(
        &self,
        h: Tensor<S, D>,
        before: ShearTensor<S, D>,
        shear: S,
    ) -> ShearTensor<S, D> {
        let half = S::of(0.5);
        let more = self.of_strain(h.symmetric(), shear);
        let turn = h.antisymmetric().times(half).rotation();
        let turned = turn.mul(before.s.plus(half, more.s)).mul(turn.transpose());
        ShearTensor { s: turned.plus(half, more.s), axial: before.axial + more.axial }
    }

    /// 2G dev of a (rate of) strain. In plane strain the third axis carries the rest of the deviator; in the papers' plane it has none.
    #[inline(always)]
    pub fn of_strain<S: Real, const D: usize>(&self, strain: Tensor<S, D>, shear: S) -> ShearTensor<S, D> {
        let d = self.plane.d(D);
        let mean = strain.trace() * S::of(-1.0 / d);
        let twice = shear + shear;
        let s = strain.plus_diagonal(mean).times(twice);
        ShearTensor { s, axial: if d == 2.0 { S::zero() } else { twice * mean } }
    }
}

/// 1 for two particles of the same body, else 0.
#[inline(always)]
pub(crate) fn same_body<S: Real>(a: S, b: S) -> S {
    S::select((a - b).abs().lt(S::of(0.5)), S::one(), S::zero())
}

/// The shear stress of a stored particle, Pa.
pub(crate) fn shear_stress<const D: usize>(run: &impl Run<D>, place: usize) -> Tensor<f64, 3> {
    let word = |field, k| run.word(field, k, place);
    let s = Tensor::<f64, D>::from_fn(|i, j| word(Quantity::ShearStress, i * D + j));
    s.lift(word(Quantity::AxialShearStress, 0))
}

/// State of a stored particle with this shear stress; `shear_energy` is what the shear forces have stored in it, J.
pub(crate) fn state<const D: usize>(
    run: &impl Run<D>,
    place: usize,
    (s, shear_energy): (Tensor<f64, 3>, f64),
) -> State {
    let word = |field| run.word(field, 0, place);
    let (density, rest) = (word(Quantity::Density), word(Quantity::RestDensity));
    let c2 = word(Quantity::SoundSpeed).powi(2);
    let pressure = c2 * (density - rest);
    let ratio = density / rest;
    State {
        deformation: None,
        gradient: None,
        density,
        cauchy: s.plus_diagonal(-pressure),
        strain_energy: word(Quantity::Mass) * c2 * (ratio.ln() + 1.0 / ratio - 1.0) + shear_energy,
        booked_ahead: 0.0,
        couple: [0.0; 3],
    }
}

/// V = m / rho of every particle, for the next list.
pub(crate) fn refresh_volumes<const D: usize>(run: &mut impl Run<D>) {
    run.each(&motion::Refresh, Now { t: 0.0, dt: 0.0 });
}
