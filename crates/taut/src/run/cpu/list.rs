//! The pair list of bodies without a lattice: the neighbours of a particle in blocks of as many as there are lanes (drawn
//! for four), and for each pair as little as the weights can be made from.
//!
//! ```text
//! a chunk of particles owns its part of the list:
//!   start   | first block of each particle                                |
//!   ids     | b0 b1 b2 b3 | b4 b5 b6 b7 | b8  a  a  a | ...   the last block is filled up with a itself
//!   slope   | s of the same pairs, single, 0 in the fill  | ...   s = W'/r without its unit
//!   over_r  | 1/r of the same pairs, 0 in the fill        | ...   (read only where a pass needs the direction)
//! records:  | what the pass reads of particle 0 | its place | its volume | up to a multiple of four numbers | of particle 1 | ...
//!                                                            times the unit of s
//! ```
//!
//! What the loop streams through matters: a list that held the gradient too (24 bytes a pair in 3D) ran at half
//! the speed of one with 12, and this one has 8 (12 with the direction). The distance x_ab comes from the records instead, where each
//! is used by all neighbours: a place is D whole numbers, the position in steps of some 2^-30 of the kernel's support, counted modulo 2^32.
//! Their difference is exact, changes sign with the pair, and is 2e-9 of the support off; so `grad W V_b = w x_ab` and `e = x_ab / r`. A step is a power
//! of two in metres, so that differences become distances by setting an exponent ([`Lanes::offsets`]).
//! In single precision s is 1e-7 off, but the same for both halves of a pair; so V_a V_b s is too, and momentum is exact
//! to rounding in the precision of the run. The correction matrix is made from the same weights, so that gradients of linear fields are exact.
//!
//! A record of the plane has no room for the volume (it would grow from a half or a whole cache line to the next), and in a single
//! run nothing would be gained. There the list holds w = s V_b in the precision of the run instead of s ([`volume_apart`]).
//!
//! Whole records are loaded and transposed in registers: gathers from columns would be
//! slower. What comes next in the list is asked for ahead of time: the hardware does not see it coming (measured: twice the speed).

use super::CHUNK;
use crate::kernel::Kernel;
use crate::math::{Element, Lanes, MOST_LANES, Vector, prefetch};
use crate::neighbours::floor;
use crate::particles::{Lines, Plain};
use crate::pass::{ALL_WEIGHTS, Pair};
use rayon::prelude::*;

/// Blocks between the one at work and the one asked for.
const AHEAD: usize = 16;
/// Most steps of the fine grid in the support of the kernel; more than half as many are taken.
const MOST_STEPS: f64 = (1_u32 << 30) as f64;

/// The next power of two that is not less than `x`, a positive number.
fn power_of_two(x: f64) -> f64 {
    let below = f64::from_bits(x.to_bits() & !((1 << 52) - 1));
    if below < x { 2.0 * below } else { below }
}

/// Numbers that hold the place of a particle.
pub const fn place_words<E: Element, const D: usize>() -> usize {
    D.div_ceil(E::COORDINATES)
}

/// Whether the volume of b stands in its record, behind the place, and not in the weight of each of its pairs.
pub const fn volume_apart<E: Element, const D: usize>() -> bool {
    size_of::<E>() > size_of::<f32>() && D == 3
}

/// Numbers that stand in a record behind what the pass reads.
pub const fn tail_words<E: Element, const D: usize>() -> usize {
    place_words::<E, D>() + volume_apart::<E, D>() as usize
}

/// The pairs of one chunk of particles. Buffers grow geometrically and are kept.
#[derive(Debug)]
pub struct PairChunk<E> {
    /// The first block of each particle, and the end.
    pub start: Vec<u32>,
    /// Neighbours, block by block.
    pub ids: Lines<u32>,
    /// W'/r of each, without its unit; nothing where the volume does not stand in the records.
    pub slope: Lines<f32>,
    /// V_b W'/r of each; nothing where the volume stands in the records.
    pub w: Lines<E>,
    /// 1/r of each, 1/m.
    pub over_r: Lines<f32>,
    /// Pairs, without the fill.
    pub pairs: u64,
    /// A particle with the fewest neighbours, and how many.
    pub loneliest: (u32, u32),
    /// (r/h)^2 of the neighbours of one particle while they are found.
    pub q2: Vec<f32>,
}

