//! Particles sorted into cells.
//!
//! ```text
//!  2D, around o:  |   |   |   |   |   |     lines of cells go down: a cell is a little wider than the search radius, and an eighth of that
//!                 |   |###|###|###|   |     long (drawn: a half). So all that is near a point lies in three lines of 17 cells (3D: nine
//!                 |   |###|###|###|   |     lines), each of which is one range of slots, 29 % shorter than three cells as long as they are
//!                 |   |###|# o|###|   |     wide.
//!                 |   |###|###|###|   |
//!                 |   |###|###|###|   |
//!                 |   |   |   |   |   |
//! ```
//!
//! The grid is folded: cell `c` of an axis is stored in row `c mod rows`. Where the particles' extent asks for
//! no more rows than there are, folding changes nothing; where it asks for too many (one particle flung far
//! away), distant cells share a place and the distance test tells them apart. Memory is thus bounded by the
//! number of particles, never by where they are. At least three rows per axis (17 along the last) keep the cells around a
//! point apart.

use std::ops::Range;

use rayon::prelude::*;

use super::error::{self, SearchError};
use super::extent::{floor, range};
use crate::math::MOST_LANES;

/// Cells along the last axis to one along the others.
const SLICES: usize = 8;
/// Cells wider than the radius by this share, so that the rounding of a cell number cannot move two particles
/// within the radius more than one cell (or [`SLICES`]) apart.
const MARGIN: f64 = 1e-4;
/// Whole cells along the extent at most: cell numbers are then rounded by less than 3 * 2^-53 * 2^36 < 0.3 MARGIN.
const FINEST: f64 = (1_u64 << 36) as f64;
/// Cells per particle at most,
const CELLS_PER_PARTICLE: usize = 4;
/// but so many are always granted.
const FEW_CELLS: usize = 1 << 10;
/// Particles handed to a thread at a time.
const CHUNK: usize = 1 << 14;

/// Particles binned into cells of the search radius; the buffers are reused from one build to the next.
///
/// A particle's place in the sorted order is its slot. Within a cell, slots ascend with the particle.
#[derive(Debug, Clone)]
pub struct CellGrid<const D: usize> {
    radius: f64,
    origin: [f64; D],
    cells_per_metre: [f64; D],
    rows: [usize; D],
    folded: [bool; D],
    cell: Vec<u32>,
    start: Vec<u32>,
    id: Vec<u32>,
    x: [Vec<f64>; D],
}

/// The cells around a point: lines of them, and which of each line. [`CellGrid::ranges`] makes ranges of slots of it.
#[derive(Debug, Clone)]
pub struct Near {
    /// The first cell of each line.
    lines: [u32; 9],
    len: usize,
    /// Which cells of a line, as one range or two.
    along: [(u32, u32); 2],
}

impl<const D: usize> CellGrid<D> {
    /// An empty grid.
    pub fn new() -> Self {
        const { assert!(D >= 1 && D <= 3, "a grid has one, two or three axes") };
        Self {
            radius: 1.0,
            origin: [0.0; D],
            cells_per_metre: [1.0; D],
            rows: least(),
            folded: [false; D],
            cell: Vec::new(),
            start: vec![0; least::<D>().iter().product::<usize>() + 2],
            id: Vec::new(),
            x: std::array::from_fn(|_| Vec::new()),
        }
    }

    /// Sorts the particles at `x` (columns, m) into cells for searches up to `radius` (m).
    ///
    /// # Errors
    /// A coordinate or radius that is not a usable number, columns of unequal length, 2^32 particles or more.
    /// The grid then keeps what it held.
    pub fn build(&mut self, x: [&[f64]; D], radius: f64) -> Result<(), SearchError> {
        self.bin(x, radius)?;
        self.gather(x);
        Ok(())
    }

    /// The same, but [`CellGrid::positions`] are not to be asked for.
    ///
    /// # Errors
    /// As [`CellGrid::build`].
    pub fn bin(&mut self, x: [&[f64]; D], radius: f64) -> Result<(), SearchError> {
        let n = error::particles(x)?;
        error::radius(radius)?;
        let ranges = x.map(range);
        if ranges.iter().any(|&(low, high)| !(-error::LARGEST <= low && high <= error::LARGEST)) {
            error::check_positions(x)?;
        }
        self.shape((ranges, n), radius);
        self.assign(x, n);
        self.sort(n);
        Ok(())
    }

    /// The radius the grid was built for, in m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Number of cells that are stored.
    pub fn cells(&self) -> usize {
        self.rows.iter().product()
    }

    /// The line of cells that a particle is in, and its cell on the line.
    #[inline(always)]
    pub fn cell_of(&self, particle: usize) -> (u32, u32) {
        let (cell, rows) = (self.cell[particle], self.rows[D - 1] as u32);
        (cell / rows, cell % rows)
    }

    /// The particle in each slot; behind them stand as many readable numbers as any type has lanes.
    pub fn ids(&self) -> &[u32] {
        &self.id[..self.cell.len()]
    }

