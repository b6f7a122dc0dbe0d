//! The nested formulation with an hourglass control, `tl-ganzenmueller` (TL ref. 51; its TL-SPH-GM).

use super::motion::{Kick, Stress, Stretch};
use super::reference::MomentSum;
use super::{CONTROLLED, Solid};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::formulation::kick::Mover;
use crate::formulation::undeformed::Rate;
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::material::Hyperelastic;
use crate::math::{Real, Tensor, Vector};
use crate::neighbours::{Adjacency, Lattice, Search};
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

/// The nested form and, in every pair, a penalty on what the deformation gradients do not tell of the distance:
///
/// rho0 a += sum_b (alpha/2) E W V_b / R^2 [((F_a + F_b) X_ab - 2 x_ab) . e] e with e = x_ab / |x_ab| and R = |X_ab|.
///
/// The force is along the present line of the pair and zero for any linear field, so linear and angular momentum are
/// exact. alpha is a number to be tuned: too little lets zig-zag modes grow, too much stiffens what is not linear.
#[derive(Clone, Copy, Debug)]
pub struct Ganzenmueller<M> {
    /// Material and damper.
    pub solid: Solid<M>,
    /// The kernel.
    pub kernel: Kernel,
    /// The strength of the control.
    pub alpha: f64,
    /// rho0 omega^2 h^2 of its stiffest mode over alpha E.
    pub coupling: f64,
}

/// On a lattice the stiffest mode of the control alternates along one axis: rho0 omega^2 h^2 = 0.71 alpha E (2 alpha E sum W V h^2 (e_x/R)^2 over the
/// neighbours that move against it; h = 1.15 dp in 2D, less in 3D).
const ON_LATTICE: f64 = 0.71;

impl<M: Hyperelastic> Ganzenmueller<M> {
    /// With the paper's damping and this strength of the control (10 in the trials of the paper's cases).
    #[must_use]
    pub fn new(material: M, kernel: Kernel, alpha: f64) -> Self {
        Self { solid: Solid::new(material, kernel.h()), kernel, alpha, coupling: ON_LATTICE }
    }

    /// The same for particles of these volumes (m^3) at these places (m) that stand on no lattice. Gershgorin, block by block:
    /// rho0 omega^2 <= alpha E max_a (|sum_b c_ab e (x) e| + sum_b c_ab), c_ab = W V_b / R^2.
    #[must_use]
    pub fn among<const D: usize>(self, x: [&[f64]; D], volume: &[f64]) -> Self {
        let spacing = volume.first().map_or(0.0, |v| v.powf(1.0 / D as f64));
        let mut list = Adjacency::default();
        let on_lattice = Lattice::detect(x, spacing).is_ok_and(|lattice| lattice.is_some());
        // Positions that are no numbers stop the run when it starts.
        if on_lattice || Search::new().pairs(x, self.kernel.support(), None, &mut list).is_err() {
            return self;
        }
        let row = |a: usize| {
            let (mut block, mut sum) = (Tensor::<f64, D>::from_fn(|_, _| 0.0), 0.0);
            for &b in list.of(a) {
                let apart = Vector::<f64, D>::from_fn(|i| x[i][a] - x[i][b as usize]);
                let r2 = apart.norm_squared();
                let c = self.kernel.w(r2.sqrt()) * volume[b as usize] / r2;
                block = Tensor::from_fn(|i, j| block.0[i][j] + c * apart[i] * apart[j] / r2);
                sum += c;
            }
            let rows = block.0.iter().map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
            rows.fold(0.0, f64::max) + sum
        };
        let coupling = self.kernel.h().powi(2) * (0..volume.len()).map(row).fold(0.0, f64::max);
        Self { coupling: coupling.max(ON_LATTICE), ..self }
    }

    fn density(&self) -> f64 {
        self.solid.material.moduli().density
    }

    /// alpha E, Pa.
    fn penalty(&self) -> f64 {
        self.alpha * self.solid.material.moduli().young()
    }
}

