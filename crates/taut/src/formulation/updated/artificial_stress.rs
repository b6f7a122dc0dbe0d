//! The nested formulation with artificial stress, `ul-artificial-stress` (UL section 6, SPH-OAS; Gray, Monaghan and Swift 2001).

use super::integrated::{Integrate, RateSum, Shear, state};
use super::kick::{ControlledKick, ControlledPush};
use super::motion::Drift;
use super::pressure::Pushing;
use super::repulsion::{Oppose, Repelling, Repulsion};
use super::{FIELDS, Hypoelastic, joined};
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum};
use crate::run::Run;

/// The nested form with a [`Repulsion`], which hides clumps and keeps zig-zag modes: a control.
#[derive(Clone, Copy, Debug)]
pub struct ArtificialStress {
    /// The shear stress.
    pub stress: Hypoelastic,
    /// The artificial stress.
    pub repulsion: Repulsion,
}

impl ArtificialStress {
    /// With the published numbers, for particles of this spacing (m).
    #[must_use]
    pub fn new(stress: Hypoelastic, kernel: Kernel, spacing: f64) -> Self {
        Self { stress, repulsion: Repulsion::new(kernel, spacing) }
    }
}

record! {
    /// What the force needs.
    Stressed { v: Velocity, p: Pressure, z: Impedance, s: ShearStress, r: ArtificialStress, body: Body }
}

/// The force sum.
struct Momentum<'a>(&'a Repulsion);

impl<const D: usize> PairSum<D> for Momentum<'_> {
    type Reads = Stressed<f64, D>;
    type Adds = ControlledPush<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut ControlledPush<S, D>,
        (a, b): (&Stressed<S, D>, &Stressed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let pushing = |p: &Stressed<S, D>| Pushing { v: p.v, p: p.p, z: p.z };
        let seen = |p: &Stressed<S, D>| Repelling { pushing: pushing(p), s: p.s, r: p.r, body: p.body };
        self.0.add(sum, (&seen(a), &seen(b)), ab);
    }
}

impl<const D: usize> Formulation<D> for ArtificialStress {
    const FIELDS: &'static [Quantity] =
        &joined::<{ FIELDS.len() + 1 }>(FIELDS, &[Quantity::ArtificialStress]);

    fn relisted(&self, _: &mut impl Run<D>) {}

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.each(&Shear, now);
        run.each(&Oppose(self.repulsion.strength), now);
        run.pairs(&Momentum(&self.repulsion), &ControlledKick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Integrate(self.stress), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        state(run, place)
    }
}
