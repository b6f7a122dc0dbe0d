//! Pairs over a stencil: consecutive particles go through the lanes.

use super::{Chunk, Sums, Then, Together, Walk};
use crate::field::{Of, Record};
use crate::math::{Element, Lanes};
use crate::pass::{ALL_WEIGHTS, Now, PairSum};
use crate::run::cpu::kit::Kit;
use crate::run::cpu::places::{PairPlaces, Row, Span};
use crate::run::cpu::stencil::{Block, Stencil};

/// A sum over the neighbours of lattice-born particles and the update that follows it; a chunk counts blocks.
pub struct Stencilled<'a, P, E, const D: usize> {
    pub sum: &'a P,
    pub then: Then<'a>,
    /// Where the sum reads; nobody writes there meanwhile.
    pub own: PairPlaces<E>,
    pub stencil: &'a Stencil<D>,
    /// The home of every block, or nothing if each is its own.
    pub homes: &'a [u32],
    pub now: Now<f64>,
}

/// What a block carries through its entries.
struct Running<A, S> {
    a: A,
    sum: S,
}

type RunningOf<P, V, const D: usize> =
    Running<Of<<P as PairSum<D>>::Reads, V, D>, Of<<P as PairSum<D>>::Adds, V, D>>;

impl<P: PairSum<D>, E: Element, const D: usize> Stencilled<'_, P, E, D> {
    /// Many numbers in, few out (forces from stress): weight by weight, because then only the numbers that one weight needs are
    /// loaded. Few in, many out (gradients): the whole pair at once, leaving out its zeros.
    const WEIGHT_BY_WEIGHT: bool = P::Reads::WORDS > 2 * P::Adds::WORDS;

    #[inline(always)]
    fn part<V: Lanes<E = E>, const M: u8>(&self, block: &Block, run: &mut RunningOf<P, V, D>, now: &Now<V>) {
        for entry in self.stencil.full::<M>(block) {
            let b = P::Reads::read::<V>(&Row(&self.own, entry.of(block)));
            self.sum.add(&mut run.sum, (&run.a, &b), &self.stencil.pair::<V, M>(entry), now);
        }
    }

    /// Entries of which only some lanes count: rare, so all weights at once.
    #[inline(always)]
    fn rest<V: Lanes<E = E>>(&self, block: &Block, run: &mut RunningOf<P, V, D>, now: &Now<V>) {
        for entry in self.stencil.partial(block) {
            let b = P::Reads::read::<V>(&Row(&self.own, entry.of(block)));
            self.sum.add(&mut run.sum, (&run.a, &b), &self.stencil.masked::<V, ALL_WEIGHTS>(entry), now);
        }
    }

    #[inline(always)]
    fn gather<V: Lanes<E = E>>(&self, block: &Block, now: &Now<V>) -> Of<P::Adds, V, D> {
        let a = P::Reads::read::<V>(&Row(&self.own, block.first as isize));
        let mut run = Running { a, sum: P::Adds::nought::<V>() };
        if Self::WEIGHT_BY_WEIGHT {
            self.part::<V, 1>(block, &mut run, now);
            self.part::<V, 2>(block, &mut run, now);
            if D == 3 {
                self.part::<V, 4>(block, &mut run, now);
            }
            self.part::<V, 8>(block, &mut run, now);
        } else {
            self.part::<V, 9>(block, &mut run, now);
            self.part::<V, 10>(block, &mut run, now);
            self.part::<V, 11>(block, &mut run, now);
            if D == 3 {
                self.part::<V, 12>(block, &mut run, now);
                self.part::<V, 13>(block, &mut run, now);
                self.part::<V, 14>(block, &mut run, now);
                self.part::<V, 15>(block, &mut run, now);
            }
        }
        self.rest::<V>(block, &mut run, now);
        run.sum
    }
}

impl<P: PairSum<D>, E: Element, const D: usize> Walk<E> for Stencilled<'_, P, E, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        let now = self.now.cast::<K::Pair>();
        let mut sums = Sums::new();
        for k in chunk.first..chunk.end {
            let block = &self.stencil.blocks[k];
            self.then.fetch(block.first as usize + 2 * K::Pair::N, (0, 1));
            self.own.fetch(block.first as usize + self.stencil.reach + K::Pair::N);
            let sum = self.gather(block, &now);
            P::Adds::write(sum, &mut Together(&mut sums));
            let home = self.homes.get(k).map_or(block.first, |&home| home) as usize;
            self.then.at(Span { first: block.first as usize, home, count: block.active.into() }, &sums);
        }
    }
}
