//! Lanes without intrinsics: four doubles in an array, left to the compiler. Runs on every machine (on arm64 the
//! compiler turns it into NEON, which is part of the base instruction set there).

use super::Lanes;
use crate::math::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Four doubles in an array.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Plain4([f64; 4]);

impl Plain4 {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([f(a), f(b), f(c), f(d)])
    }

    #[inline(always)]
    fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let ([a, b, c, d], [p, q, r, s]) = (self.0, o.0);
        Self([f(a, p), f(b, q), f(c, r), f(d, s)])
    }
}

macro_rules! operator {
    ($($trait:ident $name:ident $op:tt),*) => {$(
        impl $trait for Plain4 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                self.zip(o, |a, b| a $op b)
            }
        }
    )*};
}
operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Plain4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl Real for Plain4 {
    type Mask = [bool; 4];
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self([x; 4])
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.map(f64::exp)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.map(f64::ln)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, Real::min)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, Real::max)
    }
    #[inline(always)]
    fn lt(self, o: Self) -> [bool; 4] {
        let (a, b) = (self.0, o.0);
        [a[0] < b[0], a[1] < b[1], a[2] < b[2], a[3] < b[3]]
    }
    #[inline(always)]
    fn select(m: [bool; 4], yes: Self, no: Self) -> Self {
        let (a, b) = (yes.0, no.0);
        let pick = |l: usize| if m[l] { a[l] } else { b[l] };
        Self([pick(0), pick(1), pick(2), pick(3)])
    }
}

impl Lanes for Plain4 {
    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        // SAFETY: the caller vouches for four doubles.
        Self(unsafe { from.cast::<[f64; 4]>().read_unaligned() })
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        // SAFETY: the caller vouches for four floats.
        Self(unsafe { from.cast::<[f32; 4]>().read_unaligned() }.map(f64::from))
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        // SAFETY: the caller vouches for four doubles.
        unsafe { to.cast::<[f64; 4]>().write_unaligned(self.0) }
    }
    #[inline(always)]
    unsafe fn transposed(from: [*const f64; 4]) -> [Self; 4] {
        // SAFETY: the caller vouches for four doubles behind each address.
        let [a, b, c, d] = unsafe { from.map(|p| Self::load(p).0) };
        let word = |k: usize| Self([a[k], b[k], c[k], d[k]]);
        [word(0), word(1), word(2), word(3)]
    }
    #[inline(always)]
    fn total(self) -> f64 {
        let [a, b, c, d] = self.0;
        (a + c) + (b + d)
    }
}
