//! A body as a sparse matrix: factored, and its lowest modes.

use super::StudyError;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use std::collections::HashMap;
use taut::field::Quantity;
use taut::integrator::{Stiffness, highest, scattered};
use taut::simulation::Solver;

/// What is added to the diagonal, over the largest eigenvalue, so that rigid motion does not make the matrix singular: far below the lowest vibration,
/// and far above rounding.
const SHIFT: f64 = 1e-10;
/// More vectors than modes are iterated, so that the last of them converge.
const MORE: usize = 8;
/// Most iterations of a subspace.
const ITERATIONS: usize = 500;
/// They end when no eigenvalue changes by more than this share of itself ...
const CHANGE: f64 = 1e-9;
/// ... or of the largest of the matrix, which is a hundred times what rounding makes of a rigid motion.
const ROUNDED: f64 = 1e-14;
/// A mode is a rigid motion if so much of its square is.
const RIGID: f64 = 0.9;

/// W^(-1/2) K W^(-1/2) of the free components, where a = -W^-1 K u and W are the weights in which that is symmetric.
pub struct Operator {
    /// The free components, particle by particle in the order of storage.
    free: Vec<usize>,
    /// Square roots of their weights.
    root: Vec<f64>,
    /// Components of a displacement in all.
    len: usize,
    matrix: SparseColMat<usize, f64>,
    factor: Llt<usize, f64>,
    /// About the largest eigenvalue, 1/s^2.
    top: f64,
    /// Rigid motions, orthonormal, as columns.
    rigid: Mat<f64>,
    /// By how much the matrix differs from its transpose, over its largest number.
    pub asymmetry: f64,
}

/// A mode of vibration.
#[derive(Clone, Debug)]
pub struct Mode {
    /// omega^2, 1/s^2.
    pub eigenvalue: f64,
    /// Displacement, component by component in the order of storage, of any length.
    pub shape: Vec<f64>,
    /// Share of its square that is rigid motion.
    pub rigid: f64,
}

impl Mode {
    /// Frequency, Hz; 0 for what is rounded below it.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.eigenvalue.max(0.0).sqrt() / std::f64::consts::TAU
    }

    /// Whether it is a rigid motion, or as near to it as there is.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.rigid > RIGID
    }
}

impl Operator {
    /// Of a body that has started, whose particles see each other up to `support` (m).
    ///
    /// # Errors
    /// If the matrix has no factors: the body is not stable where it is.
    pub fn of(solver: &mut dyn Solver, support: f64) -> Result<Self, StudyError> {
        let x: Vec<[f64; 3]> =
            (0..solver.len()).map(|p| solver.read(Quantity::ReferencePosition, p)).collect();
        let held: Vec<[f64; 3]> = (0..solver.len()).map(|p| solver.read(Quantity::Free, p)).collect();
        let Some(mut stiffness) = solver.stiffness() else { return Err(StudyError::Rigid) };
        let d = stiffness.dimension();
        let free: Vec<usize> = (0..x.len() * d).filter(|i| held[i / d][i % d] > 0.0).collect();
        let weights = stiffness.weights();
        let root: Vec<f64> = free.iter().map(|&i| weights[i].sqrt()).collect();
        let entries = probed(stiffness.as_mut(), (&x, support), (&free, &root));
        let top = highest(stiffness.as_mut(), 60);
        let (matrix, factor, asymmetry) = factored(&entries, free.len(), SHIFT * top)?;
        let rigid = rigid_motions(&x, (&free, &root), d);
        Ok(Self { free, root, len: x.len() * d, matrix, factor, top, rigid, asymmetry })
    }

