//! Lanes of AVX2 with fused multiply-add. Reached only behind [`available`], through a function that carries
//! `#[target_feature(enable = "avx2,fma")]` and into which all of this is inlined.

use super::Lanes;
use crate::math::Real;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Whether this machine has what [`F64x4`] needs.
#[must_use]
pub fn available() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

/// Four doubles in one AVX register.
#[derive(Clone, Copy, Debug)]
pub struct F64x4(__m256d);

impl F64x4 {
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let mut a = [0.0; 4];
        // SAFETY: four doubles on the stack; AVX2 is there (see module).
        unsafe {
            self.store(a.as_mut_ptr());
            Self::load(a.map(f).as_ptr())
        }
    }
}

macro_rules! operator {
    ($($trait:ident $name:ident $intrinsic:ident),*) => {$(
        impl $trait for F64x4 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                // SAFETY: AVX2 is there (see module).
                Self(unsafe { $intrinsic(self.0, o.0) })
            }
        }
    )*};
}
operator!(Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd);

impl Neg for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: AVX2 is there (see module).
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

// SAFETY of every block below: AVX2 and FMA are there (see module).
impl Real for F64x4 {
    type Mask = __m256d;
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self(unsafe { _mm256_set1_pd(x) })
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(unsafe { _mm256_fmadd_pd(self.0, a.0, b.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.each(f64::exp)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.each(f64::ln)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn select(mask: __m256d, yes: Self, no: Self) -> Self {
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask) })
    }
}

impl Lanes for F64x4 {
    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        // SAFETY: the caller vouches for four doubles.
        Self(unsafe { _mm256_loadu_pd(from) })
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        // SAFETY: the caller vouches for four floats.
        Self(unsafe { _mm256_cvtps_pd(_mm_loadu_ps(from)) })
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        // SAFETY: the caller vouches for four doubles.
        unsafe { _mm256_storeu_pd(to, self.0) }
    }
    /// Half-register loads and inserts instead of full loads: no cross-lane shuffle is needed then.
    #[inline(always)]
    unsafe fn transposed(from: [*const f64; 4]) -> [Self; 4] {
        // SAFETY: the caller vouches for four doubles behind each address.
        unsafe {
            let half = |lo: usize, hi: usize, o: usize| {
                let low = _mm256_castpd128_pd256(_mm_loadu_pd(from[lo].add(o)));
                _mm256_insertf128_pd::<1>(low, _mm_loadu_pd(from[hi].add(o)))
            };
            let (a, b, c, d) = (half(0, 2, 0), half(1, 3, 0), half(0, 2, 2), half(1, 3, 2));
            [
                Self(_mm256_unpacklo_pd(a, b)),
                Self(_mm256_unpackhi_pd(a, b)),
                Self(_mm256_unpacklo_pd(c, d)),
                Self(_mm256_unpackhi_pd(c, d)),
            ]
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        // SAFETY: AVX2 is there (see module).
        unsafe {
            let pair = _mm_add_pd(_mm256_castpd256_pd128(self.0), _mm256_extractf128_pd::<1>(self.0));
            _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)))
        }
    }
}
