//! Pressure and its dissipation between all particles: a Riemann solver without limiter.

use crate::math::{Real, Vector};
use crate::pass::Pair;

/// A particle as the pressure sees it.
#[derive(Clone, Copy, Debug)]
pub struct Pushing<S, const D: usize> {
    /// Velocity.
    pub v: Vector<S, D>,
    /// Pressure.
    pub p: S,
    /// Impedance rho0 c0.
    pub z: S,
}

/// The dissipation alone, along the present line x = x_a - x_b of the pair instead of that of the list, which a spin leaves behind. The speed of
/// approach is that of the time of v, half a step `half` before: what spins does not approach.
#[inline(always)]
pub fn damp<S: Real, const D: usize, const M: u8>(
    (force, power): (&mut Vector<S, D>, &mut S),
    (v, x, half): (Vector<S, D>, Vector<S, D>, S),
    (z, ab): (S, &Pair<S, D, M>),
) {
    // A list is filled up with pairs of a particle with itself, of weight 0.
    let per_square = S::one() / x.norm_squared().max(S::of(1e-30));
    let length = ab.x.norm_squared() * ab.over_r;
    let approach = z * v.dot(x.plus(-half, v)) * length * per_square;
    let mut pushed = Vector::zero();
    ab.along(&mut pushed, x, approach);
    *force = *force + pushed;
    *power = pushed.dot(v).mul_add(S::of(-0.5), *power);
}

/// Adds [-(p_a + p_b) + z (v_a - v_b).e] grad W V_b, which is -2 P* grad W V_b with the interface pressure
/// P* = (p_a + p_b)/2 - z (v_a - v_b).e / 2; and the power per volume that the second term takes out of the motion.
///
/// The sign: e points from b to a, so (v_a - v_b).e < 0 in approach, and P* rises. There is no limiter and no
/// pressure-jump term in the velocity: with either, the published periods do not come out and the form is unstable.
#[inline(always)]
pub fn push<S: Real, const D: usize, const M: u8>(
    (force, power): (&mut Vector<S, D>, &mut S),
    (a, b): (&Pushing<S, D>, &Pushing<S, D>),
    ab: &Pair<S, D, M>,
) {
    let v = a.v - b.v;
    // (v_a - v_b).e, from a product that the last line has too.
    let opening = v.dot(ab.x) * ab.over_r;
    let approach = opening * ((a.z + b.z) * S::of(0.5));
    ab.gradient(force, approach - (a.p + b.p));
    let mut rate = S::zero();
    ab.divergence(&mut rate, v);
    *power = (approach * S::of(-0.5)).mul_add(rate, *power);
}
