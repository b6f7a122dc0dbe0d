//! New velocities of updated Lagrangian particles.

use crate::field::Of;
use crate::formulation::kick::Mover;
use crate::math::Real;
use crate::pass::{Now, Update};

record! {
    /// Force per volume of a, and the power that dissipation takes, per volume.
    Push { f: ForceDensity, power: DissipationRate }
    /// A particle about to be accelerated.
    Inert {
        x: Position, v: Velocity, m: Mass, volume: Volume, b: BodyForce, free: Free, given: PrescribedVelocity,
        shear: ShearAcceleration, work: ExternalWork, stored: ShearWork, dissipated: Dissipated,
    }
    /// A particle accelerated and moved by half a step.
    Moved {
        x: Position, v: Velocity, a: Acceleration, work: ExternalWork, stored: ShearWork,
        dissipated: Dissipated,
    }
}

/// a = (V/m) f + A; v += dt a; constraints; x += dt/2 v (UL Eqs. 24, 25). The volume is that of the last list, not m over
/// the present density: only then does V_a V_b stand in both halves of a pair, and momentum is exact.
pub struct Kick;

impl<const D: usize> Update<D> for Kick {
    type Sum = Push<f64, D>;
    type Reads = Inert<f64, D>;
    type Writes = Moved<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Push<S, D>, a: &Inert<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let internal = sum.f.times(a.volume / a.m) + a.shear;
        let mover = Mover { v: a.v, m: a.m, b: a.b, free: a.free, given: a.given };
        let kicked = mover.kick(internal, now);
        // On all that moves, led particles included: what holds them against it is in the external work.
        let stored = (a.m * now.dt) * a.shear.dot(kicked.mean);
        Moved {
            x: a.x.plus(now.dt * S::of(0.5), kicked.v),
            v: kicked.v,
            a: kicked.a,
            work: a.work + kicked.external_work,
            stored: a.stored - stored,
            dissipated: (a.volume * now.dt).mul_add(sum.power, a.dissipated),
        }
    }
}
