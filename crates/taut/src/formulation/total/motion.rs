//! The passes that all total Lagrangian formulations share: velocity, deformation and stress.

use super::Solid;
use crate::field::Of;
use crate::formulation::kick::Mover;
use crate::formulation::undeformed::{Force, Gradient};
use crate::material::Hyperelastic;
use crate::math::{Real, Tensor};
use crate::pass::{Now, Update};

record! {
    /// A particle about to be accelerated.
    Inert { v: Velocity, m: Mass, b: BodyForce, free: Free, given: PrescribedVelocity, work: ExternalWork }
    /// A particle accelerated.
    Moved { v: Velocity, a: Acceleration, work: ExternalWork }
    /// A particle about to be deformed.
    Formed {
        u: Displacement, v: Velocity, f: DeformationGradient, correction: Correction, volume: Volume,
        dissipated: Dissipated,
    }
    /// A particle deformed.
    Deformed {
        u: Displacement, f: DeformationGradient, rate: DeformationRate, q: NominalStress, pair: PairStiffness,
        c2: WaveSpeedSquared, dissipated: Dissipated,
    }
}

/// v += dt (f / rho0 + b), then constraints (TL Eq. 31).
pub struct Kick {
    /// 1 / rho0, or a calibrated multiple of it, m^3/kg.
    pub per_density: f64,
}

impl<const D: usize> Update<D> for Kick {
    type Sum = Force<f64, D>;
    type Reads = Inert<f64, D>;
    type Writes = Moved<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Force<S, D>, a: &Inert<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let mover = Mover { v: a.v, m: a.m, b: a.b, free: a.free, given: a.given };
        let kicked = mover.kick(sum.f.times(S::of(self.per_density)), now);
        Moved { v: kicked.v, a: kicked.a, work: a.work + kicked.external_work }
    }
}

/// What a formulation makes of the deformation of a particle.
pub trait Stress<const D: usize>: Send + Sync {
    /// The material and its damper.
    type Material: Hyperelastic;
    /// The solid.
    fn solid(&self) -> &Solid<Self::Material>;
    /// Upper bound of rho0 c^2, Pa, that the time step has to obey.
    #[inline(always)]
    fn stiffness<S: Real>(&self, f: Tensor<S, D>) -> S {
        self.solid().material.stiffness(f)
    }
    /// Stress handed to neighbours, and stiffness of the pair force, from F, damping stress and B.
    fn hand_over<S: Real>(
        &self,
        f: Tensor<S, D>,
        damping: Tensor<S, D>,
        correction: Tensor<S, D>,
    ) -> (Tensor<S, D>, S);
}

/// dF = L B; F += dt dF; u += dt v; then stress, wave speed and dissipation. `now.dt` is the mean of two steps: the end of
/// one and the beginning of the next, fused (TL Eqs. 22, 30, 32).
pub struct Stretch<'a, F>(pub &'a F);

impl<F: Stress<D>, const D: usize> Update<D> for Stretch<'_, F> {
    type Sum = Gradient<f64, D>;
    type Reads = Formed<f64, D>;
    type Writes = Deformed<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Gradient<S, D>, a: &Formed<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let solid = self.0.solid();
        let rate = sum.l.mul(a.correction);
        let f = a.f.plus(now.dt, rate);
        let damping = solid.damping(f, rate);
        let (q, pair) = self.0.hand_over(f, damping, a.correction);
        let inverse = f.inverse();
        // Power of the damper, tau_d F^-T : dF, per reference volume.
        let power = damping.mul(inverse.transpose()).double_dot(rate);
        let c2 = self.0.stiffness(f) * S::of(1.0 / solid.material.moduli().density);
        // An inverted particle has no wave speed: infinite, so that the step sees it at once. One whose F is
        // not a number has none either, but that is another cause: NaN stays NaN.
        let inverted = f.det().lt(S::of(f64::MIN_POSITIVE));
        Deformed {
            u: a.u.plus(now.dt, a.v),
            f,
            rate,
            q,
            pair,
            c2: S::select(inverted, S::of(f64::INFINITY), c2),
            dissipated: (a.volume * now.dt).mul_add(power, a.dissipated),
        }
    }
}
