//! Lanes of AVX-512. Reached only behind [`available`], through a function that carries
//! `#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma,popcnt,bmi1,bmi2")]` and into which all of this is inlined.

use super::fine::Fine;
use super::{Lanes, each_lane, operators};
use crate::math::Real;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Whether this machine has what these lanes need.
#[must_use]
pub fn available() -> bool {
    super::avx2::available()
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
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
    /// The first two numbers of each half of `self` and `other` side by side, and the last two.
    #[inline(always)]
    fn halves(self, other: Self) -> (Self, Self) {
        // SAFETY: AVX-512 is there (see module).
        unsafe {
            let first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let last = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            (
                Self(_mm512_permutex2var_pd(self.0, first, other.0)),
                Self(_mm512_permutex2var_pd(self.0, last, other.0)),
            )
        }
    }
}

impl F32x16 {
    /// The first half plus the second, in double precision: lanes of a sum are of like size, but there may be many.
    #[inline(always)]
    fn folded(self) -> F64x8 {
        // SAFETY: AVX-512 is there (see module).
        unsafe {
            let low = _mm512_cvtps_pd(_mm512_castps512_ps256(self.0));
            let high = _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(self.0));
            F64x8(_mm512_add_pd(low, high))
        }
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
        unsafe {
            // Records l and l + 2 share a register, so that quarters of the unpacked ones only need to be put in order.
            macro_rules! both {
                ($l:literal) => {{
                    let low = _mm512_castpd256_pd512(_mm256_loadu_pd(from($l)));
                    _mm512_insertf64x4::<1>(low, _mm256_loadu_pd(from($l + 2)))
                }};
            }
            let (a, b, c, d) = (both!(0), both!(1), both!(4), both!(5));
            let (ab, cd) = (_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d));
            let (ab2, cd2) = (_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d));
            [
                Self(_mm512_shuffle_f64x2::<0b10_00_10_00>(ab, cd)),
                Self(_mm512_shuffle_f64x2::<0b10_00_10_00>(ab2, cd2)),
                Self(_mm512_shuffle_f64x2::<0b11_01_11_01>(ab, cd)),
                Self(_mm512_shuffle_f64x2::<0b11_01_11_01>(ab2, cd2)),
            ]
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        // SAFETY: AVX-512 is there (see module).
        unsafe { _mm512_reduce_add_pd(self.0) }
    }
    #[inline(always)]
    fn totals(rows: &[Self], to: &mut [f64]) {
        let (&[a, b, c, d, e, f, g, h], 8..) = (rows, to.len()) else {
            return to.iter_mut().zip(rows).for_each(|(sum, row)| *sum = row.total());
        };
        // SAFETY: AVX-512 is there (see module); `to` has room for eight.
        unsafe {
            macro_rules! pair {
                ($x:ident, $y:ident) => {
                    Self(_mm512_unpacklo_pd($x.0, $y.0)) + Self(_mm512_unpackhi_pd($x.0, $y.0))
                };
            }
            let (first, second) = (pair!(a, b).halves(pair!(c, d)), pair!(e, f).halves(pair!(g, h)));
            let (first, second) = (first.0 + first.1, second.0 + second.1);
            let low = Self(_mm512_shuffle_f64x2::<0x44>(first.0, second.0));
            let high = Self(_mm512_shuffle_f64x2::<0xEE>(first.0, second.0));
            (low + high).store(to.as_mut_ptr());
        }
    }
    #[inline(always)]
    fn bits(mask: __mmask8) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    unsafe fn compress(self, bits: u32, ids: *const u32, (to, to_ids): (*mut f32, *mut u32)) {
        // SAFETY: the caller vouches for eight numbers behind each address. (Packed in the register and stored whole: the
        // instruction that stores only some lanes is slow on some processors.)
        unsafe {
            let packed = _mm256_maskz_compress_ps(bits as u8, _mm512_cvtpd_ps(self.0));
            _mm256_storeu_ps(to, packed);
            let packed = _mm256_maskz_compress_epi32(bits as u8, _mm256_loadu_si256(ids.cast()));
            _mm256_storeu_si256(to_ids.cast(), packed);
        }
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        let fine = Fine::of(step);
        // SAFETY: AVX-512 is there (see module).
        unsafe {
            let own = _mm512_set1_epi64((own ^ Fine::MIDDLE) as i64);
            let apart = _mm512_sub_epi32(own, _mm512_castpd_si512(self.0));
            let (low, exponent) = (_mm512_set1_epi64(0xffff_ffff), _mm512_set1_epi64(fine.exponent as i64));
            let number = |bits| {
                let shifted = _mm512_castsi512_pd(bits);
                Self(_mm512_sub_pd(shifted, _mm512_set1_pd(fine.shift)))
            };
            // (apart & low) | exponent
            let first = _mm512_ternarylogic_epi64::<0xea>(apart, low, exponent);
            let second = _mm512_or_si512(_mm512_srli_epi64::<32>(apart), exponent);
            [number(first), number(second)]
        }
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
        unsafe {
            // Records l, l + 4, l + 8 and l + 12 share a register, so that the transposition stays inside quarters.
            // (A macro, because a closure may stay out of line, and then every intrinsic in it is a call.)
            macro_rules! four {
                ($l:literal) => {{
                    let low = _mm512_castps128_ps512(_mm_loadu_ps(from($l)));
                    let low = _mm512_insertf32x4::<1>(low, _mm_loadu_ps(from($l + 4)));
                    let low = _mm512_insertf32x4::<2>(low, _mm_loadu_ps(from($l + 8)));
                    _mm512_insertf32x4::<3>(low, _mm_loadu_ps(from($l + 12)))
                }};
            }
            let (a, b, c, d) = (four!(0), four!(1), four!(2), four!(3));
            let (ab, cd) = (_mm512_unpacklo_ps(a, b), _mm512_unpacklo_ps(c, d));
            let (ab2, cd2) = (_mm512_unpackhi_ps(a, b), _mm512_unpackhi_ps(c, d));
            [
                Self(_mm512_shuffle_ps::<0x44>(ab, cd)),
                Self(_mm512_shuffle_ps::<0xEE>(ab, cd)),
                Self(_mm512_shuffle_ps::<0x44>(ab2, cd2)),
                Self(_mm512_shuffle_ps::<0xEE>(ab2, cd2)),
            ]
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        self.folded().total()
    }
    #[inline(always)]
    fn totals(rows: &[Self], to: &mut [f64]) {
        let &[a, b, c, d, e, f, g, h] = rows else {
            return to.iter_mut().zip(rows).for_each(|(sum, row)| *sum = row.total());
        };
        // Written out: a closure handed to `map` would not be inlined, and every intrinsic in it would be a call.
        let (a, b, c, d) = (a.folded(), b.folded(), c.folded(), d.folded());
        F64x8::totals(&[a, b, c, d, e.folded(), f.folded(), g.folded(), h.folded()], to);
    }
    #[inline(always)]
    fn bits(mask: __mmask16) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    unsafe fn compress(self, bits: u32, ids: *const u32, (to, to_ids): (*mut f32, *mut u32)) {
        // SAFETY: the caller vouches for sixteen numbers behind each address.
        unsafe {
            _mm512_storeu_ps(to, _mm512_maskz_compress_ps(bits as u16, self.0));
            let packed = _mm512_maskz_compress_epi32(bits as u16, _mm512_loadu_si512(ids.cast()));
            _mm512_storeu_si512(to_ids.cast(), packed);
        }
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        // SAFETY: AVX-512 is there (see module).
        unsafe {
            let theirs = _mm512_castps_si512(self.0);
            let steps = Self(_mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_set1_epi32(own as i32), theirs)));
            [steps * Self::of(step), Self::zero()]
        }
    }
}
