//! A shear acceleration that is integrated itself, shared by the forms that take it from a Laplacian of velocity (UL section 4).
//! Their motion needs no shear stress; who wants to see one has it [follow](super::followed).

use super::kick::Push;
use super::pressure::{Pushing, push};
use super::same_body;
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
    Rates { compression: Compression, shear: ShearAcceleration }
    /// A particle before.
    Before { density: Density, m: Mass, volume: Volume, g: ShearModulus, shear: ShearAcceleration }
    /// A particle after.
    After { density: Density, rate: DensityRate, shear: ShearAcceleration }
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
    /// Adds the part of a pair, from v = v_a - v_b and whether both are in one body (1) or not (0).
    fn add<S: Real, const D: usize, const M: u8>(
        sum: &mut Vector<S, D>,
        v_inside: (Vector<S, D>, S),
        ab: &Pair<S, D, M>,
    );
}

/// sum_b (e.v_ab / r) grad W V_b (UL Eq. 19): along the line of the pair, so that a spin makes nothing of it. Here as (x.v_ab / r^2) W'/r V_b x.
pub struct AlongPairs;

impl HalfLaplacian for AlongPairs {
    #[inline(always)]
    fn add<S: Real, const D: usize, const M: u8>(
        sum: &mut Vector<S, D>,
        (v, inside): (Vector<S, D>, S),
        ab: &Pair<S, D, M>,
    ) {
        ab.along(sum, ab.x, v.dot(ab.x) * (ab.over_r * ab.over_r * inside));
    }
}

/// Sums for the rates of density and shear acceleration.
pub struct RateSum<L>(PhantomData<L>);

impl<L> RateSum<L> {
    /// The sum with this Laplacian.
    pub const NEW: Self = Self(PhantomData);
}

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
        L::add(&mut sum.shear, (v, same_body(a.body, b.body)), ab);
    }
}

/// drho/dt and A at the end of the step (UL Eqs. 11, 20, 25), with a factor times the sum for a Laplacian.
pub struct Integrate(pub f64);

impl<const D: usize> Update<D> for Integrate {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let rate = a.density * sum.compression;
        let stiffness = a.g * (a.volume / a.m) * S::of(self.0);
        After {
            density: (now.dt * S::of(0.5)).mul_add(rate, a.density),
            rate,
            shear: a.shear.plus(now.dt * stiffness, sum.shear),
        }
    }
}
