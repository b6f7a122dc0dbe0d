//! The small-strain formulation, `small-strain` (SS Eqs. 3-11): Hooke's law on the gradient of the displacement, kernel and gradient of the undeformed body. Everything
//! is linear, so that a load twice as large moves twice as far, whatever the strain; turns count as strains.

mod normalisation;
mod passes;

pub use normalisation::{Adjoint, Bare, Literal, Normalisation};

use super::undeformed::{Momentum, Rate};
use super::{Formulation, State};
use crate::field::Quantity;
use crate::kernel::Kernel;
use crate::material::LinearElastic;
use crate::math::Tensor;
use crate::pass::Now;
use crate::run::Run;
use passes::{Kick, Readying, Strain, Weighing};
use std::marker::PhantomData;

/// rho0 a = sum_b (sigma_a/s_a + sigma_b/s_b) . grad W V_b with eps = sym(sum_b (u_b - u_a) (x) grad W V_b) / s_a, where `N` says
/// what s is.
#[derive(Clone, Copy, Debug)]
pub struct SmallStrain<N> {
    /// The material.
    pub material: LinearElastic,
    kernel: Kernel,
    normalisation: PhantomData<N>,
}

impl<N: Normalisation> SmallStrain<N> {
    /// With this kernel.
    #[must_use]
    pub fn new(material: LinearElastic, kernel: Kernel) -> Self {
        Self { material, kernel, normalisation: PhantomData }
    }
}

impl<N: Normalisation, const D: usize> Formulation<D> for SmallStrain<N> {
    const FIELDS: &'static [Quantity] = &[
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
        Quantity::Shepard,
        Quantity::DisplacementGradient,
        Quantity::DeformationRate,
        Quantity::NominalStress,
        Quantity::WaveSpeedSquared,
        Quantity::Dissipated,
        Quantity::ExternalWork,
    ];

    fn relisted(&self, run: &mut impl Run<D>) {
        let c2 = self.material.longitudinal() / self.material.moduli.density;
        let ready = Readying { own: self.kernel.w(0.0), c2 };
        run.pairs(&Weighing(self.kernel), &ready, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        let per_density = 1.0 / self.material.moduli.density;
        run.pairs(&Momentum, &Kick { per_density, normalisation: self.normalisation }, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Rate, &Strain(self), now);
    }

    /// With forces over s_a, the operator is symmetric in the product with m_a s_a.
    fn metric(&self, run: &impl Run<D>, place: usize) -> f64 {
        run.word(Quantity::Mass, 0, place) / N::force(run.word(Quantity::Shepard, 0, place))
    }

    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        let word = |field, k| run.word(field, k, place);
        let tensor = |field| Tensor::<f64, D>::from_fn(|i, j| word(field, i * D + j));
        let h = tensor(Quantity::DisplacementGradient).plus(-ahead, tensor(Quantity::DeformationRate));
        State {
            deformation: None,
            gradient: Some(h.lift(h.trace() * self.material.axial_strain)),
            density: self.material.density(h),
            cauchy: self.material.cauchy(h),
            strain_energy: self.material.energy(h) * word(Quantity::Volume, 0),
            booked_ahead: 0.0,
            couple: [0.0; 3],
        }
    }
}
