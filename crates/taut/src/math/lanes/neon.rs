//! Lanes of NEON, which every 64-bit ARM processor has: two registers side by side, so that there are four doubles or eight floats.

use super::{Lanes, each_lane};
use crate::math::Real;
use std::arch::aarch64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Four doubles in two registers.
#[derive(Clone, Copy, Debug)]
pub struct F64x4([float64x2_t; 2]);

/// Eight floats in two registers.
#[derive(Clone, Copy, Debug)]
pub struct F32x8([float32x4_t; 2]);

/// Arithmetic of one lane type, from its intrinsics, register by register.
macro_rules! real {
    ($lanes:ident, $e:ty, $n:literal, $mask:ty, $set:ident, $neg:ident, $abs:ident, $sqrt:ident, $fma:ident, $lt:ident,
     $select:ident; $($trait:ident $name:ident $intrinsic:ident),*) => {
        $(impl $trait for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                // SAFETY: NEON is part of the base instruction set, here and below.
                unsafe { Self([$intrinsic(self.0[0], o.0[0]), $intrinsic(self.0[1], o.0[1])]) }
            }
        })*

        impl Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: as above.
                unsafe { Self([$neg(self.0[0]), $neg(self.0[1])]) }
            }
        }

        each_lane!($lanes, $e, $n);

        // SAFETY of every block below: as above.
        impl Real for $lanes {
            type Mask = [$mask; 2];
            #[inline(always)]
            fn of(x: f64) -> Self {
                Self([unsafe { $set(x as $e) }; 2])
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                unsafe { Self([$fma(b.0[0], self.0[0], a.0[0]), $fma(b.0[1], self.0[1], a.0[1])]) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self([$sqrt(self.0[0]), $sqrt(self.0[1])]) }
            }
            #[inline(always)]
            fn abs(self) -> Self {
                unsafe { Self([$abs(self.0[0]), $abs(self.0[1])]) }
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.each(<$e>::exp)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.each(<$e>::ln)
            }
            // As on other machines: the second where one of them is no number. NEON's own minimum would be that.
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self::select(self.lt(other), self, other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self::select(other.lt(self), self, other)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> [$mask; 2] {
                unsafe { [$lt(self.0[0], other.0[0]), $lt(self.0[1], other.0[1])] }
            }
            #[inline(always)]
            fn select(mask: [$mask; 2], yes: Self, no: Self) -> Self {
                unsafe { Self([$select(mask[0], yes.0[0], no.0[0]), $select(mask[1], yes.0[1], no.0[1])]) }
            }
        }
    };
}
real!(F64x4, f64, 4, uint64x2_t, vdupq_n_f64, vnegq_f64, vabsq_f64, vsqrtq_f64, vfmaq_f64, vcltq_f64, vbslq_f64;
    Add add vaddq_f64, Sub sub vsubq_f64, Mul mul vmulq_f64, Div div vdivq_f64);
real!(F32x8, f32, 8, uint32x4_t, vdupq_n_f32, vnegq_f32, vabsq_f32, vsqrtq_f32, vfmaq_f32, vcltq_f32, vbslq_f32;
    Add add vaddq_f32, Sub sub vsubq_f32, Mul mul vmulq_f32, Div div vdivq_f32);

// SAFETY of every block below: NEON is there, and the caller vouches for the numbers behind the pointers.
impl Lanes for F64x4 {
    type E = f64;
    const N: usize = 4;

    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        unsafe { Self([vld1q_f64(from), vld1q_f64(from.add(2))]) }
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        unsafe {
            let four = vld1q_f32(from);
            Self([vcvt_f64_f32(vget_low_f32(four)), vcvt_high_f64_f32(four)])
        }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        unsafe {
            vst1q_f64(to, self.0[0]);
            vst1q_f64(to.add(2), self.0[1]);
        }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store_single(self, to: *mut f32) {
        unsafe { vst1q_f32(to, vcvt_high_f32_f64(vcvt_f32_f64(self.0[0]), self.0[1])) }
    }
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f64) -> [Self; 4] {
        unsafe {
            let (a, b) = (Self::load(from(0)).0, Self::load(from(1)).0);
            let (c, d) = (Self::load(from(2)).0, Self::load(from(3)).0);
            [
                Self([vzip1q_f64(a[0], b[0]), vzip1q_f64(c[0], d[0])]),
                Self([vzip2q_f64(a[0], b[0]), vzip2q_f64(c[0], d[0])]),
                Self([vzip1q_f64(a[1], b[1]), vzip1q_f64(c[1], d[1])]),
                Self([vzip2q_f64(a[1], b[1]), vzip2q_f64(c[1], d[1])]),
            ]
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        unsafe { vaddvq_f64(vaddq_f64(self.0[0], self.0[1])) }
    }
    #[inline(always)]
    fn bits(mask: [uint64x2_t; 2]) -> u32 {
        unsafe {
            let lane = |x: u64, l: u32| (x & 1) as u32 * (1 << l);
            lane(vgetq_lane_u64::<0>(mask[0]), 0)
                | lane(vgetq_lane_u64::<1>(mask[0]), 1)
                | lane(vgetq_lane_u64::<0>(mask[1]), 2)
                | lane(vgetq_lane_u64::<1>(mask[1]), 3)
        }
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        unsafe {
            let (a, b) = (vreinterpretq_u64_f64(self.0[0]), vreinterpretq_u64_f64(self.0[1]));
            let wide = |own: u32, theirs| {
                let steps = vreinterpret_s32_u32(vsub_u32(vdup_n_u32(own), theirs));
                vmulq_n_f64(vcvtq_f64_s64(vmovl_s32(steps)), step)
            };
            let (low, high) = (own as u32, (own >> 32) as u32);
            [
                Self([wide(low, vmovn_u64(a)), wide(low, vmovn_u64(b))]),
                Self([wide(high, vshrn_n_u64::<32>(a)), wide(high, vshrn_n_u64::<32>(b))]),
            ]
        }
    }
}

