//! Recognising bodies that were born on a lattice: whole, cut, with holes, or turned.

use super::adjacency::Adjacency;
use super::error::SearchError;
use super::search::Search;
use crate::math::Vector;

/// How far a particle may stand off its lattice point, in spacings. Coordinates that were made by `origin + (i + 1/2) dp`, turned
/// or not, are off by less than 1e-9; jittered or fitted particles by more than 1e-3.
const TOLERANCE: f64 = 1e-6;

/// A lattice: axes at right angles, one spacing, and the cell of every particle.
#[derive(Clone, Debug)]
pub struct Lattice<const D: usize> {
    /// Unit vectors of the axes; exactly those of space where the lattice is not turned.
    pub axes: [Vector<f64, D>; D],
    /// Distance of neighbours, m.
    pub spacing: f64,
    /// Cell of every particle, counted along the axes.
    pub cells: Vec<[i32; D]>,
}

impl<const D: usize> Lattice<D> {
    /// The lattice that all particles stand on, each in a cell of its own; `None` if there is no such lattice. `spacing` is what
    /// the neighbours' distance should be, within a per cent.
    ///
    /// # Errors
    /// As [`Search::pairs`].
    pub fn detect(x: [&[f64]; D], spacing: f64) -> Result<Option<Self>, SearchError> {
        if x[0].len() < 1 << D {
            return Ok(None);
        }
        let mut list = Adjacency::default();
        Search::new().pairs(x, 1.01 * spacing, None, &mut list)?;
        let at = |a: usize| Vector::<f64, D>::from_fn(|i| x[i][a]);
        let Some((origin, axes, spacing)) = frame(&list, &at) else { return Ok(None) };
        let mut cells = Vec::with_capacity(x[0].len());
        for a in 0..x[0].len() {
            let d = (at(a) - origin).times(1.0 / spacing);
            let along = axes.map(|axis| d.dot(axis));
            let cell = along.map(f64::round);
            let off = along.iter().zip(&cell).any(|(c, n)| (c - n).abs() > TOLERANCE);
            if off || cell.iter().any(|n| n.abs() > 1e6) {
                return Ok(None);
            }
            cells.push(cell.map(|n| n as i32));
        }
        let lattice = Self { axes, spacing, cells };
        Ok(lattice.distinct().then_some(lattice))
    }

    fn distinct(&self) -> bool {
        let mut sorted = self.cells.clone();
        sorted.sort_unstable();
        sorted.windows(2).all(|w| w[0] != w[1])
    }

    /// The axis along which the body is longest: rows of particles follow it.
    #[must_use]
    pub fn long_axis(&self) -> usize {
        let extent = |i: usize| {
            let along = || self.cells.iter().map(|c| c[i]);
            along().max().unwrap_or(0) - along().min().unwrap_or(0)
        };
        // The last of equals, so that rows of a cube follow its last axis.
        (0..D).max_by_key(|&i| extent(i)).unwrap_or(0)
    }

    /// The particles row by row.
    #[must_use]
    pub fn rows(&self) -> Vec<u32> {
        let long = self.long_axis();
        let key = |&a: &u32| {
            let cell = self.cells[a as usize];
            let others: [i32; D] = std::array::from_fn(|i| if i == long { 0 } else { cell[i] });
            (others, cell[long])
        };
        let mut order: Vec<u32> = (0..self.cells.len() as u32).collect();
        order.sort_unstable_by_key(key);
        order
    }
}

/// A particle with neighbours at right angles on all axes: origin, axes, spacing.
fn frame<const D: usize>(
    list: &Adjacency,
    at: &impl Fn(usize) -> Vector<f64, D>,
) -> Option<(Vector<f64, D>, [Vector<f64, D>; D], f64)> {
    (0..list.particles()).find_map(|a| {
        let mut found: Vec<Vector<f64, D>> = Vec::new();
        for &b in list.of(a) {
            let step = at(b as usize) - at(a);
            let length = step.norm_squared().sqrt();
            let right = |other: &Vector<f64, D>| other.dot(step).abs() < TOLERANCE * length * length;
            if found.len() < D && found.iter().all(right) {
                found.push(step);
            }
        }
        let axes: [Vector<f64, D>; D] = found.try_into().ok()?;
        let spacing = axes[0].norm_squared().sqrt();
        let equal = axes.iter().all(|s| (s.norm_squared().sqrt() / spacing - 1.0).abs() < TOLERANCE);
        equal.then(|| (at(a), aligned(axes.map(|s| s.times(1.0 / spacing))), spacing))
    })
}

/// The same axes in the order of those of space, all pointing forward, and exactly those of space if they are.
fn aligned<const D: usize>(axes: [Vector<f64, D>; D]) -> [Vector<f64, D>; D] {
    let mut left: Vec<Vector<f64, D>> = axes.to_vec();
    std::array::from_fn(|i| {
        let best = (0..left.len()).max_by(|&p, &q| left[p][i].abs().total_cmp(&left[q][i].abs()));
        let axis = left.swap_remove(best.unwrap_or(0));
        let axis = if axis[i] < 0.0 { -axis } else { axis };
        if axis[i] > 1.0 - 1e-12 { Vector::from_fn(|k| f64::from(u8::from(k == i))) } else { axis }
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample::{lattice, slices};
    use super::*;

    fn detect<const D: usize>(x: &[Vec<f64>; D]) -> Option<Lattice<D>> {
        Lattice::detect(slices(x), 0.1).expect("finite positions")
    }

    #[test]
    fn a_block_is_found_and_its_rows_follow_the_long_axis() {
        let x = lattice([4, 9, 3], 0.1);
        let found = detect(&x).expect("a lattice");
        assert_eq!(found.long_axis(), 1);
        assert_eq!(found.axes[2], Vector([0.0, 0.0, 1.0]));
        let rows = found.rows();
        for pair in rows.chunks(9).flat_map(|row| row.windows(2)) {
            let step = x[1][pair[1] as usize] - x[1][pair[0] as usize];
            assert!((step - 0.1).abs() < 1e-12, "neighbours in a row follow each other");
        }
    }

    #[test]
    fn holes_and_turns_do_not_matter_but_jitter_does() {
        let [px, py] = lattice([20, 20], 0.1);
        let hole: Vec<usize> = (0..400).filter(|&a| (px[a] - 1.0).hypot(py[a] - 1.0) > 0.4).collect();
        let (s, c) = 0.3f64.sin_cos();
        let turned = [
            hole.iter().map(|&a| c * px[a] - s * py[a]).collect::<Vec<_>>(),
            hole.iter().map(|&a| s * px[a] + c * py[a]).collect::<Vec<_>>(),
        ];
        let found = detect(&turned).expect("a turned lattice with a hole");
        assert!((found.axes[0][0] - c).abs() < 1e-9);
        let jittered = [turned[0].iter().map(|v| v + 1e-3 * (v * 1e4).sin()).collect(), turned[1].clone()];
        assert!(detect(&jittered).is_none());
    }

    #[test]
    fn two_particles_in_one_cell_are_no_lattice() {
        let mut x = lattice([5, 5], 0.1);
        x[0].push(x[0][3]);
        x[1].push(x[1][3]);
        assert!(detect(&x).is_none());
    }
}
