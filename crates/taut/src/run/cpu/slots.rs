//! Places of particles in the order of the cells they are found in, so that candidates are read without indices.
//!
//! ```text
//! slots of the grid:   | cell 0: a3 a7 | cell 1: a0 | cell 2: a1 a4 a9 | ...
//! x                    |      x3 x7    |      x0    |      x1 x4 x9    | ...   one column for each axis
//! ```
//!
//! A number is a coordinate on the fine grid of the list (see [`super::list`]), 32 bits that lanes of single precision only move: their differences
//! are exact, so both sides of a pair find the same distance, and twice as many go side by side as in double precision.

use crate::math::{Element, MOST_LANES};
use crate::particles::Lines;
use rayon::prelude::*;

/// Slots that a thread takes at a time.
const CHUNK: usize = 1 << 12;

/// The places by slot.
#[derive(Debug)]
pub struct Slots<const D: usize> {
    columns: [Lines<f32>; D],
}

impl<const D: usize> Default for Slots<D> {
    fn default() -> Self {
        Self { columns: std::array::from_fn(|_| Lines::default()) }
    }
}

impl<const D: usize> Slots<D> {
    /// Fills the columns; `ids` are the particles by slot, `place` knows the coordinates of each.
    pub fn fill(&mut self, ids: &[u32], place: impl Fn(usize) -> [u32; D] + Sync) {
        for (axis, column) in self.columns.iter_mut().enumerate() {
            column.resize(ids.len() + MOST_LANES);
            let chunks = column[..ids.len()].par_chunks_mut(CHUNK).zip(ids.par_chunks(CHUNK));
            chunks.for_each(|(column, ids)| {
                for (x, &a) in column.iter_mut().zip(ids) {
                    *x = f32::packed(&[place(a as usize)[axis]]);
                }
            });
        }
    }

    /// The column of an axis from a slot on; behind the last stand as many readable numbers as any type has lanes.
    ///
    /// # Safety
    /// There is such a slot.
    #[inline(always)]
    pub unsafe fn from(&self, axis: usize, slot: usize) -> *const f32 {
        debug_assert!(slot + MOST_LANES <= self.columns[axis].len());
        // SAFETY: the caller's promise.
        unsafe { self.columns[axis].as_ptr().add(slot) }
    }
}
