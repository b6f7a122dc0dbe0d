//! What two surfaces do to each other: an energy of how far one reaches into the other.

use crate::kernel::{Kernel, Shape};
use crate::math::Vector;

/// Smoothing length of the contact kernel over the spacing: a particle feels a surface over 2.3 spacings, so that it slides over the
/// particles of the other side as over a plane (the overlap of a flat lattice varies by 1 per cent along it).
const SMOOTHING: f64 = 1.15;

/// The law of contact of particles a spacing apart.
///
/// The **overlap** of particle a with a body is sigma_a = sum_b V_b W(|x_a - x_b|) over the particles b of that body. Lattices that
/// continue each other have sigma_0; there surfaces touch. What exceeds it is stored:
///
/// E = sum_a V_a (k s / 2) (sigma_a - sigma_0)_+^2,  over the particles of both bodies, k = 2 k_1 k_2 / (k_1 + k_2), k_i = K of body i.
///
/// E depends on distances only, so its forces f_ab = -V_a V_b (p_a + p_b) W' e with p = k s (sigma - sigma_0)_+ are central and
/// antisymmetric: momentum, angular momentum and energy are kept. s is such that flat surfaces pressed together by delta push back
/// with k delta / dp: the contact is as stiff as a layer of the materials that is one spacing thick.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    h: f64,
    /// 5 W(0) / h: W' = -5 W(0)/h q (1 - q/2)^3.
    steep: f64,
    kernel: Kernel,
    /// Overlap of surfaces that just touch.
    pub rest: f64,
    /// s.
    pub gain: f64,
    /// Spacing, m.
    pub spacing: f64,
}

impl Law {
    /// The law for particles `spacing` (m) apart in `dimension` 2 or 3.
    #[must_use]
    pub fn new(spacing: f64, dimension: usize) -> Self {
        let h = SMOOTHING * spacing;
        let kernel = Kernel::new(Shape::WendlandC2, h, dimension);
        let mut law = Self { h, steep: 5.0 * kernel.w(0.0) / h, kernel, rest: 0.0, gain: 0.0, spacing };
        let (rest, slope) = law.above_a_lattice(dimension);
        law.rest = rest;
        // E per area = 2 dp (k s / 2) (slope delta)^2 for both sides, so the pressure is 2 dp k s slope^2 delta.
        law.gain = 0.5 / (slope * spacing).powi(2);
        law
    }

    /// Overlap, and its derivative, of a particle one spacing above the first row of a lattice, straight above one of its particles.
    fn above_a_lattice(&self, dimension: usize) -> (f64, f64) {
        let (dp, reach) = (self.spacing, (self.support() / self.spacing).ceil() as i32);
        let aside = if dimension == 3 { -reach..=reach } else { 0..=0 };
        let volume = dp.powi(dimension as i32);
        let mut sums = (0.0, 0.0);
        for (i, j) in aside.flat_map(|j| (-reach..=reach).map(move |i| (i, j))) {
            for row in 1..=reach {
                let x = Vector([f64::from(i), f64::from(row), f64::from(j)]).times(dp);
                let r = x.norm_squared().sqrt();
                sums.0 += volume * self.w(r);
                sums.1 += volume * self.slope(r) * x[1] / r;
            }
        }
        sums
    }

    /// How far a particle feels others, m.
    #[must_use]
    pub fn support(&self) -> f64 {
        2.0 * self.h
    }

    /// W, 1/m^d.
    #[must_use]
    pub fn w(&self, r: f64) -> f64 {
        self.kernel.w(r)
    }

    /// W' = dW/dr, 1/m^(d+1).
    #[must_use]
    pub fn slope(&self, r: f64) -> f64 {
        self.kernel.dw(r)
    }

