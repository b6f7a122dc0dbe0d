//! Pairs over a list: the neighbours of one particle go through the lanes.

use super::{Chunk, Spread, Sums, Then, Walk};
use crate::field::{Record, Source};
use crate::math::{Element, Lanes};
use crate::pass::{Now, PairSum};
use crate::run::MAX_WORDS;
use crate::run::cpu::kit::Kit;
use crate::run::cpu::list::PairBlocks;

/// A sum over neighbours and the update that follows it.
pub struct Listed<'a, P, E, const D: usize> {
    pub sum: &'a P,
    pub then: Then<'a>,
    /// Packed records, `stride` numbers for each particle; the volume follows what the pass reads.
    pub records: &'a [E],
    pub stride: usize,
    pub blocks: &'a PairBlocks<D>,
    pub now: Now<f64>,
}

/// The words of the neighbours, lane by lane.
struct Words<V>([V; MAX_WORDS]);

impl<V: Lanes> Source<V> for Words<V> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        self.0[k]
    }
}

/// The record of one particle in all lanes.
struct Broadcast<'a, E>(&'a [E]);

impl<V: Lanes> Source<V> for Broadcast<'_, V::E> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        V::of(self.0[k].to_f64())
    }
}

impl<P: PairSum<D>, E: Element, const D: usize> Listed<'_, P, E, D> {
    /// The sum over the neighbours of `a`, as number `lane` of `sums`.
    #[inline(always)]
    fn gather<V: Lanes<E = E>>(&self, a: usize, lane: usize, sums: &mut Sums) {
        let row = &self.records[a * self.stride..(a + 1) * self.stride];
        let own = P::Reads::read::<V>(&Broadcast(row));
        let now = self.now.cast();
        let mut sum = P::Adds::nought::<V>();
        for block in self.blocks.of(a) {
            let ids = self.blocks.ids::<V>(block);
            let mut words = Words([V::zero(); MAX_WORDS]);
            for k in (0..P::Reads::WORDS + 1).step_by(4) {
                // SAFETY: neighbours are particles, and every row is padded to a multiple of four numbers.
                let four = unsafe {
                    V::transposed(|l| self.records.as_ptr().add(ids[l] as usize * self.stride + k))
                };
                words.0[k..k + 4].copy_from_slice(&four);
            }
            let other = P::Reads::read::<V>(&words);
            let pair = self.blocks.pair::<V>(block, words.0[P::Reads::WORDS]);
            self.sum.add(&mut sum, (&own, &other), &pair, &now);
        }
        P::Adds::write(sum, &mut Spread(sums, lane));
    }
}

impl<P: PairSum<D>, E: Element, const D: usize> Walk<E> for Listed<'_, P, E, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        let mut sums = Sums::new();
        let mut first = chunk.first;
        while first < chunk.end {
            let count = (chunk.end - first).min(K::Point::N);
            for lane in 0..count {
                self.gather::<K::Pair>(first + lane, lane, &mut sums);
            }
            self.then.at(first, count, &sums);
            first += count;
        }
    }
}
