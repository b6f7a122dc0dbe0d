//! The essentially non-hourglass formulation, `ul-non-hourglass` (UL section 4).

use super::kick::{Kick, Push};
use super::motion::{Drift, MomentSum};
use super::pressure::{Pushing, push};
use super::{FIELDS, Hypoelastic, same_body};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

/// dv/dt = pressure + A with dA/dt = 2 zeta (G/rho) sum_b (e.v_ab / r) grad W V_b inside the body (UL Eqs. 19, 20): the shear
/// acceleration is integrated itself, not derived from an integrated stress. A is never rotated and never reset, so
/// a stressed body that spins as a whole is outside of what this form can do.
#[derive(Clone, Copy, Debug)]
pub struct NonHourglass {
    /// Shear stress for output; it does not act back.
    pub stress: Hypoelastic,
    /// The factor of Eq. (19).
    pub zeta: f64,
}

impl NonHourglass {
    /// With the paper's zeta = 0.7 d + 2.1.
    #[must_use]
    pub fn new(stress: Hypoelastic, dimension: usize) -> Self {
        Self { stress, zeta: 0.7 * dimension as f64 + 2.1 }
    }

    /// c_M = sqrt((K + 3 zeta G / (d + 2)) / rho0), m/s: Eq. (19) is zeta/(d + 2) (lap v + 2 grad div v) in the continuum, so the
    /// fastest wave is faster than the bulk wave that the paper's acoustic step (Eq. 22) looks at.
    #[must_use]
    pub fn shear_speed(&self, moduli: &Moduli, dimension: usize) -> f64 {
        let extra = 3.0 * self.zeta * moduli.shear / (dimension as f64 + 2.0);
        ((moduli.bulk + extra) / moduli.density).sqrt()
    }
}

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
struct Momentum;

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

/// Sums for the rates of density, shear acceleration and (for output) shear stress.
struct RateSum;

impl<const D: usize> PairSum<D> for RateSum {
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
        ab.along(&mut sum.shear, ab.e, inside.dot(ab.e));
        ab.outer(&mut sum.l, -inside);
    }
}

/// drho/dt, A and s at the end of the step (UL Eqs. 11, 20, 25, 26).
struct Integrate<'a>(&'a NonHourglass);

impl<const D: usize> Update<D> for Integrate<'_> {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let rate = a.density * sum.compression;
        let stiffness = a.g * (a.volume / a.m) * S::of(2.0 * self.0.zeta);
        let new = self.0.stress.rate(sum.l.mul(a.correction), a.s, a.g);
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

impl<const D: usize> Formulation<D> for NonHourglass {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.pairs(&Momentum, &Kick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Integrate(self), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        super::state(run, place, run.word(Quantity::ShearWork, 0, place))
    }
}