    /// A bound of the second derivatives of W at a distance, 1/m^(d+2): the larger of |W''| along the pair and |W'|/r across it.
    #[must_use]
    pub fn curvature(&self, r: f64) -> f64 {
        let q = r / self.h;
        let left = (1.0 - 0.5 * q).max(0.0);
        self.steep / self.h * left * left * left.max((1.0 - 2.0 * q).abs())
    }

    /// p / k = s (sigma - sigma_0)_+.
    #[must_use]
    pub fn pressure(&self, overlap: f64) -> f64 {
        self.gain * (overlap - self.rest).max(0.0)
    }

    /// Energy per volume over k: s/2 (sigma - sigma_0)_+^2.
    #[must_use]
    pub fn energy(&self, overlap: f64) -> f64 {
        0.5 * self.gain * (overlap - self.rest).max(0.0).powi(2)
    }

    /// Whether a particle counts as pressing when the stable step is asked for: a little before it does, so that the step
    /// does not jump when surfaces meet.
    #[must_use]
    pub fn is_near(&self, overlap: f64) -> bool {
        overlap > 0.8 * self.rest
    }
}

/// k = 2 k_1 k_2 / (k_1 + k_2) of two bulk moduli, Pa; `None` stands for a rigid body.
#[must_use]
pub fn stiffness(one: Option<f64>, other: Option<f64>) -> f64 {
    match (one, other) {
        (Some(k), Some(l)) => 2.0 * k * l / (k + l),
        (Some(k), None) | (None, Some(k)) => 2.0 * k,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivatives_of_the_kernel_are_bounded_as_said() {
        for dimension in [2, 3] {
            let law = Law::new(0.01, dimension);
            for i in 1..200 {
                let (r, e) = (law.support() * f64::from(i) / 200.0, 1e-7);
                let second = (law.slope(r + e) - law.slope(r - e)) / (2.0 * e);
                let bound = law.curvature(r);
                // Central differences: e^2/6 of the fourth derivative, below 1e-6 of the bound at 0.
                let slack = 1e-6 * law.curvature(0.0);
                assert!(second.abs() <= bound + slack && -law.slope(r) / r <= bound + slack, "{r}");
            }
        }
    }

    /// Two half spaces of lattices, as far as they feel each other, at a distance of one spacing less `delta`.
    fn energy_per_area(law: &Law, dimension: usize, delta: f64) -> f64 {
        let (dp, volume) = (law.spacing, law.spacing.powi(dimension as i32));
        let aside = if dimension == 3 { -3..=3 } else { 0..=0 };
        let mut sum = 0.0;
        for depth in 0..3 {
            let mut overlap = 0.0;
            for (i, j) in aside.clone().flat_map(|j| (-3..=3).map(move |i| (i, j))) {
                for row in 0..3 {
                    let y = (f64::from(depth + row) + 1.0) * dp - delta;
                    let r = ((f64::from(i) * dp).powi(2) + (f64::from(j) * dp).powi(2) + y * y).sqrt();
                    overlap += volume * law.w(r);
                }
            }
            sum += 2.0 * dp * law.energy(overlap);
        }
        sum
    }

    #[test]
    fn flat_surfaces_push_back_like_a_layer_of_one_spacing() {
        for dimension in [2, 3] {
            let law = Law::new(0.01, dimension);
            assert!(energy_per_area(&law, dimension, 0.0) < 1e-25, "touching is no pressing");
            let delta = 1e-4 * law.spacing;
            let stored = energy_per_area(&law, dimension, delta);
            // E = delta^2 / (2 dp) for k = 1; the slope of the overlap grows by about delta/dp meanwhile.
            let expected = 0.5 * delta * delta / law.spacing;
            assert!((stored / expected - 1.0).abs() < 1e-3, "{}", stored / expected);
        }
    }

    #[test]
    fn the_softer_body_decides() {
        assert_eq!(stiffness(Some(3.0), Some(3.0)), 3.0);
        assert_eq!(stiffness(Some(3.0), None), 6.0);
        assert!(stiffness(Some(3.0), Some(1e9)) < 6.0);
    }
}
