//! Values as rows of numbers, so that one loader serves every record.

use crate::math::{Real, Tensor, Vector};

/// Somewhere numbers are read from, addressed by their place in a record.
pub trait Source<S> {
    /// Number `k` of the record.
    fn get(&self, k: usize) -> S;
}

/// Somewhere numbers are written to, addressed by their place in a record.
pub trait Sink<S> {
    /// Sets number `k` of the record.
    fn put(&mut self, k: usize, x: S);
}

/// A scalar, vector or tensor as consecutive numbers.
pub trait Value<S: Real>: Copy {
    /// How many numbers.
    const WORDS: usize;
    /// Reads the numbers `k`, `k + 1`, ...
    fn read(from: &impl Source<S>, k: usize) -> Self;
    /// Writes the numbers `k`, `k + 1`, ...
    fn write(self, to: &mut impl Sink<S>, k: usize);
    /// All zero.
    fn nought() -> Self;
}

impl<S: Real> Value<S> for S {
    const WORDS: usize = 1;
    #[inline(always)]
    fn read(from: &impl Source<S>, k: usize) -> Self {
        from.get(k)
    }
    #[inline(always)]
    fn write(self, to: &mut impl Sink<S>, k: usize) {
        to.put(k, self);
    }
    #[inline(always)]
    fn nought() -> Self {
        S::zero()
    }
}

impl<S: Real, const D: usize> Value<S> for Vector<S, D> {
    const WORDS: usize = D;
    #[inline(always)]
    fn read(from: &impl Source<S>, k: usize) -> Self {
        let mut v = Self::zero();
        for i in 0..D {
            v.0[i] = from.get(k + i);
        }
        v
    }
    #[inline(always)]
    fn write(self, to: &mut impl Sink<S>, k: usize) {
        for i in 0..D {
            to.put(k + i, self[i]);
        }
    }
    #[inline(always)]
    fn nought() -> Self {
        Self::zero()
    }
}

impl<S: Real, const D: usize> Value<S> for Tensor<S, D> {
    const WORDS: usize = D * D;
    #[inline(always)]
    fn read(from: &impl Source<S>, k: usize) -> Self {
        let mut t = Self::zero();
        for i in 0..D {
            for j in 0..D {
                t.0[i][j] = from.get(k + i * D + j);
            }
        }
        t
    }
    #[inline(always)]
    fn write(self, to: &mut impl Sink<S>, k: usize) {
        for i in 0..D {
            for j in 0..D {
                to.put(k + i * D + j, self[i][j]);
            }
        }
    }
    #[inline(always)]
    fn nought() -> Self {
        Self::zero()
    }
}
