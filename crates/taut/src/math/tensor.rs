//! Second-order tensors of a fixed dimension.

use super::{Real, Vector};
use std::ops::{Add, Index, Sub};

/// A second-order tensor, row by row: `t[i][j]` is component (i, j).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensor<S, const D: usize>(pub [[S; D]; D]);

impl<S, const D: usize> Index<usize> for Tensor<S, D> {
    type Output = [S; D];
    #[inline(always)]
    fn index(&self, i: usize) -> &[S; D] {
        &self.0[i]
    }
}

impl<S: Real, const D: usize> Tensor<S, D> {
    /// The zero tensor.
    #[inline(always)]
    #[must_use]
    pub fn zero() -> Self {
        Self([[S::zero(); D]; D])
    }

    /// `s` times the unit tensor.
    #[inline(always)]
    #[must_use]
    pub fn diagonal(s: S) -> Self {
        Self::from_fn(|i, j| if i == j { s } else { S::zero() })
    }

    /// Component (i, j) is `f(i, j)`.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize, usize) -> S) -> Self {
        let mut t = Self::zero();
        for i in 0..D {
            for j in 0..D {
                t.0[i][j] = f(i, j);
            }
        }
        t
    }

    /// The transpose.
    #[inline(always)]
    #[must_use]
    pub fn transpose(self) -> Self {
        Self::from_fn(|i, j| self[j][i])
    }

    /// The trace.
    #[inline(always)]
    #[must_use]
    pub fn trace(self) -> S {
        let mut sum = self[0][0];
        for i in 1..D {
            sum = sum + self[i][i];
        }
        sum
    }

    /// `s` times this tensor.
    #[inline(always)]
    #[must_use]
    pub fn times(self, s: S) -> Self {
        Self::from_fn(|i, j| self[i][j] * s)
    }

    /// `self + s * other`, fused.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, s: S, other: Self) -> Self {
        Self::from_fn(|i, j| s.mul_add(other[i][j], self[i][j]))
    }

    /// `self + s 1`.
    #[inline(always)]
    #[must_use]
    pub fn plus_diagonal(self, s: S) -> Self {
        Self::from_fn(|i, j| if i == j { self[i][j] + s } else { self[i][j] })
    }

    /// The product `self . other`.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::should_implement_trait, reason = "a dot of tensors is spelled out, never `*`")]
    pub fn mul(self, other: Self) -> Self {
        Self::from_fn(|i, j| {
            let mut sum = self[i][0] * other[0][j];
            for k in 1..D {
                sum = self[i][k].mul_add(other[k][j], sum);
            }
            sum
        })
    }

    /// The product `self . v`.
    #[inline(always)]
    #[must_use]
    pub fn mul_vector(self, v: Vector<S, D>) -> Vector<S, D> {
        Vector::from_fn(|i| Vector(self[i]).dot(v))
    }

    /// The full contraction `self : other`.
    #[inline(always)]
    #[must_use]
    pub fn double_dot(self, other: Self) -> S {
        let mut sum = S::zero();
        for i in 0..D {
            for j in 0..D {
                sum = self[i][j].mul_add(other[i][j], sum);
            }
        }
        sum
    }

    /// The symmetric part.
    #[inline(always)]
    #[must_use]
    pub fn symmetric(self) -> Self {
        Self::from_fn(|i, j| (self[i][j] + self[j][i]) * S::of(0.5))
    }

    /// The antisymmetric part, `(self - self^T) / 2`.
    #[inline(always)]
    #[must_use]
    pub fn antisymmetric(self) -> Self {
        Self::from_fn(|i, j| (self[i][j] - self[j][i]) * S::of(0.5))
    }

    /// The rotation (1 - a)^-1 (1 + a) of this antisymmetric tensor a (`D` = 2 or 3): by the angle 2 atan |a| (Cayley).
    #[inline(always)]
    #[must_use]
    pub fn rotation(self) -> Self {
        let squared = self.double_dot(self) * S::of(0.5);
        let factor = S::of(2.0) / (S::one() + squared);
        (self + self.mul(self)).times(factor).plus_diagonal(S::one())
    }

    /// The cofactor matrix: `det(self)` times the inverse transpose.
    #[inline(always)]
    #[must_use]
    pub fn cofactor(self) -> Self {
        match D {
            1 => Self::diagonal(S::one()),
            2 => Self::from_fn(|i, j| if i == j { self[1 - i][1 - j] } else { -self[1 - i][1 - j] }),
            _ => Self::from_fn(|i, j| {
                let (p, q, r, s) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
                self[p][r] * self[q][s] - self[p][s] * self[q][r]
            }),
        }
    }

    /// The determinant (`D` = 1, 2 or 3).
    #[inline(always)]
    #[must_use]
    pub fn det(self) -> S {
        Vector(self[0]).dot(Vector(self.cofactor()[0]))
    }

    /// The inverse (`D` = 1, 2 or 3); not a number where singular.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        let cofactor = self.cofactor();
        let det = Vector(self[0]).dot(Vector(cofactor[0]));
        cofactor.transpose().times(S::one() / det)
    }

    /// The same tensor in three dimensions, with `zz` on the third axis if that was missing.
    #[inline(always)]
    pub fn lift(self, zz: S) -> Tensor<S, 3> {
        Tensor::from_fn(|i, j| {
            if i < D && j < D {
                self[i][j]
            } else if i == j {
                zz
            } else {
                S::zero()
            }
        })
    }
}

