//! Several numbers in one: the lanes of a SIMD register.

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
pub mod plain;

use super::Real;

/// Numbers that move together. Every instruction set offers types of its own; which ones a run uses is decided at run time, and
/// the physics never knows.
pub trait Lanes: Real {
    /// What stands in memory: `f64` or `f32`.
    type E: Element;

    /// Numbers side by side; a multiple of four, at most [`MOST_LANES`].
    const N: usize;

    /// Reads `N` consecutive numbers.
    ///
    /// # Safety
    /// `from` points at `N` readable numbers.
    unsafe fn load(from: *const Self::E) -> Self;

    /// Reads `N` consecutive numbers of single precision.
    ///
    /// # Safety
    /// `from` points at `N` readable floats.
    unsafe fn load_single(from: *const f32) -> Self;

    /// Writes `N` consecutive numbers.
    ///
    /// # Safety
    /// `to` points at `N` writable numbers.
    unsafe fn store(self, to: *mut Self::E);

    /// Writes the lanes as double precision.
    ///
    /// # Safety
    /// `to` points at `N` writable doubles.
    unsafe fn store_double(self, to: *mut f64);

    /// Writes the lanes as single precision, rounded.
    ///
    /// # Safety
    /// `to` points at `N` writable floats.
    unsafe fn store_single(self, to: *mut f32);

    /// Reads four consecutive numbers behind each of `N` addresses and transposes: lane `l` of word `k` is what stands `k`
    /// behind `from(l)`.
    ///
    /// # Safety
    /// Each address points at four readable numbers.
    unsafe fn transposed(from: impl Fn(usize) -> *const Self::E) -> [Self; 4];

    /// The sum of the lanes, always added in the same order.
    fn total(self) -> f64;
}

/// Most lanes of any type.
pub const MOST_LANES: usize = 16;

/// A number in memory.
pub trait Element: Real + Default {
    /// From double precision, rounded.
    fn from_f64(x: f64) -> Self;
    /// To double precision.
    fn to_f64(self) -> f64;
}

impl Element for f64 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
}

impl Element for f32 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as Self
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// The four operators of a lane type, from intrinsics.
#[cfg(target_arch = "x86_64")]
macro_rules! operators {
    ($lanes:ty: $($trait:ident $name:ident $intrinsic:ident),*) => {$(
        impl $trait for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                // SAFETY: the instructions are there (see module).
                Self(unsafe { $intrinsic(self.0, o.0) })
            }
        }
    )*};
}

/// Lane by lane, for the few functions that have no instruction.
#[cfg(target_arch = "x86_64")]
macro_rules! each_lane {
    ($lanes:ty, $e:ty, $n:literal) => {
        impl $lanes {
            #[inline(always)]
            fn each(self, f: impl Fn($e) -> $e) -> Self {
                let mut a: [$e; $n] = [0.0; $n];
                // SAFETY: as many numbers on the stack as lanes; the instructions are there (see module).
                unsafe {
                    self.store(a.as_mut_ptr());
                    Self::load(a.map(f).as_ptr())
                }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
use {each_lane, operators};

#[cfg(test)]
mod tests;
