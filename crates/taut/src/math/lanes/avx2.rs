//! Lanes of AVX2 with fused multiply-add. Reached only behind [`available`], through a function that carries
//! `#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2")]` and into which all of this is inlined.

use super::fine::Fine;
use super::{Lanes, each_lane, operators};
use crate::math::Real;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Whether this machine has what these lanes need.
#[must_use]
pub fn available() -> bool {
    // The last three came with AVX2 in every processor: counting and shifting bits.
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && is_x86_feature_detected!("popcnt")
        && is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
}

/// Four doubles in one AVX register.
#[derive(Clone, Copy, Debug)]
pub struct F64x4(__m256d);

/// Eight floats in one AVX register.
#[derive(Clone, Copy, Debug)]
pub struct F32x8(__m256);

impl F32x8 {
    /// The first half plus the second, in double precision: lanes of a sum are of like size, but there may be many.
    #[inline(always)]
    fn folded(self) -> F64x4 {
        // SAFETY: AVX2 is there (see module).
        unsafe {
            let low = _mm256_cvtps_pd(_mm256_castps256_ps128(self.0));
            let high = _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(self.0));
            F64x4(_mm256_add_pd(low, high))
        }
    }
}

operators!(F64x4: Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd);
operators!(F32x8: Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);
each_lane!(F64x4, f64, 4);
each_lane!(F32x8, f32, 8);

/// Arithmetic of one lane type, from its intrinsics.
macro_rules! real {
    ($lanes:ty, $mask:ty, $set:ident, $xor:ident, $andnot:ident, $fma:ident, $sqrt:ident, $min:ident, $max:ident,
     $cmp:ident, $blend:ident, $e:ty) => {
        impl Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: AVX2 is there (see module).
                Self(unsafe { $xor(self.0, $set(-0.0)) })
            }
        }

        // SAFETY of every block below: AVX2 and FMA are there (see module).
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
                Self(unsafe { $andnot($set(-0.0), self.0) })
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
                Self(unsafe { $blend(no.0, yes.0, mask) })
            }
        }
    };
}
real!(
    F64x4,
    __m256d,
    _mm256_set1_pd,
    _mm256_xor_pd,
    _mm256_andnot_pd,
    _mm256_fmadd_pd,
    _mm256_sqrt_pd,
    _mm256_min_pd,
    _mm256_max_pd,
    _mm256_cmp_pd,
    _mm256_blendv_pd,
    f64
);
real!(
    F32x8,
    __m256,
    _mm256_set1_ps,
    _mm256_xor_ps,
    _mm256_andnot_ps,
    _mm256_fmadd_ps,
    _mm256_sqrt_ps,
    _mm256_min_ps,
    _mm256_max_ps,
    _mm256_cmp_ps,
    _mm256_blendv_ps,
    f32
);

