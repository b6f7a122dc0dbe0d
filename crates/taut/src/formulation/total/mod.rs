//! Total Lagrangian formulations: the kernel is evaluated once, in the reference configuration.

mod calibration;
mod ganzenmueller;
mod hourglass_free;
mod motion;
mod nested;
mod reference;

pub use ganzenmueller::Ganzenmueller;
pub use hourglass_free::HourglassFree;
pub use motion::{Kick, Stress, Stretch};
pub use nested::Nested;

use super::State;
use crate::field::Quantity;
use crate::material::{Hyperelastic, Moduli};
use crate::math::{Real, Tensor};
use crate::run::Run;

/// Fields of every total Lagrangian body.
pub(crate) const FIELDS: &[Quantity] = &[
    Quantity::ReferencePosition,
    Quantity::Displacement,
    Quantity::Velocity,
    Quantity::Acceleration,
    Quantity::BodyForce,
    Quantity::Free,
    Quantity::PrescribedVelocity,
    Quantity::Mass,
    Quantity::Volume,
    Quantity::Body,
    Quantity::Correction,
    Quantity::DeformationGradient,
    Quantity::DeformationRate,
    Quantity::NominalStress,
    Quantity::PairStiffness,
    Quantity::WaveSpeedSquared,
    Quantity::Dissipated,
    Quantity::ExternalWork,
];

/// Fields of a body with an hourglass control: those of every body, and the energy that the control stores.
pub(crate) const CONTROLLED: [Quantity; FIELDS.len() + 1] = {
    let mut all = [Quantity::ShearWork; FIELDS.len() + 1];
    let mut i = 0;
    while i < FIELDS.len() {
        all[i] = FIELDS[i];
        i += 1;
    }
    all
};

/// A solid: a material and its Kelvin-Voigt damper.
#[derive(Clone, Copy, Debug)]
pub struct Solid<M> {
    /// The material.
    pub material: M,
    /// gamma = rho0 c h / 2 with c = sqrt(K/rho0), Pa s (TL Eq. 23).
    pub gamma: f64,
}

impl<M: Hyperelastic> Solid<M> {
    /// The solid with the damping of the paper, for smoothing length `h`.
    #[must_use]
    pub fn new(material: M, h: f64) -> Self {
        let Moduli { density, .. } = material.moduli();
        Self { material, gamma: 0.5 * density * material.moduli().sound_speed() * h }
    }

    /// The same with so many times the damping; 0 for none.
    #[must_use]
    pub fn damped(self, factor: f64) -> Self {
        Self { gamma: factor * self.gamma, ..self }
    }

    /// Damping stress tau_d = (gamma/2) (dF F^T + F dF^T) (TL Eqs. 23, 24).
    #[inline(always)]
    pub fn damping<S: Real, const D: usize>(&self, f: Tensor<S, D>, rate: Tensor<S, D>) -> Tensor<S, D> {
        rate.mul(f.transpose()).symmetric().times(S::of(self.gamma))
    }

    /// (tau + tau_d) F^-T B^T, what the nested forms hand over: B is symmetric but for the rounding of listed weights, and only B^T is the adjoint
    /// of the gradient whatever they are.
    #[inline(always)]
    pub fn corrected<S: Real, const D: usize>(
        &self,
        f: Tensor<S, D>,
        damping: Tensor<S, D>,
        correction: Tensor<S, D>,
    ) -> Tensor<S, D> {
        let tau = self.material.kirchhoff(f);
        let in_plane: Tensor<S, D> = Tensor::from_fn(|i, j| tau[i][j] + damping[i][j]);
        in_plane.mul(f.inverse().transpose()).mul(correction.transpose())
    }

    /// State of a stored particle.
    pub(crate) fn state<const D: usize>(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        let word = |field, k| run.word(field, k, place);
        let tensor = |field| Tensor::<f64, D>::from_fn(|i, j| word(field, i * D + j));
        let (later, rate) = (tensor(Quantity::DeformationGradient), tensor(Quantity::DeformationRate));
        let f = later.plus(-ahead, rate);
        let power = self.damping(later, rate).mul(later.inverse().transpose()).double_dot(rate);
        let j = f.det();
        State {
            deformation: Some(f.lift(1.0)),
            gradient: None,
            density: self.material.moduli().density / j,
            cauchy: self.material.kirchhoff(f).times(1.0 / j),
            strain_energy: self.material.energy(f) * word(Quantity::Volume, 0),
            booked_ahead: if ahead > 0.0 { ahead * power * word(Quantity::Volume, 0) } else { 0.0 },
            couple: [0.0; 3],
        }
    }
}
