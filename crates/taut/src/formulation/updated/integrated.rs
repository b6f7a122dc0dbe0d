//! A shear stress that is integrated in time, shared by the forms that nest one gradient into another (UL section 3).

use super::{Hypoelastic, same_body, shear_stress};
use crate::field::{Of, Quantity};
use crate::formulation::State;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

record! {
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
    /// A particle before, whose gradients are corrected.
    Correctable { density: Density, g: ShearModulus, s: ShearStress, axial: AxialShearStress, b: Correction }
    /// A particle after.
    After {
        density: Density, rate: DensityRate, s: ShearStress, s_rate: ShearStressRate,
        axial: AxialShearStress, axial_rate: AxialShearStressRate,
    }
}

/// Half a step of the shear stress.
pub struct Shear;

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

/// Sums for the rates of density and shear stress.
pub struct RateSum;

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
pub struct Integrate(pub Hypoelastic);

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

/// The same with L corrected by B (UL Eq. 26).
pub struct IntegrateCorrected(pub Hypoelastic);

impl<const D: usize> Update<D> for IntegrateCorrected {
    type Sum = Rates<f64, D>;
    type Reads = Correctable<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Correctable<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let corrected = Rates { l: sum.l.mul(a.b), ..*sum };
        let before = Before { density: a.density, g: a.g, s: a.s, axial: a.axial };
        Integrate(self.0).at(&corrected, &before, now)
    }
}

/// The state, with the energy s:s / (4G) per volume, and what work of other shear forces has stored (`ShearWork`).
pub fn state<const D: usize>(run: &impl Run<D>, place: usize) -> State {
    let word = |field, k| run.word(field, k, place);
    let s = shear_stress(run, place);
    let volume = word(Quantity::Mass, 0) / word(Quantity::Density, 0);
    let elastic = volume * s.double_dot(s) / (4.0 * word(Quantity::ShearModulus, 0));
    super::state(run, place, (s, elastic + word(Quantity::ShearWork, 0)))
}
