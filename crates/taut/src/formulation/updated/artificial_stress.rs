//! The nested formulation with artificial stress, `ul-artificial-stress` (UL section 6, SPH-OAS; Gray, Monaghan and Swift 2001).

use super::integrated::{Integrate, RateSum, Shear, state};
use super::kick::{ControlledKick, ControlledPush};
use super::motion::Drift;
use super::pressure::{Pushing, push};
use super::{FIELDS, Hypoelastic, joined, same_body};
use crate::field::{Of, Quantity};
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::math::{Real, Tensor, Vector};
use crate::pass::{Now, Pair, PairSum, Update};
use crate::run::Run;

/// The nested form, and (V_a/m_a) sum_b f_ab^4 (R_a + R_b) grad W V_b inside the body, which pushes apart what tension clumps: R = -eps
/// times the tensile part of sigma = s - p 1 along its principal axes, f_ab = W(x_ab)/W(dp). Gray et al. divide R by rho^2 and multiply with
/// masses; here it is normalised as the stress that it opposes. They derive it in the plane; in space it is the same along three
/// principal directions, which is ours. It hides clumps and keeps zig-zag modes: a control.
#[derive(Clone, Copy, Debug)]
pub struct ArtificialStress {
    /// The shear stress.
    pub stress: Hypoelastic,
    /// eps; 0.3 by Gray et al. for their kernel and h.
    pub strength: f64,
    kernel: Kernel,
    /// 1/W(dp), m^d.
    unit: f64,
}

impl ArtificialStress {
    /// With the published eps = 0.3 (and exponent 4), for particles of this spacing (m).
    #[must_use]
    pub fn new(stress: Hypoelastic, kernel: Kernel, spacing: f64) -> Self {
        Self { stress, strength: 0.3, kernel, unit: 1.0 / kernel.w(spacing) }
    }

    /// Adds f_ab^4 r grad W V_b to `sum`, with r the R of both.
    #[inline(always)]
    pub(super) fn repel<S: Real, const D: usize, const M: u8>(
        &self,
        sum: &mut Vector<S, D>,
        r: Tensor<S, D>,
        ab: &Pair<S, D, M>,
    ) {
        let f = self.kernel.w(ab.x.norm_squared().sqrt()) * S::of(self.unit);
        let squared = f * f;
        ab.dot(sum, r.times(squared * squared));
    }
}

record! {
    /// What the force needs.
    Stressed { v: Velocity, p: Pressure, z: Impedance, s: ShearStress, r: ArtificialStress, body: Body }
    /// A stress to be opposed.
    Strained { s: ShearStress, p: Pressure }
    /// What opposes it.
    Opposed { r: ArtificialStress }
}

/// R = -eps sum_k max(sigma_k, 0) n_k (x) n_k.
pub struct Oppose(pub f64);

impl<const D: usize> Update<D> for Oppose {
    type Sum = ();
    type Reads = Strained<f64, D>;
    type Writes = Opposed<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Strained<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        let against = |value: S| value.max(S::zero()) * S::of(-self.0);
        Opposed { r: a.s.plus_diagonal(-a.p).with_principal_values(against) }
    }
}

/// The force sum.
struct Momentum<'a>(&'a ArtificialStress);

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
        push((&mut sum.f, &mut sum.power), (&pushing(a), &pushing(b)), ab);
        let inside = same_body(a.body, b.body);
        ab.dot(&mut sum.f, (a.s + b.s).times(inside));
        self.0.repel(&mut sum.g, (a.r + b.r).times(inside), ab);
    }
}

impl<const D: usize> Formulation<D> for ArtificialStress {
    const FIELDS: &'static [Quantity] =
        &joined::<{ FIELDS.len() + 1 }>(FIELDS, &[Quantity::ArtificialStress]);

    fn relisted(&self, _: &mut impl Run<D>) {}

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.each(&Shear, now);
        run.each(&Oppose(self.strength), now);
        run.pairs(&Momentum(self), &ControlledKick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Integrate(self.stress), now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        state(run, place)
    }
}
