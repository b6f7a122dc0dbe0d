//! The loops over a chunk of particles, generic in the lanes, and their entry points for each instruction set.

mod listed;
mod listing;
mod packing;
mod points;
mod stencilled;

pub use listed::{Listed, stride};
pub use listing::{Listing, MOST_PAIRS};
pub use packing::Packing;
pub use points::{Each, Fold};
pub use stencilled::Stencilled;

use super::kit::{InstructionSet, Kit, Precision};
use super::places::{Fetching, Places, Some, Span};
use crate::field::{Record, Sink, Source};
use crate::math::{Lanes, MOST_LANES};
use crate::pass::{Now, Update};
use crate::run::MAX_WORDS;
use std::mem::MaybeUninit;

/// A run of consecutive particles (or blocks of them) that one thread works on.
pub struct Chunk {
    /// Which one.
    pub index: usize,
    /// First.
    pub first: usize,
    /// One past the last.
    pub end: usize,
}

/// A loop over a chunk.
pub trait Walk<E> {
    /// Walks the chunk with the lanes of `K`.
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk);
}

/// The loop with lanes of the base instruction set: plain ones everywhere, NEON on arm64.
pub fn base<E, K: Kit<Pair: Lanes<E = E>>>(walk: &impl Walk<E>, chunk: &Chunk) {
    walk.chunk::<K>(chunk);
}

/// The loop with AVX2 lanes: everything below is inlined here and compiled for AVX2.
///
/// # Safety
/// The machine has what AVX2 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2")]
pub unsafe fn avx2<E, K: Kit<Pair: Lanes<E = E>>>(walk: &impl Walk<E>, chunk: &Chunk) {
    walk.chunk::<K>(chunk);
}

/// The loop with AVX-512 lanes.
///
/// # Safety
/// The machine has what AVX-512 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma,popcnt,bmi1,bmi2")]
pub unsafe fn avx512<E, K: Kit<Pair: Lanes<E = E>>>(walk: &impl Walk<E>, chunk: &Chunk) {
    walk.chunk::<K>(chunk);
}

/// Sums of some consecutive particles: number `k` of particle `l` at `words[k][l]`. Rows are read only after they were written.
pub struct Sums {
    words: [[MaybeUninit<f64>; MOST_LANES]; MAX_WORDS],
}

impl Sums {
    /// No sums yet.
    #[inline(always)]
    pub const fn new() -> Self {
        Self { words: [[MaybeUninit::uninit(); MOST_LANES]; MAX_WORDS] }
    }

    #[inline(always)]
    fn row(&mut self, k: usize) -> *mut f64 {
        self.words[k].as_mut_ptr().cast()
    }
}

/// Sums whose lanes are the particles.
pub struct Together<'a>(pub &'a mut Sums);
/// Sums of which each particle's is still spread over the lanes: number `k` of particle `l` is the total of `rows[k][l]`.
pub struct Spread<V> {
    rows: [[MaybeUninit<V>; MOST_POINTS]; MAX_WORDS],
    /// The particle that is written.
    pub lane: usize,
}

/// Most lanes of an update.
const MOST_POINTS: usize = 8;

impl<V: Lanes> Spread<V> {
    /// No sums yet.
    #[inline(always)]
    pub const fn new() -> Self {
        Self { rows: [[MaybeUninit::uninit(); MOST_POINTS]; MAX_WORDS], lane: 0 }
    }

    /// Adds up the lanes of the first `words` numbers of `count` particles, as `room` of them: those that are not there are zero.
    #[inline(always)]
    pub fn total(&mut self, words: usize, (count, room): (usize, usize), to: &mut Sums) {
        for (k, row) in self.rows.iter_mut().enumerate().take(words) {
            for lane in &mut row[count..room] {
                lane.write(V::zero());
            }
            // SAFETY: the first `count` were written by `put`, the others just now; a row of sums is longer than `room`.
            unsafe {
                let row = std::slice::from_raw_parts(row.as_ptr().cast::<V>(), room);
                V::totals(row, std::slice::from_raw_parts_mut(to.row(k), room));
            }
        }
    }
}
/// Sums of particles from `.1` on.
pub struct From<'a>(pub &'a Sums, pub usize);

impl<V: Lanes> Sink<V> for Together<'_> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: V) {
        // SAFETY: a row holds as many numbers as any type has lanes.
        unsafe { x.store_double(self.0.row(k)) }
    }
}

impl<V: Lanes> Sink<V> for Spread<V> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: V) {
        self.rows[k][self.lane].write(x);
    }
}

