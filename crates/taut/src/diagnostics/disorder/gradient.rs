//! F by least squares, exact for linear fields on any arrangement:
//! F_i = (sum_j w_ij x_ji X_ji^T) K_i^+ + N_i with K_i = sum_j w_ij X_ji X_ji^T,
//! over the reference neighbours of the same body within the support radius.
//!
//! Along directions that the neighbours do not resolve (a row of particles, a lone one) K has no inverse; its
//! pseudo-inverse leaves them out, and the projector N_i puts the identity there.

use rayon::prelude::*;

use super::CHUNK;
use super::symmetric::{Square, apply, dot, pseudo_inverse};
use crate::neighbours::Adjacency;

/// Reference neighbours with what the least squares need of them.
#[derive(Debug, Clone)]
pub(super) struct LeastSquares<const D: usize> {
    /// Reference positions, point by point: a neighbour is one place in memory, not D.
    x0: Vec<[f64; D]>,
    support: f64,
    neighbours: Adjacency,
    inverse: Vec<Square<D>>,
    missing: Vec<Square<D>>,
}

impl<const D: usize> LeastSquares<D> {
    /// Prepares the least squares over `neighbours` of the particles at `x0`, all within `support`.
    pub fn new(x0: [&[f64]; D], support: f64, neighbours: Adjacency) -> Self {
        let n = neighbours.particles();
        let mut new = Self { x0: Vec::new(), support, neighbours, inverse: Vec::new(), missing: Vec::new() };
        points(x0, &mut new.x0);
        let inverses: Vec<_> = (0..n).into_par_iter().map(|i| pseudo_inverse(new.moment(i))).collect();
        (new.inverse, new.missing) = inverses.into_iter().unzip();
        new
    }

    /// X_ji = X_j - X_i.
    pub fn step(&self, i: usize, j: usize) -> [f64; D] {
        apart(&self.x0[j], &self.x0[i])
    }

    /// The weighted mean of the unit vectors to the neighbours of `i`, its length: 0 where they surround the
    /// particle evenly, about 0.4 (2D) and 0.3 (3D) on a flat surface; 1 without neighbours.
    pub fn one_sided(&self, i: usize) -> f64 {
        let (mut sum, mut weights) = ([0.0; D], 0.0);
        for &j in self.neighbours.of(i) {
            let step = self.step(i, j as usize);
            let distance = dot(step, step).sqrt();
            let weight = self.weight(distance);
            weights += weight;
            for axis in 0..D {
                sum[axis] += weight * step[axis] / distance.max(f64::MIN_POSITIVE);
            }
        }
        if weights > 0.0 { dot(sum, sum).sqrt() / weights } else { 1.0 }
    }

    /// Writes F of every particle at `x` into `f`.
    pub fn gradients(&self, x: &[[f64; D]], f: &mut [Square<D>]) {
        f.par_chunks_mut(CHUNK).enumerate().for_each(|(k, chunk)| {
            for (offset, f) in chunk.iter_mut().enumerate() {
                *f = self.gradient(x, k * CHUNK + offset);
            }
        });
    }

    /// F of particle `i`.
    fn gradient(&self, x: &[[f64; D]], i: usize) -> Square<D> {
        let mut sum = [[0.0; D]; D];
        for &j in self.neighbours.of(i) {
            let step = self.step(i, j as usize);
            let moved = apart(&x[j as usize], &x[i]);
            let weight = self.weight(dot(step, step).sqrt());
            for axis in 0..D {
                for k in 0..D {
                    sum[axis][k] += weight * moved[axis] * step[k];
                }
            }
        }
        // K^+ is symmetric: a row of sum times K^+ is K^+ times that row.
        let mut f = self.missing[i];
        for axis in 0..D {
            let row = apply(&self.inverse[i], sum[axis]);
            for k in 0..D {
                f[axis][k] += row[k];
            }
        }
        f
    }

    /// K of particle `i`.
    fn moment(&self, i: usize) -> Square<D> {
        let mut sum = [[0.0; D]; D];
        for &j in self.neighbours.of(i) {
            let step = self.step(i, j as usize);
            let weight = self.weight(dot(step, step).sqrt());
            for axis in 0..D {
                for k in 0..D {
                    sum[axis][k] += weight * step[axis] * step[k];
                }
            }
        }
        sum
    }

    /// The shape of the Wendland C2 kernel: (1 - q)^4 (1 + 4 q), q = R / support.
    fn weight(&self, distance: f64) -> f64 {
        let q = distance / self.support;
        let square = (1.0 - q) * (1.0 - q);
        square * square * (1.0 + 4.0 * q)
    }
}

/// b - a.
pub(super) fn apart<const D: usize>(b: &[f64; D], a: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| b[axis] - a[axis])
}

/// Writes columns point by point.
pub(super) fn points<const D: usize>(columns: [&[f64]; D], out: &mut Vec<[f64; D]>) {
    out.clear();
    out.extend((0..columns[0].len()).map(|i| columns.map(|column| column[i])));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::{sample, trivial_pairs};

    fn gradients<const D: usize>(x0: &[Vec<f64>; D], x: [&[f64]; D]) -> Vec<Square<D>> {
        let x0 = sample::slices(x0);
        let neighbours = trivial_pairs(x0, 2.6, None).unwrap();
        let squares = LeastSquares::new(x0, 2.6, neighbours);
        let (mut f, mut at) = (vec![[[0.0; D]; D]; x0[0].len()], Vec::new());
        points(x, &mut at);
        squares.gradients(&at, &mut f);
        f
    }

    #[test]
    fn linear_fields_are_exact_on_any_set() {
        let x0 =
            sample::random::<2>(300, 5).map(|column| column.iter().map(|v| v * 12.0).collect::<Vec<_>>());
        let wanted = [[1.5, -0.25], [0.75, 0.5]];
        let at =
            |row: [f64; 2]| (0..300).map(|a| row[0] * x0[0][a] + row[1] * x0[1][a] + 3.0).collect::<Vec<_>>();
        let (x, y) = (at(wanted[0]), at(wanted[1]));
        for f in gradients(&x0, [&x, &y]) {
            for (got, expected) in f.as_flattened().iter().zip(wanted.as_flattened()) {
                // Roundings of coordinates up to 30 over distances of about 1, times the conditioning.
                assert!((got - expected).abs() < 1e-12, "{got} for {expected}");
            }
        }
    }

    #[test]
    fn weights_are_flat_at_the_centre_and_at_the_support() {
        let squares = LeastSquares::<2>::new([&[], &[]], 2.0, Adjacency::default());
        let (centre, middle, end) = (squares.weight(2e-4), squares.weight(1.0), squares.weight(1.9998));
        // 1 - 10 q^2 near the centre, 5 (1 - q)^4 near the support, with q and 1 - q of 1e-4.
        assert!((centre - 1.0).abs() < 1.1e-7 && end < 6e-16);
        assert_eq!(middle, 3.0 / 16.0);
    }

    #[test]
    fn a_row_has_the_identity_across_it_and_a_lone_particle_everywhere() {
        let x0 = [vec![0.0, 1.0, 2.0, 3.0, 90.0], vec![0.0; 5], vec![7.0; 5]];
        let stretched: Vec<f64> = x0[0].iter().map(|v| 2.0 * v).collect();
        let f = gradients(&x0, [&stretched, &x0[1], &x0[2]]);
        assert_eq!(f[4], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        for f in &f[..4] {
            assert!((f[0][0] - 2.0).abs() < 1e-14, "a few roundings: {f:?}");
            assert_eq!((f[1], f[2]), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
        }
    }
}
