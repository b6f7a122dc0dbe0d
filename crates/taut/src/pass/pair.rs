//! The geometry of a pair, as a pass sees it.

use crate::math::{Real, Tensor, Vector};

/// All weights may be other than zero.
pub const ALL_WEIGHTS: u8 = 0b1111;

/// A pair in the configuration of its list. Signs: `e` points from b to a, `e = x_ab / r` with `x_ab = x_a - x_b`;
/// `grad_w = W'(r) V_b e` is the gradient at a, so it points from a to b; `w = W'(r) V_b / r` is not positive.
///
/// `M` is the set of weights that may be other than zero: bit c for component c of `grad_w`, bit 3 for `w`. The
/// products below leave the others out at compile time.
#[derive(Clone, Copy, Debug)]
pub struct Pair<S, const D: usize, const M: u8> {
    /// Kernel gradient times volume of b, m^-1.
    pub grad_w: Vector<S, D>,
    /// Kernel slope over distance, times volume of b, m^-2.
    pub w: S,
    /// Unit vector from b to a.
    pub e: Vector<S, D>,
    /// x_a - x_b in the configuration of the list, m; not masked.
    pub x: Vector<S, D>,
    /// 1/r, m^-1; not masked, and zero if no term uses a direction.
    pub over_r: S,
}

impl<S: Real, const D: usize, const M: u8> Pair<S, D, M> {
    const fn has(bit: usize) -> bool {
        M & (1 << bit) != 0
    }

    /// `sum += v (x) grad W`.
    #[inline(always)]
    pub fn outer(&self, sum: &mut Tensor<S, D>, v: Vector<S, D>) {
        for i in 0..D {
            for j in 0..D {
                if Self::has(j) {
                    sum.0[i][j] = v[i].mul_add(self.grad_w[j], sum.0[i][j]);
                }
            }
        }
    }

    /// `sum += q . grad W`.
    #[inline(always)]
    pub fn dot(&self, sum: &mut Vector<S, D>, q: Tensor<S, D>) {
        for i in 0..D {
            for j in 0..D {
                if Self::has(j) {
                    sum.0[i] = q[i][j].mul_add(self.grad_w[j], sum.0[i]);
                }
            }
        }
    }

    /// `sum += s grad W`, as `s w x_ab`: by one product instead of three.
    #[inline(always)]
    pub fn gradient(&self, sum: &mut Vector<S, D>, s: S) {
        self.along(sum, self.x, s);
    }

    /// `sum += v . grad W`, as `(v . x_ab) w`: who needs `v . x_ab` or `v . e` elsewhere has it only once.
    #[inline(always)]
    pub fn divergence(&self, sum: &mut S, v: Vector<S, D>) {
        if Self::has(3) {
            *sum = v.dot(self.x).mul_add(self.w, *sum);
        }
    }

    /// `sum += s w x`.
    #[inline(always)]
    pub fn along(&self, sum: &mut Vector<S, D>, x: Vector<S, D>, s: S) {
        if Self::has(3) {
            *sum = sum.plus(s * self.w, x);
        }
    }
}