impl<S: Real> Tensor<S, 3> {
    /// The von Mises measure sqrt(3/2 s:s) of the deviator s of this stress.
    #[inline(always)]
    #[must_use]
    pub fn von_mises(self) -> S {
        let s = self.plus_diagonal(self.trace() * S::of(-1.0 / 3.0));
        (s.double_dot(s) * S::of(1.5)).sqrt()
    }
}

impl<S: Real, const D: usize> Add for Tensor<S, D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::from_fn(|i, j| self[i][j] + o[i][j])
    }
}

impl<S: Real, const D: usize> Sub for Tensor<S, D> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::from_fn(|i, j| self[i][j] - o[i][j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Tensor<f64, 3> = Tensor([[2.0, 0.3, -0.1], [0.5, 1.5, 0.2], [0.1, -0.4, 0.9]]);

    #[test]
    fn inverse_undoes_the_tensor() {
        let error = A.mul(A.inverse()) - Tensor::diagonal(1.0);
        assert!(error.double_dot(error) < 1e-30, "rounding only");
        let b = Tensor([[1.2, 0.4], [-0.3, 0.8]]);
        let error = b.mul(b.inverse()) - Tensor::diagonal(1.0);
        assert!(error.double_dot(error) < 1e-30, "rounding only");
        assert!((b.det() - 1.08).abs() < 1e-15);
    }

    #[test]
    fn an_antisymmetric_tensor_makes_a_rotation() {
        let angle = 0.7f64;
        let t = (0.5 * angle).tan();
        let plane = Tensor([[0.0, -t], [t, 0.0]]).rotation();
        let expected = Tensor([[angle.cos(), -angle.sin()], [angle.sin(), angle.cos()]]);
        let error = plane - expected;
        assert!(error.double_dot(error) < 1e-30, "rounding only");
        let space = A.antisymmetric();
        let turn = space.rotation();
        let error = turn.mul(turn.transpose()) - Tensor::diagonal(1.0);
        assert!(error.double_dot(error) < 1e-30 && (turn.det() - 1.0).abs() < 1e-15);
        let (one, minus) = (Tensor::diagonal(1.0) + space, Tensor::diagonal(1.0) - space);
        let error = minus.mul(turn) - one;
        assert!(error.double_dot(error) < 1e-30, "as defined");
    }

    #[test]
    fn uniaxial_stress_is_its_own_von_mises_stress() {
        let mut s = Tensor::<f64, 3>::zero();
        s.0[1][1] = -4.0;
        assert!((s.von_mises() - 4.0).abs() < 1e-15);
        assert!(s.plus_diagonal(7.0).von_mises() - 4.0 < 1e-14, "pressure does not matter");
    }

    #[test]
    fn lift_fills_the_third_axis_only_in_the_plane() {
        assert_eq!(Tensor([[1.0, 2.0], [3.0, 4.0]]).lift(5.0)[2], [0.0, 0.0, 5.0]);
        assert_eq!(A.lift(5.0), A);
    }
}
