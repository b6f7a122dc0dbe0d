//! The nested form as its equation is written, with a product with B on both sides of every pair: what `tl-nested` is compared with.

use taut::field::{Of, Quantity};
use taut::formulation::total::{Kick, Nested, Solid, Stress, Stretch};
use taut::formulation::undeformed::{Force, Rate};
use taut::formulation::{Formulation, State};
use taut::material::Hyperelastic;
use taut::math::{Real, Tensor};
use taut::pass::{Both, Now, Pair, PairSum};
use taut::record;
use taut::run::Run;

/// rho0 a = sum_b (P_a B_a + P_b B_b) grad W V_b (TL Eq. 20), with P handed over and both products in the sum.
pub struct AsWritten<M>(pub Nested<M>);

record! {
    /// What a pair force needs.
    Stressed { q: NominalStress, correction: Correction }
}

struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Stressed<f64, D>;
    type Adds = Force<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Of<Self::Adds, S, D>,
        (a, b): Both<'_, Self::Reads, S, D>,
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let corrected = |x: &Stressed<S, D>| x.q.mul(x.correction.transpose());
        ab.dot(&mut sum.f, corrected(a) + corrected(b));
    }
}

impl<M: Hyperelastic, const D: usize> Stress<D> for AsWritten<M> {
    type Material = M;

    #[inline(always)]
    fn solid(&self) -> &Solid<M> {
        &self.0.solid
    }

    #[inline(always)]
    fn hand_over<S: Real>(
        &self,
        f: Tensor<S, D>,
        damping: Tensor<S, D>,
        _: Tensor<S, D>,
    ) -> (Tensor<S, D>, S) {
        (self.0.solid.corrected(f, damping, Tensor::diagonal(S::one())), S::zero())
    }
}

impl<M: Hyperelastic, const D: usize> Formulation<D> for AsWritten<M> {
    const FIELDS: &'static [Quantity] = <Nested<M> as Formulation<D>>::FIELDS;

    fn relisted(&self, run: &mut impl Run<D>) {
        self.0.relisted(run);
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Momentum, &Kick { per_density: 1.0 / self.0.solid.material.moduli().density }, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Rate, &Stretch(self), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        self.0.state(run, place, ahead)
    }
}
