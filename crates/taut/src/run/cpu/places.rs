//! Where the numbers of a record stand in memory, so that chunks can be read and written from several threads.

use crate::field::{Quantity, Record, Sink, Source};
use crate::math::Lanes;
use crate::particles::Particles;
use crate::run::MAX_WORDS;

/// A pointer that threads share. Sound because every thread reads and writes its own chunk only.
#[derive(Clone, Copy, Debug)]
pub struct Shared(*mut f64);

// SAFETY: see above; each use states which elements it touches.
unsafe impl Send for Shared {}
// SAFETY: as above.
unsafe impl Sync for Shared {}

impl Shared {
    /// Shares a slice.
    pub fn new(slice: &mut [f64]) -> Self {
        Self(slice.as_mut_ptr())
    }

    /// # Safety
    /// `i` is inside the slice, and no other thread touches element `i` meanwhile.
    #[inline(always)]
    pub unsafe fn set(self, i: usize, x: f64) {
        // SAFETY: the caller's promise.
        unsafe { self.0.add(i).write(x) }
    }
}

/// The columns of a record.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    columns: [Shared; MAX_WORDS],
    len: usize,
}

impl Places {
    /// Finds the columns of record `R`.
    pub fn of<R: Record<D>, const D: usize>(particles: &mut Particles<D>) -> Self {
        assert!(R::WORDS <= MAX_WORDS, "a record of {} numbers is too wide", R::WORDS);
        let mut at = [0; MAX_WORDS];
        particles.each_column::<R>(|k, column| at[k] = column);
        let mut columns = [Shared(std::ptr::null_mut()); MAX_WORDS];
        for k in 0..R::WORDS {
            columns[k] = Shared(particles.nth_ptr(at[k]));
        }
        Self { columns, len: R::WORDS }
    }

    /// The same with one more scalar at the end.
    pub fn with<const D: usize>(mut self, field: Quantity, particles: &mut Particles<D>) -> Self {
        assert!(self.len < MAX_WORDS, "a record of {} numbers is too wide", self.len + 1);
        self.columns[self.len] = Shared(particles.nth_ptr(particles.place(field)));
        self.len += 1;
        self
    }

    /// How many numbers.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Copies the record of particle `a` into a row.
    ///
    /// # Safety
    /// `a` is a particle, and nobody writes its record meanwhile.
    #[inline(always)]
    pub unsafe fn gather(&self, a: usize, row: &mut [f64]) {
        for k in 0..self.len.min(row.len()) {
            // SAFETY: the caller's promise.
            row[k] = unsafe { self.columns[k].0.add(a).read() };
        }
    }
}

impl Places {
    /// The same record elsewhere: column `k` starts at `first + k * stride` of a buffer.
    ///
    /// # Safety
    /// The buffer holds that many columns, with room for lanes before and after each.
    pub unsafe fn elsewhere(&self, first: *mut f64, stride: usize) -> Self {
        let mut moved = *self;
        for k in 0..self.len {
            // SAFETY: the caller's promise.
            moved.columns[k] = Shared(unsafe { first.add(k * stride) });
        }
        moved
    }

    /// Column `k` of `len` particles.
    ///
    /// # Safety
    /// The column is that long, and nobody writes it meanwhile.
    pub unsafe fn column(&self, k: usize, len: usize) -> &[f64] {
        // SAFETY: the caller's promise.
        unsafe { std::slice::from_raw_parts(self.columns[k].0, len) }
    }
}

/// Four consecutive particles, of which only the first few belong to this block: the others are neither read nor written.
pub struct Some4<'a>(pub &'a Places, pub usize, pub usize);

// SAFETY: as below.
impl<V: Lanes> Source<V> for Some4<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        unsafe {
            let first = self.0.columns.get_unchecked(k).0.add(self.1);
            let lane = |l: usize| first.add(if l < self.2 { l } else { 0 }).read();
            V::load([lane(0), lane(1), lane(2), lane(3)].as_ptr())
        }
    }
}
impl<V: Lanes> Sink<V> for Some4<'_> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: V) {
        let mut lanes = [0.0; 4];
        unsafe {
            x.store(lanes.as_mut_ptr());
            let first = self.0.columns.get_unchecked(k).0.add(self.1);
            for (l, &value) in lanes.iter().enumerate().take(self.2) {
                first.add(l).write(value);
            }
        }
    }
}

/// Four consecutive particles.
pub struct Four<'a>(pub &'a Places, pub usize);
/// One particle.
pub struct One<'a>(pub &'a Places, pub usize);

// SAFETY of the blocks below: whoever makes a `Four` or `One` has checked that the particles exist and belong to the
// chunk of this thread, and `k` is below the width of the record the places were made for.
impl<V: Lanes> Source<V> for Four<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        unsafe { V::load(self.0.columns.get_unchecked(k).0.add(self.1)) }
    }
}
impl<V: Lanes> Sink<V> for Four<'_> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: V) {
        unsafe { x.store(self.0.columns.get_unchecked(k).0.add(self.1)) }
    }
}
impl Source<f64> for One<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        unsafe { self.0.columns.get_unchecked(k).0.add(self.1).read() }
    }
}
impl Sink<f64> for One<'_> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: f64) {
        unsafe { self.0.columns.get_unchecked(k).0.add(self.1).write(x) }
    }
}