impl<E> Default for PairChunk<E> {
    fn default() -> Self {
        let (ids, w) = (Lines::default(), Lines::default());
        let (slope, over_r) = (Lines::default(), Lines::default());
        let loneliest = (0, u32::MAX);
        Self { start: Vec::new(), ids, slope, w, over_r, pairs: 0, loneliest, q2: Vec::new() }
    }
}

/// The pairs of all particles.
#[derive(Debug)]
pub struct PairList<E, const D: usize> {
    /// Chunk by chunk.
    pub chunks: Vec<PairChunk<E>>,
    /// The places of all particles, and their volumes if those stand apart: [`tail_words`] columns, with readable numbers behind each.
    tails: Vec<E>,
    /// Numbers from one column to the next.
    column: usize,
    /// A step of the fine grid, m: a power of two.
    step: f64,
}

impl<E, const D: usize> Default for PairList<E, D> {
    fn default() -> Self {
        Self { chunks: Vec::new(), tails: Vec::new(), column: 0, step: 0.0 }
    }
}

impl<E: Plain> PairChunk<E> {
    /// Makes room for so many neighbours in all, and so many of one particle. `apart`: see [`volume_apart`].
    #[inline]
    pub fn room(&mut self, (all, one): (usize, usize), apart: bool) {
        if self.ids.len() < all {
            let room = all + all / 4;
            self.ids.resize(room);
            self.over_r.resize(room);
            if apart { self.slope.resize(room) } else { self.w.resize(room) }
        }
        if self.q2.len() < one {
            self.q2.resize(one + one / 4, 0.0);
        }
    }
}

impl<E: Element + Plain, const D: usize> PairList<E, D> {
    /// Prepares for particles at `x`, of these volumes, and a kernel: chunks, places and volumes.
    pub fn prepare(&mut self, (x, volume): ([&[f64]; D], &[f64]), kernel: &Kernel) {
        let len = x[0].len();
        self.step = power_of_two(kernel.support() / MOST_STEPS);
        self.chunks.resize_with(len.div_ceil(CHUNK), PairChunk::default);
        self.column = len + MOST_LANES;
        self.tails.resize(self.column * tail_words::<E, D>(), E::default());
        let per_metre = 1.0 / self.step;
        let steps = |x: f64| floor(x * per_metre + 0.5) as u32;
        for (word, column) in self.tails.chunks_exact_mut(self.column).enumerate() {
            if word >= place_words::<E, D>() {
                let chunks = column[..len].par_chunks_mut(CHUNK).zip(volume.par_chunks(CHUNK));
                let steep = |(to, v): (&mut E, &f64)| *to = E::from_f64(v * kernel.steepness());
                chunks.for_each(|(column, volume)| column.iter_mut().zip(volume).for_each(steep));
                continue;
            }
            let axes = &x[word * E::COORDINATES..D.min((word + 1) * E::COORDINATES)];
            column[..len].par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, places)| {
                for (i, place) in places.iter_mut().enumerate() {
                    let mut coordinates = [0; 2];
                    for (coordinate, x) in coordinates.iter_mut().zip(axes) {
                        *coordinate = steps(x[chunk * CHUNK + i]);
                    }
                    *place = E::packed(&coordinates);
                }
            });
        }
    }

    /// The columns that stand in a record behind what the pass reads.
    pub fn tails(&mut self) -> impl Iterator<Item = *mut E> {
        self.tails.chunks_exact_mut(self.column.max(1)).map(|column| column.as_mut_ptr())
    }

    /// A step of the fine grid, m.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The coordinates of a particle on the fine grid.
    #[inline(always)]
    pub fn place(&self, a: usize) -> [u32; D] {
        let word = |axis: usize| self.tails[axis / E::COORDINATES * self.column + a];
        std::array::from_fn(|axis| word(axis).coordinate(axis % E::COORDINATES))
    }

    /// Pairs, each counted from both sides.
    pub fn pairs(&self) -> u64 {
        self.chunks.iter().map(|chunk| chunk.pairs).sum()
    }

    /// The first particle with the fewest neighbours, and how many.
    pub fn loneliest(&self) -> Option<(usize, usize)> {
        let fewest = self.chunks.iter().map(|chunk| chunk.loneliest).min_by_key(|&(_, count)| count);
        fewest.map(|(a, count)| (a as usize, count as usize))
    }

    /// The coordinates of a particle on the fine grid, from the numbers that hold them.
    #[inline(always)]
    pub fn coordinates(place: &[E]) -> [u32; D] {
        std::array::from_fn(|axis| place[axis / E::COORDINATES].coordinate(axis % E::COORDINATES))
    }
}

