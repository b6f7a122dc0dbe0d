//! The sums that all forms share whose neighbours are those of the undeformed body.

use crate::math::Real;
use crate::pass::{Now, Pair, PairSum};

record! {
    /// What the rate of deformation is made of.
    Flow { v: Velocity }
    /// The uncorrected gradient of velocity.
    Gradient { l: VelocityGradient }
    /// What a pair force needs.
    Stressed { q: NominalStress }
    /// Force per reference volume.
    Force { f: ForceDensity }
}

/// sum_b (v_b - v_a) (x) grad W V_b (TL Eq. 22 without B; SS Eq. 9 for the rate, without the factor 1/2 and the transpose).
pub struct Rate;

impl<const D: usize> PairSum<D> for Rate {
    type Reads = Flow<f64, D>;
    type Adds = Gradient<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Gradient<S, D>,
        (a, b): (&Flow<S, D>, &Flow<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.outer(&mut sum.l, b.v - a.v);
    }
}

/// sum_b (Q_a + Q_b) . grad W V_b, where Q is P B (TL Eq. 20) or sigma/s (SS Eq. 7 with the density at rest).
pub struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Stressed<f64, D>;
    type Adds = Force<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Force<S, D>,
        (a, b): (&Stressed<S, D>, &Stressed<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.dot(&mut sum.f, a.q + b.q);
    }
}