record! {
    /// What a pair force needs.
    Formed { q: NominalStress, f: DeformationGradient, u: Displacement }
    /// Force per reference volume, and the part of the control.
    Forces { f: ForceDensity, control: ControlForce }
    /// A particle about to be accelerated.
    Inert {
        v: Velocity, m: Mass, b: BodyForce, free: Free, given: PrescribedVelocity, work: ExternalWork, stored: ShearWork,
    }
    /// A particle accelerated.
    Moved { v: Velocity, a: Acceleration, work: ExternalWork, stored: ShearWork }
}

/// The force sum.
struct Momentum {
    kernel: Kernel,
    /// alpha E / 2, Pa.
    half_penalty: f64,
}

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Formed<f64, D>;
    type Adds = Forces<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Forces<S, D>,
        (a, b): (&Formed<S, D>, &Formed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.dot(&mut sum.f, a.q + b.q);
        let u = a.u - b.u;
        let x = ab.x + u;
        // (F_a + F_b) X - 2 x, in displacements: exactly zero at rest.
        let error = (a.f + b.f).plus_diagonal(S::of(-2.0)).mul_vector(ab.x).plus(S::of(-2.0), u);
        // What fills the last lanes is a particle and itself, without weight: keep its quotients finite.
        let least = S::of(1e-12 * self.kernel.h() * self.kernel.h());
        let (reference, present) = (ab.x.norm_squared().max(least), x.norm_squared().max(least));
        let w = self.kernel.w_over_slope(reference);
        ab.along(&mut sum.control, x, w * S::of(self.half_penalty) * error.dot(x) / present);
    }
}

/// The kick with both forces; what is moved against the control is stored.
struct ControlledKick(Kick);

impl<const D: usize> Update<D> for ControlledKick {
    type Sum = Forces<f64, D>;
    type Reads = Inert<f64, D>;
    type Writes = Moved<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Forces<S, D>, a: &Inert<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let control = sum.control.times(S::of(self.0.per_density));
        let mover = Mover { v: a.v, m: a.m, b: a.b, free: a.free, given: a.given };
        let kicked = mover.kick(sum.f.times(S::of(self.0.per_density)) + control, now);
        let stored = a.m * now.dt * control.dot(kicked.mean);
        Moved { v: kicked.v, a: kicked.a, work: a.work + kicked.external_work, stored: a.stored - stored }
    }
}

impl<M: Hyperelastic, const D: usize> Stress<D> for Ganzenmueller<M> {
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

    /// The springs of the control beside the material. A material alone has rho0 omega^2 h^2 < 3.5 rho0 c^2 (the
    /// critical Courant number is 1.06 with c), and a step of 0.6 h/c can carry 4 / 0.6^2 = 11.1 of it together.
    #[inline(always)]
    fn stiffness<S: Real>(&self, f: Tensor<S, D>) -> S {
        let material = self.solid.material.stiffness(f);
        material.max(material.mul_add(S::of(3.5 / 11.1), S::of(self.penalty() * self.coupling / 11.1)))
    }
}

impl<M: Hyperelastic, const D: usize> Formulation<D> for Ganzenmueller<M> {
    const FIELDS: &'static [Quantity] = &CONTROLLED;

    fn relisted(&self, run: &mut impl Run<D>) {
        run.pairs(&MomentSum, &Invert, Now { t: 0.0, dt: 0.0 });
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        let sum = Momentum { kernel: self.kernel, half_penalty: 0.5 * self.penalty() };
        run.pairs(&sum, &ControlledKick(Kick { per_density: 1.0 / self.density() }), now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&Rate, &Stretch(self), now);
    }

    /// The energy of the control counts as strain energy.
    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State {
        let state = self.solid.state(run, place, ahead);
        State { strain_energy: state.strain_energy + run.word(Quantity::ShearWork, 0, place), ..state }
    }
}
