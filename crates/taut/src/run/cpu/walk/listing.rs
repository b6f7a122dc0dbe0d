//! Making the list: what lies within the support of the kernel goes through the lanes, cell by cell, and right on into the list.

use super::{Chunk, Walk};
use crate::kernel::Kernel;
use crate::math::{Element, Lanes, MOST_LANES};
use crate::neighbours::{CellGrid, Near};
use crate::run::cpu::kit::Kit;
use crate::run::cpu::lines::Plain;
use crate::run::cpu::list::PairChunk;
use crate::run::cpu::places::Shared;
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
    pub chunks: Shared<PairChunk<E>>,
    /// All pairs so far.
    pub pairs: &'a AtomicU64,
}

/// More pairs than this are refused.
pub const MOST_PAIRS: u64 = u32::MAX as u64;

impl<E: Element + Plain, const D: usize> Listing<'_, E, D> {
    /// Writes the neighbours of `a` among `near` into the list, from number `first` on; returns how many.
    #[inline(always)]
    fn find<U: Lanes<E = f64>>(
        &self,
        a: usize,
        near: &Near,
        (first, list): (usize, &mut PairChunk<E>),
    ) -> usize {
        let own = self.x.map(|column| U::of(column[a]));
        let square = U::of(self.grid.radius() * self.grid.radius());
        let (slots, positions) = (self.grid.ids(), self.grid.positions());
        let (ids, squares) = (&mut list.ids[first..], &mut list.r2);
        debug_assert!(ids.len().min(squares.len()) >= near.candidates() + MOST_LANES);
        let mut found = 0;
        for range in near.ranges() {
            for slot in range.clone().step_by(U::N) {
                let mut r2 = U::zero();
                for axis in 0..D {
                    // SAFETY: the grid keeps readable numbers behind its last slot.
                    let x = unsafe { U::load(positions[axis].as_ptr().add(slot)) };
                    let step = own[axis] - x;
                    r2 = step.mul_add(step, r2);
                }
                let left = (range.end - slot).min(U::N);
                // Not itself; nor what lies on the same spot, which would have no direction and no force.
                let bits = U::bits(r2.lt(square)) & U::bits(U::zero().lt(r2)) & (u32::MAX >> (32 - left));
                // SAFETY: the grid keeps readable ids behind its last slot; no more are found than are candidates, and there is
                // room for those and the lanes of one more.
                unsafe {
                    let to = (squares.as_mut_ptr().add(found), ids.as_mut_ptr().add(found));
                    r2.compress(bits, slots.as_ptr().add(slot), to);
                }
                found += bits.count_ones() as usize;
            }
        }
        found
    }

    /// Leaves only neighbours with the tag of `a`, if there are tags.
    fn sift(&self, a: usize, found: usize, (first, list): (usize, &mut PairChunk<E>)) -> usize {
        let Some(tag) = self.same else { return found };
        let mut left = 0;
        for k in 0..found {
            (list.ids[first + left], list.r2[left]) = (list.ids[first + k], list.r2[k]);
            left += usize::from(tag[a] == tag[list.ids[first + left] as usize]);
        }
        left
    }

    /// Fills the last block with `a`, without weight, and makes the weights of all `len` numbers from `first` on.
    #[inline(always)]
    fn weigh<U: Lanes<E = f64>>(
        &self,
        a: usize,
        (found, len): (usize, usize),
        (first, list): (usize, &mut PairChunk<E>),
    ) {
        list.ids[first + found..first + len].fill(a as u32);
        list.r2[found..len].fill(0.0);
        let mut volumes = [0.0; MOST_LANES];
        for at in (0..len).step_by(U::N) {
            for (l, volume) in volumes.iter_mut().enumerate().take(U::N) {
                *volume = self.volume[list.ids[first + at + l] as usize];
            }
            // SAFETY: `len` is a multiple of the lanes, the list has room for it, and volumes hold any lanes.
            unsafe {
                let r = U::load(list.r2.as_ptr().add(at)).sqrt();
                let over_r = U::select(U::zero().lt(r), U::one() / r, U::zero());
                let w = self.kernel.dw(r) * over_r * U::load(volumes.as_ptr());
                E::put(w, list.w.as_mut_ptr().add(first + at));
                over_r.store_single(list.over_r.as_mut_ptr().add(first + at));
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
        let lanes = K::Listed::N;
        let (mut first, mut cell, mut near) = (0, None, Near::none());
        for a in chunk.first..chunk.end {
            // Neighbours in the order of particles mostly share their cell.
            if cell != Some(self.grid.cell_of(a)) {
                cell = Some(self.grid.cell_of(a));
                near = self.grid.near(self.x.map(|column| column[a]));
            }
            let most = near.candidates() + 2 * MOST_LANES;
            list.room(first + most, most);
            let found = self.find::<K::Point>(a, &near, (first, list));
            let found = self.sift(a, found, (first, list));
            let len = found.next_multiple_of(lanes);
            self.weigh::<K::Point>(a, (found, len), (first, list));
            first += len;
            list.start.push((first / lanes) as u32);
            list.pairs += found as u64;
            if (found as u32) < list.loneliest.1 {
                list.loneliest = (a as u32, found as u32);
            }
            if self.pairs.fetch_add(found as u64, Ordering::Relaxed) > MOST_PAIRS {
                break;
            }
        }
    }
}
