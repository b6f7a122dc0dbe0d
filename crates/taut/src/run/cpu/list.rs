//! The pair list in the shape that lanes want: the neighbours of a particle in blocks of as many as there are lanes (drawn
//! for four).
//!
//! ```text
//! particle a:  ids      | b0 b1 b2 b3 | b4 b5 b6 b7 | b8  a  a  a |      the last block is filled up with a itself
//!              weights  | e_x x4, e_y x4, (e_z x4), W' x4, W'/r x4 | ...      and zero weights
//! records:     | what the pass reads of particle 0, then V_0, up to a multiple of four numbers | of particle 1 | ...
//! ```
//!
//! Pair data are single precision: the loop is bound by the memory they stream through, and a weight that is 6e-8 off is still a
//! weight. What must be exact stays exact: e, W' and W'/r are rounded alike for (a, b) and (b, a) and the volume of b comes in
//! double precision from its record, so that momentum is conserved to rounding; and the correction matrix is made
//! from the same weights, so that gradients of linear fields are exact. Four whole records are loaded and
//! transposed in registers: gathers from columns would be slower.

use super::CHUNK;
use crate::kernel::Kernel;
use crate::math::{Lanes, Vector};
use crate::neighbours::Adjacency;
use crate::pass::{ALL_WEIGHTS, Pair};

/// Blocks of neighbours, with e, W' and W'/r of each.
#[derive(Debug)]
pub struct PairBlocks<const D: usize> {
    start: Vec<u32>,
    ids: Vec<u32>,
    /// Neighbours in a block.
    lanes: usize,
    weights: Vec<f32>,
}

impl<const D: usize> Default for PairBlocks<D> {
    fn default() -> Self {
        Self { start: Vec::new(), ids: Vec::new(), weights: Vec::new(), lanes: 4 }
    }
}

impl<const D: usize> PairBlocks<D> {
    /// Numbers of a pair.
    const WORDS: usize = D + 2;

    /// Fills blocks of `lanes` neighbours. Buffers grow geometrically and are kept.
    pub fn build(&mut self, list: &Adjacency, x: [&[f64]; D], kernel: &Kernel, lanes: usize) {
        let len = list.particles();
        self.lanes = lanes;
        self.start.clear();
        self.start.push(0);
        let mut blocks = 0;
        for a in 0..len {
            blocks += list.of(a).len().div_ceil(lanes) as u32;
            self.start.push(blocks);
        }
        self.ids.resize(blocks as usize * lanes, 0);
        self.weights.resize(blocks as usize * lanes * Self::WORDS, 0.0);
        let fill = Fill { list, x, kernel, start: &self.start, lanes };
        fill.all(0, len, &mut self.ids, &mut self.weights);
    }

    /// The blocks of particle `a`.
    #[inline(always)]
    pub fn of(&self, a: usize) -> std::ops::Range<usize> {
        self.start[a] as usize..self.start[a + 1] as usize
    }

    /// The neighbours of a block; the list was made for the lanes of `V`.
    #[inline(always)]
    pub fn ids<V: Lanes>(&self, block: usize) -> &[u32] {
        debug_assert_eq!(V::N, self.lanes);
        &self.ids[block * V::N..(block + 1) * V::N]
    }

    /// The pairs of a block, given the volumes of the neighbours.
    #[inline(always)]
    pub fn pair<V: Lanes>(&self, block: usize, volume: V) -> Pair<V, D, ALL_WEIGHTS> {
        let size = V::N * Self::WORDS;
        let words = &self.weights[block * size..(block + 1) * size];
        // SAFETY: `words` holds D + 2 times as many numbers as lanes.
        let word = |k: usize| unsafe { V::load_single(words.as_ptr().add(V::N * k)) };
        let mut e = Vector::zero();
        for i in 0..D {
            e.0[i] = word(i);
        }
        Pair { grad_w: e.times(word(D) * volume), w: word(D + 1) * volume, e }
    }
}

/// What is needed to fill the blocks of a range of particles.
struct Fill<'a, const D: usize> {
    list: &'a Adjacency,
    x: [&'a [f64]; D],
    kernel: &'a Kernel,
    start: &'a [u32],
    lanes: usize,
}

impl<const D: usize> Fill<'_, D> {
    /// Fills particles `first..end`, splitting the range (at multiples of the chunk) until it is small.
    fn all(&self, first: usize, end: usize, ids: &mut [u32], weights: &mut [f32]) {
        if end - first <= 4 * CHUNK {
            for a in first..end {
                self.one(a, self.start[first] as usize, (ids, weights));
            }
            return;
        }
        let middle = (first + (end - first) / 2).next_multiple_of(CHUNK);
        let cut = (self.start[middle] - self.start[first]) as usize * self.lanes;
        let (low, high) = ids.split_at_mut(cut);
        let (light, heavy) = weights.split_at_mut(cut * PairBlocks::<D>::WORDS);
        rayon::join(|| self.all(first, middle, low, light), || self.all(middle, end, high, heavy));
    }

    fn one(&self, a: usize, base: usize, (ids, weights): (&mut [u32], &mut [f32])) {
        let (n, size) = (self.lanes, self.lanes * PairBlocks::<D>::WORDS);
        let blocks = self.start[a] as usize - base..self.start[a + 1] as usize - base;
        for (block, some) in blocks.zip(self.list.of(a).chunks(n)) {
            let ids = &mut ids[block * n..(block + 1) * n];
            ids.fill(a as u32);
            let words = &mut weights[block * size..(block + 1) * size];
            words.fill(0.0);
            for (l, &b) in some.iter().enumerate() {
                ids[l] = b;
                let x_ab: Vector<f64, D> = Vector::from_fn(|i| self.x[i][a] - self.x[i][b as usize]);
                let r = x_ab.norm_squared().sqrt();
                let slope = self.kernel.dw(r);
                // Particles on top of each other have no direction and no force.
                let inverse = if r > 0.0 { 1.0 / r } else { 0.0 };
                for i in 0..D {
                    words[n * i + l] = (x_ab[i] * inverse) as f32;
                }
                words[n * D + l] = slope as f32;
                words[n * (D + 1) + l] = (slope * inverse) as f32;
            }
        }
    }
}