    /// The position in each slot, as columns in m.
    pub fn positions(&self) -> [&[f64]; D] {
        std::array::from_fn(|axis| self.x[axis].as_slice())
    }

    /// Whether cells far apart may share a place.
    pub fn is_folded(&self) -> bool {
        self.folded.contains(&true)
    }

    /// The cells that hold everything within the radius of `point` (m).
    pub fn near(&self, point: [f64; D]) -> Near {
        let cell = self.cell_at(point);
        let mut near = Near { along: self.around(cell[D - 1]), ..Near::none() };
        for turn in 0..3_usize.pow(D as u32 - 1) {
            let (mut digits, mut line) = (turn, Some(0));
            for axis in 0..D - 1 {
                let row = self.row(axis, cell[axis] + (digits % 3) as i64 - 1);
                line = line.zip(row).map(|(line, row)| line * self.rows[axis] + row);
                digits /= 3;
            }
            if let Some(line) = line {
                near.lines[near.len] = (line * self.rows[D - 1]) as u32;
                near.len += 1;
            }
        }
        near
    }

    /// Moves `near` to another cell of the same line.
    #[inline(always)]
    pub fn slide(&self, near: &mut Near, cell: u32) {
        near.along = self.around(i64::from(cell));
    }

    /// The slots in part `part` of the cells of `near`, below [`Near::parts`]. In all, each slot comes at most once, always in the same
    /// order.
    #[inline(always)]
    pub fn range(&self, near: &Near, part: usize) -> Range<usize> {
        let (first, (from, end)) = (near.lines[part / 2], near.along[part % 2]);
        self.start[(first + from) as usize] as usize..self.start[(first + end) as usize] as usize
    }

    /// All of them.
    pub fn ranges<'a>(&'a self, near: &'a Near) -> impl Iterator<Item = Range<usize>> + 'a {
        (0..near.parts()).map(|part| self.range(near, part))
    }

    /// Where a cell of an axis is stored; nowhere, if it is beyond the particles.
    #[inline(always)]
    fn row(&self, axis: usize, cell: i64) -> Option<usize> {
        let rows = self.rows[axis] as i64;
        if (0..rows).contains(&cell) {
            Some(cell as usize)
        } else if self.folded[axis] {
            Some(cell.rem_euclid(rows) as usize)
        } else {
            None
        }
    }

    /// Where the cells around `middle` are stored on a line, as ranges.
    #[inline(always)]
    fn around(&self, middle: i64) -> [(u32, u32); 2] {
        let (rows, reach) = (self.rows[D - 1] as i64, SLICES as i64);
        let (from, end) = (middle - reach, middle + reach + 1);
        if !self.folded[D - 1] {
            return [(from.clamp(0, rows) as u32, end.clamp(0, rows) as u32), (0, 0)];
        }
        let from = from.rem_euclid(rows);
        let end = from + 2 * reach + 1;
        [(from as u32, end.min(rows) as u32), (0, (end - rows).max(0) as u32)]
    }

    /// Chooses origin, cell size and the number of rows per axis.
    fn shape(&mut self, (ranges, n): ([(f64, f64); D], usize), radius: f64) {
        self.origin = ranges.map(|(low, _)| if low.is_finite() { low } else { 0.0 });
        let extent = ranges.map(|(low, high)| (high - low).max(0.0));
        let longest = extent.iter().copied().fold(0.0, f64::max);
        let size = (radius * (1.0 + MARGIN)).max(longest / FINEST);
        self.radius = radius;
        let most = (CELLS_PER_PARTICLE * n).clamp(FEW_CELLS, 1 << 31);
        let sizes: [f64; D] =
            std::array::from_fn(|axis| size / if axis + 1 == D { SLICES as f64 } else { 1.0 });
        let wanted: [usize; D] = std::array::from_fn(|axis| (extent[axis] / sizes[axis]) as usize + 1);
        self.cells_per_metre = sizes.map(|size| 1.0 / size);
        self.rows = fold(wanted, most);
        // One more, in case that the rounding of a cell number disagrees with that of the extent.
        self.folded = std::array::from_fn(|axis| wanted[axis] + 1 > self.rows[axis]);
    }

    /// Finds the cell of every particle.
    fn assign(&mut self, x: [&[f64]; D], n: usize) {
        let mut cell = std::mem::take(&mut self.cell);
        cell.resize(n, 0);
        cell.par_chunks_mut(CHUNK).enumerate().for_each(|(k, chunk)| {
            for (offset, cell) in chunk.iter_mut().enumerate() {
                let place = self.place(x.map(|column| column[k * CHUNK + offset]));
                *cell = (0..D).fold(0, |line, axis| line * self.rows[axis] + place[axis]) as u32;
            }
        });
        self.cell = cell;
    }

    /// Counting sort by cell. Counts stand two places ahead, so that each entry of `start`, advanced by one per
    /// particle placed, ends up as the start of the cell it belongs to.
    fn sort(&mut self, n: usize) {
        self.start.clear();
        self.start.resize(self.cells() + 2, 0);
        for &cell in &self.cell {
            self.start[cell as usize + 2] += 1;
        }
        let mut sum = 0;
        for count in &mut self.start {
            sum += *count;
            *count = sum;
        }
        self.id.resize(n + MOST_LANES, 0);
        self.id[n..].fill(0);
        for (a, &cell) in self.cell.iter().enumerate() {
            let next = &mut self.start[cell as usize + 1];
            self.id[*next as usize] = a as u32;
            *next += 1;
        }
    }