/// How four numbers of four bytes are packed: their bytes in the new order, for every set of lanes.
static PACKED: [[u8; 16]; 16] = {
    let mut table = [[0; 16]; 16];
    let mut bits = 0;
    while bits < 16 {
        let (mut lane, mut found) = (0, 0);
        while lane < 4 {
            if bits >> lane & 1 == 1 {
                let mut byte = 0;
                while byte < 4 {
                    table[bits][4 * found + byte] = (4 * lane + byte) as u8;
                    byte += 1;
                }
                found += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    table
};

/// Writes those of four floats whose bits are set, and the whole numbers behind `ids` that belong to them, one after the other.
///
/// # Safety
/// AVX2 is there; four numbers stand, or have room, behind each address.
#[inline(always)]
unsafe fn pack_four(bits: u32, (x, ids): (__m128, *const u32), (to, to_ids): (*mut f32, *mut u32)) {
    let order = PACKED[bits as usize & 15].as_ptr();
    // SAFETY: the caller's promise.
    unsafe {
        let order = _mm_loadu_si128(order.cast());
        _mm_storeu_si128(to.cast(), _mm_shuffle_epi8(_mm_castps_si128(x), order));
        _mm_storeu_si128(to_ids.cast(), _mm_shuffle_epi8(_mm_loadu_si128(ids.cast()), order));
    }
}

impl Lanes for F64x4 {
    type E = f64;
    const N: usize = 4;

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
    unsafe fn store_single(self, to: *mut f32) {
        // SAFETY: the caller vouches for four floats.
        unsafe { _mm_storeu_ps(to, _mm256_cvtpd_ps(self.0)) }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        // SAFETY: the caller vouches for four doubles.
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        // SAFETY: the caller vouches for four doubles.
        unsafe { _mm256_storeu_pd(to, self.0) }
    }
    /// Half-register loads and inserts instead of full loads: no cross-lane shuffle is needed then. (Macros, here and below, because a
    /// closure may stay out of line, and then every intrinsic in it is a call.)
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f64) -> [Self; 4] {
        // SAFETY: the caller vouches for four doubles behind each address.
        unsafe {
            macro_rules! half {
                ($lo:literal, $hi:literal, $o:literal) => {{
                    let low = _mm256_castpd128_pd256(_mm_loadu_pd(from($lo).add($o)));
                    _mm256_insertf128_pd::<1>(low, _mm_loadu_pd(from($hi).add($o)))
                }};
            }
            let (a, b, c, d) = (half!(0, 2, 0), half!(1, 3, 0), half!(0, 2, 2), half!(1, 3, 2));
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
    #[inline(always)]
    fn totals(rows: &[Self], to: &mut [f64]) {
        debug_assert!(rows.len().is_multiple_of(4) && to.len() >= rows.len());
        for (k, rows) in rows.chunks_exact(4).enumerate() {
            let (a, b, c, d) = (rows[0], rows[1], rows[2], rows[3]);
            // SAFETY: AVX2 is there (see module).
            unsafe {
                let ab = _mm256_add_pd(_mm256_unpacklo_pd(a.0, b.0), _mm256_unpackhi_pd(a.0, b.0));
                let cd = _mm256_add_pd(_mm256_unpacklo_pd(c.0, d.0), _mm256_unpackhi_pd(c.0, d.0));
                let low = _mm256_permute2f128_pd::<0x20>(ab, cd);
                let high = _mm256_permute2f128_pd::<0x31>(ab, cd);
                _mm256_storeu_pd(to[4 * k..4 * k + 4].as_mut_ptr(), _mm256_add_pd(low, high));
            }
        }
    }
    #[inline(always)]
    unsafe fn compress(self, bits: u32, ids: *const u32, to: (*mut f32, *mut u32)) {
        // SAFETY: the caller vouches for four numbers behind each address.
        unsafe { pack_four(bits, (_mm256_cvtpd_ps(self.0), ids), to) }
    }
    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        // SAFETY: AVX2 is there (see module).
        unsafe { _mm256_movemask_pd(mask) as u32 }
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        let fine = Fine::of(step);
        // SAFETY: AVX2 is there (see module).
        unsafe {
            let own = _mm256_set1_epi64x((own ^ Fine::MIDDLE) as i64);
            let apart = _mm256_sub_epi32(own, _mm256_castpd_si256(self.0));
            let exponent = _mm256_set1_epi64x(fine.exponent as i64);
            let number = |bits| {
                let shifted = _mm256_castsi256_pd(_mm256_blend_epi32::<0b1010_1010>(bits, exponent));
                Self(_mm256_sub_pd(shifted, _mm256_set1_pd(fine.shift)))
            };
            [number(apart), number(_mm256_srli_epi64::<32>(apart))]
        }
    }
}

impl Lanes for F32x8 {
    type E = f32;
    const N: usize = 8;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller vouches for eight floats.
        Self(unsafe { _mm256_loadu_ps(from) })
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        // SAFETY: the caller vouches for eight floats.
        unsafe { Self::load(from) }
    }
    #[inline(always)]
    unsafe fn store_single(self, to: *mut f32) {
        // SAFETY: the caller vouches for eight floats.
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        // SAFETY: the caller vouches for eight doubles.
        unsafe {
            _mm256_storeu_pd(to, _mm256_cvtps_pd(_mm256_castps256_ps128(self.0)));
            _mm256_storeu_pd(to.add(4), _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(self.0)));
        }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller vouches for eight floats.
        unsafe { _mm256_storeu_ps(to, self.0) }
    }
    /// Records l and l + 4 share a register, so that the transposition stays inside halves.
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f32) -> [Self; 4] {
        // SAFETY: the caller vouches for four floats behind each address.
        unsafe {
            macro_rules! both {
                ($l:literal) => {{
                    let low = _mm256_castps128_ps256(_mm_loadu_ps(from($l)));
                    _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(from($l + 4)))
                }};
            }
            let (a, b, c, d) = (both!(0), both!(1), both!(2), both!(3));
            let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
            let (ab2, cd2) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
            [
                Self(_mm256_shuffle_ps::<0x44>(ab, cd)),
                Self(_mm256_shuffle_ps::<0xEE>(ab, cd)),
                Self(_mm256_shuffle_ps::<0x44>(ab2, cd2)),
                Self(_mm256_shuffle_ps::<0xEE>(ab2, cd2)),
            ]
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        self.folded().total()
    }
    #[inline(always)]
    fn totals(rows: &[Self], to: &mut [f64]) {
        for (rows, to) in rows.chunks_exact(4).zip(to.chunks_exact_mut(4)) {
            F64x4::totals(&[rows[0].folded(), rows[1].folded(), rows[2].folded(), rows[3].folded()], to);
        }
    }
    #[inline(always)]
    unsafe fn compress(self, bits: u32, ids: *const u32, (to, to_ids): (*mut f32, *mut u32)) {
        // SAFETY: the caller vouches for eight numbers behind each address; no more than four are packed from the first half.
        unsafe {
            let found = (bits & 15).count_ones() as usize;
            pack_four(bits & 15, (_mm256_castps256_ps128(self.0), ids), (to, to_ids));
            let high = _mm256_extractf128_ps::<1>(self.0);
            pack_four(bits >> 4, (high, ids.add(4)), (to.add(found), to_ids.add(found)));
        }
    }
    #[inline(always)]
    fn bits(mask: __m256) -> u32 {
        // SAFETY: AVX2 is there (see module).
        unsafe { _mm256_movemask_ps(mask) as u32 }
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        // SAFETY: AVX2 is there (see module).
        unsafe {
            let theirs = _mm256_castps_si256(self.0);
            let steps = Self(_mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_set1_epi32(own as i32), theirs)));
            [steps * Self::of(step), Self::zero()]
        }
    }
}
