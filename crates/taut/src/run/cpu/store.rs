//! The columns of a run, in one or two precisions.

use super::kit::Precision;
use super::places::{Column, PairPlaces, Places};
use crate::field::{Quantity, Record};
use crate::math::Element;
use crate::particles::{GUARD, Lines, Particles, stride};
use crate::run::Numbers;
use std::any::TypeId;
use std::marker::PhantomData;

/// Columns in double precision and, in a single run, beside them in single:
///
/// ```text
/// state (integrated in time)      f64 is right; f32 is a copy, kept only where pair sums read it
/// everything else                 f32 is right; f64 is what the set-up wrote
/// ```
#[derive(Debug)]
pub struct Store<const D: usize, P> {
    particles: Particles<D>,
    single: Lines<f32>,
    /// Whether the single column is in use, by column.
    used: Vec<bool>,
    precision: PhantomData<P>,
}

impl<const D: usize, P: Precision> Store<D, P> {
    /// Takes over particles.
    pub fn new(particles: Particles<D>) -> Self {
        Self { particles, single: Lines::default(), used: Vec::new(), precision: PhantomData }
    }

    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// The particles, to write; single copies are made anew.
    pub fn particles_mut(&mut self) -> &mut Particles<D> {
        if P::MIXED {
            for &field in Quantity::ALL {
                self.settle(field);
            }
            self.used.clear();
        }
        &mut self.particles
    }

    /// Whether the single column is the right one.
    fn is_single(&self, field: Quantity, column: usize) -> bool {
        P::MIXED && !field.is_state() && self.used.get(column).copied().unwrap_or(false)
    }

    fn at(&self, column: usize) -> usize {
        GUARD + column * stride(self.particles.len())
    }

    /// Makes the double column right.
    pub fn settle(&mut self, field: Quantity) {
        if !self.particles.has(field) {
            return;
        }
        for column in self.columns(field) {
            if self.is_single(field, column) {
                let first = self.at(column);
                let len = self.particles.len();
                for (to, &from) in
                    self.particles.nth_mut(column).iter_mut().zip(&self.single[first..first + len])
                {
                    *to = f64::from(from);
                }
            }
        }
    }

    fn columns(&self, field: Quantity) -> std::ops::Range<usize> {
        let first = self.particles.place(field);
        first..first + field.rank().words(D)
    }

    /// The single column, made from the double one when first asked for.
    fn single_column(&mut self, column: usize) -> *mut f32 {
        let first = self.at(column);
        let len = self.particles.len();
        if self.used.len() <= column {
            self.used.resize(column + 1, false);
        }
        let room = first + stride(len);
        if self.single.len() < room {
            self.single.resize(room);
        }
        if !self.used[column] {
            self.used[column] = true;
            for (to, &from) in self.single[first..first + len].iter_mut().zip(self.particles.nth(column)) {
                *to = from as f32;
            }
        }
        // SAFETY: `first` is inside the buffer.
        unsafe { self.single.as_mut_ptr().add(first) }
    }

    /// Where an update finds a number.
    fn column(&mut self, field: Quantity, word: usize) -> Column {
        let column = self.particles.place(field) + word;
        let double = self.particles.nth_ptr(column);
        match (P::MIXED, field.is_state()) {
            (false, _) => Column { double, single: std::ptr::null_mut(), shared: false },
            (true, false) => {
                Column { double: std::ptr::null_mut(), single: self.single_column(column), shared: false }
            }
            (true, true) => {
                let copied = self.used.get(column).copied().unwrap_or(false);
                let single = if copied { self.single_column(column) } else { std::ptr::null_mut() };
                Column { double, single, shared: false }
            }
        }
    }

    /// The columns of an update's record; `shared` says which fields are read at the home of a block.
    pub fn places<R: Record<D>>(&mut self, shared: impl Fn(Quantity) -> bool) -> Places {
        self.room();
        Places::of::<R, D>(|field, word| Column { shared: shared(field), ..self.column(field, word) })
    }

    /// Where a pair sum finds a number.
    pub fn pair_column(&mut self, field: Quantity, word: usize) -> *mut P::E {
        self.room();
        let column = self.particles.place(field) + word;
        if TypeId::of::<P::E>() == TypeId::of::<f32>() {
            self.single_column(column).cast()
        } else {
            self.particles.nth_ptr(column).cast()
        }
    }

    /// The columns of a pair sum's record.
    pub fn pair_places<R: Record<D>>(&mut self) -> PairPlaces<P::E> {
        PairPlaces::of::<R, D>(|field, word| self.pair_column(field, word))
    }

    /// Makes the single buffer large enough for all columns at once, so that it never moves while pointers to it are alive.
    fn room(&mut self) {
        if P::MIXED {
            let all = GUARD + self.particles.columns() * stride(self.particles.len());
            if self.single.len() < all + GUARD {
                self.single.resize(all + GUARD);
            }
        }
    }

    /// One number of all particles, whichever precision it is kept in.
    pub fn numbers(&self, field: Quantity, word: usize) -> Numbers<'_> {
        let column = self.particles.place(field) + word;
        if self.is_single(field, column) {
            let first = self.at(column);
            Numbers::Single(&self.single[first..first + self.particles.len()])
        } else {
            Numbers::Double(self.particles.nth(column))
        }
    }

    /// One number, whichever precision it is kept in.
    pub fn word(&self, field: Quantity, word: usize, place: usize) -> f64 {
        let column = self.particles.place(field) + word;
        if self.is_single(field, column) {
            self.single[self.at(column) + place].to_f64()
        } else {
            self.particles.nth(column)[place]
        }
    }

    /// Sets one number, in all precisions it is kept in.
    pub fn set_word(&mut self, field: Quantity, word: usize, (place, value): (usize, f64)) {
        let column = self.particles.place(field) + word;
        self.particles.nth_mut(column)[place] = value;
        if self.used.get(column).copied().unwrap_or(false) {
            let at = self.at(column) + place;
            self.single[at] = value as f32;
        }
    }
}
