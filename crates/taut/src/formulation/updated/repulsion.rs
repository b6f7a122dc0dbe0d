//! Artificial stress: what pushes apart the particles that tension clumps (Gray, Monaghan and Swift 2001).

use super::kick::ControlledPush;
use super::pressure::{Pushing, push};
use super::same_body;
use crate::field::Of;
use crate::kernel::Kernel;
use crate::math::{Real, Tensor, Vector};
use crate::pass::{Now, Pair, Update};

/// (V_a/m_a) sum_b f_ab^4 (R_a + R_b) grad W V_b inside the body: R = -eps times the tensile part of sigma = s - p 1 along its principal axes,
/// f_ab = W(x_ab)/W(dp). Gray et al. divide R by rho^2 and multiply with masses; here it is normalised as the stress that it opposes. They
/// derive it in the plane; in space it is the same along three principal directions, which is ours.
#[derive(Clone, Copy, Debug)]
pub struct Repulsion {
    /// eps; 0.3 by Gray et al. for their kernel and h.
    pub strength: f64,
    kernel: Kernel,
    /// 1/W(dp), m^d.
    unit: f64,
}

impl Repulsion {
    /// With the published eps = 0.3 (and exponent 4), for particles of this spacing (m).
    #[must_use]
    pub fn new(kernel: Kernel, spacing: f64) -> Self {
        Self { strength: 0.3, kernel, unit: 1.0 / kernel.w(spacing) }
    }

    /// The same with this eps.
    #[must_use]
    pub const fn of(self, strength: f64) -> Self {
        Self { strength, ..self }
    }

    /// Adds what pressure and its dissipation, the stress inside of a body, and artificial stress make of a pair.
    #[inline(always)]
    pub fn add<S: Real, const D: usize, const M: u8>(
        &self,
        sum: &mut ControlledPush<S, D>,
        (a, b): (&Repelling<S, D>, &Repelling<S, D>),
        ab: &Pair<S, D, M>,
    ) {
        push((&mut sum.f, &mut sum.power), (&a.pushing, &b.pushing), ab);
        let inside = same_body(a.body, b.body);
        ab.dot(&mut sum.f, (a.s + b.s).times(inside));
        self.repel(&mut sum.g, (a.r + b.r).times(inside), ab);
    }

    /// Adds f_ab^4 r grad W V_b to `sum`, with r the R of both.
    #[inline(always)]
    fn repel<S: Real, const D: usize, const M: u8>(
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

/// A particle as this force sees it.
pub struct Repelling<S, const D: usize> {
    /// As the pressure sees it.
    pub pushing: Pushing<S, D>,
    /// The stress that it hands to its neighbours.
    pub s: Tensor<S, D>,
    /// Its artificial stress.
    pub r: Tensor<S, D>,
    /// Its body.
    pub body: S,
}

record! {
    /// A stress to be opposed.
    Strained { s: ShearStress, p: Pressure }
    /// What opposes it.
    Opposed { r: ArtificialStress }
}

/// R = -eps sum_k max(sigma_k, 0) n_k (x) n_k, with this eps.
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
