//! The form with the plain Laplacian of velocity, `ul-laplacian` (UL Eq. 18, Fig. 7).

use super::accumulated::{HalfLaplacian, Integrate, Momentum, RateSum};
use super::followed::Watch;
use super::kick::Kick;
use super::motion::Drift;
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::math::{Real, Vector};
use crate::pass::{Now, Pair};
use crate::run::Run;

/// dv/dt = pressure + A with dA/dt = 2 (G/rho) sum_b v_ab W'(r)/r V_b inside the body (UL Eqs. 17, 18). A rigid spin makes shear
/// forces in it, so that angular momentum is not kept and a plate cannot bend: the control that shows why Eq. (19) looks along pairs.
#[derive(Clone, Copy, Debug)]
pub struct Laplacian<W> {
    /// Shear stress for output, or nobody who looks at it; it does not act back.
    pub stress: W,
}

impl<W> Laplacian<W> {
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
        (v, inside): (Vector<S, D>, S),
        ab: &Pair<S, D, M>,
    ) {
        ab.along(sum, v, inside);
    }
}

impl<W: Watch, const D: usize> Formulation<D> for Laplacian<W> {
    const FIELDS: &'static [Quantity] = W::FIELDS;

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
        run.pairs(&RateSum::<Whole>::NEW, &Integrate(2.0), now);
    }

    fn look(&self, run: &mut impl Run<D>) {
        self.stress.look(run);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        super::state(run, place, (W::seen(run, place), run.word(Quantity::ShearWork, 0, place)))
    }
}
