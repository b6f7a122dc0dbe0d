//! Particles as columns: one array for every number of every field, in an order in which neighbours are near each other.

mod lines;

pub(crate) use lines::{Lines, Plain};

use crate::field::{Quantity, Record};
use crate::math::Vector;

/// Free numbers before the first and after the last particle of a column: lanes may be read beyond the ends.
pub(crate) const GUARD: usize = 16;

/// Distance of two columns, in numbers: at least the particles and the guard, and 320 bytes off a multiple of 4096, because
/// columns that are walked together must not share the same few lines of the first cache (measured: 1.2 to 1.8 times). Every column
/// begins at a cache line.
pub(crate) const fn stride(len: usize) -> usize {
    let least = len + 2 * GUARD;
    least + (512 + 40 - least % 512) % 512
}

/// A set of particles. Fields are added once, at the start; their numbers then stay where they are, only
/// [`Particles::reorder`] permutes them. Ids are stable: output does not depend on the order.
///
/// ```text
/// | guard | X_x of all particles | guard, stagger | X_y of all particles | guard, stagger | ...
/// ```
#[derive(Clone, Debug)]
pub struct Particles<const D: usize> {
    len: usize,
    ids: Vec<u32>,
    /// Where each id is stored.
    stored: Vec<u32>,
    first: Vec<Option<usize>>,
    /// How many columns.
    columns: usize,
    /// All columns in one piece.
    data: Lines<f64>,
    scratch: Vec<f64>,
}

impl<const D: usize> Particles<D> {
    /// `len` particles with ids 0, 1, ... and no fields yet.
    #[must_use]
    pub fn new(len: usize) -> Self {
        Self {
            len,
            ids: (0..len as u32).collect(),
            stored: (0..len as u32).collect(),
            first: vec![None; Quantity::ALL.len()],
            columns: 0,
            data: Lines::default(),
            scratch: Vec::new(),
        }
    }

    /// How many particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no particle.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The stable id of the particle that is stored at each place.
    #[must_use]
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }

    /// The place where the particle of an id is stored. Places change when particles are reordered; ids do not.
    #[must_use]
    pub fn stored(&self, id: usize) -> usize {
        self.stored[id] as usize
    }

    /// Adds a field, all zero; a field that is there already stays as it is.
    pub fn add(&mut self, field: Quantity) {
        if self.first[field as usize].is_none() {
            self.first[field as usize] = Some(self.columns);
            self.columns += field.rank().words(D);
            self.data.resize(self.columns * stride(self.len) + GUARD);
        }
    }

    /// Whether the field is there.
    #[must_use]
    pub fn has(&self, field: Quantity) -> bool {
        self.first[field as usize].is_some()
    }

    /// Index of the first column of a field.
    ///
    /// # Panics
    /// If nobody added the field: a pass reads what no formulation declared, which is a programming error.
    #[must_use]
    pub fn place(&self, field: Quantity) -> usize {
        let Some(first) = self.first[field as usize] else {
            panic!("a pass asks for {}, which this formulation does not carry", field.name());
        };
        first
    }

    /// Calls `f(k, column)` for every number `k` of record `R`, where `column` is the index of its column.
    pub fn each_column<R: Record<D>>(&self, mut f: impl FnMut(usize, usize)) {
        let mut k = 0;
        for &field in R::FIELDS {
            let first = self.place(field);
            for w in 0..field.rank().words(D) {
                f(k, first + w);
                k += 1;
            }
        }
    }

    /// One number of a field, for all particles; `word` counts rows first.
    #[must_use]
    pub fn column(&self, field: Quantity, word: usize) -> &[f64] {
        self.nth(self.place(field) + word)
    }

    /// One number of a field, to write.
    pub fn column_mut(&mut self, field: Quantity, word: usize) -> &mut [f64] {
        let place = self.place(field);
        self.nth_mut(place + word)
    }

    /// The components of a vector field.
    #[must_use]
    pub fn vector(&self, field: Quantity) -> [&[f64]; D] {
        std::array::from_fn(|i| self.column(field, i))
    }

    /// The vector at one place.
    #[must_use]
    pub fn vector_at(&self, field: Quantity, place: usize) -> Vector<f64, D> {
        Vector(std::array::from_fn(|i| self.column(field, i)[place]))
    }

    /// Sets the vector at one place.
    pub fn set_vector(&mut self, field: Quantity, place: usize, value: Vector<f64, D>) {
        for i in 0..D {
            self.column_mut(field, i)[place] = value[i];
        }
    }

    /// How many columns.
    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    /// Column number `k`, as [`Particles::place`] counts them.
    pub(crate) fn nth(&self, k: usize) -> &[f64] {
        let first = GUARD + k * stride(self.len);
        &self.data[first..first + self.len]
    }

    /// Column number `k`, to write.
    pub(crate) fn nth_mut(&mut self, k: usize) -> &mut [f64] {
        let first = GUARD + k * stride(self.len);
        &mut self.data[first..first + self.len]
    }

    /// The first number of column `k`; the columns follow each other, and up to sixteen numbers before and after each
    /// may be read.
    pub(crate) fn nth_ptr(&mut self, k: usize) -> *mut f64 {
        let first = GUARD + k * stride(self.len);
        debug_assert!(first + self.len + GUARD <= self.data.len());
        // SAFETY: column `k` exists, so its first number is inside `data` (or one past the end of an empty one).
        unsafe { self.data.as_mut_ptr().add(first) }
    }

    /// Puts the particles in a new order: place `i` then holds what stood at `order[i]`.
    pub fn reorder(&mut self, order: &[u32]) {
        debug_assert_eq!(order.len(), self.len);
        let mut scratch = std::mem::take(&mut self.scratch);
        scratch.resize(self.len, 0.0);
        for k in 0..self.columns {
            let column = self.nth_mut(k);
            for (to, &from) in scratch.iter_mut().zip(order) {
                *to = column[from as usize];
            }
            column.copy_from_slice(&scratch);
        }
        self.scratch = scratch;
        self.ids = order.iter().map(|&from| self.ids[from as usize]).collect();
        for (place, &id) in self.ids.iter().enumerate() {
            self.stored[id as usize] = place as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reordering_moves_fields_and_ids_together() {
        let mut p = Particles::<2>::new(4);
        p.add(Quantity::Velocity);
        for i in 0..4 {
            p.set_vector(Quantity::Velocity, i, Vector([i as f64, -(i as f64)]));
        }
        p.reorder(&[2, 0, 3, 1]);
        assert_eq!(p.ids(), [2, 0, 3, 1]);
        assert_eq!([0, 1, 2, 3].map(|id| p.stored(id)), [1, 3, 0, 2]);
        assert_eq!(p.column(Quantity::Velocity, 1), [-2.0, 0.0, -3.0, -1.0]);
        p.reorder(&[1, 3, 0, 2]);
        assert_eq!(p.ids(), [0, 1, 2, 3]);
    }

    #[test]
    #[should_panic(expected = "Density")]
    fn reading_a_field_that_nobody_wrote_is_caught() {
        let _ = Particles::<3>::new(1).column(Quantity::Density, 0);
    }
}
