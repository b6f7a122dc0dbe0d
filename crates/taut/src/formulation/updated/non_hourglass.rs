//! The essentially non-hourglass formulation, `ul-non-hourglass` (UL section 4).

use super::accumulated::{AlongPairs, Integrate, Momentum, RateSum};
use super::followed::Watch;
use super::kick::Kick;
use super::motion::Drift;
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::pass::Now;
use crate::run::Run;

/// dv/dt = pressure + A with dA/dt = 2 zeta (G/rho) sum_b (e.v_ab / r) grad W V_b inside the body (UL Eqs. 19, 20): the shear
/// acceleration is integrated itself, not derived from an integrated stress. A is never rotated and never reset, so
/// a stressed body that spins as a whole is outside of what this form can do.
#[derive(Clone, Copy, Debug)]
pub struct NonHourglass<W> {
    /// Shear stress for output, or nobody who looks at it; it does not act back.
    pub stress: W,
    /// The factor of Eq. (19).
    pub zeta: f64,
}

impl<W> NonHourglass<W> {
    /// With the paper's zeta = 0.7 d + 2.1.
    #[must_use]
    pub fn new(stress: W, dimension: usize) -> Self {
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

impl<W: Watch, const D: usize> Formulation<D> for NonHourglass<W> {
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
        run.pairs(&RateSum::<AlongPairs>::NEW, &Integrate(2.0 * self.zeta), now);
    }

    fn look(&self, run: &mut impl Run<D>) {
        self.stress.look(run);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        super::state(run, place, (W::seen(run, place), run.word(Quantity::ShearWork, 0, place)))
    }
}
