//! Small square matrices: products, and the pseudo-inverse of a symmetric one.

/// A D x D matrix, row by row.
pub(super) type Square<const D: usize> = [[f64; D]; D];

/// Eigenvalues below this share of the largest count as zero: a direction in which neighbours spread less than
/// 1e-4 of what they spread along the widest is one they do not resolve.
const ZERO: f64 = 1e-8;

/// Sweeps of rotations; convergence is quadratic, and 3 x 3 matrices need four or five.
const SWEEPS: usize = 12;

/// A matrix times a vector.
pub(super) fn apply<const D: usize>(matrix: &Square<D>, vector: [f64; D]) -> [f64; D] {
    matrix.map(|row| dot(row, vector))
}

/// The scalar product.
pub(super) fn dot<const D: usize>(left: [f64; D], right: [f64; D]) -> f64 {
    (0..D).fold(0.0, |sum, axis| sum + left[axis] * right[axis])
}

/// Pseudo-inverse of a symmetric positive semidefinite matrix, and the projector on its null space.
pub(super) fn pseudo_inverse<const D: usize>(matrix: Square<D>) -> (Square<D>, Square<D>) {
    let (values, vectors) = eigen(matrix);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let (mut inverse, mut null) = ([[0.0; D]; D], [[0.0; D]; D]);
    for k in 0..D {
        let resolved = values[k] > ZERO * largest;
        let (out, factor) = if resolved { (&mut inverse, 1.0 / values[k]) } else { (&mut null, 1.0) };
        for i in 0..D {
            for j in 0..D {
                out[i][j] += factor * vectors[i][k] * vectors[j][k];
            }
        }
    }
    (inverse, null)
}

/// Eigenvalues and eigenvectors (as columns) of a symmetric matrix by Jacobi's cyclic rotations.
fn eigen<const D: usize>(mut matrix: Square<D>) -> ([f64; D], Square<D>) {
    let mut vectors = [[0.0; D]; D];
    for axis in 0..D {
        vectors[axis][axis] = 1.0;
    }
    for _ in 0..SWEEPS {
        for p in 0..D {
            for q in p + 1..D {
                rotate(&mut matrix, &mut vectors, p, q);
            }
        }
    }
    (std::array::from_fn(|axis| matrix[axis][axis]), vectors)
}

/// Rotates axes p and q so that the entry between them vanishes.
fn rotate<const D: usize>(matrix: &mut Square<D>, vectors: &mut Square<D>, p: usize, q: usize) {
    if matrix[p][q] == 0.0 {
        return;
    }
    let ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    let turn = |a: f64, b: f64| (cosine * a - sine * b, sine * a + cosine * b);
    for k in 0..D {
        (matrix[k][p], matrix[k][q]) = turn(matrix[k][p], matrix[k][q]);
    }
    for k in 0..D {
        (matrix[p][k], matrix[q][k]) = turn(matrix[p][k], matrix[q][k]);
        (vectors[k][p], vectors[k][q]) = turn(vectors[k][p], vectors[k][q]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outer(vector: [f64; 3], onto: &mut Square<3>) {
        for i in 0..3 {
            for j in 0..3 {
                onto[i][j] += vector[i] * vector[j];
            }
        }
    }

    #[test]
    fn inverse_where_there_is_one() {
        let matrix = [[4.0, 1.0, -2.0], [1.0, 3.0, 0.5], [-2.0, 0.5, 5.0]];
        let (inverse, null) = pseudo_inverse(matrix);
        assert_eq!(null, [[0.0; 3]; 3]);
        for axis in 0..3 {
            let column = apply(&inverse, matrix[axis]);
            for k in 0..3 {
                // A few roundings at a condition number of about 5.
                assert!((column[k] - f64::from(u8::from(k == axis))).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn missing_directions_go_to_the_projector() {
        let mut line = [[0.0; 3]; 3];
        outer([2.0, -1.0, 2.0], &mut line);
        let (inverse, null) = pseudo_inverse(line);
        // The inverse of v v^T along v is v v^T / |v|^4, |v| = 3; a few roundings.
        assert!((inverse[0][1] + 2.0 / 81.0).abs() < 1e-15);
        let missing: f64 = (0..3).map(|axis| null[axis][axis]).sum();
        assert!((missing - 2.0).abs() < 1e-14);
        assert!(apply(&null, [2.0, -1.0, 2.0]).iter().all(|part| part.abs() < 1e-14));
        assert_eq!(pseudo_inverse([[0.0; 2]; 2]), ([[0.0; 2]; 2], [[1.0, 0.0], [0.0, 1.0]]));
    }
}
