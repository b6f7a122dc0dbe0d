//! Hooke's law of small strains (SS Eqs. 3, 8).

use super::Moduli;
use crate::math::{Real, Tensor};

/// sigma = gamma tr(eps) 1 + 2 G eps. The paper's "G" is E/(1 + nu), twice the shear modulus G; its p is gamma tr(eps), positive in tension. In the
/// plane the trace is that of the plane, and what happens on the third axis is a multiple of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearElastic {
    /// The elastic moduli.
    pub moduli: Moduli,
    /// gamma, Pa.
    pub coupling: f64,
    /// sigma_zz of a body in the plane over tr(eps), Pa.
    pub axial_stress: f64,
    /// eps_zz of a body in the plane over tr(eps).
    pub axial_strain: f64,
}

impl LinearElastic {
    /// In space, and in plane strain: gamma = nu E / ((1 + nu)(1 - 2 nu)), Lamé's constant.
    #[must_use]
    pub fn solid(moduli: Moduli) -> Self {
        let coupling = moduli.lambda();
        Self { moduli, coupling, axial_stress: coupling, axial_strain: 0.0 }
    }

    /// In plane stress: gamma = nu E / ((1 + nu)(1 - nu)), from sigma_zz = 0. (SS Eq. 8 prints that of plane strain, its appendix both.)
    #[must_use]
    pub fn plane_stress(moduli: Moduli) -> Self {
        let share = moduli.lambda() / (moduli.lambda() + 2.0 * moduli.shear);
        Self { moduli, coupling: 2.0 * moduli.shear * share, axial_stress: 0.0, axial_strain: -share }
    }

    /// rho0 c^2 of longitudinal waves, Pa.
    #[must_use]
    pub fn longitudinal(&self) -> f64 {
        self.coupling + 2.0 * self.moduli.shear
    }

    /// Stress of a displacement gradient, Pa.
    #[inline(always)]
    pub fn stress<S: Real, const D: usize>(&self, gradient: Tensor<S, D>) -> Tensor<S, D> {
        let strain = gradient.symmetric();
        strain.times(S::of(2.0 * self.moduli.shear)).plus_diagonal(strain.trace() * S::of(self.coupling))
    }

    /// Strain in three dimensions.
    #[must_use]
    pub fn strain<const D: usize>(&self, gradient: Tensor<f64, D>) -> Tensor<f64, 3> {
        let strain = gradient.symmetric();
        strain.lift(strain.trace() * self.axial_strain)
    }

    /// Stress in three dimensions, Pa.
    #[must_use]
    pub fn cauchy<const D: usize>(&self, gradient: Tensor<f64, D>) -> Tensor<f64, 3> {
        self.stress(gradient).lift(gradient.trace() * self.axial_stress)
    }

    /// Strain energy per volume, J/m^3.
    #[must_use]
    pub fn energy<const D: usize>(&self, gradient: Tensor<f64, D>) -> f64 {
        0.5 * self.stress(gradient).double_dot(gradient)
    }

    /// Density, kg/m^3 (SS Eq. 6): rho0 exp(-tr eps) with the trace in three dimensions, which is (1 - 2 nu)/(nu "G") p in either plane. For
    /// output: in all sums the density stays rho0, or the response would not be linear (SS Fig. 14).
    #[must_use]
    pub fn density<const D: usize>(&self, gradient: Tensor<f64, D>) -> f64 {
        self.moduli.density * (-self.strain(gradient).trace()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The moduli of the paper: E = 0.39 Pa and "G" = 0.3 Pa, so nu = 0.3.
    fn paper() -> Moduli {
        Moduli::from_young(1000.0, 0.39, 0.3)
    }

    #[test]
    fn coupling_is_that_of_the_paper() {
        let (nu, g) = (0.3, 0.3);
        assert!((LinearElastic::solid(paper()).coupling - nu * g / (1.0 - 2.0 * nu)).abs() < 1e-15);
        assert!((LinearElastic::plane_stress(paper()).coupling - nu * g / (1.0 - nu)).abs() < 1e-15);
    }

    /// Pulled along x in plane stress: sigma_x = E eps_x, eps_y = eps_z = -nu eps_x.
    #[test]
    fn plane_stress_is_a_free_third_axis() {
        let material = LinearElastic::plane_stress(paper());
        let gradient = Tensor([[1e-3, 2e-4], [-2e-4, -3e-4]]);
        let (stress, strain) = (material.cauchy(gradient), material.strain(gradient));
        assert!((stress[0][0] - 0.39e-3).abs() < 1e-17 && stress[1][1].abs() < 1e-17 && stress[2][2] == 0.0);
        assert!((strain[2][2] + 3e-4).abs() < 1e-17 && strain[0][1] == 0.0);
        assert!((material.energy(gradient) - 0.5 * 0.39e-6).abs() < 1e-19);
    }

    /// SS Eq. 6 as it is printed, with p = gamma tr(eps) of either plane.
    #[test]
    fn density_follows_the_pressure() {
        let gradient = Tensor([[2e-3, 1e-3], [0.0, 5e-4]]);
        for material in [LinearElastic::solid(paper()), LinearElastic::plane_stress(paper())] {
            let p = material.coupling * gradient.trace();
            let printed = 1000.0 * (-(1.0 - 0.6) / (0.3 * 0.3) * p).exp();
            assert!((material.density(gradient) / printed - 1.0).abs() < 1e-14);
        }
    }
}
