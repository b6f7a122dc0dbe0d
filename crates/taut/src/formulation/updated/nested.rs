//! The nested formulation, `ul-nested` (UL section 3, SPH-OG).

use super::kick::{Kick, Push};
use super::motion::Drift;
use super::pressure::{Pushing, push};
use super::{FIELDS, Hypoelastic, same_body};
use crate::field::{Of, Quantity};
use crate::formulation::{Formulation, State};
use crate::math::{Real, Tensor};
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

/// dv/dt = pressure + (V_a/m_a) sum_b (s_a + s_b) grad W V_b inside the body, with s integrated from the gradient of velocity
/// (UL Eqs. 7-14, no kernel correction). Blind to zig-zag modes, and torn apart by them: the negative control.
#[derive(Clone, Copy, Debug)]
pub struct Nested {
    /// The shear stress.
    pub stress: Hypoelastic,
}

record! {
    /// What the force needs.
    Stressed { v: Velocity, p: Pressure, z: Impedance, s: ShearStress, body: Body }
    /// What the rates need.
    Flow { v: Velocity, body: Body }
    /// The sums of the rates.
    Rates { compression: Compression, l: VelocityGradient }
    /// Shear stress about to be integrated.
    Sheared { s: ShearStress, s_rate: ShearStressRate, axial: AxialShearStress, axial_rate: AxialShearStressRate }
    /// Shear stress half a step later.
    Shifted { s: ShearStress, axial: AxialShearStress }
    /// A particle before.
    Before { density: Density, g: ShearModulus, s: ShearStress, axial: AxialShearStress }
    /// A particle after.
    After {
        density: Density, rate: DensityRate, s: ShearStress, s_rate: ShearStressRate,
        axial: AxialShearStress, axial_rate: AxialShearStressRate,
    }
}

/// Half a step of the shear stress.
struct Shear;

impl<const D: usize> Update<D> for Shear {
    type Sum = ();
    type Reads = Sheared<f64, D>;
    type Writes = Shifted<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Sheared<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        Shifted { s: a.s.plus(half, a.s_rate), axial: half.mul_add(a.axial_rate, a.axial) }
    }
}

/// The force sum.
struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Stressed<f64, D>;
    type Adds = Push<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Push<S, D>,
        (a, b): (&Stressed<S, D>, &Stressed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let pushing = |p: &Stressed<S, D>| Pushing { v: p.v, p: p.p, z: p.z };
        push((&mut sum.f, &mut sum.power), (&pushing(a), &pushing(b)), ab);
        ab.dot(&mut sum.f, (a.s + b.s).times(same_body(a.body, b.body)));
    }
}

/// Sums for the rates of density and shear stress.
struct RateSum;

impl<const D: usize> PairSum<D> for RateSum {
    type Reads = Flow<f64, D>;
    type Adds = Rates<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Rates<S, D>,
        (a, b): (&Flow<S, D>, &Flow<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let v = b.v - a.v;
        ab.divergence(&mut sum.compression, -v);
        ab.outer(&mut sum.l, v.times(same_body(a.body, b.body)));
    }
}

/// The second half of the step of density and shear stress.
struct Integrate(Hypoelastic);

impl<const D: usize> Update<D> for Integrate {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let rate = a.density * sum.compression;
        let new = self.0.rate(sum.l, a.s, a.g);
        After {
            density: half.mul_add(rate, a.density),
            rate,
            s: a.s.plus(half, new.s),
            s_rate: new.s,
            axial: half.mul_add(new.axial, a.axial),
            axial_rate: new.axial,
        }
    }
}

impl<const D: usize> Formulation<D> for Nested {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted(&self, _: &mut impl Run<D>) {}

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.each(&Shear, now);
        run.pairs(&Momentum, &Kick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Integrate(self.stress), now);
    }

    /// The shear energy is s:s / (4G) per volume.
    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        let word = |field, k| run.word(field, k, place);
        let s: Tensor<f64, 3> = Tensor::<f64, D>::from_fn(|i, j| word(Quantity::ShearStress, i * D + j))
            .lift(word(Quantity::AxialShearStress, 0));
        let volume = word(Quantity::Mass, 0) / word(Quantity::Density, 0);
        super::state(run, place, volume * s.double_dot(s) / (4.0 * word(Quantity::ShearModulus, 0)))
    }
}