    /// The lowest modes that are vibrations, and how many rigid motions there are below or among them.
    ///
    /// # Errors
    /// If they do not converge.
    pub fn lowest(&self, count: usize) -> Result<Vec<Mode>, StudyError> {
        let n = self.free.len();
        let width = (count + self.rigid.ncols() + MORE).min(n);
        let noise = scattered(n * width);
        let mut y = Mat::from_fn(n, width, |i, j| noise[j * n + i]);
        let mut before = vec![f64::INFINITY; width];
        for _ in 0..ITERATIONS {
            let z = self.factor.solve(&y).qr().compute_thin_Q();
            let projected = z.transpose() * (&self.matrix * &z);
            let ritz = projected.self_adjoint_eigen(Side::Lower).map_err(|_| StudyError::Unconverged)?;
            y = &z * ritz.U();
            let values: Vec<f64> = (0..width).map(|j| ritz.S().column_vector()[j]).collect();
            let wanted = width - MORE.min(width - 1);
            let still = |j: usize| {
                (values[j] - before[j]).abs() <= (CHANGE * values[j].abs()).max(ROUNDED * self.top)
            };
            if (0..wanted).all(still) {
                return Ok((0..wanted).map(|j| self.mode(values[j], &y, j)).collect());
            }
            before = values;
        }
        Err(StudyError::Unconverged)
    }

    fn mode(&self, eigenvalue: f64, y: &Mat<f64>, column: usize) -> Mode {
        let mut shape = vec![0.0; self.len];
        for (k, &i) in self.free.iter().enumerate() {
            shape[i] = y[(k, column)] / self.root[k];
        }
        let overlap = self.rigid.transpose() * y.col(column);
        Mode { eigenvalue, shape, rigid: overlap.iter().map(|c| c * c).sum() }
    }

    /// Where accelerations `b` (m/s^2, by all components) are in balance: K u = W b. What of the load would move the body as a whole, or turn it in the
    /// mode that comes near to a turn, is left out: against that nothing holds it. The displacement, and how much of the load was left out,
    /// over all of it.
    ///
    /// # Errors
    /// If the modes do not converge.
    pub fn balance(&self, b: &[f64]) -> Result<(Vec<f64>, f64), StudyError> {
        let loose: Vec<Mode> = self.lowest(self.rigid.ncols())?.into_iter().filter(Mode::is_rigid).collect();
        let load = Mat::from_fn(self.free.len(), 1, |k, _| self.root[k] * b[self.free[k]]);
        let basis =
            Mat::from_fn(self.free.len(), loose.len(), |k, j| self.root[k] * loose[j].shape[self.free[k]]);
        let without = |v: &Mat<f64>| v - &basis * (basis.transpose() * v);
        let held = without(&load);
        let left = (&load - &held).norm_l2() / load.norm_l2().max(f64::MIN_POSITIVE);
        let mut y = without(&self.factor.solve(&held));
        // The shift is corrected away: each time the error shrinks by it over the lowest eigenvalue.
        for _ in 0..4 {
            let rest = without(&(&held - &self.matrix * &y));
            y = without(&(&y + self.factor.solve(&rest)));
        }
        let mut u = vec![0.0; self.len];
        for (k, &i) in self.free.iter().enumerate() {
            u[i] = y[(k, 0)] / self.root[k];
        }
        Ok((u, left))
    }
}

/// The numbers of the matrix, by displacing particles that do not see each other's neighbours together.
fn probed(
    stiffness: &mut dyn Stiffness,
    (x, support): (&[[f64; 3]], f64),
    (free, root): (&[usize], &[f64]),
) -> Vec<(usize, usize, f64)> {
    let (d, n) = (stiffness.dimension(), stiffness.len());
    let mut place = vec![usize::MAX; n];
    free.iter().enumerate().for_each(|(k, &i)| place[i] = k);
    // A displacement is felt two supports away: by neighbours of neighbours.
    let reach = 2.001 * support;
    let cell = |p: usize| x[p].map(|c| (c / (2.0 * reach)).floor() as i64);
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    (0..x.len()).for_each(|p| cells.entry(cell(p)).or_default().push(p));
    let most = cells.values().map(Vec::len).max().unwrap_or(0);
    let (mut u, mut a) = (vec![0.0; n], vec![0.0; n]);
    let mut entries = Vec::new();
    for (colour, rank, axis) in
        (0..1_i64 << d).flat_map(|c| (0..most).flat_map(move |r| (0..d).map(move |axis| (c, r, axis))))
    {
        let mine = |key: &[i64; 3]| (0..d).all(|k| key[k].rem_euclid(2) == colour >> k & 1);
        let moved: Vec<usize> =
            cells.iter().filter(|(key, _)| mine(key)).filter_map(|(_, of)| of.get(rank)).copied().collect();
        let moved: Vec<usize> = moved.into_iter().filter(|p| place[p * d + axis] != usize::MAX).collect();
        if moved.is_empty() {
            continue;
        }
        u.fill(0.0);
        moved.iter().for_each(|p| u[p * d + axis] = 1.0);
        stiffness.apply(&u, &mut a);
        for &p in &moved {
            let column = place[p * d + axis];
            for near in around(&cells, cell(p)) {
                let apart: f64 = (0..3).map(|k| (x[near][k] - x[p][k]).powi(2)).sum();
                for row in (0..d).map(|k| near * d + k).filter(|&i| apart <= reach * reach && a[i] != 0.0) {
                    let k = place[row];
                    entries.push((k, column, -a[row] * root[k] / root[column]));
                }
            }
        }
    }
    entries
}

