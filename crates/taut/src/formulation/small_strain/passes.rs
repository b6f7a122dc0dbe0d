//! The passes of the small-strain form.

use super::{Normalisation, SmallStrain};
use crate::field::Of;
use crate::formulation::kick::Mover;
use crate::formulation::undeformed::{Force, Gradient};
use crate::kernel::Kernel;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};
use std::marker::PhantomData;

record! {
    /// A reference particle.
    Placed { volume: Volume }
    /// Its Shepard sum.
    Weighed { s: Shepard }
    /// The same, and its wave speed.
    Ready { s: Shepard, c2: WaveSpeedSquared }
    /// A particle about to be deformed.
    Formed { u: Displacement, v: Velocity, h: DisplacementGradient, s: Shepard }
    /// A particle deformed.
    Deformed { u: Displacement, h: DisplacementGradient, rate: DeformationRate, q: NominalStress }
    /// A particle about to be accelerated.
    Inert { v: Velocity, m: Mass, b: BodyForce, free: Free, given: PrescribedVelocity, work: ExternalWork, s: Shepard }
    /// A particle accelerated.
    Moved { v: Velocity, a: Acceleration, work: ExternalWork }
}

/// sum_b W_ab V_b without a itself.
pub struct Weighing(pub Kernel);

impl<const D: usize> PairSum<D> for Weighing {
    type Reads = Placed<f64, D>;
    type Adds = Weighed<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Weighed<S, D>,
        _: (&Placed<S, D>, &Placed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        // What fills the last lanes is a particle and itself, without weight: keep its quotient finite.
        let r2 = ab.x.norm_squared().max(S::of(1e-12 * self.0.h() * self.0.h()));
        sum.s = sum.s + self.0.w_over_slope(r2) * r2 * ab.w;
    }
}

/// s_a = sum_b W_ab V_b + W(0) V_a, and the speed of longitudinal waves.
pub struct Readying {
    /// W(0), m^-D.
    pub own: f64,
    /// c^2, m^2/s^2.
    pub c2: f64,
}

impl<const D: usize> Update<D> for Readying {
    type Sum = Weighed<f64, D>;
    type Reads = Placed<f64, D>;
    type Writes = Ready<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Weighed<S, D>, a: &Placed<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        Ready { s: a.volume.mul_add(S::of(self.own), sum.s), c2: S::of(self.c2) }
    }
}

/// u += dt v (SS Eq. 11); the gradient of u, which is linear in v, likewise; then the stress (SS Eq. 3). The end of one step and
/// the beginning of the next, fused.
pub struct Strain<'a, N>(pub &'a SmallStrain<N>);

impl<N: Normalisation, const D: usize> Update<D> for Strain<'_, N> {
    type Sum = Gradient<f64, D>;
    type Reads = Formed<f64, D>;
    type Writes = Deformed<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Gradient<S, D>, a: &Formed<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let rate = sum.l.times(N::gradient(a.s));
        let h = a.h.plus(now.dt, rate);
        let q = self.0.material.stress(h).times(N::stress(a.s));
        Deformed { u: a.u.plus(now.dt, a.v), h, rate, q }
    }
}

/// v += dt (f / rho0 + b), then constraints (SS Eqs. 7, 10).
pub struct Kick<N> {
    /// 1 / rho0, m^3/kg.
    pub per_density: f64,
    /// Which normalisation.
    pub normalisation: PhantomData<N>,
}

impl<N: Normalisation, const D: usize> Update<D> for Kick<N> {
    type Sum = Force<f64, D>;
    type Reads = Inert<f64, D>;
    type Writes = Moved<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Force<S, D>, a: &Inert<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let mover = Mover { v: a.v, m: a.m, b: a.b, free: a.free, given: a.given };
        let kicked = mover.kick(sum.f.times(S::of(self.per_density) * N::force(a.s)), now);
        Moved { v: kicked.v, a: kicked.a, work: a.work + kicked.external_work }
    }
}
