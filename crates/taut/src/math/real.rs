//! The number that the physics is generic in.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number: `f64`, `f32`, or a handful of them side by side in the lanes of a SIMD register.
///
/// There is no data-dependent branch on a `Real`: compare with [`Real::lt`] and choose with [`Real::select`].
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// What a comparison gives: one truth value, or one for each lane.
    type Mask: Copy;

    /// The number nearest to `x`, in every lane.
    fn of(x: f64) -> Self;
    /// `self * a + b`, rounded once where the machine can.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Natural exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::of(0.0)
    }

    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::of(1.0)
    }

    /// `self` to the power -1/3, for positive numbers.
    ///
    /// Newton's iteration `y <- y (4 - x y^3) / 3` from the [1/1] Padé approximant at 1. Eight iterations reach
    /// rounding for 0.02 < x < 20, which is far beyond the volume ratios of any admissible deformation.
    #[inline(always)]
    fn inverse_cbrt(self) -> Self {
        let x = self;
        let (two, four, third) = (Self::of(2.0), Self::of(4.0), Self::of(1.0 / 3.0));
        let mut y = (two + x) / two.mul_add(x, Self::one());
        for _ in 0..8 {
            y = y * (four - x * y * y * y) * third;
        }
        y
    }

    /// `self` to the power -2/d for d = 2 or 3: the isochoric factor of the deviator.
    #[inline(always)]
    fn isochoric(self, d: f64) -> Self {
        if d == 3.0 {
            let y = self.inverse_cbrt();
            y * y
        } else {
            Self::one() / self
        }
    }
}

macro_rules! scalar {
    ($t:ty) => {
        impl Real for $t {
            type Mask = bool;
            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                // Without a fused instruction the library routine is slow; the plain form differs in the last bit.
                self * a + b
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$t>::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                <$t>::abs(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                <$t>::exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                <$t>::ln(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }
    };
}
scalar!(f32);
scalar!(f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_cube_root_is_exact_to_rounding() {
        for i in 0..200 {
            let x = 0.05 * 1.03f64.powi(i);
            if x < 18.0 {
                // 4 eps: the last Newton step rounds five times.
                let error = (x.inverse_cbrt() / x.powf(-1.0 / 3.0) - 1.0).abs();
                assert!(error < 4.0 * f64::EPSILON, "x = {x}: {error:e}");
            }
        }
    }

    #[test]
    fn isochoric_factor_of_both_dimensions() {
        assert!((1.3f64.isochoric(2.0) - 1.0 / 1.3).abs() < 1e-15);
        assert!((1.3f64.isochoric(3.0) - 1.3f64.powf(-2.0 / 3.0)).abs() < 1e-15);
    }
}