/// What makes pairs of a chunk from records.
#[derive(Clone, Copy)]
pub struct Weights<'a, E, const D: usize> {
    chunk: &'a PairChunk<E>,
    step: f64,
}

impl<E: Element + Plain, const D: usize> PairList<E, D> {
    /// The weights of a chunk.
    #[inline(always)]
    pub fn weights(&self, chunk: usize) -> Weights<'_, E, D> {
        Weights { chunk: &self.chunks[chunk], step: self.step }
    }
}

impl<'a, E: Element + Plain, const D: usize> Weights<'a, E, D> {
    /// The blocks of the particle that is number `i` of the chunk.
    #[inline(always)]
    pub fn blocks(&self, i: usize) -> std::ops::Range<usize> {
        self.chunk.start[i] as usize..self.chunk.start[i + 1] as usize
    }

    /// The neighbours of a block; asks for those of a later one.
    #[inline(always)]
    pub fn ids<V: Lanes>(&self, block: usize) -> &'a [u32] {
        let first = block * V::N;
        prefetch(self.chunk.ids.as_ptr().wrapping_add(first + AHEAD * V::N));
        &self.chunk.ids[first..first + V::N]
    }

    /// V_b W'/r of the pairs from `first` on. `tail` are the numbers of the neighbours behind what the pass reads.
    #[inline(always)]
    fn w<V: Lanes<E = E>>(&self, first: usize, tail: &[V]) -> V {
        if volume_apart::<E, D>() {
            debug_assert!(first + V::N <= self.chunk.slope.len());
            // SAFETY: `slope` is as long as `ids`, and `ids` found this block in it.
            let slope = unsafe { self.chunk.slope.as_ptr().add(first) };
            prefetch(slope.wrapping_add(AHEAD * V::N));
            // SAFETY: as above.
            let slope = unsafe { V::load_single(slope) };
            slope * tail[place_words::<E, D>()]
        } else {
            debug_assert!(first + V::N <= self.chunk.w.len());
            // SAFETY: `w` is as long as `ids`, and `ids` found this block in it.
            let w = unsafe { self.chunk.w.as_ptr().add(first) };
            prefetch(w.wrapping_add(AHEAD * V::N));
            // SAFETY: as above.
            unsafe { V::load(w) }
        }
    }

    /// 1/r of the pairs from `first` on.
    #[inline(always)]
    fn over_r<V: Lanes<E = E>>(&self, first: usize) -> V {
        debug_assert!(first + V::N <= self.chunk.over_r.len());
        // SAFETY: `over_r` is as long as `ids`, and `ids` found this block in it.
        let over_r = unsafe { self.chunk.over_r.as_ptr().add(first) };
        prefetch(over_r.wrapping_add(AHEAD * V::N));
        // SAFETY: as above.
        unsafe { V::load_single(over_r) }
    }

    /// The pairs of a block, with their directions if wanted. `tail` are the numbers of the neighbours behind what the pass reads, `own` is the
    /// place of the particle.
    #[inline(always)]
    pub fn pair<V: Lanes<E = E>>(
        &self,
        (block, directed): (usize, bool),
        own: [u32; D],
        tail: &[V],
    ) -> Pair<V, D, ALL_WEIGHTS> {
        let first = block * V::N;
        let mut x = Vector::zero();
        for axis in (0..D).step_by(E::COORDINATES) {
            let second = E::COORDINATES > 1 && axis + 1 < D;
            let high = if second { u64::from(own[axis + 1]) << 32 } else { 0 };
            let place = tail[axis / E::COORDINATES];
            let offsets = place.offsets(u64::from(own[axis]) | high, self.step);
            x.0[axis] = offsets[0];
            if second {
                x.0[axis + 1] = offsets[1];
            }
        }
        let w = self.w(first, tail);
        let over_r = if directed { self.over_r::<V>(first) } else { V::zero() };
        Pair { grad_w: x.times(w), w, e: x.times(over_r), x, over_r }
    }
}
