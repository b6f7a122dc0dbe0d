//! Making the list: what lies within the support of the kernel goes through the lanes, cell by cell, and right on into the list.

use super::{Chunk, Walk};
use crate::kernel::Kernel;
use crate::math::{Element, Lanes, MOST_LANES};
use crate::neighbours::{CellGrid, Near};
use crate::particles::Plain;
use crate::run::cpu::kit::Kit;
use crate::run::cpu::list::{PairChunk, PairList, volume_apart};
use crate::run::cpu::places::Shared;
use crate::run::cpu::slots::Slots;
use std::sync::atomic::{AtomicU64, Ordering};

/// Finds the pairs of every chunk.
pub struct Listing<'a, E, const D: usize> {
    pub grid: &'a CellGrid<D>,
    /// Positions by particle.
    pub x: [&'a [f64]; D],
    pub volume: &'a [f64],
    /// Only pairs of equal tag, if there are tags.
    pub same: Option<&'a [u32]>,
    pub kernel: &'a Kernel,
    /// Where the particles are on the fine grid of the list: by slot, and by particle.
    pub slots: &'a Slots<D>,
    pub list: &'a PairList<E, D>,
    pub chunks: Shared<PairChunk<E>>,
    /// All pairs so far.
    pub pairs: &'a AtomicU64,
}

/// More pairs than this are refused.
pub const MOST_PAIRS: u64 = u32::MAX as u64;

impl<E: Element + Plain, const D: usize> Listing<'_, E, D> {
    /// Writes the neighbours of `a` among `near` into the list, from number `first` on; returns how many.
    #[inline(always)]
    fn find<W: Lanes<E = f32>>(
        &self,
        a: usize,
        near: &Near,
        (first, list): (usize, &mut PairChunk<E>),
    ) -> usize {
        let own = self.list.place(a);
        let (support, step) = (self.kernel.support(), self.list.step());
        let (square, per_square) = (W::of((support / step).powi(2)), W::of((step / self.kernel.h()).powi(2)));
        let slots = self.grid.ids();
        let mut found = 0;
        for part in 0..near.parts() {
            let range = self.grid.range(near, part);
            if range.is_empty() {
                continue;
            }
            let most = found + range.len() + 3 * MOST_LANES;
            list.room((first + most, most), volume_apart::<E, D>());
            let (ids, squares) = (&mut list.ids[first..], &mut list.q2);
            for slot in range.clone().step_by(W::N) {
                let mut r2 = W::zero();
                for axis in 0..D {
                    // SAFETY: the slots of a range exist, and numbers behind the last are readable.
                    let [steps, _] =
                        unsafe { W::load(self.slots.from(axis, slot)).offsets(own[axis].into(), 1.0) };
                    r2 = steps.mul_add(steps, r2);
                }
                let left = (range.end - slot).min(W::N);
                // Not itself; nor what lies on the same spot, which would have no direction and no force.
                let bits = W::bits(r2.lt(square)) & W::bits(W::zero().lt(r2)) & (u32::MAX >> (32 - left));
                // SAFETY: the grid keeps readable ids behind its last slot; no more are found than are candidates, and there is
                // room for those and the lanes of one more.
                unsafe {
                    let to = (squares.as_mut_ptr().add(found), ids.as_mut_ptr().add(found));
                    (r2 * per_square).compress(bits, slots.as_ptr().add(slot), to);
                }
                found += bits.count_ones() as usize;
            }
        }
        found
    }

    /// Leaves only neighbours with the tag of `a`, if there are tags; and none that only share the place of a cell: coordinates count modulo
    /// four supports.
    fn sift(&self, a: usize, found: usize, (first, list): (usize, &mut PairChunk<E>)) -> usize {
        let folded = self.grid.is_folded();
        if self.same.is_none() && !folded {
            return found;
        }
        let mut left = 0;
        for k in 0..found {
            let b = list.ids[first + k];
            (list.ids[first + left], list.q2[left]) = (b, list.q2[k]);
            let alike = self.same.is_none_or(|tag| tag[a] == tag[b as usize]);
            let close = |x: &[f64]| (x[a] - x[b as usize]).abs() < 2.0 * self.kernel.support();
            left += usize::from(alike && (!folded || self.x.iter().all(|x| close(x))));
        }
        left
    }

    /// Fills the last block with `a`, without weight, and makes the weights of all `len` numbers from `first` on, and of more of the same up
    /// to the lanes of `W`.
    #[inline(always)]
    fn weigh<W: Lanes<E = f32>>(
        &self,
        a: usize,
        (found, len): (usize, usize),
        (first, list): (usize, &mut PairChunk<E>),
    ) {
        let len = len.next_multiple_of(W::N);
        list.ids[first + found..first + len].fill(a as u32);
        list.q2[found..len].fill(0.0);
        let (steepness, per_h) = (self.kernel.steepness(), W::of(1.0 / self.kernel.h()));
        for at in (0..len).step_by(W::N) {
            // SAFETY: there is room for `len` numbers, a multiple of the lanes.
            let slope = unsafe {
                let q = W::load(list.q2.as_ptr().add(at)).sqrt();
                let over_q = W::select(W::zero().lt(q), W::one() / q, W::zero());
                (over_q * per_h).store(list.over_r.as_mut_ptr().add(first + at));
                self.kernel.slope(q) * over_q
            };
            if volume_apart::<E, D>() {
                // SAFETY: as above.
                unsafe { slope.store(list.slope.as_mut_ptr().add(first + at)) };
                continue;
            }
            let mut slopes = [0.0; MOST_LANES];
            // SAFETY: room for any lanes.
            unsafe { slope.store(slopes.as_mut_ptr()) };
            let block = first + at..first + at + W::N;
            let (ids, weights) = (&list.ids[block.clone()], &mut list.w[block]);
            for l in 0..W::N {
                weights[l] = E::from_f64(f64::from(slopes[l]) * (self.volume[ids[l] as usize] * steepness));
            }
        }
    }
}

impl<E: Element + Plain, const D: usize> Walk<E> for Listing<'_, E, D> {
    #[inline(always)]
    fn chunk<K: Kit<Pair: Lanes<E = E>>>(&self, chunk: &Chunk) {
        // SAFETY: there is one list for each chunk, and this chunk is this thread's.
        let list = unsafe { self.chunks.get_mut(chunk.index) };
        list.start.clear();
        list.start.push(0);
        list.pairs = 0;
        list.loneliest = (chunk.first as u32, u32::MAX);
        if self.pairs.load(Ordering::Relaxed) > MOST_PAIRS {
            return;
        }
        let lanes = K::Listed::N;
        let (mut first, mut line, mut near) = (0, None, Near::none());
        for a in chunk.first..chunk.end {
            // Neighbours in the order of particles mostly share their line of cells.
            let (own_line, cell) = self.grid.cell_of(a);
            if line == Some(own_line) {
                self.grid.slide(&mut near, cell);
            } else {
                line = Some(own_line);
                near = self.grid.near(self.x.map(|column| column[a]));
            }
            list.room((first + 3 * MOST_LANES, 3 * MOST_LANES), volume_apart::<E, D>());
            let found = self.find::<K::Search>(a, &near, (first, list));
            let found = self.sift(a, found, (first, list));
            let len = found.next_multiple_of(lanes);
            self.weigh::<K::Weight>(a, (found, len), (first, list));
            first += len;
            list.start.push((first / lanes) as u32);
            list.pairs += found as u64;
            if (found as u32) < list.loneliest.1 {
                list.loneliest = (a as u32, found as u32);
            }
        }
        self.pairs.fetch_add(list.pairs, Ordering::Relaxed);
    }
}
