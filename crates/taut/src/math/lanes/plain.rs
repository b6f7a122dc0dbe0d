//! Lanes without intrinsics: numbers in an array, left to the compiler. Runs on every machine.

use super::{Element, Lanes};
use crate::math::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `N` numbers in an array.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Plain<E, const N: usize>([E; N]);

/// Four doubles.
pub type Plain4 = Plain<f64, 4>;
/// Eight floats.
pub type PlainSingle8 = Plain<f32, 8>;

impl<E: Copy, const N: usize> Plain<E, N> {
    #[inline(always)]
    fn map(mut self, f: impl Fn(E) -> E) -> Self {
        for l in 0..N {
            self.0[l] = f(self.0[l]);
        }
        self
    }

    #[inline(always)]
    fn zip(mut self, o: Self, f: impl Fn(E, E) -> E) -> Self {
        for l in 0..N {
            self.0[l] = f(self.0[l], o.0[l]);
        }
        self
    }
}

macro_rules! operator {
    ($($trait:ident $name:ident $op:tt),*) => {$(
        impl<E: Real, const N: usize> $trait for Plain<E, N> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                self.zip(o, |a, b| a $op b)
            }
        }
    )*};
}
operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<E: Real, const N: usize> Neg for Plain<E, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl<E: Real<Mask = bool>, const N: usize> Real for Plain<E, N> {
    type Mask = [bool; N];
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self([E::of(x); N])
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(E::sqrt)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(E::abs)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.map(E::exp)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.map(E::ln)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, E::min)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, E::max)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> [bool; N] {
        let mut mask = [false; N];
        for l in 0..N {
            mask[l] = self.0[l].lt(other.0[l]);
        }
        mask
    }
    #[inline(always)]
    fn select(mask: [bool; N], mut yes: Self, no: Self) -> Self {
        for l in 0..N {
            yes.0[l] = E::select(mask[l], yes.0[l], no.0[l]);
        }
        yes
    }
}

macro_rules! lanes {
    ($e:ty, $n:literal) => {
        impl Lanes for Plain<$e, $n> {
            type E = $e;
            const N: usize = $n;

            #[inline(always)]
            unsafe fn load(from: *const $e) -> Self {
                // SAFETY: the caller vouches for the numbers.
                Self(unsafe { from.cast::<[$e; $n]>().read_unaligned() })
            }
            #[inline(always)]
            unsafe fn load_single(from: *const f32) -> Self {
                // SAFETY: the caller vouches for the floats.
                Self(unsafe { from.cast::<[f32; $n]>().read_unaligned() }.map(<$e>::from))
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut $e) {
                // SAFETY: the caller vouches for the numbers.
                unsafe { to.cast::<[$e; $n]>().write_unaligned(self.0) }
            }
            #[inline(always)]
            unsafe fn store_double(self, to: *mut f64) {
                // SAFETY: the caller vouches for the doubles.
                unsafe { to.cast::<[f64; $n]>().write_unaligned(self.0.map(f64::from)) }
            }
            #[inline(always)]
            unsafe fn store_single(self, to: *mut f32) {
                // SAFETY: the caller vouches for the floats.
                unsafe { to.cast::<[f32; $n]>().write_unaligned(self.0.map(|x| x as f32)) }
            }
            #[inline(always)]
            unsafe fn transposed(from: impl Fn(usize) -> *const $e) -> [Self; 4] {
                let mut words = [Self([0.0; $n]); 4];
                for l in 0..$n {
                    // SAFETY: the caller vouches for four numbers behind each address.
                    let record = unsafe { from(l).cast::<[$e; 4]>().read_unaligned() };
                    for k in 0..4 {
                        words[k].0[l] = record[k];
                    }
                }
                words
            }
            #[inline(always)]
            fn total(self) -> f64 {
                // Halves first, as the registers do.
                let half = |l: usize| f64::from(self.0[l]) + f64::from(self.0[l + $n / 2]);
                (0..$n / 2).map(half).sum()
            }
            #[inline(always)]
            fn bits(mask: [bool; $n]) -> u32 {
                (0..$n).fold(0, |bits, l| bits | u32::from(mask[l]) << l)
            }
            #[inline(always)]
            fn offsets(self, own: u64, step: f64) -> [Self; 2] {
                std::array::from_fn(|which| {
                    if which >= <$e>::COORDINATES {
                        return Self([0.0; $n]);
                    }
                    let own = (own >> (32 * which)) as u32;
                    self.map(|x| own.wrapping_sub(x.coordinate(which)) as i32 as $e * step as $e)
                })
            }
        }
    };
}
lanes!(f64, 4);
lanes!(f32, 8);
