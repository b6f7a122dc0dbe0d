//! Several numbers in one: the lanes of a SIMD register.

#[cfg(target_arch = "x86_64")]
pub mod avx2;
pub mod plain;

use super::Real;

/// Four doubles that move together. Every instruction set offers a type of its own; which one a run uses is
/// decided at run time, and the physics never knows.
pub trait Lanes: Real {
    /// Numbers side by side.
    const N: usize = 4;

    /// Reads four consecutive numbers.
    ///
    /// # Safety
    /// `from` points at four readable doubles.
    unsafe fn load(from: *const f64) -> Self;

    /// Reads four consecutive numbers of single precision.
    ///
    /// # Safety
    /// `from` points at four readable floats.
    unsafe fn load_single(from: *const f32) -> Self;

    /// Writes four consecutive numbers.
    ///
    /// # Safety
    /// `to` points at four writable doubles.
    unsafe fn store(self, to: *mut f64);

    /// Reads four consecutive numbers behind each of four addresses and transposes: lane `l` of word `k` is
    /// what stands `k` behind `from[l]`.
    ///
    /// # Safety
    /// Each address points at four readable doubles.
    unsafe fn transposed(from: [*const f64; 4]) -> [Self; 4];

    /// The sum of the lanes, always added in the same order.
    fn total(self) -> f64;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exercise<V: Lanes>() {
        let a: Vec<f64> = (0..16).map(|i| 0.3 + f64::from(i) * 0.21).collect();
        let lane = |v: V| {
            let mut out = [0.0; 4];
            // SAFETY: `out` holds four doubles.
            unsafe { v.store(out.as_mut_ptr()) };
            out
        };
        // SAFETY: sixteen doubles behind the pointers used.
        let (x, y) = unsafe { (V::load(a.as_ptr()), V::load(a.as_ptr().add(5))) };
        let each = |name: &str, got: V, want: &dyn Fn(f64, f64) -> f64| {
            for (l, g) in lane(got).into_iter().enumerate() {
                let w = want(a[l], a[l + 5]);
                // One fused rounding against two: 2 eps relative.
                assert!((g - w).abs() <= 2.0 * f64::EPSILON * w.abs(), "{name} lane {l}: {g} {w}");
            }
        };
        each("+", x + y, &|a, b| a + b);
        each("-", x - y, &|a, b| a - b);
        each("*", x * y, &|a, b| a * b);
        each("/", x / y, &|a, b| a / b);
        each("neg", -x, &|a, _| -a);
        each("fma", x.mul_add(y, y), &|a, b| a * b + b);
        each("sqrt", x.sqrt(), &|a, _| a.sqrt());
        each("abs", (-x).abs(), &|a, _| a);
        each("exp", x.exp(), &|a, _| a.exp());
        each("ln", x.ln(), &|a, _| a.ln());
        each("min", y.min(x), &|a, _| a);
        each("max", y.max(x), &|_, b| b);
        each("select", V::select(x.lt(V::of(0.6)), x, y), &|a, b| if a < 0.6 { a } else { b });
        let single: Vec<f32> = (0..8u8).map(|i| f32::from(i) * 0.25).collect();
        // SAFETY: eight floats behind the pointer.
        assert_eq!(lane(unsafe { V::load_single(single.as_ptr().add(1)) }), [0.25, 0.5, 0.75, 1.0]);
        assert!((x.total() - a[..4].iter().sum::<f64>()).abs() < 1e-15);
        // SAFETY: each address is followed by at least four doubles.
        let t = unsafe { V::transposed([0, 2, 4, 6].map(|o| a.as_ptr().add(o))) };
        for (k, word) in t.into_iter().enumerate() {
            assert_eq!(lane(word), [a[k], a[2 + k], a[4 + k], a[6 + k]]);
        }
    }

    #[test]
    fn plain_lanes_behave_as_four_scalars() {
        exercise::<plain::Plain4>();
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn avx2_lanes_behave_as_four_scalars() {
        if avx2::available() {
            exercise::<avx2::F64x4>();
        }
    }
}
