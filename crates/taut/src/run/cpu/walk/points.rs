//! Loops without neighbours.

use super::{Chunk, Sums, Updating, Walk};
use crate::field::Record;
use crate::math::{Lanes, Real};
use crate::pass::{Now, Reduce, Update};
use crate::run::cpu::kit::Kit;
use crate::run::cpu::places::{Places, Shared, Some, Span};

/// An update without a sum.
pub struct Each<'a, U, const D: usize> {
    pub update: &'a U,
    pub reads: Places,
    pub writes: Places,
    pub now: Now<f64>,
}

impl<E, U: Update<D, Sum = ()>, const D: usize> Walk<E> for Each<'_, U, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        let updating =
            Updating { then: self.update, reads: &self.reads, writes: &self.writes, now: self.now };
        updating.at::<K, D>(Span::new(chunk.first, chunk.end - chunk.first), &Sums::new());
    }
}

/// A reduction; chunk `c` leaves its numbers at `partial[c * FOLDS..]`.
pub struct Fold<'a, R, const D: usize, const FOLDS: usize> {
    pub reduce: &'a R,
    pub reads: Places,
    pub partial: Shared<f64>,
}

impl<E, R: Reduce<D, N>, const D: usize, const N: usize> Walk<E> for Fold<'_, R, D, N> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        let mut lanes = R::FOLDS.map(|f| K::Point::of(f.start()));
        let mut first = chunk.first;
        while first < chunk.end {
            // Lanes beyond the last particle repeat the first of the group; they are left out.
            let count = (chunk.end - first).min(K::Point::N);
            let values = if K::MIXED {
                self.reduce.at(&R::Reads::read::<K::Point>(&Some::<true> {
                    places: &self.reads,
                    span: Span::new(first, count),
                }))
            } else {
                self.reduce.at(&R::Reads::read::<K::Point>(&Some::<false> {
                    places: &self.reads,
                    span: Span::new(first, count),
                }))
            };
            for k in 0..N {
                let value =
                    if count < K::Point::N { only(count, values[k], R::FOLDS[k].start()) } else { values[k] };
                lanes[k] = R::FOLDS[k].join(lanes[k], value);
            }
            first += count;
        }
        for k in 0..N {
            let mut all = [0.0; crate::math::MOST_LANES];
            // SAFETY: room for any lanes.
            unsafe { lanes[k].store(all.as_mut_ptr()) };
            let start = R::FOLDS[k].start();
            let out = all.into_iter().take(K::Point::N).fold(start, |a, b| R::FOLDS[k].join(a, b));
            // SAFETY: there are N numbers for each chunk, and this chunk is this thread's.
            unsafe { self.partial.set(chunk.index * N + k, out) };
        }
    }
}

/// The first `count` lanes of `x`, and `rest` in the others.
#[inline(always)]
fn only<U: Lanes<E = f64>>(count: usize, x: U, rest: f64) -> U {
    let mut all = [0.0; crate::math::MOST_LANES];
    // SAFETY: room for any lanes.
    unsafe {
        x.store(all.as_mut_ptr());
        all[count..].fill(rest);
        U::load(all.as_ptr())
    }
}