    /// Copies the positions into the order of the slots.
    fn gather(&mut self, x: [&[f64]; D]) {
        for (sorted, column) in self.x.iter_mut().zip(x) {
            sorted.resize(column.len(), 0.0);
            let slots = sorted.par_chunks_mut(CHUNK).zip(self.id[..column.len()].par_chunks(CHUNK));
            slots.for_each(|(sorted, ids)| {
                for (x, &a) in sorted.iter_mut().zip(ids) {
                    *x = column[a as usize];
                }
            });
        }
    }

    /// The cell of a point along each axis.
    #[inline(always)]
    fn cell_at(&self, point: [f64; D]) -> [i64; D] {
        std::array::from_fn(|axis| floor((point[axis] - self.origin[axis]) * self.cells_per_metre[axis]))
    }

    /// Where the cell of a point is stored along each axis.
    fn place(&self, point: [f64; D]) -> [usize; D] {
        let cell = self.cell_at(point);
        std::array::from_fn(|axis| {
            let rows = self.rows[axis] as i64;
            (if (0..rows).contains(&cell[axis]) { cell[axis] } else { cell[axis].rem_euclid(rows) }) as usize
        })
    }
}

impl<const D: usize> Default for CellGrid<D> {
    fn default() -> Self {
        Self::new()
    }
}

impl Near {
    /// Nothing.
    pub const fn none() -> Self {
        Self { lines: [0; 9], len: 0, along: [(0, 0); 2] }
    }

    /// Number of parts, each of which is a range of slots, maybe empty: two for each line, because it may go round.
    #[inline(always)]
    pub const fn parts(&self) -> usize {
        2 * self.len
    }
}

/// Least number of rows per axis.
fn least<const D: usize>() -> [usize; D] {
    std::array::from_fn(|axis| if axis + 1 == D { 2 * SLICES + 1 } else { 3 })
}

/// Number of rows to store per axis where the extent asks for `wanted`: no fewer than [`least`], in all about `most` or less.
fn fold<const D: usize>(wanted: [usize; D], most: usize) -> [usize; D] {
    let least = least::<D>();
    let mut rows: [usize; D] =
        std::array::from_fn(|axis| wanted[axis].saturating_add(1).clamp(least[axis], most.max(least[axis])));
    while rows.iter().map(|&count| count as f64).product::<f64>() > most as f64 {
        let ratio = |axis: usize| rows[axis] as f64 / least[axis] as f64;
        let longest = (0..D).fold(0, |best, axis| if ratio(axis) > ratio(best) { axis } else { best });
        if rows[longest] == least[longest] {
            break;
        }
        rows[longest] = (rows[longest] / 2).max(least[longest]);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_hold_every_particle_once_and_ascend_within_a_cell() {
        let x = [[0.5, 3.5, 0.6, 9.0, 0.4].as_slice(), &[0.0; 5]];
        let mut grid = CellGrid::new();
        grid.build(x, 1.0).unwrap();
        assert_eq!(grid.ids(), [0, 2, 4, 1, 3]);
        assert_eq!(grid.positions()[0], [0.5, 0.6, 0.4, 3.5, 9.0]);
    }

    #[test]
    fn memory_is_bounded_by_the_number_of_particles() {
        let n = 1000;
        let mut x: Vec<f64> = (0..n).map(f64::from).collect();
        x[7] = 1e140;
        x[8] = -1e9;
        let mut grid = CellGrid::new();
        grid.build([&x, &x, &x], 1.0).unwrap();
        assert!(grid.cells() <= CELLS_PER_PARTICLE * n as usize, "{} cells", grid.cells());
    }

    #[test]
    fn three_and_seventeen_rows_at_least_and_halving_the_longest() {
        assert_eq!(fold([1, 1], 4), [3, 17]);
        assert_eq!(fold([999, 19, 159], 2_800_000), [500, 20, 160]);
    }

    #[test]
    fn refuses_what_is_not_a_number() {
        let mut grid = CellGrid::new();
        let column = [0.0, 1.0, f64::NAN];
        let error = grid.build([&[0.0; 3], &column], 1.0).unwrap_err();
        assert!(matches!(error, SearchError::Position { particle: 2, axis: 1, .. }), "{error}");
        assert!(matches!(grid.build([&[f64::INFINITY]; 2], 1.0), Err(SearchError::Position { .. })));
        assert_eq!(grid.build([&[0.0]; 2], 0.0), Err(SearchError::Radius(0.0)));
        assert!(matches!(grid.build([&[0.0]; 2], f64::NAN), Err(SearchError::Radius(_))));
        assert!(matches!(grid.build([&[0.0], &[]], 1.0), Err(SearchError::Length { found: 0, .. })));
    }
}
