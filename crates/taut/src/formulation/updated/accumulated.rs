//! A shear acceleration that is integrated itself, shared by the forms that take it from a Laplacian of velocity (UL section 4).
//! Their motion needs no shear stress; who wants to see one has it integrated beside (UL Eqs. 6-8, 26, 27).

use super::kick::Push;
use super::motion::MomentSum;
use super::pressure::{Pushing, push};
use super::{FIELDS, Hypoelastic, MOTION, same_body, shear_stress};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::math::{Real, Tensor, Vector};
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;
use std::fmt::Debug;
use std::marker::PhantomData;

record! {
    /// What the force needs.
    Pressed { v: Velocity, p: Pressure, z: Impedance }
    /// What the rates need.
    Flow { v: Velocity, body: Body }
    /// The sums of the rates.
    Rates { compression: Compression, shear: ShearAcceleration }
    /// The same, with what a stress needs.
    Watched { compression: Compression, shear: ShearAcceleration, l: VelocityGradient }
    /// A particle before.
    Before { density: Density, m: Mass, volume: Volume, g: ShearModulus, shear: ShearAcceleration }
    /// A particle after.
    After { density: Density, rate: DensityRate, shear: ShearAcceleration }
    /// The same with its stress.
    Seen {
        density: Density, m: Mass, volume: Volume, g: ShearModulus, shear: ShearAcceleration, correction: Correction,
        s: ShearStress, s_rate: ShearStressRate, axial: AxialShearStress, axial_rate: AxialShearStressRate,
    }
    /// The same after.
    SeenAfter {
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

/// Who looks at the shear stress: its law does, by integrating it; or nobody, at no cost.
pub trait Watch: Copy + Debug + Send + Sync + 'static {
    /// The fields of a form that is looked at so.
    const FIELDS: &'static [Quantity];

    /// What a new list asks for.
    fn relisted<const D: usize>(&self, run: &mut impl Run<D>);

    /// drho/dt and A at the end of the step (UL Eqs. 11, 20, 25), with `factor` times the sum of L for a Laplacian.
    fn rates<L: HalfLaplacian, const D: usize>(&self, factor: f64, run: &mut impl Run<D>, now: Now<f64>);

    /// The shear stress of a stored particle, Pa, in three dimensions.
    fn seen<const D: usize>(run: &impl Run<D>, place: usize) -> Tensor<f64, 3>;
}

/// Nobody looks: a step costs what its motion costs.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    const FIELDS: &'static [Quantity] = MOTION;

    fn relisted<const D: usize>(&self, _: &mut impl Run<D>) {}

    fn rates<L: HalfLaplacian, const D: usize>(&self, factor: f64, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum::<L>(PhantomData), &Integrate(factor), now);
    }

    fn seen<const D: usize>(_: &impl Run<D>, _: usize) -> Tensor<f64, 3> {
        Tensor::zero()
    }
}

impl Watch for Hypoelastic {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted<const D: usize>(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn rates<L: HalfLaplacian, const D: usize>(&self, factor: f64, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&WatchedSum::<L>(PhantomData), &Watching(*self, factor), now);
    }

    fn seen<const D: usize>(run: &impl Run<D>, place: usize) -> Tensor<f64, 3> {
        shear_stress(run, place)
    }
}

/// Sums for the rates of density and shear acceleration.
struct RateSum<L>(PhantomData<L>);

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
        L::add(&mut sum.shear, v.times(same_body(a.body, b.body)), ab);
    }
}

/// The same, and the gradient of velocity.
struct WatchedSum<L>(PhantomData<L>);

impl<L: HalfLaplacian, const D: usize> PairSum<D> for WatchedSum<L> {
    type Reads = Flow<f64, D>;
    type Adds = Watched<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Watched<S, D>,
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

/// Density and A, and how the sums and the step make them.
#[inline(always)]
fn integrated<S: Real, const D: usize>(
    sum: &Rates<S, D>,
    a: &Before<S, D>,
    (factor, now): (f64, &Now<S>),
) -> After<S, D> {
    let rate = a.density * sum.compression;
    let stiffness = a.g * (a.volume / a.m) * S::of(factor);
    After {
        density: (now.dt * S::of(0.5)).mul_add(rate, a.density),
        rate,
        shear: a.shear.plus(now.dt * stiffness, sum.shear),
    }
}

/// drho/dt and A.
struct Integrate(f64);

impl<const D: usize> Update<D> for Integrate {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        integrated(sum, a, (self.0, now))
    }
}

/// drho/dt, A, and s with the spin of its particle (UL Eqs. 6, 7, 26).
pub struct Watching(pub Hypoelastic, pub f64);

impl<const D: usize> Update<D> for Watching {
    type Sum = Watched<f64, D>;
    type Reads = Seen<f64, D>;
    type Writes = SeenAfter<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Watched<S, D>, a: &Seen<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let sums = Rates { compression: sum.compression, shear: sum.shear };
        let before = Before { density: a.density, m: a.m, volume: a.volume, g: a.g, shear: a.shear };
        let After { density, rate, shear } = integrated(&sums, &before, (self.1, now));
        let new = self.0.rate(sum.l.mul(a.correction), a.s, a.g);
        SeenAfter {
            density,
            rate,
            shear,
            s: a.s.plus(half, a.s_rate + new.s),
            s_rate: new.s,
            axial: half.mul_add(a.axial_rate + new.axial, a.axial),
            axial_rate: new.axial,
        }
    }
}