/// The particles of a cell and those next to it.
fn around(cells: &HashMap<[i64; 3], Vec<usize>>, at: [i64; 3]) -> impl Iterator<Item = usize> {
    let step = |k: i64| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
    let near = (0..27).filter_map(move |k| cells.get(&std::array::from_fn(|i| at[i] + step(k)[i])));
    near.flatten().copied()
}

type Factored = (SparseColMat<usize, f64>, Llt<usize, f64>, f64);

/// The symmetric part of the matrix, the factors of it with `shift` on the diagonal, and how far it was from symmetric.
fn factored(entries: &[(usize, usize, f64)], n: usize, shift: f64) -> Result<Factored, StudyError> {
    let all: HashMap<(usize, usize), f64> = entries.iter().map(|&(i, j, v)| ((i, j), v)).collect();
    let largest = entries.iter().fold(0.0, |m: f64, e| m.max(e.2.abs()));
    let other = |i, j| all.get(&(j, i)).copied().unwrap_or(0.0);
    let apart = entries.iter().fold(0.0, |m: f64, &(i, j, v)| m.max((v - other(i, j)).abs()));
    let mut both: Vec<Triplet<usize, usize, f64>> = Vec::new();
    for &(i, j, v) in entries {
        both.push(Triplet::new(i, j, 0.5 * v));
        both.push(Triplet::new(j, i, 0.5 * v));
    }
    let unmade = |_| StudyError::TooLarge;
    let matrix = SparseColMat::try_new_from_triplets(n, n, &both).map_err(unmade)?;
    both.extend((0..n).map(|i| Triplet::new(i, i, shift)));
    let shifted = SparseColMat::try_new_from_triplets(n, n, &both).map_err(unmade)?;
    let factor = shifted.sp_cholesky(Side::Lower).map_err(|_| StudyError::Unstable)?;
    Ok((matrix, factor, apart / largest.max(f64::MIN_POSITIVE)))
}

/// Translations along and small turns about the axes, of the free components, orthonormal.
fn rigid_motions(x: &[[f64; 3]], (free, root): (&[usize], &[f64]), d: usize) -> Mat<f64> {
    let turns = if d == 2 { 2..3 } else { 0..3 };
    let count = d + turns.len();
    let n = x.len() as f64;
    let centre: [f64; 3] = std::array::from_fn(|k| x.iter().map(|x| x[k]).sum::<f64>() / n);
    let size = x.iter().flat_map(|x| (0..3).map(|k| (x[k] - centre[k]).abs())).fold(0.0, f64::max);
    let motion = |i: usize, j: usize| {
        let (p, k) = (i / d, i % d);
        if j < d {
            return f64::from(u8::from(j == k));
        }
        let axis = turns.start + j - d;
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let r = |k: usize| (x[p][k] - centre[k]) / size;
        if k == next {
            -r(last)
        } else if k == last {
            r(next)
        } else {
            0.0
        }
    };
    Mat::from_fn(free.len(), count, |k, j| root[k] * motion(free[k], j)).qr().compute_thin_Q()
}

#[cfg(test)]
mod tests;
