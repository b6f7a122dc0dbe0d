//! Several numbers in one: the lanes of a SIMD register.

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
#[cfg(target_arch = "x86_64")]
mod fine;
#[cfg(target_arch = "aarch64")]
pub mod neon;
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

    /// The sum of the lanes of each of the rows, four or a multiple, written to `to`; lanes are added in an order of this type's own, always
    /// the same.
    #[inline(always)]
    fn totals(rows: &[Self], to: &mut [f64]) {
        for (sum, row) in to.iter_mut().zip(rows) {
            *sum = row.total();
        }
    }

    /// A mask as bits, the first lane lowest.
    fn bits(mask: Self::Mask) -> u32;

    /// Writes the lanes whose bits are set to `to`, one after the other, in single precision, and the whole numbers that stand at their
    /// places from `ids` on to `to_ids`. What follows them, up to `N` numbers in all, is overwritten too. Without branches: which
    /// lanes count cannot be foreseen.
    ///
    /// # Safety
    /// `ids` points at `N` readable, `to` and `to_ids` at `N` writable numbers.
    #[inline(always)]
    unsafe fn compress(self, bits: u32, ids: *const u32, (to, to_ids): (*mut f32, *mut u32)) {
        let mut all = [0.0; MOST_LANES];
        // SAFETY: room for any lanes; the rest is the caller's promise.
        unsafe {
            self.store_single(all.as_mut_ptr());
            let mut found = 0;
            for (lane, &x) in all.iter().enumerate().take(Self::N) {
                to.add(found).write(x);
                to_ids.add(found).write(ids.add(lane).read());
                found += (bits >> lane & 1) as usize;
            }
        }
    }

    /// The lanes hold places on a fine grid, packed by [`Element::packed`]: how far `own`, the bits of one such number, is from each, in as
    /// many coordinates as a number holds (others are zero), in units of which a step of the grid is `step`, a power of two: in double
    /// precision nothing is rounded. Coordinates count modulo 2^32, so only the distance has to be small.
    fn offsets(self, own: u64, step: f64) -> [Self; 2];
}

/// Most lanes of any type.
pub const MOST_LANES: usize = 16;

/// A number in memory.
pub trait Element: Real + Default {
    /// From double precision, rounded.
    fn from_f64(x: f64) -> Self;
    /// To double precision.
    fn to_f64(self) -> f64;

    /// Whole-number coordinates that fit into one number as bits.
    const COORDINATES: usize;
    /// That many coordinates as the bits of a number, which is then only moved, never reckoned with.
    fn packed(coordinates: &[u32]) -> Self;
    /// Coordinate number `which` of those.
    fn coordinate(self, which: usize) -> u32;
    /// Writes lanes of double precision, rounded to this one.
    ///
    /// # Safety
    /// `to` points at as many writable numbers as `U` has lanes.
    unsafe fn put<U: Lanes<E = f64>>(lanes: U, to: *mut Self);
}

/// Asks for the memory at `at` ahead of time; harmless wherever it points.
#[inline(always)]
pub fn prefetch<T>(at: *const T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: a prefetch neither faults nor changes anything.
    unsafe {
        std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(at.cast());
    }
    #[cfg(target_arch = "aarch64")]
    // SAFETY: as above.
    unsafe {
        std::arch::asm!("prfm pldl1keep, [{}]", in(reg) at, options(nostack, preserves_flags, readonly));
    }
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let _ = at;
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
    const COORDINATES: usize = 2;
    #[inline(always)]
    fn packed(coordinates: &[u32]) -> Self {
        let half = |i: usize| u64::from(coordinates.get(i).copied().unwrap_or(0));
        Self::from_bits(half(0) | half(1) << 32)
    }
    #[inline(always)]
    fn coordinate(self, which: usize) -> u32 {
        (self.to_bits() >> (32 * which)) as u32
    }
    #[inline(always)]
    unsafe fn put<U: Lanes<E = f64>>(lanes: U, to: *mut Self) {
        // SAFETY: the caller's promise.
        unsafe { lanes.store(to) }
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
    const COORDINATES: usize = 1;
    #[inline(always)]
    fn packed(coordinates: &[u32]) -> Self {
        Self::from_bits(coordinates[0])
    }
    #[inline(always)]
    fn coordinate(self, _: usize) -> u32 {
        self.to_bits()
    }
    #[inline(always)]
    unsafe fn put<U: Lanes<E = f64>>(lanes: U, to: *mut Self) {
        // SAFETY: the caller's promise.
        unsafe { lanes.store_single(to) }
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
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
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

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use each_lane;
#[cfg(target_arch = "x86_64")]
use operators;

#[cfg(test)]
mod tests;
