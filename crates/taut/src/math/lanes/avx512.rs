//! Lanes of AVX-512. Reached only behind [`available`], through a function that carries
//! `#[target_feature(enable = "avx512f,avx512dq,avx2,fma")]` and into which all of this is inlined.

use super::avx2::{F32x8, F64x4};
use super::{Lanes, each_lane, operators};
use crate::math::Real;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Whether this machine has what these lanes need.
#[must_use]
pub fn available() -> bool {
    super::avx2::available() && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq")
}

/// Eight doubles in one AVX-512 register.
#[derive(Clone, Copy, Debug)]
pub struct F64x8(__m512d);

/// Sixteen floats in one AVX-512 register.
#[derive(Clone, Copy, Debug)]
pub struct F32x16(__m512);

operators!(F64x8: Add add _mm512_add_pd, Sub sub _mm512_sub_pd, Mul mul _mm512_mul_pd, Div div _mm512_div_pd);
operators!(F32x16: Add add _mm512_add_ps, Sub sub _mm512_sub_ps, Mul mul _mm512_mul_ps, Div div _mm512_div_ps);
each_lane!(F64x8, f64, 8);
each_lane!(F32x16, f32, 16);

/// Arithmetic of one lane type, from its intrinsics.
macro_rules! real {
    ($lanes:ty, $mask:ty, $set:ident, $xor:ident, $abs:ident, $fma:ident, $sqrt:ident, $min:ident, $max:ident,
     $cmp:ident, $blend:ident, $e:ty) => {
        impl Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: AVX-512 is there (see module).
                Self(unsafe { $xor(self.0, $set(-0.0)) })
            }
        }

        // SAFETY of every block below: AVX-512 is there (see module).
        impl Real for $lanes {
            type Mask = $mask;
            #[inline(always)]
            fn of(x: f64) -> Self {
                Self(unsafe { $set(x as $e) })
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                Self(unsafe { $fma(self.0, a.0, b.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(unsafe { $abs(self.0) })
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.each(<$e>::exp)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.each(<$e>::ln)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                unsafe { $cmp::<_CMP_LT_OQ>(self.0, other.0) }
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(unsafe { $blend(mask, no.0, yes.0) })
            }
        }
    };
}
real!(
    F64x8,
    __mmask8,
    _mm512_set1_pd,
    _mm512_xor_pd,
    _mm512_abs_pd,
    _mm512_fmadd_pd,
    _mm512_sqrt_pd,
    _mm512_min_pd,
    _mm512_max_pd,
    _mm512_cmp_pd_mask,
    _mm512_mask_blend_pd,
    f64
);
real!(
    F32x16,
    __mmask16,
    _mm512_set1_ps,
    _mm512_xor_ps,
    _mm512_abs_ps,
    _mm512_fmadd_ps,
    _mm512_sqrt_ps,
    _mm512_min_ps,
    _mm512_max_ps,
    _mm512_cmp_ps_mask,
    _mm512_mask_blend_ps,
    f32
);

impl F64x8 {
    #[inline(always)]
    fn join(low: F64x4, high: F64x4) -> Self {
        // SAFETY: AVX-512 is there (see module).
        Self(unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low.register()), high.register()) })
    }
}

impl F32x16 {
    #[inline(always)]
    fn join(low: F32x8, high: F32x8) -> Self {
        // SAFETY: AVX-512 is there (see module).
        Self(unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(low.register()), high.register()) })
    }
}

impl Lanes for F64x8 {
    type E = f64;
    const N: usize = 8;

    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        // SAFETY: the caller vouches for eight doubles.
        Self(unsafe { _mm512_loadu_pd(from) })
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        // SAFETY: the caller vouches for eight floats.
        Self(unsafe { _mm512_cvtps_pd(_mm256_loadu_ps(from)) })
    }
    #[inline(always)]
    unsafe fn store_single(self, to: *mut f32) {
        // SAFETY: the caller vouches for eight floats.
        unsafe { _mm256_storeu_ps(to, _mm512_cvtpd_ps(self.0)) }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        // SAFETY: the caller vouches for eight doubles.
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        // SAFETY: the caller vouches for eight doubles.
        unsafe { _mm512_storeu_pd(to, self.0) }
    }
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f64) -> [Self; 4] {
        // SAFETY: the caller vouches for four doubles behind each address.
        let (low, high) = unsafe { (F64x4::transposed(&from), F64x4::transposed(|l| from(l + 4))) };
        let word = |k: usize| Self::join(low[k], high[k]);
        [word(0), word(1), word(2), word(3)]
    }
    #[inline(always)]
    fn total(self) -> f64 {
        // SAFETY: AVX-512 is there (see module).
        unsafe { _mm512_reduce_add_pd(self.0) }
    }
}

impl Lanes for F32x16 {
    type E = f32;
    const N: usize = 16;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller vouches for sixteen floats.
        Self(unsafe { _mm512_loadu_ps(from) })
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        // SAFETY: the caller vouches for sixteen floats.
        unsafe { Self::load(from) }
    }
    #[inline(always)]
    unsafe fn store_single(self, to: *mut f32) {
        // SAFETY: the caller vouches for sixteen floats.
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        // SAFETY: the caller vouches for sixteen doubles.
        unsafe {
            _mm512_storeu_pd(to, _mm512_cvtps_pd(_mm512_castps512_ps256(self.0)));
            _mm512_storeu_pd(to.add(8), _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(self.0)));
        }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller vouches for sixteen floats.
        unsafe { _mm512_storeu_ps(to, self.0) }
    }
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f32) -> [Self; 4] {
        // SAFETY: the caller vouches for four floats behind each address.
        let (low, high) = unsafe { (F32x8::transposed(&from), F32x8::transposed(|l| from(l + 8))) };
        let word = |k: usize| Self::join(low[k], high[k]);
        [word(0), word(1), word(2), word(3)]
    }
    #[inline(always)]
    fn total(self) -> f64 {
        // SAFETY: AVX-512 is there (see module).
        unsafe {
            let low = _mm512_cvtps_pd(_mm512_castps512_ps256(self.0));
            let high = _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(self.0));
            _mm512_reduce_add_pd(_mm512_add_pd(low, high))
        }
    }
}
