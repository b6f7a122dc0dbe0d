//! The loops over a chunk of particles, generic in the lanes, and their entry points for each instruction set.

use super::list::PairBlocks;
use super::places::{Four, One, Places, Shared, Some4};
use super::stencil::{Block, Stencil};
use crate::field::{Of, Record, Sink, Source};
use crate::math::{Lanes, Plain4};
use crate::pass::{Now, PairSum, Reduce, Update};
use crate::run::MAX_WORDS;

/// A run of consecutive particles that one thread works on.
pub struct Chunk {
    /// Which one.
    pub index: usize,
    /// First particle.
    pub first: usize,
    /// One past the last particle.
    pub end: usize,
}

impl Chunk {
    /// Groups of four particles, and where the rest begins.
    #[inline(always)]
    fn fours(&self) -> (std::iter::StepBy<std::ops::Range<usize>>, usize) {
        let rest = self.first + (self.end - self.first) / 4 * 4;
        ((self.first..rest).step_by(4), rest)
    }
}

/// A loop over a chunk.
pub trait Walk {
    /// Walks the chunk with lanes `V`.
    fn chunk<V: Lanes>(&self, chunk: &Chunk);
}

/// The loop with plain lanes.
pub fn plain(walk: &impl Walk, chunk: &Chunk) {
    walk.chunk::<Plain4>(chunk);
}

/// The loop with AVX2 lanes: everything below is inlined here and compiled for AVX2.
///
/// # Safety
/// The machine has AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
pub unsafe fn avx2(walk: &impl Walk, chunk: &Chunk) {
    walk.chunk::<crate::math::F64x4>(chunk);
}

/// A sum over neighbours and the update that follows it.
pub struct Pairs<'a, P, U, const D: usize> {
    pub sum: &'a P,
    pub then: &'a U,
    pub reads: Places,
    pub writes: Places,
    pub records: &'a [f64],
    pub stride: usize,
    pub blocks: &'a PairBlocks<D>,
    pub now: Now<f64>,
}

/// The words of four neighbours, lane by lane.
struct Words<V>([V; MAX_WORDS]);

impl<V: Lanes> Source<V> for Words<V> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        self.0[k]
    }
}

/// The record of one particle in all lanes.
struct Broadcast<'a>(&'a [f64]);

impl<V: Lanes> Source<V> for Broadcast<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        V::of(self.0[k])
    }
}

/// Sums of four particles: number `k` of particle `l` at `[k][l]`; written one particle at a time.
struct Sums {
    words: [[f64; 4]; MAX_WORDS],
    lane: usize,
}

impl<V: Lanes> Sink<V> for Sums {
    #[inline(always)]
    fn put(&mut self, k: usize, x: V) {
        self.words[k][self.lane] = x.total();
    }
}

/// Sums of four particles as lanes.
struct SumsOfFour<'a>(&'a Sums);
/// Sums of one of the four.
struct SumsOfOne<'a>(&'a Sums);

impl<V: Lanes> Source<V> for SumsOfFour<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        // SAFETY: a row holds four numbers.
        unsafe { V::load(self.0.words[k].as_ptr()) }
    }
}

impl Source<f64> for SumsOfOne<'_> {
    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        self.0.words[k][self.0.lane]
    }
}

impl<P: PairSum<D>, U: Update<D, Sum = P::Adds>, const D: usize> Pairs<'_, P, U, D> {
    /// The sum over the neighbours of `a`, into lane `a_lane` of `sums`.
    #[inline(always)]
    fn gather<V: Lanes>(&self, a: usize, lane: usize, sums: &mut Sums) {
        let row = &self.records[a * self.stride..(a + 1) * self.stride];
        let own = P::Reads::read::<V>(&Broadcast(row));
        let now = self.now.cast();
        let mut sum = P::Adds::nought::<V>();
        for block in self.blocks.of(a) {
            let ids = self.blocks.ids(block);
            let mut words = Words([V::zero(); MAX_WORDS]);
            for k in (0..P::Reads::WORDS + 1).step_by(4) {
                // SAFETY: neighbours are particles, and every row is padded to a multiple of four numbers.
                let four = unsafe {
                    V::transposed(ids.map(|b| self.records.as_ptr().add(b as usize * self.stride + k)))
                };
                words.0[k..k + 4].copy_from_slice(&four);
            }
            let other = P::Reads::read::<V>(&words);
            let pair = self.blocks.pair::<V>(block, words.0[P::Reads::WORDS]);
            self.sum.add(&mut sum, (&own, &other), &pair, &now);
        }
        sums.lane = lane;
        P::Adds::write(sum, sums);
    }
}

impl<P: PairSum<D>, U: Update<D, Sum = P::Adds>, const D: usize> Walk for Pairs<'_, P, U, D> {
    #[inline(always)]
    fn chunk<V: Lanes>(&self, chunk: &Chunk) {
        let mut sums = Sums { words: [[0.0; 4]; MAX_WORDS], lane: 0 };
        let (fours, rest) = chunk.fours();
        for first in fours {
            for lane in 0..4 {
                self.gather::<V>(first + lane, lane, &mut sums);
            }
            let sum = P::Adds::read::<V>(&SumsOfFour(&sums));
            let a = U::Reads::read::<V>(&Four(&self.reads, first));
            U::Writes::write(self.then.at(&sum, &a, &self.now.cast()), &mut Four(&self.writes, first));
        }
        for a in rest..chunk.end {
            self.gather::<V>(a, 0, &mut sums);
            let sum = P::Adds::read::<f64>(&SumsOfOne(&sums));
            let own = U::Reads::read::<f64>(&One(&self.reads, a));
            U::Writes::write(self.then.at(&sum, &own, &self.now), &mut One(&self.writes, a));
        }
    }
}

