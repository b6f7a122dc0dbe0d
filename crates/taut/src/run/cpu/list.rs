//! The pair list of bodies without a lattice: the neighbours of a particle in blocks of as many as there are lanes (drawn
//! for four), and for each pair as little as the weights can be made from.
//!
//! ```text
//! a chunk of particles owns its part of the list:
//!   start   | first block of each particle                                |
//!   ids     | b0 b1 b2 b3 | b4 b5 b6 b7 | b8  a  a  a | ...   the last block is filled up with a itself
//!   w       | V_b W'/r of the same pairs, 0 in the fill   | ...
//!   over_r  | 1/r of the same pairs, 0 in the fill        | ...   (read only where a pass needs the direction)
//! records:  | what the pass reads of particle 0 | its place | up to a multiple of four numbers | of particle 1 | ...
//! ```
//!
//! The loop is bound by the memory it streams through: a list that held the gradient too (24 bytes a pair in 3D) ran at half
//! the speed of this one (12, or 16 with the direction). The distance x_ab comes from the records instead, where each
//! is used by all neighbours: a place is D whole numbers, the position in steps of 2^-30 of the kernel's support, counted modulo 2^32.
//! Their difference is exact, changes sign with the pair, and is 1e-9 of the support off; so
//! `grad W V_b = w x_ab` and `e = x_ab / r`. The volume of b is part of w in the precision of the run: V_a V_b stands in both
//! halves of a pair, and momentum is exact to that rounding. The correction matrix is made from the same weights, so that
//! gradients of linear fields are exact. Whole records are loaded and transposed in registers: gathers from columns would be
//! slower. What comes next in the list is asked for ahead of time: the hardware does not see it coming (measured: twice the speed).

use super::CHUNK;
use super::lines::{Lines, Plain};
use crate::math::{Element, Lanes, MOST_LANES, Vector, prefetch};
use crate::pass::{ALL_WEIGHTS, Pair};
use rayon::prelude::*;

/// Blocks between the one at work and the one asked for.
const AHEAD: usize = 16;
/// Steps of the fine grid in the support of the kernel.
const STEPS: f64 = (1_u32 << 30) as f64;

/// Numbers that hold the place of a particle.
pub const fn place_words<E: Element, const D: usize>() -> usize {
    D.div_ceil(E::COORDINATES)
}

/// The pairs of one chunk of particles. Buffers grow geometrically and are kept.
#[derive(Debug)]
pub struct PairChunk<E> {
    /// The first block of each particle, and the end.
    pub start: Vec<u32>,
    /// Neighbours, block by block.
    pub ids: Lines<u32>,
    /// V_b W'/r of each.
    pub w: Lines<E>,
    /// 1/r of each.
    pub over_r: Lines<f32>,
    /// Pairs, without the fill.
    pub pairs: u64,
    /// A particle with the fewest neighbours, and how many.
    pub loneliest: (u32, u32),
    /// Squared distances of the neighbours of one particle while they are found, m^2.
    pub r2: Vec<f64>,
}

impl<E> Default for PairChunk<E> {
    fn default() -> Self {
        let (ids, w, over_r) = (Lines::default(), Lines::default(), Lines::default());
        Self { start: Vec::new(), ids, w, over_r, pairs: 0, loneliest: (0, u32::MAX), r2: Vec::new() }
    }
}

/// The pairs of all particles.
#[derive(Debug)]
pub struct PairList<E, const D: usize> {
    /// Chunk by chunk.
    pub chunks: Vec<PairChunk<E>>,
    /// The places of all particles: [`place_words`] columns, with readable numbers behind each.
    places: Vec<E>,
    /// Numbers from one column to the next.
    column: usize,
    /// A step of the fine grid, m.
    unit: f64,
}

impl<E, const D: usize> Default for PairList<E, D> {
    fn default() -> Self {
        Self { chunks: Vec::new(), places: Vec::new(), column: 0, unit: 1.0 }
    }
}

impl<E: Plain> PairChunk<E> {
    /// Makes room for so many neighbours in all, and so many of one particle.
    #[inline]
    pub fn room(&mut self, all: usize, one: usize) {
        if self.ids.len() < all {
            let room = all + all / 4;
            self.ids.resize(room);
            self.w.resize(room);
            self.over_r.resize(room);
        }
        if self.r2.len() < one {
            self.r2.resize(one + one / 4, 0.0);
        }
    }
}

impl<E: Element + Plain, const D: usize> PairList<E, D> {
    /// Prepares for particles at `x` and a kernel of this support (m): chunks and places.
    pub fn prepare(&mut self, x: [&[f64]; D], support: f64) {
        let len = x[0].len();
        self.unit = support / STEPS;
        self.chunks.resize_with(len.div_ceil(CHUNK), PairChunk::default);
        self.column = len + MOST_LANES;
        self.places.resize(self.column * place_words::<E, D>(), E::default());
        let per_metre = 1.0 / self.unit;
        let steps = |x: f64| (x * per_metre).round() as i64 as u32;
        for (word, column) in self.places.chunks_exact_mut(self.column).enumerate() {
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

    /// The columns of places.
    pub fn places(&mut self) -> impl Iterator<Item = *mut E> {
        self.places.chunks_exact_mut(self.column.max(1)).map(|column| column.as_mut_ptr())
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
    unit: f64,
}

impl<E: Element + Plain, const D: usize> PairList<E, D> {
    /// The weights of a chunk.
    #[inline(always)]
    pub fn weights(&self, chunk: usize) -> Weights<'_, E, D> {
        Weights { chunk: &self.chunks[chunk], unit: self.unit }
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
        prefetch(self.chunk.w.as_ptr().wrapping_add(first + AHEAD * V::N));
        &self.chunk.ids[first..first + V::N]
    }

    /// The pairs of a block, with their directions if wanted. `place` holds the places of the neighbours, `own` that of the particle.
    #[inline(always)]
    pub fn pair<V: Lanes<E = E>>(
        &self,
        (block, directed): (usize, bool),
        own: [u32; D],
        place: &[V],
    ) -> Pair<V, D, ALL_WEIGHTS> {
        let (first, unit) = (block * V::N, V::of(self.unit));
        debug_assert!(first + V::N <= self.chunk.w.len() && self.chunk.w.len() <= self.chunk.over_r.len());
        // SAFETY: `w` and `over_r` are as long as `ids`, and `ids` found this block in it.
        let (w, over_r) = unsafe {
            let over_r = self.chunk.over_r.as_ptr().add(first);
            let over_r = if directed {
                prefetch(over_r.wrapping_add(AHEAD * V::N));
                V::load_single(over_r)
            } else {
                V::zero()
            };
            (V::load(self.chunk.w.as_ptr().add(first)), over_r)
        };
        let mut x = Vector::zero();
        for axis in 0..D {
            let steps = place[axis / E::COORDINATES].steps_from(axis % E::COORDINATES, own[axis]);
            x.0[axis] = steps * unit;
        }
        Pair { grad_w: x.times(w), w, e: x.times(over_r), x }
    }
}
