//! Packing columns into records: four particles at a time are transposed in registers, as many columns as there are lanes.

use super::{Chunk, Walk, stride};
use crate::field::Record;
use crate::math::{Element, Lanes, MOST_LANES};
use crate::run::cpu::kit::Kit;
use crate::run::cpu::places::{PairPlaces, Shared};
use std::marker::PhantomData;

/// Packs the columns of record `R`, and the place behind them, into one row for each particle.
pub struct Packing<R, E, const D: usize> {
    /// The columns, those of the place last. Up to four numbers behind the last particle are readable.
    pub own: PairPlaces<E>,
    /// The rows.
    pub records: Shared<E>,
    pub record: PhantomData<fn() -> R>,
}

impl<R: Record<D>, E: Element, const D: usize> Packing<R, E, D> {
    /// Columns `k..` of particles `a..a + count`.
    #[inline(always)]
    fn four<V: Lanes<E = E>>(&self, k: usize, (a, count): (usize, usize)) {
        let stride = stride::<R, E, D>();
        let last = self.own.len() - 1;
        // SAFETY: four numbers are readable in every column from `a` on. (The padding repeats the last column.)
        let rows = unsafe { V::transposed(|lane| self.own.from((k + lane).min(last), a)) };
        let width = V::N.min(stride - k);
        for (i, &row) in rows.iter().enumerate().take(count) {
            // SAFETY: every particle has a row of `stride` numbers, which this thread alone writes.
            unsafe {
                let to = self.records.from((a + i) * stride + k);
                if width == V::N {
                    row.store(to);
                } else {
                    let mut some = [E::default(); MOST_LANES];
                    row.store(some.as_mut_ptr());
                    to.copy_from_nonoverlapping(some.as_ptr(), width);
                }
            }
        }
    }
}

impl<R: Record<D>, E: Element, const D: usize> Walk<E> for Packing<R, E, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        for a in (chunk.first..chunk.end).step_by(4) {
            for k in (0..stride::<R, E, D>()).step_by(K::Listed::N) {
                self.four::<K::Listed>(k, (a, (chunk.end - a).min(4)));
            }
        }
    }
}
