//! The non-hourglass form with the Riemann solver that its paper cites, `ul-low-dissipation` (Zhang, Hu and Adams 2017).

use super::accumulated::{AlongPairs, HalfLaplacian, Integrate, Rates};
use super::followed::{FOLLOWED, Watch};
use super::kick::{Kick, Push};
use super::motion::Drift;
use super::{Hypoelastic, same_body};
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum};
use crate::run::Run;

/// As [`NonHourglass`](super::NonHourglass), with the interface values of the low-dissipation solver that UL section 3 names:
///
/// P* = (p_a + p_b)/2 + beta Z (U_a - U_b)/2, beta = min(3 max(U_a - U_b, 0)/c0, 1), and U* = (U_a + U_b)/2 + (p_a - p_b)/(2 Z),
///
/// U the velocity along the unit vector from a to b. The published periods do not come out: the jump of pressure in U* diffuses the
/// pressure of bending away, so that a plate is soft and loses its energy. For comparison.
#[derive(Clone, Copy, Debug)]
pub struct LowDissipation {
    /// Shear stress for output; it does not act back.
    pub stress: Hypoelastic,
    /// The factor of UL Eq. (19).
    pub zeta: f64,
}

impl LowDissipation {
    /// With the paper's zeta = 0.7 d + 2.1.
    #[must_use]
    pub fn new(stress: Hypoelastic, dimension: usize) -> Self {
        Self { stress, zeta: 0.7 * dimension as f64 + 2.1 }
    }

    /// c_M as that of the non-hourglass form, m/s.
    #[must_use]
    pub fn shear_speed(&self, moduli: &Moduli, dimension: usize) -> f64 {
        let extra = 3.0 * self.zeta * moduli.shear / (dimension as f64 + 2.0);
        ((moduli.bulk + extra) / moduli.density).sqrt()
    }
}

record! {
    /// What the force needs.
    Pressed { v: Velocity, p: Pressure, z: Impedance, c: SoundSpeed }
    /// What the rates need.
    Flow { v: Velocity, p: Pressure, z: Impedance, body: Body }
}

/// The force sum: -2 P* grad W V_b, and the power of the limited term and of the jump of pressure.
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
        // e points from b to a: U_a - U_b = -v_ab . e.
        let v = a.v - b.v;
        let apart = v.dot(ab.e);
        let beta = (S::of(-6.0) * apart / (a.c + b.c)).max(S::zero()).min(S::one());
        let limited = beta * apart * (a.z + b.z) * S::of(0.5);
        ab.gradient(&mut sum.f, limited - (a.p + b.p));
        let mut rate = S::zero();
        ab.divergence(&mut rate, v);
        sum.power = (limited * S::of(-0.5)).mul_add(rate, sum.power);
        // What the jump of pressure in the density takes of the energy of pressure: (p_a - p_b)^2 / (2 Z), half of it from each.
        let jump = a.p - b.p;
        let mut slope = S::zero();
        ab.divergence(&mut slope, ab.e);
        sum.power = (jump * jump / (a.z + b.z)).mul_add(-slope, sum.power);
    }
}

/// Sums for the rates, with the jump of pressure in that of density.
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
        let jump = (a.p - b.p) * S::of(2.0) / (a.z + b.z);
        ab.divergence(&mut sum.compression, v.plus(jump, ab.e));
        AlongPairs::add(&mut sum.shear, (v, same_body(a.body, b.body)), ab);
    }
}

impl<const D: usize> Formulation<D> for LowDissipation {
    const FIELDS: &'static [Quantity] = FOLLOWED;

    fn relisting(&self, run: &mut impl Run<D>) {
        self.stress.relisting(run);
    }

    fn relisted(&self, run: &mut impl Run<D>) {
        self.stress.relisted(run);
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.pairs(&Momentum, &Kick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Integrate(2.0 * self.zeta), now);
    }

    fn look(&self, run: &mut impl Run<D>) {
        self.stress.look(run);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        super::state(run, place, (Hypoelastic::seen(run, place), run.word(Quantity::ShearWork, 0, place)))
    }
}
