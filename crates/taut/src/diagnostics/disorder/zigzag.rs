//! The zigzag of every particle: what is left of the steps to its nearest neighbours when the deformation that
//! F describes is taken away.

use rayon::prelude::*;

use super::CHUNK;
use super::gradient::LeastSquares;
use super::symmetric::{Square, apply, dot};
use crate::neighbours::Adjacency;

/// Writes the zigzag amplitude of every particle at `x` into `out`, in spacings; 0 where the shell is empty.
pub(super) fn amplitudes<const D: usize>(
    (squares, shells, dp): (&LeastSquares<D>, &Adjacency, &[f64]),
    f: &[Square<D>],
    x: &[[f64; D]],
    out: &mut [f64],
) {
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(k, chunk)| {
        for (offset, out) in chunk.iter_mut().enumerate() {
            let i = k * CHUNK + offset;
            let shell = shells.of(i);
            let mut sum = [0.0; D];
            for &j in shell {
                let rest = remainder(squares, f, x, (i, j as usize));
                for axis in 0..D {
                    sum[axis] += rest[axis];
                }
            }
            *out = dot(sum, sum).sqrt() / (2.0 * dp[i] * shell.len().max(1) as f64);
        }
    });
}

/// x_ji - 1/2 (F_i + F_j) X_ji.
fn remainder<const D: usize>(
    squares: &LeastSquares<D>,
    f: &[Square<D>],
    x: &[[f64; D]],
    (i, j): (usize, usize),
) -> [f64; D] {
    let step = squares.step(i, j);
    let (here, there) = (apply(&f[i], step), apply(&f[j], step));
    std::array::from_fn(|axis| x[j][axis] - x[i][axis] - 0.5 * (here[axis] + there[axis]))
}

/// Root mean square, 99th percentile and maximum of `values`, which are put into another order; not numbers if
/// there are none.
pub(super) fn summary(values: &mut [f64]) -> (f64, f64, f64) {
    let n = values.len();
    if n == 0 {
        return (f64::NAN, f64::NAN, f64::NAN);
    }
    let rms = (values.iter().map(|value| value * value).sum::<f64>() / n as f64).sqrt();
    let rank = (99 * n).div_ceil(100) - 1;
    let (_, &mut percentile, above) = values.select_nth_unstable_by(rank, f64::total_cmp);
    (rms, percentile, above.iter().copied().fold(percentile, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentile_is_the_nearest_rank() {
        let mut values: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        let (rms, percentile, most) = summary(&mut values);
        assert_eq!((percentile, most), (198.0, 200.0));
        // Sum of squares of 1..n is n (n + 1) (2 n + 1) / 6, exact here; one rounding in the root.
        assert!((rms - (201.0 * 401.0 / 6.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(summary(&mut [3.0]), (3.0, 3.0, 3.0));
        assert!(summary(&mut []).0.is_nan());
    }
}
