//! Sweeps over pairs, one pair after the other, on several threads.
//!
//! ```text
//! cells wider than the support, in 3^D colours:    0 1 2 0 1 2 0 ...
//!                                                  2 0 1 2 0 1 2 ...   (drawn with fewer than there are)
//! ```
//!
//! A cell owns the pairs whose first particle is in it; they touch particles of the cell and of those around it, so cells of one colour have
//! nothing in common. Colours follow each other, cells of one colour go to threads, and inside a cell the order is fixed: the result is
//! bitwise the same for any number of threads, and for any instruction set.

use super::{Relist, Run};
use crate::field::{Record, Sink, Source};
use crate::neighbours::{Adjacency, Search, SearchError};
use crate::pass::PairSweep;
use rayon::prelude::*;
use std::ops::Range;

/// Cells wider than the support by this share, so that rounding cannot bring neighbours more than one cell apart.
const MARGIN: f64 = 1e-6;

/// A pair of a list.
#[derive(Clone, Copy, Debug)]
struct Coupled {
    a: u32,
    b: u32,
    /// W' / r, 1/m^(D+2).
    w: f64,
}

/// The pairs of a body whose neighbours never change, by colour and cell, and room for the records of its particles.
#[derive(Debug, Default)]
pub struct Sweeper {
    pairs: Vec<Coupled>,
    /// Pairs of each cell, colour by colour.
    colours: Vec<Vec<Range<usize>>>,
    rows: Vec<f64>,
}

/// A row of numbers.
struct Row<'a>(&'a mut [f64]);

impl Source<f64> for Row<'_> {
    fn get(&self, k: usize) -> f64 {
        self.0[k]
    }
}

impl Sink<f64> for Row<'_> {
    fn put(&mut self, k: usize, x: f64) {
        self.0[k] = x;
    }
}

/// Rows that several threads write, each its own.
struct Rows {
    first: *mut f64,
    width: usize,
}

// SAFETY: threads work on cells of one colour, which share no rows.
unsafe impl Sync for Rows {}

impl Rows {
    /// # Safety
    /// The row exists, and nobody else has it.
    #[allow(clippy::mut_from_ref, reason = "cells of one colour share no rows")]
    unsafe fn of(&self, a: u32) -> &mut [f64] {
        // SAFETY: the caller's promise.
        unsafe { std::slice::from_raw_parts_mut(self.first.add(a as usize * self.width), self.width) }
    }
}

/// The fields of a record in a run, number by number.
fn words<R: Record<D>, const D: usize>() -> impl Iterator<Item = (crate::field::Quantity, usize)> {
    R::FIELDS.iter().flat_map(|&field| (0..field.rank().words(D)).map(move |word| (field, word)))
}

impl Sweeper {
    /// The pairs of the particles of a run within the support of a kernel; neighbours of any body.
    ///
    /// # Errors
    /// If a position is not a number.
    pub fn new<const D: usize>(run: &impl Run<D>, how: &Relist) -> Result<Self, SearchError> {
        let (x, support) = (run.particles().vector(how.positions), how.kernel.support());
        let mut list = Adjacency::default();
        Search::new().pairs(x, support, None, &mut list)?;
        let low = x.map(|column| column.iter().copied().fold(f64::INFINITY, f64::min));
        let size = support * (1.0 + MARGIN);
        let cell =
            |a: usize| -> [i64; D] { std::array::from_fn(|i| ((x[i][a] - low[i]) / size).floor() as i64) };
        let colour = |cell: [i64; D]| cell.iter().fold(0, |sum, c| 3 * sum + (c % 3) as usize);
        let key = |a: u32| (colour(cell(a as usize)), cell(a as usize), a);
        let mut order: Vec<u32> = (0..x[0].len() as u32).collect();
        order.sort_by_cached_key(|&a| key(a));
        let mut new = Self { colours: vec![Vec::new(); 3_usize.pow(D as u32)], ..Self::default() };
        for members in order.chunk_by(|&a, &b| cell(a as usize) == cell(b as usize)) {
            let first = new.pairs.len();
            for &a in members {
                let mut others: Vec<u32> = list.of(a as usize).iter().copied().filter(|&b| b > a).collect();
                others.sort_unstable();
                new.pairs.extend(others.into_iter().map(|b| {
                    let r2 = (0..D).map(|i| (x[i][a as usize] - x[i][b as usize]).powi(2)).sum::<f64>();
                    let r = r2.sqrt();
                    Coupled { a, b, w: if r > 0.0 { how.kernel.dw(r) / r } else { 0.0 } }
                }));
            }
            new.colours[colour(cell(members[0] as usize))].push(first..new.pairs.len());
        }
        Ok(new)
    }

    /// One sweep forward and one backward: every pair twice.
    pub fn sweep<const D: usize, P: PairSweep<D>>(&mut self, run: &mut impl Run<D>, pass: &P) {
        let (given, width) = (P::Given::WORDS, P::Given::WORDS + P::State::WORDS);
        let len = run.particles().len();
        self.rows.resize(len * width, 0.0);
        for (k, (field, word)) in words::<P::Given, D>().chain(words::<P::State, D>()).enumerate() {
            (0..len).for_each(|a| self.rows[a * width + k] = run.word(field, word, a));
        }
        let rows = Rows { first: self.rows.as_mut_ptr(), width };
        for cells in &self.colours {
            cells.par_iter().for_each(|cell| {
                self.pairs[cell.clone()].iter().for_each(|pair| meet(&rows, pair, pass));
            });
        }
        for cells in self.colours.iter().rev() {
            cells.par_iter().for_each(|cell| {
                self.pairs[cell.clone()].iter().rev().for_each(|pair| meet(&rows, pair, pass));
            });
        }
        for (k, (field, word)) in words::<P::State, D>().enumerate() {
            (0..len).for_each(|a| run.set_word(field, word, (a, self.rows[a * width + given + k])));
        }
    }
}

/// The exchange of one pair.
fn meet<const D: usize, P: PairSweep<D>>(rows: &Rows, pair: &Coupled, pass: &P) {
    // SAFETY: a and b are different particles of cells that this thread has for itself.
    let (a, b) = unsafe { (rows.of(pair.a), rows.of(pair.b)) };
    let (given_a, state_a) = a.split_at_mut(P::Given::WORDS);
    let (given_b, state_b) = b.split_at_mut(P::Given::WORDS);
    let (given_a, given_b) = (P::Given::read(&Row(given_a)), P::Given::read(&Row(given_b)));
    let state = (P::State::read(&Row(state_a)), P::State::read(&Row(state_b)));
    let (new_a, new_b) = pass.exchange((&given_a, &given_b), state, pair.w);
    P::State::write(new_a, &mut Row(state_a));
    P::State::write(new_b, &mut Row(state_b));
}
