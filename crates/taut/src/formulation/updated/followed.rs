//! A shear stress that is only looked at: it follows the motion and does not act back (UL Eqs. 6-8, 26, 27).
//!
//! As long as a list lasts, its weights and B stay, and particles move by the mean of the velocities before and after each step: the sum of L dt
//! over the steps is the gradient of what particles have travelled meanwhile. So s is integrated once for a list and not once for a step,
//! and who looks at it sees what the present list adds to it so far. How often that happens changes nothing.

use super::motion::MomentSum;
use super::{Hypoelastic, MOTION, ShearTensor, joined, same_body};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::math::{Real, Tensor};
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;
use std::fmt::Debug;

record! {
    /// Where a particle is and was.
    Moving { x: Position, from: FollowedPosition }
    /// How far it has come.
    Travelled { u: Travel }
    /// The same, and its body.
    Traveller { u: Travel, body: Body }
    /// The gradient of what was travelled.
    Stretched { h: DisplacementGradient }
    /// A shear stress before.
    Stressed { s: ShearStress, axial: AxialShearStress, g: ShearModulus, b: Correction }
    /// The same, and where its particle is.
    StressedAt { s: ShearStress, axial: AxialShearStress, g: ShearModulus, b: Correction, x: Position }
    /// A shear stress that is up to date.
    Settled { s: ShearStress, axial: AxialShearStress, from: FollowedPosition }
    /// What is seen of it.
    Seen { s: SeenShearStress, axial: SeenAxialShearStress }
}

/// Fields of a form whose shear stress is followed.
pub const FOLLOWED: &[Quantity] = &joined::<{ MOTION.len() + 7 }>(
    MOTION,
    &[
        Quantity::Correction,
        Quantity::ShearStress,
        Quantity::AxialShearStress,
        Quantity::FollowedPosition,
        Quantity::Travel,
        Quantity::SeenShearStress,
        Quantity::SeenAxialShearStress,
    ],
);

/// Who looks at the shear stress: its law does, by following the motion; or nobody, at no cost.
pub trait Watch: Copy + Debug + Send + Sync + 'static {
    /// The fields of a form that is looked at so.
    const FIELDS: &'static [Quantity];

    /// What is to be done before a list is given up.
    fn relisting<const D: usize>(&self, run: &mut impl Run<D>);

    /// What a new list asks for.
    fn relisted<const D: usize>(&self, run: &mut impl Run<D>);

    /// Finds the shear stress at this moment.
    fn look<const D: usize>(&self, run: &mut impl Run<D>);

    /// The shear stress of a stored particle at the last look, Pa, in three dimensions.
    fn seen<const D: usize>(run: &impl Run<D>, place: usize) -> Tensor<f64, 3>;
}

/// Nobody looks.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    const FIELDS: &'static [Quantity] = MOTION;

    fn relisting<const D: usize>(&self, _: &mut impl Run<D>) {}

    fn relisted<const D: usize>(&self, _: &mut impl Run<D>) {}

    fn look<const D: usize>(&self, _: &mut impl Run<D>) {}

    fn seen<const D: usize>(_: &impl Run<D>, _: usize) -> Tensor<f64, 3> {
        Tensor::zero()
    }
}

/// No time passes.
const STILL: Now<f64> = Now { t: 0.0, dt: 0.0 };

impl Watch for Hypoelastic {
    const FIELDS: &'static [Quantity] = FOLLOWED;

    fn relisting<const D: usize>(&self, run: &mut impl Run<D>) {
        run.each(&Travelling, STILL);
        run.pairs(&StretchSum, &Follow(*self), STILL);
    }

    fn relisted<const D: usize>(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, STILL);
    }

    fn look<const D: usize>(&self, run: &mut impl Run<D>) {
        run.each(&Travelling, STILL);
        run.pairs(&StretchSum, &Look(*self), STILL);
    }

    fn seen<const D: usize>(run: &impl Run<D>, place: usize) -> Tensor<f64, 3> {
        let word = |field, k| run.word(field, k, place);
        let s = Tensor::<f64, D>::from_fn(|i, j| word(Quantity::SeenShearStress, i * D + j));
        s.lift(word(Quantity::SeenAxialShearStress, 0))
    }
}

/// How far a particle has come since its shear stress was up to date.
struct Travelling;

impl<const D: usize> Update<D> for Travelling {
    type Sum = ();
    type Reads = Moving<f64, D>;
    type Writes = Travelled<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Moving<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        Travelled { u: a.x - a.from }
    }
}

/// sum_b (u_b - u_a) (x) grad W V_b inside the body (UL Eq. 8, times dt and added up).
struct StretchSum;

impl<const D: usize> PairSum<D> for StretchSum {
    type Reads = Traveller<f64, D>;
    type Adds = Stretched<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Stretched<S, D>,
        (a, b): (&Traveller<S, D>, &Traveller<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.outer(&mut sum.h, (b.u - a.u).times(same_body(a.body, b.body)));
    }
}

impl Hypoelastic {
    /// s after particles have travelled.
    #[inline(always)]
    fn follow<S: Real, const D: usize>(
        &self,
        sum: &Stretched<S, D>,
        a: &Stressed<S, D>,
    ) -> ShearTensor<S, D> {
        self.after(sum.h.mul(a.b), ShearTensor { s: a.s, axial: a.axial }, a.g)
    }
}

/// s when a list ends.
struct Follow(Hypoelastic);

impl<const D: usize> Update<D> for Follow {
    type Sum = Stretched<f64, D>;
    type Reads = StressedAt<f64, D>;
    type Writes = Settled<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Stretched<S, D>, a: &StressedAt<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        let ShearTensor { s, axial } =
            self.0.follow(sum, &Stressed { s: a.s, axial: a.axial, g: a.g, b: a.b });
        Settled { s, axial, from: a.x }
    }
}

/// s while it lasts.
struct Look(Hypoelastic);

impl<const D: usize> Update<D> for Look {
    type Sum = Stretched<f64, D>;
    type Reads = Stressed<f64, D>;
    type Writes = Seen<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Stretched<S, D>, a: &Stressed<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        let ShearTensor { s, axial } = self.0.follow(sum, a);
        Seen { s, axial }
    }
}