impl<U: Lanes<E = f64>> Source<U> for From<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> U {
        // SAFETY: the sums were written, for all lanes of an update, of which there are at most as many as of pair sums.
        unsafe { U::load(self.0.words[k].as_ptr().cast::<f64>().add(self.1)) }
    }
}

/// An update, and where it reads and writes.
pub struct Updating<'a, U> {
    pub then: &'a U,
    pub reads: &'a Places,
    pub writes: &'a Places,
    pub now: Now<f64>,
}

impl<U> Updating<'_, U> {
    /// Updates particles whose sums are in `sums`, in the lanes of `K`.
    #[inline(always)]
    pub fn at<K: Kit, const D: usize>(&self, span: Span, sums: &Sums)
    where
        U: Update<D>,
    {
        let now = self.now.cast::<K::Point>();
        let mut done = 0;
        while done < span.count {
            let some = (span.count - done).min(K::Point::N);
            let part = Span { first: span.first + done, home: span.home + done, count: some };
            let sum = U::Sum::read::<K::Point>(&From(sums, done));
            macro_rules! update {
                ($mixed:literal) => {{
                    let place = |places| Some::<$mixed> { places, span: part };
                    let own = U::Reads::read::<K::Point>(&place(self.reads));
                    U::Writes::write(self.then.at(&sum, &own, &now), &mut place(self.writes));
                }};
            }
            if K::MIXED {
                update!(true)
            } else {
                update!(false)
            }
            done += some;
        }
    }
}

/// What follows a sum, behind a pointer: pair loops are compiled once for each sum, not once for each sum and update. The call is
/// one for a block of particles.
#[derive(Clone, Copy)]
pub struct Then<'a> {
    fetching: &'a Fetching,
    updating: *const (),
    call: unsafe fn(*const (), Span, &Sums),
}

// SAFETY: what is behind the pointer is an `Updating`, which may be shared.
unsafe impl Send for Then<'_> {}
// SAFETY: as above.
unsafe impl Sync for Then<'_> {}

impl<'a> Then<'a> {
    /// The update in the lanes of an instruction set.
    pub fn new<P: Precision, U: Update<D>, const D: usize>(
        updating: &'a Updating<'a, U>,
        fetching: &'a Fetching,
        set: InstructionSet,
    ) -> Self {
        let call = match set {
            InstructionSet::Plain => call_base::<P::Plain, U, D> as unsafe fn(*const (), Span, &Sums),
            #[cfg(target_arch = "aarch64")]
            InstructionSet::Neon => call_base::<P::Neon, U, D>,
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => call_avx2::<P::Avx2, U, D>,
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => call_avx512::<P::Avx512, U, D>,
        };
        Self { fetching, updating: std::ptr::from_ref(updating).cast(), call }
    }

    /// Asks for what an update of particle `a` reads and writes, a part of it at a time: these are dozens of columns, too many for the
    /// hardware to see them coming.
    #[inline(always)]
    pub fn fetch(&self, a: usize, part: (usize, usize)) {
        self.fetching.fetch(a, part);
    }

    /// Updates particles whose sums are in `sums`.
    #[inline(always)]
    pub fn at(&self, span: Span, sums: &Sums) {
        // SAFETY: `updating` lives as long as this, and `call` was made for its type and for instructions that are there.
        unsafe { (self.call)(self.updating, span, sums) }
    }
}

/// # Safety
/// `updating` points at an `Updating<U>`.
unsafe fn call_base<K: Kit, U: Update<D>, const D: usize>(updating: *const (), span: Span, sums: &Sums) {
    // SAFETY: the caller's promise.
    unsafe { (*updating.cast::<Updating<'_, U>>()).at::<K, D>(span, sums) }
}

/// # Safety
/// As [`call_base`], and the machine has what AVX2 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2")]
unsafe fn call_avx2<K: Kit, U: Update<D>, const D: usize>(updating: *const (), span: Span, sums: &Sums) {
    // SAFETY: the caller's promise.
    unsafe { (*updating.cast::<Updating<'_, U>>()).at::<K, D>(span, sums) }
}

/// # Safety
/// As [`call_base`], and the machine has what AVX-512 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma,popcnt,bmi1,bmi2")]
unsafe fn call_avx512<K: Kit, U: Update<D>, const D: usize>(updating: *const (), span: Span, sums: &Sums) {
    // SAFETY: the caller's promise.
    unsafe { (*updating.cast::<Updating<'_, U>>()).at::<K, D>(span, sums) }
}
