//! Principal values and directions of symmetric tensors, without a branch on a value.

use super::{Real, Tensor, Vector};

/// Turns after which nothing is left off the diagonal: one is exact in the plane; in space each round of three turns squares what is left,
/// and from any tensor six rounds come to rounding.
const ROUNDS: usize = 6;

/// A divisor that is never zero, and small against every squared quantity that means anything.
const TINY: f64 = 1e-30;

impl<S: Real, const D: usize> Tensor<S, D> {
    /// The symmetric tensor with the principal directions of this one (symmetric, `D` = 2 or 3) and `f` of its principal values:
    /// turned to principal axes, changed there, and turned back.
    #[inline(always)]
    #[must_use]
    pub fn with_principal_values(self, f: impl Fn(S) -> S) -> Self {
        let (mut t, mut axes) = (self, Self::diagonal(S::one()));
        for _ in 0..if D == 2 { 1 } else { ROUNDS } {
            for p in 0..D {
                for q in p + 1..D {
                    turn(&mut t, &mut axes, (p, q));
                }
            }
        }
        let values = Vector::<S, D>::from_fn(|k| f(t[k][k]));
        Self::from_fn(|i, j| {
            let mut sum = axes[i][0] * values[0] * axes[j][0];
            for k in 1..D {
                sum = (axes[i][k] * values[k]).mul_add(axes[j][k], sum);
            }
            sum
        })
    }
}

/// Turns the axes p and q until t_pq is zero (Jacobi): tan 2 theta = 2 t_pq / (t_qq - t_pp), by the smaller of the two angles.
#[inline(always)]
fn turn<S: Real, const D: usize>(t: &mut Tensor<S, D>, axes: &mut Tensor<S, D>, (p, q): (usize, usize)) {
    let (off, apart) = (t[p][q], t[q][q] - t[p][p]);
    let twice = off + off;
    let size = apart.abs() + apart.mul_add(apart, twice * twice).sqrt();
    let sign = S::select(apart.lt(S::zero()), -S::one(), S::one());
    let tan = sign * twice / size.max(S::of(TINY));
    let cos = S::one() / tan.mul_add(tan, S::one()).sqrt();
    let sin = tan * cos;
    t.0[p][p] = t[p][p] - tan * off;
    t.0[q][q] = tan.mul_add(off, t[q][q]);
    (t.0[p][q], t.0[q][p]) = (S::zero(), S::zero());
    for k in 0..D {
        if k != p && k != q {
            let (kp, kq) = (cos * t[k][p] - sin * t[k][q], sin.mul_add(t[k][p], cos * t[k][q]));
            (t.0[k][p], t.0[p][k], t.0[k][q], t.0[q][k]) = (kp, kp, kq, kq);
        }
        let (kp, kq) = (cos * axes[k][p] - sin * axes[k][q], sin.mul_add(axes[k][p], cos * axes[k][q]));
        (axes.0[k][p], axes.0[k][q]) = (kp, kq);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symmetric tensors with small and large, equal and unequal entries.
    fn samples<const D: usize>() -> Vec<Tensor<f64, D>> {
        let mut all = vec![Tensor::zero(), Tensor::diagonal(-3.0), Tensor::from_fn(|_, _| 2.0)];
        for k in 0..400 {
            let entry = |i: usize, j: usize| {
                let (low, high) = (i.min(j), i.max(j));
                let phase = f64::from(k) * 1.37 + low as f64 * 2.11 + high as f64 * 5.3;
                phase.sin() * if k % 5 == 0 { 10f64.powf(6.0 * (phase * 3.1).cos()) } else { 1.0 }
            };
            all.push(Tensor::from_fn(entry));
        }
        all
    }

    fn size<const D: usize>(t: Tensor<f64, D>) -> f64 {
        t.double_dot(t).sqrt()
    }

    /// Left as they are, values and directions make the tensor again; squared, its square.
    fn comes_back<const D: usize>() {
        for t in samples::<D>() {
            // Eighteen turns of a few roundings each.
            let tolerance = 100.0 * f64::EPSILON;
            let same = size(t.with_principal_values(|x| x) - t);
            assert!(same <= tolerance * size(t), "{t:?}: {same:e}");
            let squared = size(t.with_principal_values(|x| x * x) - t.mul(t));
            assert!(squared <= tolerance * size(t).powi(2), "{t:?}: {squared:e}");
        }
    }

    #[test]
    fn in_the_plane() {
        comes_back::<2>();
    }

    #[test]
    fn in_space() {
        comes_back::<3>();
    }

    /// As Gray et al. (2001) print it, with the angle itself: tan 2 theta = 2 xy / (xx - yy), xx' = c^2 xx + 2 s c xy + s^2 yy, and back.
    #[test]
    fn by_the_angle() {
        for t in samples::<2>() {
            let (sin, cos) = (0.5 * (2.0 * t[0][1]).atan2(t[0][0] - t[1][1])).sin_cos();
            let first = cos * cos * t[0][0] + 2.0 * sin * cos * t[0][1] + sin * sin * t[1][1];
            let second = sin * sin * t[0][0] - 2.0 * sin * cos * t[0][1] + cos * cos * t[1][1];
            let (p, q) = (first.max(0.0), second.max(0.0));
            let mixed = sin * cos * (p - q);
            let expected =
                Tensor([[cos * cos * p + sin * sin * q, mixed], [mixed, sin * sin * p + cos * cos * q]]);
            let error = size(t.with_principal_values(|x| x.max(0.0)) - expected);
            assert!(error <= 100.0 * f64::EPSILON * size(t), "{t:?}: {error:e}");
        }
    }
}
