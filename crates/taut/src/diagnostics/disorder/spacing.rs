//! The closest pair of particles, whatever their bodies.

use rayon::prelude::*;

use super::CHUNK;
use super::bonds::spacing;
use crate::neighbours::{CellGrid, Near, SearchError};

/// Range of radii to search in, in m: closer particles coincide, further ones cannot be told apart.
const RADII: (f64, f64) = (1e-149, 1e149);

/// Smallest |x_ij| in spacings over all pairs; infinite if there is none.
///
/// `known` is the same over some of the pairs, infinite if over none: no pair further apart needs a look.
pub(super) fn smallest<const D: usize>(
    grid: &mut CellGrid<D>,
    x: [&[f64]; D],
    dp: &[f64],
    known: f64,
) -> Result<f64, SearchError> {
    let known = (1..dp.len()).fold(known, |known, i| known.min(ratio(x, dp, i - 1, i)));
    let radius = known * dp.iter().copied().fold(0.0, f64::max);
    if dp.len() < 2 || radius < RADII.0 {
        return Ok(known);
    }
    grid.build(x, radius.min(RADII.1))?;
    let (grid, n) = (&*grid, dp.len());
    let nearest = if dp.iter().all(|unit| *unit == dp[0]) { nearest_alike } else { nearest };
    let chunks = (0..n.div_ceil(CHUNK)).into_par_iter();
    let closest = chunks.map(|k| (k * CHUNK..n.min((k + 1) * CHUNK)).map(|slot| nearest(grid, dp, slot)));
    Ok(closest.map(|found| found.fold(known, f64::min)).reduce(|| known, f64::min))
}

/// Smallest |x_ij| in spacings between the particle in `slot` and those near it in later slots, which find the others.
fn nearest<const D: usize>(grid: &CellGrid<D>, dp: &[f64], slot: usize) -> f64 {
    let (x, ids, near) = (grid.positions(), grid.ids(), around(grid, slot));
    let squares = later(grid, &near, slot).map(|other| {
        let unit = spacing(dp, ids[slot] as usize, ids[other] as usize);
        square(x, slot, other) / (unit * unit)
    });
    squares.fold(f64::INFINITY, f64::min).sqrt()
}

/// The same where all have one spacing.
fn nearest_alike<const D: usize>(grid: &CellGrid<D>, dp: &[f64], slot: usize) -> f64 {
    let (x, near) = (grid.positions(), around(grid, slot));
    let squares = later(grid, &near, slot).map(|other| square(x, slot, other));
    squares.fold(f64::INFINITY, f64::min).sqrt() / dp[0]
}

/// The cells around a slot.
fn around<const D: usize>(grid: &CellGrid<D>, slot: usize) -> Near {
    grid.near(grid.positions().map(|column| column[slot]))
}

/// Slots after this one, in the cells around it.
fn later<'a, const D: usize>(
    grid: &'a CellGrid<D>,
    near: &'a Near,
    slot: usize,
) -> impl Iterator<Item = usize> + 'a {
    grid.ranges(near).flat_map(move |range| range.start.max(slot + 1)..range.end)
}

/// |x_ij|^2.
fn square<const D: usize>(x: [&[f64]; D], i: usize, j: usize) -> f64 {
    x.iter().fold(0.0, |sum, column| sum + (column[j] - column[i]).powi(2))
}

/// |x_ij| in spacings.
fn ratio<const D: usize>(x: [&[f64]; D], dp: &[f64], i: usize, j: usize) -> f64 {
    x.iter().fold(0.0, |sum, column| sum + (column[j] - column[i]).powi(2)).sqrt() / spacing(dp, i, j)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::sample;

    #[test]
    fn equals_the_search_over_all_pairs() {
        for seed in 0..20 {
            let columns = sample::random::<3>(400, seed);
            let x = sample::slices(&columns);
            let dp: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(1 + i % 5)).collect();
            let pairs = (0..400).flat_map(|i| (0..i).map(move |j| (i, j)));
            let expected = pairs.map(|(i, j)| ratio(x, &dp, i, j)).fold(f64::INFINITY, f64::min);
            let found = smallest(&mut CellGrid::new(), x, &dp, f64::INFINITY).unwrap();
            // The root of a quotient against the quotient of a root.
            assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected, "{found} for {expected}");
        }
    }

    #[test]
    fn finds_a_pair_hardly_closer_than_the_known_ones() {
        // The first particle sets the origin of the cells; the third and the last are 0.97 apart, and in cells
        // nine tenths as wide as the known distance they would be two cells apart.
        let x = [[0.0, 9.0, 0.85, 5.0, 1.82].as_slice(), &[50.0, 0.0, 0.0, 0.0, 0.0]];
        let found = smallest(&mut CellGrid::new(), x, &[1.0; 5], 1.0).unwrap();
        assert!((found - 0.97).abs() < 1e-15, "roundings of numbers below 2: {found}");
    }

    #[test]
    fn none_one_and_coincident() {
        let found = |x: &[f64]| {
            let dp = vec![2.0; x.len()];
            smallest(&mut CellGrid::new(), [x, &vec![0.0; x.len()]], &dp, f64::INFINITY).unwrap()
        };
        assert_eq!((found(&[]), found(&[1.0])), (f64::INFINITY, f64::INFINITY));
        assert_eq!((found(&[5.0, 9.0]), found(&[5.0, 9.0, 5.0])), (2.0, 0.0));
        assert_eq!(found(&[0.0, 1e149]), 5e148);
    }
}