/// A sum over the neighbours of lattice-born particles and the update that follows it; a chunk counts blocks.
pub struct Stencils<'a, P, U, const D: usize> {
    pub sum: &'a P,
    pub then: &'a U,
    /// Where the sum reads; nobody writes there meanwhile.
    pub own: Places,
    pub reads: Places,
    pub writes: Places,
    pub stencil: &'a Stencil<D>,
    pub now: Now<f64>,
}

/// What a block carries through its entries.
struct Running<A, S> {
    a: A,
    sum: S,
}

type RunningOf<P, V, const D: usize> =
    Running<Of<<P as PairSum<D>>::Reads, V, D>, Of<<P as PairSum<D>>::Adds, V, D>>;

impl<P: PairSum<D>, U: Update<D, Sum = P::Adds>, const D: usize> Stencils<'_, P, U, D> {
    /// Many numbers in, few out (forces from stress): weight by weight, because then only the numbers that one weight needs are
    /// loaded. Few in, many out (gradients): the whole pair at once, leaving out its zeros.
    const WEIGHT_BY_WEIGHT: bool = P::Reads::WORDS > 2 * P::Adds::WORDS;

    #[inline(always)]
    fn part<V: Lanes, const M: u8>(&self, block: &Block, run: &mut RunningOf<P, V, D>, now: &Now<V>) {
        let own = &self.own;
        let (full, some) = self.stencil.lists::<M>(block);
        let at = |delta: i32| (block.first as i32 + delta) as usize;
        for entry in full {
            let b = P::Reads::read::<V>(&Four(own, at(entry.delta)));
            self.sum.add(&mut run.sum, (&run.a, &b), &self.stencil.pair::<V, M>(entry), now);
        }
        for entry in some {
            let b = P::Reads::read::<V>(&Four(own, at(entry.delta)));
            self.sum.add(&mut run.sum, (&run.a, &b), &self.stencil.masked::<V, M>(entry), now);
        }
    }

    #[inline(always)]
    fn gather<V: Lanes>(&self, block: &Block, now: &Now<V>) -> Of<P::Adds, V, D> {
        let a = P::Reads::read::<V>(&Four(&self.own, block.first as usize));
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
        run.sum
    }
}

impl<P: PairSum<D>, U: Update<D, Sum = P::Adds>, const D: usize> Walk for Stencils<'_, P, U, D> {
    #[inline(always)]
    fn chunk<V: Lanes>(&self, chunk: &Chunk) {
        let now = self.now.cast::<V>();
        for block in &self.stencil.blocks[chunk.first..chunk.end] {
            let sum = self.gather(block, &now);
            let first = block.first as usize;
            if block.active == 4 {
                let own = U::Reads::read::<V>(&Four(&self.reads, first));
                U::Writes::write(self.then.at(&sum, &own, &now), &mut Four(&self.writes, first));
            } else {
                let active = usize::from(block.active);
                let own = U::Reads::read::<V>(&Some4(&self.reads, first, active));
                U::Writes::write(self.then.at(&sum, &own, &now), &mut Some4(&self.writes, first, active));
            }
        }
    }
}

/// An update without a sum.
pub struct Each<'a, U, const D: usize> {
    pub update: &'a U,
    pub reads: Places,
    pub writes: Places,
    pub now: Now<f64>,
}

impl<U: Update<D, Sum = ()>, const D: usize> Walk for Each<'_, U, D> {
    #[inline(always)]
    fn chunk<V: Lanes>(&self, chunk: &Chunk) {
        let (fours, rest) = chunk.fours();
        for first in fours {
            let a = U::Reads::read::<V>(&Four(&self.reads, first));
            U::Writes::write(self.update.at(&(), &a, &self.now.cast()), &mut Four(&self.writes, first));
        }
        for a in rest..chunk.end {
            let own = U::Reads::read::<f64>(&One(&self.reads, a));
            U::Writes::write(self.update.at(&(), &own, &self.now), &mut One(&self.writes, a));
        }
    }
}

/// A reduction; chunk `c` leaves its numbers at `partial[c * K..]`.
pub struct Fold<'a, R, const D: usize, const K: usize> {
    pub reduce: &'a R,
    pub reads: Places,
    pub partial: Shared,
}

impl<R: Reduce<D, K>, const D: usize, const K: usize> Walk for Fold<'_, R, D, K> {
    #[inline(always)]
    fn chunk<V: Lanes>(&self, chunk: &Chunk) {
        let mut lanes = R::FOLDS.map(|f| V::of(f.start()));
        let (fours, rest) = chunk.fours();
        for first in fours {
            let values = self.reduce.at(&R::Reads::read::<V>(&Four(&self.reads, first)));
            for k in 0..K {
                lanes[k] = R::FOLDS[k].join(lanes[k], values[k]);
            }
        }
        let mut out = R::FOLDS.map(crate::pass::Fold::start);
        for k in 0..K {
            let mut four = [0.0; 4];
            // SAFETY: four numbers on the stack.
            unsafe { lanes[k].store(four.as_mut_ptr()) };
            out[k] = four.into_iter().fold(out[k], |a, b| R::FOLDS[k].join(a, b));
        }
        for a in rest..chunk.end {
            let values = self.reduce.at(&R::Reads::read::<f64>(&One(&self.reads, a)));
            for k in 0..K {
                out[k] = R::FOLDS[k].join(out[k], values[k]);
            }
        }
        for k in 0..K {
            // SAFETY: there are K numbers for each chunk, and this chunk is this thread's.
            unsafe { self.partial.set(chunk.index * K + k, out[k]) };
        }
    }
}
