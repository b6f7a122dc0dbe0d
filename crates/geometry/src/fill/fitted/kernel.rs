//! The kernel that particles settle by: Wendland's C2, W = a (1 - q/2)^4 (1 + 2q) with q = r/h and support 2h.

use crate::point::Dimension;
use std::f64::consts::PI;

/// Smoothing length over the spacing: that of the total Lagrangian forms.
const SMOOTHING: f64 = 1.15;

#[derive(Debug, Clone, Copy)]
pub(super) struct Kernel {
    h: f64,
    /// W at the middle.
    top: f64,
}

impl Kernel {
    pub(super) fn new(spacing: f64, dimension: Dimension) -> Self {
        let h = SMOOTHING * spacing;
        let top = match dimension {
            Dimension::Two => 7.0 / (4.0 * PI * h * h),
            Dimension::Three => 21.0 / (16.0 * PI * h * h * h),
        };
        Self { h, top }
    }

    /// How far it reaches, m.
    pub(super) fn reach(&self) -> f64 {
        2.0 * self.h
    }

    /// W'/r and W'' at a distance, 0 beyond the reach: the slope along the way is r times the first, the second derivatives across and
    /// along the way are the first and the second.
    pub(super) fn slopes(&self, r: f64) -> [f64; 2] {
        let q = r / self.h;
        let s = (1.0 - 0.5 * q).max(0.0);
        let scale = -5.0 * self.top / (self.h * self.h);
        [scale * s * s * s, scale * s * s * (1.0 - 2.0 * q)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_the_kernel_and_its_integral_is_one() {
        for dimension in [Dimension::Two, Dimension::Three] {
            let kernel = Kernel::new(0.3, dimension);
            let w = |r: f64| {
                let q = r / kernel.h;
                kernel.top * (1.0 - 0.5 * q).powi(4) * (1.0 + 2.0 * q)
            };
            let (n, e) = (4000, 1e-5);
            let dr = kernel.reach() / f64::from(n);
            let shell = |r: f64| match dimension {
                Dimension::Two => 2.0 * PI * r,
                Dimension::Three => 4.0 * PI * r * r,
            };
            let mass: f64 = (0..n).map(|i| (f64::from(i) + 0.5) * dr).map(|r| w(r) * shell(r) * dr).sum();
            // The middle rule of a smooth function: dr^2 times its curvature.
            assert!((mass - 1.0).abs() < 1e-6, "{mass}");
            for r in [0.05, 0.2, 0.4, 0.6] {
                let [across, along] = kernel.slopes(r);
                let slope = (w(r + e) - w(r - e)) / (2.0 * e);
                let curve = (w(r + e) - 2.0 * w(r) + w(r - e)) / (e * e);
                assert!((r * across - slope).abs() < 1e-6 * kernel.top / kernel.h);
                assert!((along - curve).abs() < 1e-4 * kernel.top / kernel.h.powi(2));
            }
        }
    }
}
