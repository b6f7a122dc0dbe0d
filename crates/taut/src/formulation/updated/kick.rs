//! New velocities of updated Lagrangian particles.

use crate::field::Of;
use crate::formulation::kick::Mover;
use crate::math::{Real, Vector};
use crate::pass::{Now, Update};

record! {
    /// Force per volume of a, and the power that dissipation takes, per volume.
    Push { f: ForceDensity, power: DissipationRate }
    /// The same, and the force of a control beside it.
    ControlledPush { f: ForceDensity, power: DissipationRate, g: ControlForce }
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
        a.moved(sum.f, (a.shear, sum.power), now)
    }
}

/// The same with a control in the place of A: a = (V/m) (f + g), the work of g in the books of the shear forces.
pub struct ControlledKick;

impl<const D: usize> Update<D> for ControlledKick {
    type Sum = ControlledPush<f64, D>;
    type Reads = Inert<f64, D>;
    type Writes = Moved<f64, D>;

    #[inline(always)]
    fn at<S: Real>(
        &self,
        sum: &ControlledPush<S, D>,
        a: &Inert<S, D>,
        now: &Now<S>,
    ) -> Of<Self::Writes, S, D> {
        a.moved(sum.f, (sum.g.times(a.volume / a.m), sum.power), now)
    }
}

impl<S: Real, const D: usize> Inert<S, D> {
    /// Moved by the force density `f`, a shear acceleration whose work is stored, and what dissipation takes per volume.
    #[inline(always)]
    fn moved(&self, f: Vector<S, D>, (shear, power): (Vector<S, D>, S), now: &Now<S>) -> Moved<S, D> {
        let internal = f.times(self.volume / self.m) + shear;
        let mover = Mover { v: self.v, m: self.m, b: self.b, free: self.free, given: self.given };
        let kicked = mover.kick(internal, now);
        // On all that moves, led particles included: what holds them against it is in the external work.
        let stored = (self.m * now.dt) * shear.dot(kicked.mean);
        Moved {
            x: self.x.plus(now.dt * S::of(0.5), kicked.v),
            v: kicked.v,
            a: kicked.a,
            work: self.work + kicked.external_work,
            stored: self.stored - stored,
            dissipated: (self.volume * now.dt).mul_add(power, self.dissipated),
        }
    }
}
