//! A shear acceleration that is integrated itself, shared by the forms that take it from a Laplacian of velocity (UL section 4).

use super::kick::Push;
use super::pressure::{Pushing, push};
use super::{Hypoelastic, same_body};
use crate::field::Of;
use crate::math::{Real, Vector};
use crate::pass::{Now, Pair, PairSum, Update};
use std::marker::PhantomData;

record! {
    /// What the force needs.
    Pressed { v: Velocity, p: Pressure, z: Impedance }
    /// What the rates need.
    Flow { v: Velocity, body: Body }
    /// The sums of the rates.
    Rates { compression: Compression, shear: ShearAcceleration, l: VelocityGradient }
    /// A particle before.
    Before {
        density: Density, m: Mass, volume: Volume, g: ShearModulus, shear: ShearAcceleration, correction: Correction,
        s: ShearStress, s_rate: ShearStressRate, axial: AxialShearStress, axial_rate: AxialShearStressRate,
    }
    /// A particle after.
    After {
        density: Density, rate: DensityRate, shear: ShearAcceleration,
        s: ShearStress, s_rate: ShearStressRate, axial: AxialShearStress, axial_rate: AxialShearStressRate,
    }
}

/// The force sum.
pub struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Pressed<f64, D>;
    type Adds = Push<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Push<S, D>,
        (a, b): (&Pressed<S, D>, &Pressed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let a = Pushing { v: a.v, p: a.p, z: a.z };
        let b = Pushing { v: b.v, p: b.p, z: b.z };
        push((&mut sum.f, &mut sum.power), (&a, &b), ab);
    }
}

/// A sum that is half of the Laplacian of velocity.
pub trait HalfLaplacian: Sync {
    /// Adds the part of a pair, v = v_a - v_b.
    fn add<S: Real, const D: usize, const M: u8>(sum: &mut Vector<S, D>, v: Vector<S, D>, ab: &Pair<S, D, M>);
}

/// Sums for the rates of density, shear acceleration and (for output) shear stress.
pub struct RateSum<L>(pub PhantomData<L>);

impl<L: HalfLaplacian, const D: usize> PairSum<D> for RateSum<L> {
    type Reads = Flow<f64, D>;
    type Adds = Rates<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Rates<S, D>,
        (a, b): (&Flow<S, D>, &Flow<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let v = a.v - b.v;
        ab.divergence(&mut sum.compression, v);
        let inside = v.times(same_body(a.body, b.body));
        L::add(&mut sum.shear, inside, ab);
        ab.outer(&mut sum.l, -inside);
    }
}

/// drho/dt, A and s at the end of the step (UL Eqs. 11, 20, 25, 26).
pub struct Integrate {
    /// Shear stress for output; it does not act back.
    pub stress: Hypoelastic,
    /// What the sum is multiplied by to be a Laplacian.
    pub factor: f64,
}

impl<const D: usize> Update<D> for Integrate {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let rate = a.density * sum.compression;
        let stiffness = a.g * (a.volume / a.m) * S::of(self.factor);
        let new = self.stress.rate(sum.l.mul(a.correction), a.s, a.g);
        After {
            density: half.mul_add(rate, a.density),
            rate,
            shear: a.shear.plus(now.dt * stiffness, sum.shear),
            s: a.s.plus(half, a.s_rate + new.s),
            s_rate: new.s,
            axial: half.mul_add(a.axial_rate + new.axial, a.axial),
            axial_rate: new.axial,
        }
    }
}
