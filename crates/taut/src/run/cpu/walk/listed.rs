//! Pairs over a list: the neighbours of one particle go through the lanes.

use super::{Chunk, Spread, Sums, Then, Walk};
use crate::field::{Record, Source};
use crate::math::{Element, Lanes, prefetch};
use crate::particles::Plain;
use crate::pass::{Now, PairSum};
use crate::run::MAX_WORDS;
use crate::run::cpu::kit::Kit;
use crate::run::cpu::list::{PairList, Weights, tail_words};
use crate::run::cpu::places::Span;

/// A sum over neighbours and the update that follows it.
pub struct Listed<'a, P, E, const D: usize> {
    pub sum: &'a P,
    pub then: Then<'a>,
    /// Packed records, [`stride`] numbers for each particle; place and volume follow what the pass reads.
    pub records: &'a [E],
    pub list: &'a PairList<E, D>,
    pub now: Now<f64>,
}

/// Numbers from one packed record of `R` to the next.
pub const fn stride<R: Record<D>, E: Element, const D: usize>() -> usize {
    (R::WORDS + tail_words::<E, D>()).next_multiple_of(4)
}

/// Particles between the one at work and the one whose record is asked for.
const AHEAD: usize = 2048;

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

impl<P: PairSum<D>, E: Element + Plain, const D: usize> Listed<'_, P, E, D> {
    /// The sum over the neighbours of `a`, number `i` of its chunk, as row `lane` of `sums`.
    #[inline(always)]
    fn gather<V: Lanes<E = E>>(
        &self,
        (a, i): (usize, usize),
        weights: &Weights<'_, E, D>,
        to: &mut Spread<V>,
    ) {
        let (stride, words) = (stride::<P::Reads, E, D>(), P::Reads::WORDS);
        let row = &self.records[a * stride..(a + 1) * stride];
        let own = P::Reads::read::<V>(&Broadcast(row));
        let coordinates = PairList::<E, D>::coordinates(&row[words..]);
        let now = self.now.cast();
        let mut sum = P::Adds::nought::<V>();
        for block in weights.blocks(i) {
            let ids = weights.ids::<V>(block);
            let mut other = Words([V::zero(); MAX_WORDS]);
            for k in (0..stride).step_by(4) {
                // SAFETY: neighbours are particles, and every row is padded to a multiple of four numbers.
                let four =
                    unsafe { V::transposed(|l| self.records.as_ptr().add(ids[l] as usize * stride + k)) };
                other.0[k..k + 4].copy_from_slice(&four);
            }
            let pair = weights.pair::<V>((block, P::DIRECTED), coordinates, &other.0[words..]);
            self.sum.add(&mut sum, (&own, &P::Reads::read::<V>(&other)), &pair, &now);
        }
        P::Adds::write(sum, to);
    }
}

impl<P: PairSum<D>, E: Element + Plain, const D: usize> Walk<E> for Listed<'_, P, E, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        let weights = self.list.weights(chunk.index);
        let (mut sums, mut rows) = (Sums::new(), Spread::<K::Listed>::new());
        let mut first = chunk.first;
        while first < chunk.end {
            let count = (chunk.end - first).min(K::Point::N);
            for lane in 0..count {
                rows.lane = lane;
                self.then.fetch(first + K::Point::N, (lane, K::Point::N));
                for line in (0..stride::<P::Reads, E, D>() * size_of::<E>()).step_by(64) {
                    let at = self
                        .records
                        .as_ptr()
                        .wrapping_add((first + lane + AHEAD) * stride::<P::Reads, E, D>());
                    prefetch(at.wrapping_byte_add(line));
                }
                self.gather((first + lane, first + lane - chunk.first), &weights, &mut rows);
            }
            rows.total(P::Adds::WORDS, (count, K::Point::N), &mut sums);
            self.then.at(Span::new(first, count), &sums);
            first += count;
        }
    }
}
