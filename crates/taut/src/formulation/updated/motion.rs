//! Passes shared by the updated Lagrangian formulations: drift and correction matrix.

use super::same_body;
use crate::correction::Moment;
use crate::field::Of;
use crate::math::Real;
use crate::pass::{Now, Pair, PairSum, Update};

record! {
    /// A particle about to drift.
    Drifting {
        x: Position, v: Velocity, density: Density, rate: DensityRate, rest: RestDensity, c: SoundSpeed,
    }
    /// A particle half a step later.
    Drifted { x: Position, density: Density, p: Pressure }
    /// A point and its body.
    Place { x: Position, body: Body }
    /// What a new configuration needs.
    Heavy { m: Mass, density: Density }
    /// The volume of a new configuration.
    Extent { volume: Volume }
}

/// Half a step of positions and densities, then p = c0^2 (rho - rho0) (UL Eqs. 5, 23).
pub struct Drift;

impl<const D: usize> Update<D> for Drift {
    type Sum = ();
    type Reads = Drifting<f64, D>;
    type Writes = Drifted<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Drifting<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let density = half.mul_add(a.rate, a.density);
        Drifted { x: a.x.plus(half, a.v), density, p: a.c * a.c * (density - a.rest) }
    }
}

/// V = m / rho, once for each configuration.
pub struct Refresh;

impl<const D: usize> Update<D> for Refresh {
    type Sum = ();
    type Reads = Heavy<f64, D>;
    type Writes = Extent<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Heavy<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        Extent { volume: a.m / a.density }
    }
}

/// sum_b (x_b - x_a) (x) grad W V_b inside the body. UL Eq. (27) has x_a - x_b and a negative definite inverse; ours is
/// positive, and so is the sign of the gradient it corrects.
pub struct MomentSum;

impl<const D: usize> PairSum<D> for MomentSum {
    type Reads = Place<f64, D>;
    type Adds = Moment<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Moment<S, D>,
        (a, b): (&Place<S, D>, &Place<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        ab.outer(&mut sum.m, (b.x - a.x).times(same_body(a.body, b.body)));
    }
}
