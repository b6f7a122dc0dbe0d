//! The nested formulation, `ul-nested` (UL section 3, SPH-OG).

use super::integrated::{Integrate, RateSum, Shear, state};
use super::kick::{Kick, Push};
use super::motion::Drift;
use super::pressure::{Pushing, push};
use super::{FIELDS, Hypoelastic, same_body};
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum};
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

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        state(run, place)
    }
}
