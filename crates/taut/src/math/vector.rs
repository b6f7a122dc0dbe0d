//! Vectors of a fixed dimension.

use super::{Real, Tensor};
use std::ops::{Add, Index, IndexMut, Neg, Sub};

/// A vector of `D` components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<S, const D: usize>(pub [S; D]);

impl<S, const D: usize> Index<usize> for Vector<S, D> {
    type Output = S;
    #[inline(always)]
    fn index(&self, i: usize) -> &S {
        &self.0[i]
    }
}

impl<S, const D: usize> IndexMut<usize> for Vector<S, D> {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut S {
        &mut self.0[i]
    }
}

impl<S: Real, const D: usize> Vector<S, D> {
    /// The zero vector.
    #[inline(always)]
    #[must_use]
    pub fn zero() -> Self {
        Self([S::zero(); D])
    }

    /// Component `i` is `f(i)`.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize) -> S) -> Self {
        let mut v = Self::zero();
        for i in 0..D {
            v.0[i] = f(i);
        }
        v
    }

    /// The inner product.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, other: Self) -> S {
        let mut sum = self[0] * other[0];
        for i in 1..D {
            sum = self[i].mul_add(other[i], sum);
        }
        sum
    }

    /// The square of the length.
    #[inline(always)]
    #[must_use]
    pub fn norm_squared(self) -> S {
        self.dot(self)
    }

    /// `s` times this vector.
    #[inline(always)]
    #[must_use]
    pub fn times(self, s: S) -> Self {
        Self::from_fn(|i| self[i] * s)
    }

    /// `self + s * other`, fused.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, s: S, other: Self) -> Self {
        Self::from_fn(|i| s.mul_add(other[i], self[i]))
    }

    /// The dyad `self (x) other`: component (i, j) is `self_i other_j`.
    #[inline(always)]
    #[must_use]
    pub fn outer(self, other: Self) -> Tensor<S, D> {
        Tensor::from_fn(|i, j| self[i] * other[j])
    }
}

impl<S: Real, const D: usize> Add for Vector<S, D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::from_fn(|i| self[i] + o[i])
    }
}

impl<S: Real, const D: usize> Sub for Vector<S, D> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::from_fn(|i| self[i] - o[i])
    }
}

impl<S: Real, const D: usize> Neg for Vector<S, D> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::from_fn(|i| -self[i])
    }
}
