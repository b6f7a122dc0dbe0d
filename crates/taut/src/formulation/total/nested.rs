//! The nested formulation, `tl-nested` (TL section 3.2): stress from a gradient, force from the gradient of stress.

use super::motion::{Kick, Stress, Stretch};
use super::reference::MomentSum;
use super::{FIELDS, Solid};
use crate::correction::Invert;
use crate::field::Quantity;
use crate::formulation::undeformed::{Momentum, Rate};
use crate::formulation::{Formulation, State};
use crate::material::Hyperelastic;
use crate::math::{Real, Tensor};
use crate::pass::Now;
use crate::run::Run;

/// rho0 a = sum_b (P_a B_a + P_b B_b) grad W V_b with P = tau F^-T (TL Eq. 20; B is symmetric). Blind to zig-zag modes.
#[derive(Clone, Copy, Debug)]
pub struct Nested<M> {
    /// Material and damper.
    pub solid: Solid<M>,
}

impl<M: Hyperelastic> Nested<M> {
    /// With the paper's damping, for smoothing length `h`.
    #[must_use]
    pub fn new(material: M, h: f64) -> Self {
        Self { solid: Solid::new(material, h) }
    }
}

impl<M: Hyperelastic, const D: usize> Stress<D> for Nested<M> {
    type Material = M;

    #[inline(always)]
    fn solid(&self) -> &Solid<M> {
        &self.solid
    }

    #[inline(always)]
    fn hand_over<S: Real>(
        &self,
        f: Tensor<S, D>,
        damping: Tensor<S, D>,
        correction: Tensor<S, D>,
    ) -> (Tensor<S, D>, S) {
        (self.solid.corrected(f, damping, correction), S::zero())
    }
}

impl<M: Hyperelastic, const D: usize> Formulation<D> for Nested<M> {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Momentum, &Kick { per_density: 1.0 / self.solid.material.moduli().density }, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Rate, &Stretch(self), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        self.solid.state(run, place, ahead)
    }
}
