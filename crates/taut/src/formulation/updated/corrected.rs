//! The nested formulation with artificial stress and corrected gradients, `ul-artificial-stress-corrected`.

use super::integrated::{IntegrateCorrected, RateSum, Shear, state};
use super::kick::{ControlledKick, ControlledPush};
use super::motion::{Drift, MomentSum};
use super::pressure::Pushing;
use super::repulsion::{Oppose, Repelling, Repulsion};
use super::{FIELDS, Hypoelastic, joined};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

/// As `ul-artificial-stress`, with B (UL Eq. 27) in the gradient of velocity that strains (UL Eq. 26) and in the stress that is handed to
/// neighbours, (V_a/m_a) sum_b (s_a B_a + s_b B_b) grad W V_b. The one is the adjoint of the other, so that energy is kept; with B in
/// the strain alone the stress would store more than the force has put in. Without B the layers at a surface see half of their strain, and plates swing too slowly by dp/H.
/// Pressure and density go without, as in all forms of the paper.
#[derive(Clone, Copy, Debug)]
pub struct CorrectedArtificialStress {
    /// The shear stress.
    pub stress: Hypoelastic,
    /// The artificial stress.
    pub repulsion: Repulsion,
}

impl CorrectedArtificialStress {
    /// With the published numbers, for particles of this spacing (m).
    #[must_use]
    pub fn new(stress: Hypoelastic, kernel: Kernel, spacing: f64) -> Self {
        Self { stress, repulsion: Repulsion::new(kernel, spacing) }
    }
}

record! {
    /// A stress to be handed to neighbours.
    Sheared { s: ShearStress, b: Correction }
    /// s B.
    Handed { q: NominalStress }
    /// What the force needs.
    Stressed { v: Velocity, p: Pressure, z: Impedance, q: NominalStress, r: ArtificialStress, body: Body }
}

/// Q = s B.
struct Hand;

impl<const D: usize> Update<D> for Hand {
    type Sum = ();
    type Reads = Sheared<f64, D>;
    type Writes = Handed<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Sheared<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        Handed { q: a.s.mul(a.b) }
    }
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
        let seen = |p: &Stressed<S, D>| Repelling { pushing: pushing(p), s: p.q, r: p.r, body: p.body };
        self.0.add(sum, (&seen(a), &seen(b)), ab);
    }
}

impl<const D: usize> Formulation<D> for CorrectedArtificialStress {
    const FIELDS: &'static [Quantity] =
        &joined::<{ FIELDS.len() + 2 }>(FIELDS, &[Quantity::ArtificialStress, Quantity::NominalStress]);

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.each(&Shear, now);
        run.each(&Oppose(self.repulsion.strength), now);
        run.each(&Hand, now);
        run.pairs(&Momentum(&self.repulsion), &ControlledKick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &IntegrateCorrected(self.stress), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        state(run, place)
    }
}
