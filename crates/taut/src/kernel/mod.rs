//! Smoothing kernels W(r, h): Wendland C2, cubic spline, Gaussian; normalised in 2 and 3 dimensions.

use crate::math::Real;
use std::f64::consts::PI;

/// The shape of the kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Shape {
    /// Fifth-order Wendland C2 with support 2h (TL section 4, UL section 6): (1 - q/2)^4 (1 + 2q).
    #[default]
    WendlandC2,
    /// Cubic B-spline with support 2h.
    CubicSpline,
    /// exp(-q^2), cut at 3h, where it has fallen to 1e-4 of its height.
    Gaussian,
}

/// A kernel: a shape, a smoothing length and a dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    shape: Shape,
    h: f64,
    scale: f64,
    dimension: usize,
}

impl Kernel {
    /// The kernel of smoothing length `h` (m) in `dimension` 2 or 3.
    #[must_use]
    pub fn new(shape: Shape, h: f64, dimension: usize) -> Self {
        let three = dimension == 3;
        let scale = match shape {
            Shape::WendlandC2 if three => 21.0 / (16.0 * PI),
            Shape::WendlandC2 => 7.0 / (4.0 * PI),
            Shape::CubicSpline if three => 1.0 / PI,
            Shape::CubicSpline => 10.0 / (7.0 * PI),
            Shape::Gaussian => PI.powf(-(dimension as f64) / 2.0),
        } / h.powi(dimension as i32);
        Self { shape, h, scale, dimension }
    }

    /// The smoothing length, m.
    #[must_use]
    pub fn h(&self) -> f64 {
        self.h
    }

    /// The radius beyond which the kernel is zero, m.
    #[must_use]
    pub fn support(&self) -> f64 {
        match self.shape {
            Shape::WendlandC2 | Shape::CubicSpline => 2.0 * self.h,
            Shape::Gaussian => 3.0 * self.h,
        }
    }

    /// W at distance `r`, 1/m^d.
    #[must_use]
    #[inline(always)]
    pub fn w<S: Real>(&self, r: S) -> S {
        let height = self.height(r * S::of(1.0 / self.h)) * S::of(self.scale);
        S::select(r.lt(S::of(self.support())), height, S::zero())
    }

    /// The height without its unit, f(q) of W = scale f(q) at q = r/h inside the support.
    #[must_use]
    #[inline(always)]
    pub fn height<S: Real>(&self, q: S) -> S {
        let (of, one) = (S::of, S::one());
        match self.shape {
            Shape::WendlandC2 => {
                let rest = q.mul_add(of(-0.5), one);
                let squared = rest * rest;
                squared * squared * q.mul_add(of(2.0), one)
            }
            Shape::CubicSpline => {
                let rest = of(2.0) - q;
                let near = (q * q).mul_add(q.mul_add(of(0.75), of(-1.5)), one);
                S::select(q.lt(one), near, of(0.25) * rest * rest * rest)
            }
            Shape::Gaussian => (-q * q).exp(),
        }
    }

    /// W / (r dW/dr) at squared distance `r2` (m^2, greater than zero) inside the support: with it a pass makes `W V_b` of its
    /// weight `W' V_b / r`. Never positive.
    #[must_use]
    #[inline(always)]
    pub fn w_over_slope<S: Real>(&self, r2: S) -> S {
        let (of, one) = (S::of, S::one());
        let q2 = r2 * of(1.0 / (self.h * self.h));
        match self.shape {
            Shape::WendlandC2 => {
                let q = q2.sqrt();
                q.mul_add(of(0.5), -one) * q.mul_add(of(2.0), one) / (q2 * of(5.0))
            }
            Shape::CubicSpline => {
                let q = q2.sqrt();
                let near =
                    q2.mul_add(q.mul_add(of(0.75), of(-1.5)), one) / (q2 * q.mul_add(of(2.25), of(-3.0)));
                S::select(q.lt(one), near, (q - of(2.0)) / (q * of(3.0)))
            }
            Shape::Gaussian => of(-0.5) / q2,
        }
    }

    /// dW/dr at distance `r`, 1/m^(d+1); never positive.
    #[must_use]
    #[inline(always)]
    pub fn dw<S: Real>(&self, r: S) -> S {
        let slope = self.slope(r * S::of(1.0 / self.h)) * S::of(self.scale / self.h);
        S::select(r.lt(S::of(self.support())), slope, S::zero())
    }

