//! The hourglass-free formulation, `tl-hourglass-free` (TL section 3.3).

use super::calibration::lattice_moment;
use super::motion::{Kick, Stress, Stretch};
use super::reference::MomentSum;
use super::{FIELDS, Solid};
use crate::correction::Invert;
use crate::field::Quantity;
use crate::formulation::undeformed::{Force, Rate};
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::material::PairShear;
use crate::math::{Real, Tensor};
use crate::pass::{Now, Pair, PairSum};
use crate::run::Run;

/// rho0 a = sum_b (Q_a + Q_b) grad W V_b + sum_b (s_a + s_b) w_ab (u_a - u_b), where Q = tau_r F^-T + s 1 and
/// s = zeta G J^(-2/d) (TL Eqs. 20, 27-29).
///
/// Written in displacements, and with s 1 inside Q, it is algebraically the form of the paper and exactly zero at rest for any
/// arrangement of particles. There is no correction matrix in the force: with it the reference state of a free surface
/// would not be in equilibrium (the paper's text suggests one, its figures were not made with one).
#[derive(Clone, Copy, Debug)]
pub struct HourglassFree<M> {
    /// Material and damper. Without damping this formulation is unstable: the operators of force and strain are not
    /// adjoint at free surfaces.
    pub solid: Solid<M>,
    /// The factor of Eq. (27).
    pub zeta: f64,
    /// Factor of the whole force; 1 in the paper.
    pub gain: f64,
}

impl<M: PairShear> HourglassFree<M> {
    /// With the paper's zeta = 1.07 and damping, for smoothing length `h`.
    #[must_use]
    pub fn new(material: M, h: f64) -> Self {
        Self { solid: Solid::new(material, h), zeta: 1.07, gain: 1.0 }
    }

    /// With the moduli of the material exact inside of a lattice, where kernel sums miss by M = sum X_ab^2 |W'|/r V_b / d: zeta = 1, and the
    /// whole force times 1/M. (With the paper's zeta long waves feel G zeta M and K M.) The balance at rest does not
    /// change.
    #[must_use]
    pub fn calibrated<const D: usize>(material: M, kernel: &Kernel, spacing: f64) -> Self {
        Self {
            zeta: 1.0,
            gain: 1.0 / lattice_moment::<D>(kernel, spacing),
            ..Self::new(material, kernel.h())
        }
    }
}

record! {
    /// What a pair force needs.
    Strained { q: NominalStress, pair: PairStiffness, u: Displacement }
}

/// The force sum.
struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Strained<f64, D>;
    type Adds = Force<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Force<S, D>,
        (a, b): (&Strained<S, D>, &Strained<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.dot(&mut sum.f, a.q + b.q);
        ab.along(&mut sum.f, a.u - b.u, a.pair + b.pair);
    }
}

impl<M: PairShear> HourglassFree<M> {
    /// The torque of all pair forces is the sum of V e : (R F^-T M F^T), where R is tau_r with the damping stress, M the moment matrix (TL Eq. 21), whose
    /// inverse is B, and e the permutation symbol: forces have the gradient of the kernel where F has it corrected. It vanishes where M is a
    /// multiple of 1, since R is symmetric. The shear of the pairs cancels: w X = grad W, and M is symmetric.
    ///
    /// Of fields as they stand, half a step ahead of the velocity: that is where the next force acts.
    fn couple<const D: usize>(&self, run: &impl Run<D>, place: usize) -> [f64; 3] {
        let tensor = |field| Tensor::<f64, D>::from_fn(|i, j| run.word(field, i * D + j, place));
        let (f, rate) = (tensor(Quantity::DeformationGradient), tensor(Quantity::DeformationRate));
        let stress = self.reduced(f, self.solid.damping(f, rate)).0;
        let moment = tensor(Quantity::Correction).inverse();
        let turning = stress.mul(f.inverse().transpose()).mul(moment).mul(f.transpose()).lift(0.0);
        let weight = self.gain * run.word(Quantity::Volume, 0, place);
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            weight * (turning[i][j] - turning[j][i])
        })
    }

    /// tau_r = (volumetric - s ratio) 1 + tau_d, and s.
    #[inline(always)]
    fn reduced<S: Real, const D: usize>(&self, f: Tensor<S, D>, damping: Tensor<S, D>) -> (Tensor<S, D>, S) {
        let split = self.solid.material.split(f, self.zeta);
        (damping.plus_diagonal(split.volumetric - split.pair * split.ratio), split.pair)
    }
}

impl<M: PairShear, const D: usize> Stress<D> for HourglassFree<M> {
    type Material = M;

    #[inline(always)]
    fn solid(&self) -> &Solid<M> {
        &self.solid
    }

    /// Q = [volumetric - s ratio] F^-T + tau_d F^-T + s 1, and s.
    #[inline(always)]
    fn hand_over<S: Real>(
        &self,
        f: Tensor<S, D>,
        damping: Tensor<S, D>,
        _: Tensor<S, D>,
    ) -> (Tensor<S, D>, S) {
        let (reduced, pair) = self.reduced(f, damping);
        (reduced.mul(f.inverse().transpose()).plus_diagonal(pair), pair)
    }
}

impl<M: PairShear, const D: usize> Formulation<D> for HourglassFree<M> {
    const FIELDS: &'static [Quantity] = FIELDS;

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Momentum, &Kick { per_density: self.gain / self.solid.material.moduli().density }, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Rate, &Stretch(self), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        State { couple: self.couple(run, place), ..self.solid.state(run, place, ahead) }
    }
}