impl F32x8 {
    /// The first half plus the second, in double precision: lanes of a sum are of like size, but there may be many.
    #[inline(always)]
    fn folded(self) -> F64x4 {
        unsafe {
            let low = F64x4([vcvt_f64_f32(vget_low_f32(self.0[0])), vcvt_high_f64_f32(self.0[0])]);
            low + F64x4([vcvt_f64_f32(vget_low_f32(self.0[1])), vcvt_high_f64_f32(self.0[1])])
        }
    }
}

impl Lanes for F32x8 {
    type E = f32;
    const N: usize = 8;

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        unsafe { Self([vld1q_f32(from), vld1q_f32(from.add(4))]) }
    }
    #[inline(always)]
    unsafe fn load_single(from: *const f32) -> Self {
        unsafe { Self::load(from) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe {
            vst1q_f32(to, self.0[0]);
            vst1q_f32(to.add(4), self.0[1]);
        }
    }
    #[inline(always)]
    unsafe fn store_single(self, to: *mut f32) {
        unsafe { self.store(to) }
    }
    #[inline(always)]
    unsafe fn store_double(self, to: *mut f64) {
        unsafe {
            for (k, four) in self.0.into_iter().enumerate() {
                vst1q_f64(to.add(4 * k), vcvt_f64_f32(vget_low_f32(four)));
                vst1q_f64(to.add(4 * k + 2), vcvt_high_f64_f32(four));
            }
        }
    }
    #[inline(always)]
    unsafe fn transposed(from: impl Fn(usize) -> *const f32) -> [Self; 4] {
        unsafe {
            let mut words = [Self::zero(); 4];
            for half in 0..2 {
                let (a, b) = (vld1q_f32(from(4 * half)), vld1q_f32(from(4 * half + 1)));
                let (c, d) = (vld1q_f32(from(4 * half + 2)), vld1q_f32(from(4 * half + 3)));
                let pair = |x| vreinterpretq_f64_f32(x);
                let (ab, ab2) = (pair(vtrn1q_f32(a, b)), pair(vtrn2q_f32(a, b)));
                let (cd, cd2) = (pair(vtrn1q_f32(c, d)), pair(vtrn2q_f32(c, d)));
                words[0].0[half] = vreinterpretq_f32_f64(vzip1q_f64(ab, cd));
                words[1].0[half] = vreinterpretq_f32_f64(vzip1q_f64(ab2, cd2));
                words[2].0[half] = vreinterpretq_f32_f64(vzip2q_f64(ab, cd));
                words[3].0[half] = vreinterpretq_f32_f64(vzip2q_f64(ab2, cd2));
            }
            words
        }
    }
    #[inline(always)]
    fn total(self) -> f64 {
        self.folded().total()
    }
    #[inline(always)]
    fn bits(mask: [uint32x4_t; 2]) -> u32 {
        let mut lanes = [0_u32; 8];
        unsafe {
            vst1q_u32(lanes.as_mut_ptr(), mask[0]);
            vst1q_u32(lanes.as_mut_ptr().add(4), mask[1]);
        }
        lanes.iter().enumerate().fold(0, |bits, (l, lane)| bits | (lane & 1) << l)
    }
    #[inline(always)]
    fn offsets(self, own: u64, step: f64) -> [Self; 2] {
        unsafe {
            let own = vdupq_n_u32(own as u32);
            let steps =
                |theirs| vcvtq_f32_s32(vreinterpretq_s32_u32(vsubq_u32(own, vreinterpretq_u32_f32(theirs))));
            [Self([steps(self.0[0]), steps(self.0[1])]) * Self::of(step), Self::zero()]
        }
    }
}