    /// The slope without its unit, df/dq of W = scale f(q) at q = r/h inside the support.
    #[must_use]
    #[inline(always)]
    pub fn slope<S: Real>(&self, q: S) -> S {
        let of = S::of;
        match self.shape {
            Shape::WendlandC2 => {
                let rest = q.mul_add(of(-0.5), S::one());
                of(-5.0) * q * (rest * rest * rest)
            }
            Shape::CubicSpline => {
                let rest = of(2.0) - q;
                S::select(q.lt(S::one()), q * q.mul_add(of(2.25), of(-3.0)), of(-0.75) * rest * rest)
            }
            Shape::Gaussian => of(-2.0) * q * (-q * q).exp(),
        }
    }

    /// What makes W'/r of slope(q)/q, 1/m^(d+2).
    #[must_use]
    pub fn steepness(&self) -> f64 {
        self.scale / (self.h * self.h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> impl Iterator<Item = Kernel> {
        [Shape::WendlandC2, Shape::CubicSpline, Shape::Gaussian]
            .into_iter()
            .flat_map(|s| [2, 3].map(|d| Kernel::new(s, 0.7, d)))
    }

    /// Midpoint rule over `n` shells; its error is of order (support/n)^2.
    fn integral(k: &Kernel, f: impl Fn(f64) -> f64) -> f64 {
        let n = 20_000;
        let dr = k.support() / f64::from(n);
        (0..n)
            .map(|i| (f64::from(i) + 0.5) * dr)
            .map(|r| f(r) * if k.dimension == 2 { 2.0 * PI * r } else { 4.0 * PI * r * r } * dr)
            .sum()
    }

    #[test]
    fn every_kernel_is_normalised() {
        for k in all() {
            // The Gaussian misses its tail beyond 3h: erfc-like, 1.2e-4 in 2D and 4.4e-4 in 3D.
            let missing = match (k.shape, k.dimension) {
                (Shape::Gaussian, 2) => (-9.0f64).exp(),
                (Shape::Gaussian, _) => 4.3985e-4,
                _ => 0.0,
            };
            assert!((integral(&k, |r| k.w(r)) - 1.0 + missing).abs() < 1e-7, "{k:?}");
        }
    }

    #[test]
    fn every_derivative_is_the_derivative() {
        for k in all() {
            for i in 1..100 {
                let (r, e) = (k.support() * f64::from(i) / 101.0, 1e-6);
                let central = (k.w(r + e) - k.w(r - e)) / (2.0 * e);
                // Central difference: e^2 W'''/6 plus eps W/e, both below 1e-8 of the peak slope here.
                assert!((k.dw(r) - central).abs() < 1e-8 * k.w(0.0) / k.h, "{k:?} at {r}");
                assert!(k.dw(r) < 0.0, "monotone: {k:?} at {r}");
            }
        }
    }

    #[test]
    fn value_and_slope_go_together() {
        for k in all() {
            for i in 1..100 {
                let r = k.support() * f64::from(i) / 100.5;
                // A dozen operations on numbers of order 1, relative to the largest such ratio around.
                let error = k.w_over_slope(r * r) * r * k.dw(r) - k.w(r);
                assert!(error.abs() < 1e-14 * k.w(0.0), "{k:?} at {r}: {error:e}");
            }
        }
    }

    #[test]
    fn every_kernel_vanishes_outside_its_support() {
        for k in all() {
            assert_eq!((k.w(k.support()), k.dw(k.support())), (0.0, 0.0));
        }
    }

    /// First moment identity: the integral of r W'(r) is -d.
    #[test]
    fn gradient_of_a_linear_field_is_exact_in_the_continuum() {
        for k in all() {
            // Partial integration over the cut-off Gaussian leaves 4 pi R^3 W(R) = 7.5e-3 at R = 3h in 3D and d times its
            // missing tail.
            let tail = if k.shape == Shape::Gaussian { 9e-3 } else { 1e-7 };
            assert!((integral(&k, |r| r * k.dw(r)) + k.dimension as f64).abs() < tail, "{k:?}");
        }
    }
}
