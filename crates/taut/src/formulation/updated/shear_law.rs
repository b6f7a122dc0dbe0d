//! What the shear stress of `ul-generalised` is, and how a particle carries it along.

use super::{Hypoelastic, ShearTensor};
use crate::material::Plane;
use crate::math::{Real, Tensor};
use std::fmt::Debug;

/// How a particle deforms in a part of a step.
#[derive(Clone, Copy, Debug)]
pub struct Increment<S, const D: usize> {
    /// Increment of the displacement over distances in the middle of it.
    pub gradient: Tensor<S, D>,
    /// Its spin as a rotation, (1 - w/2)^-1 (1 + w/2) (Hughes and Winget 1980).
    pub turn: Tensor<S, D>,
    /// The deformation gradient from before to after.
    pub f: Tensor<S, D>,
}

/// A law of shear stress. What a particle carries is the shear stress up to a pressure, Pa; 0 at rest.
pub trait ShearLaw: Copy + Debug + Send + Sync + 'static {
    /// What is carried after an increment, with the shear modulus `g`.
    fn carried<S: Real, const D: usize>(
        &self,
        from: ShearTensor<S, D>,
        by: &Increment<S, D>,
        g: S,
    ) -> ShearTensor<S, D>;

    /// The shear part of the Cauchy stress at a density of `ratio` times that at rest.
    fn cauchy<S: Real, const D: usize>(&self, carried: ShearTensor<S, D>, ratio: S) -> ShearTensor<S, D>;

    /// Stored energy per volume at rest, J/m^3.
    fn energy<const D: usize>(&self, carried: ShearTensor<f64, D>, ratio: f64, g: f64) -> f64;
}

/// ds/dt = 2G dev(sym L) + w.s - s.w, as published. In simple shear s_12 = G sin(gamma): it falls beyond gamma = pi/2.
impl ShearLaw for Hypoelastic {
    #[inline(always)]
    fn carried<S: Real, const D: usize>(
        &self,
        from: ShearTensor<S, D>,
        by: &Increment<S, D>,
        g: S,
    ) -> ShearTensor<S, D> {
        let added = self.of_strain(by.gradient.symmetric(), g);
        let s = by.turn.mul(from.s).mul(by.turn.transpose()) + added.s;
        ShearTensor { s, axial: from.axial + added.axial }
    }

    #[inline(always)]
    fn cauchy<S: Real, const D: usize>(&self, carried: ShearTensor<S, D>, _: S) -> ShearTensor<S, D> {
        carried
    }

    fn energy<const D: usize>(&self, carried: ShearTensor<f64, D>, ratio: f64, g: f64) -> f64 {
        let s = carried.s.lift(carried.axial);
        s.double_dot(s) / (4.0 * g * ratio)
    }
}

/// J s = G dev b, W = G/2 (tr b - d), with the isochoric left Cauchy-Green tensor b of all deformation since the start (TL Eqs. 10-14), which is
/// handed on by b <- J^(-2/d) f b f^T. Carried is G (b - 1). In simple shear s_12 = G gamma.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookeanShear {
    /// The meaning of 2D.
    pub plane: Plane,
}

impl ShearLaw for NeoHookeanShear {
    #[inline(always)]
    fn carried<S: Real, const D: usize>(
        &self,
        from: ShearTensor<S, D>,
        by: &Increment<S, D>,
        g: S,
    ) -> ShearTensor<S, D> {
        let d = self.plane.d(D);
        let factor = by.f.det().isochoric(d);
        let unit = by.f.mul(by.f.transpose()).times(factor).plus_diagonal(-S::one());
        let s = by.f.mul(from.s).mul(by.f.transpose()).times(factor).plus(g, unit);
        let axial = factor * from.axial + g * (factor - S::one());
        ShearTensor { s, axial: if d == D as f64 { S::zero() } else { axial } }
    }

    #[inline(always)]
    fn cauchy<S: Real, const D: usize>(&self, carried: ShearTensor<S, D>, ratio: S) -> ShearTensor<S, D> {
        let d = self.plane.d(D);
        let mean = (carried.s.trace() + carried.axial) * S::of(-1.0 / d);
        let axial = if d == D as f64 { S::zero() } else { (carried.axial + mean) * ratio };
        ShearTensor { s: carried.s.plus_diagonal(mean).times(ratio), axial }
    }

    fn energy<const D: usize>(&self, carried: ShearTensor<f64, D>, _: f64, _: f64) -> f64 {
        0.5 * (carried.s.trace() + carried.axial)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Hyperelastic, Moduli, NeoHookean};

    const G: f64 = 3.0;

    /// What is carried after `n` equal increments of F.
    fn after<L: ShearLaw, const D: usize>(law: L, rate: Tensor<f64, D>, n: usize) -> ShearTensor<f64, D> {
        let (mut f, mut carried) = (Tensor::diagonal(1.0), ShearTensor { s: Tensor::zero(), axial: 0.0 });
        for _ in 0..n {
            let change = rate.times(1.0 / n as f64);
            let gradient = change.mul(f.plus(0.5, change).inverse());
            let by = Increment {
                gradient,
                turn: gradient.antisymmetric().times(0.5).rotation(),
                f: change.mul(f.inverse()).plus_diagonal(1.0),
            };
            carried = law.carried(carried, &by, G);
            f = f + change;
        }
        carried
    }

    /// The rate of Jaumann turns with half of the shear and so takes back what it has built up; rubber goes on.
    #[test]
    fn simple_shear_of_three() {
        for gamma in [0.5, 1.0, 2.0, 3.0f64] {
            let rate = Tensor([[0.0, gamma], [0.0, 0.0]]);
            let jaumann = after(Hypoelastic { plane: Plane::Strain }, rate, 3000);
            // What a step adds is not turned by that step: (1 - cos gamma)/2 times G and the shear of a step.
            assert!((jaumann.s[0][1] - G * gamma.sin()).abs() < G * gamma / 3000.0, "{gamma}: {jaumann:?}");
            let rubber = NeoHookeanShear { plane: Plane::Strain };
            let s = rubber.cauchy(after(rubber, rate, 3000), 1.0);
            // Exact for any number of steps, but for 3000 roundings.
            assert!((s.s[0][1] - G * gamma).abs() < 3000.0 * 1e-15 * G, "{gamma}: {s:?}");
        }
    }

    /// Stress and energy are those of the neo-Hookean material of total Lagrangian bodies, less what they have of the bulk.
    fn is_the_material<const D: usize>(plane: Plane, rate: Tensor<f64, D>) {
        let law = NeoHookeanShear { plane };
        let material = NeoHookean { moduli: Moduli { density: 1.0, bulk: 0.0, shear: G }, plane };
        let (f, carried) = (rate.plus_diagonal(1.0), after(law, rate, 7));
        let (j, s) = (f.det(), law.cauchy(carried, 1.0 / f.det()));
        let error = s.s.lift(s.axial).times(j) - material.kirchhoff(f);
        assert!(error.double_dot(error).sqrt() < 1e-13 * G, "{error:?}");
        let energy = law.energy(carried, 1.0 / j, G);
        assert!((energy / material.energy(f) - 1.0).abs() < 1e-13, "{energy}");
    }

    #[test]
    fn it_is_the_neo_hookean_material() {
        let plane = Tensor([[0.4, 0.7], [-0.3, -0.2]]);
        is_the_material(Plane::Strain, plane);
        is_the_material(Plane::Papers, plane);
        is_the_material(Plane::Strain, Tensor([[0.4, 0.7, 0.1], [-0.3, -0.2, 0.0], [0.2, -0.5, 0.3]]));
    }
}
