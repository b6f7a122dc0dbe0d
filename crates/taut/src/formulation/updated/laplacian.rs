//! The form with the plain Laplacian of velocity, `ul-laplacian` (UL Eq. 18, Fig. 7).

use super::accumulated::{HalfLaplacian, Integrate, Momentum, RateSum};
use super::kick::Kick;
use super::motion::{Drift, MomentSum};
use super::{FIELDS, Hypoelastic};
use crate::correction::Invert;
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::math::{Real, Vector};
use crate::pass::{Now, Pair};
use crate::run::Run;
use std::marker::PhantomData;

/// dv/dt = pressure + A with dA/dt = 2 (G/rho) sum_b v_ab W'(r)/r V_b inside the body (UL Eqs. 17, 18). A rigid spin makes shear
/// forces in it, so that angular momentum is not kept and a plate cannot bend: the control that shows why Eq. (19) looks along pairs.
#[derive(Clone, Copy, Debug)]
pub struct Laplacian {
    /// Shear stress for output; it does not act back.
    pub stress: Hypoelastic,
}

impl Laplacian {
    /// sqrt((K + G) / rho0), m/s: every wave feels G by the Laplacian, the longitudinal one K as well.
    #[must_use]
    pub fn shear_speed(&self, moduli: &Moduli) -> f64 {
        ((moduli.bulk + moduli.shear) / moduli.density).sqrt()
    }
}

/// sum_b v_ab W'(r)/r V_b (UL Eq. 18).
struct Whole;

impl HalfLaplacian for Whole {
    #[inline(always)]
    fn add<S: Real, const D: usize, const M: u8>(
        sum: &mut Vector<S, D>,
        v: Vector<S, D>,
        ab: &Pair<S, D, M>,
    ) {
        ab.along(sum, v, S::one());
    }
}

impl<const D: usize> Formulation<D> for Laplacian {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.pairs(&Momentum, &Kick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        let integrate = Integrate { stress: self.stress, factor: 2.0 };
        run.pairs(&RateSum::<Whole>(PhantomData), &integrate, now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        super::state(run, place, run.word(Quantity::ShearWork, 0, place))
    }
}
