//! The order in which particles are stored: particles close in the order are close in space.
//!
//! ```text
//! tiles along a Hilbert curve:    1 -> 2        inside a tile, rows:    ---> ---> ---> (across the longest axis)
//!                                      |                               ---> ---> --->
//!                                 4 <- 3                               ---> ---> --->
//! ```
//!
//! Rows, because what a row of particles reads of its neighbours are rows too, which the hardware fetches ahead (measured: 1.1 times the
//! speed of the curve alone). Tiles, because the rows around a row must stay in the second cache.

use rayon::prelude::*;

use super::error::{self, SearchError};

/// Bits of the curve per axis; three axes fill 60 of the 64 bits of a key.
const BITS: u32 = 20;
/// Steps along a row, to a spacing.
const FINE: f64 = 16.0;

/// Spacings along the edge of a tile: five rows (2D) or layers (3D) of it, at a cache line or two for each particle, fill less
/// than half of a second cache of 1 MiB.
const fn edge(dimension: usize) -> f64 {
    if dimension == 2 { 256.0 } else { 24.0 }
}

/// Where a particle comes in the order.
type Key = (u64, u64);

/// Writes into `out` the particles in the order in which they are best stored: tiles along a Hilbert curve, and rows inside a
/// tile. Particles on the same step of a row keep their order. `x` are columns in m, D is 2 or 3, `spacing` (m) is that of the
/// particles, roughly.
///
/// # Errors
/// A coordinate that is not a usable number, columns of unequal length, 2^32 particles or more.
pub fn storage_order<const D: usize>(
    x: [&[f64]; D],
    spacing: f64,
    out: &mut Vec<u32>,
) -> Result<(), SearchError> {
    const { assert!(D == 2 || D == 3, "the curve lives in two or three dimensions") };
    let n = error::particles(x)?;
    error::check_positions(x)?;
    error::radius(spacing)?;
    let low = x.map(|column| column.iter().copied().fold(f64::INFINITY, f64::min));
    let high = x.map(|column| column.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let extent: [f64; D] = std::array::from_fn(|axis| high[axis] - low[axis]);
    let rows = Rows::new(low, extent, spacing);
    let keys: Vec<Key> = (0..n).into_par_iter().map(|a| rows.key(x.map(|column| column[a]))).collect();
    out.clear();
    out.extend(0..n as u32);
    out.par_sort_unstable_by_key(|&a| (keys[a as usize], a));
    Ok(())
}

/// How space is cut into tiles and rows.
struct Rows<const D: usize> {
    low: [f64; D],
    spacing: f64,
    /// Edge of a tile, m.
    tile: f64,
    /// The axes, the longest first: it runs slowest.
    axes: [usize; D],
}

impl<const D: usize> Rows<D> {
    fn new(low: [f64; D], extent: [f64; D], spacing: f64) -> Self {
        let mut axes: [usize; D] = std::array::from_fn(|axis| axis);
        axes.sort_by(|&i, &j| extent[j].total_cmp(&extent[i]));
        let longest = extent[axes[0]];
        // A particle flung far away makes tiles larger, not numbers too large.
        let tile = (edge(D) * spacing).max(longest / f64::from((1 << BITS) - 2));
        Self { low, spacing, tile, axes }
    }

    fn key(&self, x: [f64; D]) -> Key {
        // Half a spacing up, so that particles of a lattice do not stand on the borders of rows.
        let at = |axis: usize| x[axis] - self.low[axis] + 0.5 * self.spacing;
        let tile: [u32; D] = std::array::from_fn(|axis| (at(axis) / self.tile) as u32);
        let inside = |axis: usize| at(axis) - f64::from(tile[axis]) * self.tile;
        let fast = self.axes[D - 1];
        let row =
            self.axes[..D - 1].iter().fold(0, |row, &axis| row << 20 | (inside(axis) / self.spacing) as u64);
        (key(tile), row << 20 | (inside(fast) / self.spacing * FINE) as u64)
    }
}

/// How far along the curve a cell lies.
///
/// After J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707 (2004) 381: from the coarsest bit to
/// the finest, the turn and flip of the quadrant (octant) a cell lies in is undone for all finer bits; a Gray
/// code then numbers the quadrants.
fn key<const D: usize>(mut cell: [u32; D]) -> u64 {
    for level in (1..BITS).rev() {
        let finer = (1 << level) - 1;
        for axis in 0..D {
            if cell[axis] >> level & 1 == 1 {
                cell[0] ^= finer;
            } else {
                let differ = (cell[0] ^ cell[axis]) & finer;
                cell[0] ^= differ;
                cell[axis] ^= differ;
            }
        }
    }
    for axis in 1..D {
        cell[axis] ^= cell[axis - 1];
    }
    let odd = (1..BITS)
        .filter(|level| cell[D - 1] >> level & 1 == 1)
        .fold(0, |flips, level| flips ^ ((1 << level) - 1));
    let gray = cell.map(|bits| bits ^ odd);
    (0..BITS)
        .rev()
        .fold(0, |key, level| gray.iter().fold(key, |key, bits| key << 1 | u64::from(bits >> level & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::sample;

    /// Distances of consecutive cells of a full lattice, squared, along the curve.
    fn steps<const D: usize>(side: u32) -> Vec<u32> {
        let mut cells: Vec<[u32; D]> = (0..side.pow(D as u32))
            .map(|k| std::array::from_fn(|axis| k / side.pow(axis as u32) % side))
            .collect();
        cells.sort_by_key(|&cell| key(cell));
        let square = |a: [u32; D], b: [u32; D]| (0..D).map(|i| a[i].abs_diff(b[i]).pow(2)).sum();
        cells.windows(2).map(|pair| square(pair[0], pair[1])).collect()
    }

    #[test]
    fn consecutive_cells_of_the_curve_are_neighbours() {
        assert!(steps::<2>(32).iter().all(|&step| step == 1));
        assert!(steps::<3>(16).iter().all(|&step| step == 1));
    }

    #[test]
    fn a_tile_is_stored_row_by_row_across_its_longest_axis() {
        let columns = sample::lattice::<3>([6, 3, 4], 0.1);
        let x = sample::slices(&columns);
        let mut order = Vec::new();
        storage_order(x, 0.1, &mut order).unwrap();
        let steps = order.windows(2).map(|w| (x[0][w[1] as usize] - x[0][w[0] as usize]).abs());
        assert_eq!(steps.filter(|&step| step > 0.05).count(), 5, "one layer after the other along x");
        let along = order.windows(2).filter(|w| (x[2][w[1] as usize] - x[2][w[0] as usize]).abs() < 0.05);
        assert_eq!(along.count(), 6 * 4 * 2, "y, the shortest, runs fastest");
    }

    #[test]
    fn is_a_permutation_and_the_same_for_any_number_of_threads() {
        let columns = sample::random::<3>(5000, 11);
        let order = |threads| {
            let mut order = Vec::new();
            sample::on_threads(threads, || {
                storage_order(sample::slices(&columns), 0.01, &mut order).unwrap();
            });
            order
        };
        let one = order(1);
        assert_eq!(one, order(3));
        let mut sorted = one.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..5000));
        assert_ne!(one, sorted);
    }

    #[test]
    fn odd_positions() {
        let mut order = Vec::new();
        storage_order([&[2.0; 4], &[3.0; 4]], 1.0, &mut order).unwrap();
        assert_eq!(order, [0, 1, 2, 3], "coincident particles keep their order");
        storage_order::<2>([&[], &[]], 1.0, &mut order).unwrap();
        assert!(order.is_empty());
        storage_order([&[0.0, 1e30, 1.0], &[0.0; 3]], 1.0, &mut order).unwrap();
        assert_eq!(order.len(), 3, "a particle flung away");
        assert!(storage_order([&[0.0, f64::NAN], &[0.0, 0.0]], 1.0, &mut order).is_err());
        assert!(storage_order([&[0.0, 1.0], &[0.0, 0.0]], 0.0, &mut order).is_err());
    }
}
