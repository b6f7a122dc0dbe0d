//! How far bodies are apart.

use taut::neighbours::{Adjacency, Search, SearchError};

/// The smallest distance between particles of two bodies, and room for the work.
///
/// Only particles near the bounding box of another body are looked at: most of a run, nobody is.
#[derive(Debug)]
pub struct Gap<const D: usize> {
    body: Vec<u32>,
    bodies: usize,
    reach: f64,
    near: Vec<usize>,
    columns: [Vec<f64>; D],
    search: Search<D>,
    pairs: Adjacency,
}

/// A bounding box: smallest and largest coordinates, m.
type Bounds<const D: usize> = [[f64; 2]; D];

impl<const D: usize> Gap<D> {
    /// For particles of these bodies; gaps from `reach` (m) on do not count.
    pub fn new(body: Vec<u32>, reach: f64) -> Self {
        let bodies = body.iter().max().map_or(0, |&last| last as usize + 1);
        let columns = std::array::from_fn(|_| Vec::new());
        Self {
            body,
            bodies,
            reach,
            near: Vec::new(),
            columns,
            search: Search::new(),
            pairs: Adjacency::default(),
        }
    }

    /// The smallest distance between particles of two bodies, m, at positions `x`.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn smallest(&mut self, x: [&[f64]; D]) -> Result<Option<f64>, SearchError> {
        self.select(x);
        if self.near.is_empty() {
            return Ok(None);
        }
        for (column, x) in self.columns.iter_mut().zip(x) {
            column.clear();
            column.extend(self.near.iter().map(|&i| x[i]));
        }
        let near: [&[f64]; D] = std::array::from_fn(|i| self.columns[i].as_slice());
        self.search.pairs(near, self.reach, None, &mut self.pairs)?;
        let square = |a: usize, b: usize| -> f64 { near.iter().map(|c| (c[a] - c[b]).powi(2)).sum() };
        let of = |a: usize| self.body[self.near[a]];
        let between =
            |a: usize| self.pairs.of(a).iter().map(|&b| b as usize).filter(move |&b| of(b) != of(a));
        let squares = (0..self.near.len()).flat_map(|a| between(a).map(move |b| square(a, b)));
        Ok(squares.min_by(f64::total_cmp).map(f64::sqrt))
    }

    /// Notes the particles that are within reach of the box of another body.
    fn select(&mut self, x: [&[f64]; D]) {
        self.near.clear();
        if self.bodies < 2 {
            return;
        }
        let bounds = self.bounds(x);
        let within = |i: usize, bounds: &Bounds<D>| {
            (0..D).all(|k| x[k][i] >= bounds[k][0] - self.reach && x[k][i] <= bounds[k][1] + self.reach)
        };
        let meets = |i: usize| {
            let mine = self.body[i] as usize;
            bounds.iter().enumerate().any(|(b, bounds)| b != mine && within(i, bounds))
        };
        self.near = (0..self.body.len()).filter(|&i| meets(i)).collect();
    }

    fn bounds(&self, x: [&[f64]; D]) -> Vec<Bounds<D>> {
        let mut bounds = vec![[[f64::INFINITY, f64::NEG_INFINITY]; D]; self.bodies];
        for (i, &body) in self.body.iter().enumerate() {
            for (range, x) in bounds[body as usize].iter_mut().zip(x) {
                *range = [range[0].min(x[i]), range[1].max(x[i])];
            }
        }
        bounds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_is_that_of_all_pairs_and_counts_within_reach_only() {
        // Two rows of particles, the second higher by a gap and to the right.
        let row = |n: u32, x0: f64| (0..n).map(move |i| x0 + f64::from(i));
        let x: Vec<f64> = row(10, 0.0).chain(row(10, 9.3)).collect();
        let body: Vec<u32> = (0..20).map(|i| i / 10).collect();
        let mut gap = Gap::<2>::new(body, 2.0);
        for (height, expected) in [(0.4, Some(0.5)), (1.2, Some((0.09_f64 + 1.44).sqrt())), (1.999, None)] {
            let y: Vec<f64> = (0..20).map(|i| if i < 10 { 0.0 } else { height }).collect();
            let found = gap.smallest([&x, &y]).expect("numbers");
            assert_eq!(found.is_some(), expected.is_some(), "{height}");
            // Roundings of coordinates up to 20.
            assert!((found.unwrap_or(0.0) - expected.unwrap_or(0.0)).abs() < 1e-14, "{height}: {found:?}");
        }
        let mut lone = Gap::<2>::new(vec![0; 20], 2.0);
        assert_eq!(lone.smallest([&x, &x]).expect("numbers"), None);
    }
}
