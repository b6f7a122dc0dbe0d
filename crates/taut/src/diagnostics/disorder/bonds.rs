//! Reference bonds: pairs of one body closer than 1.2 dp; how short they are now, and which are broken.

use rayon::prelude::*;

use super::CHUNK;
use super::gradient::{LeastSquares, apart};
use super::symmetric::{Square, apply, dot};
use crate::neighbours::Adjacency;

/// Reach of a bond in the reference arrangement, in spacings.
pub(super) const REACH: f64 = 1.2;

/// A bond this many times longer than the deformation around it explains is broken.
const BREAK: f64 = 1.5;

/// The spacing that lengths between `i` and `j` are measured in.
pub(super) fn spacing(dp: &[f64], i: usize, j: usize) -> f64 {
    0.5 * (dp[i] + dp[j])
}

/// Whether `i` and `j` are within the reach of a bond.
pub(super) fn within<const D: usize>(squares: &LeastSquares<D>, dp: &[f64], i: usize, j: usize) -> bool {
    let step = squares.step(i, j);
    dot(step, step).sqrt() < REACH * spacing(dp, i, j)
}

/// All bonds, each once with the smaller particle first, in ascending order.
pub(super) fn bonds<const D: usize>(
    squares: &LeastSquares<D>,
    near: &Adjacency,
    dp: &[f64],
) -> Vec<[u32; 2]> {
    let all = (0..near.particles()).flat_map(|i| near.of(i).iter().map(move |&j| [i as u32, j]));
    all.filter(|&[i, j]| i < j && within(squares, dp, i as usize, j as usize)).collect()
}

/// Marks the broken bonds of the state at `x`, whose deformation is `f`, and returns the length of the shortest
/// bond in spacings.
pub(super) fn inspect<const D: usize>(
    (squares, bonds, dp): (&LeastSquares<D>, &[[u32; 2]], &[f64]),
    f: &[Square<D>],
    x: &[[f64; D]],
    broken: &mut [bool],
) -> f64 {
    let pieces = broken.par_chunks_mut(CHUNK).zip(bonds.par_chunks(CHUNK));
    let shortest = pieces.map(|(broken, bonds)| {
        let mut shortest = f64::INFINITY;
        for (broken, bond) in broken.iter_mut().zip(bonds) {
            let [i, j] = bond.map(|particle| particle as usize);
            let now = apart(&x[j], &x[i]);
            let length = dot(now, now).sqrt();
            *broken = length > BREAK * explained(squares, f, i, j);
            shortest = shortest.min(length / spacing(dp, i, j));
        }
        shortest
    });
    shortest.reduce(|| f64::INFINITY, f64::min)
}

/// |1/2 (F_i + F_j) X_ij|.
fn explained<const D: usize>(squares: &LeastSquares<D>, f: &[Square<D>], i: usize, j: usize) -> f64 {
    let step = squares.step(i, j);
    let (here, there) = (apply(&f[i], step), apply(&f[j], step));
    let mean: [f64; D] = std::array::from_fn(|axis| 0.5 * (here[axis] + there[axis]));
    dot(mean, mean).sqrt()
}
