//! Every lane type behaves as so many scalars.

use super::*;

/// `eps`: the rounding unit of the numbers in memory.
fn exercise<V: Lanes>(eps: f64) {
    let a: Vec<V::E> = (0..64).map(|i| V::E::from_f64(0.3 + f64::from(i) * 0.21)).collect();
    let value = |i: usize| a[i].to_f64();
    let lane = |v: V| {
        let mut out = vec![V::E::default(); V::N];
        // SAFETY: `out` holds `N` numbers.
        unsafe { v.store(out.as_mut_ptr()) };
        out.into_iter().map(Element::to_f64).collect::<Vec<_>>()
    };
    // SAFETY: enough numbers behind the pointers used.
    let (x, y) = unsafe { (V::load(a.as_ptr()), V::load(a.as_ptr().add(5))) };
    let each = |name: &str, got: V, want: &dyn Fn(f64, f64) -> f64| {
        for (l, g) in lane(got).into_iter().enumerate() {
            let w = want(value(l), value(l + 5));
            // One fused rounding against two, and at most one more in exp and ln: 3 eps relative.
            assert!((g - w).abs() <= 3.0 * eps * w.abs().max(1.0), "{name} lane {l}: {g} {w}");
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
    each("exp", (x - y).exp(), &|a, b| (a - b).exp());
    each("ln", x.ln(), &|a, _| a.ln());
    each("min", y.min(x), &|a, _| a);
    each("max", y.max(x), &|_, b| b);
    each("select", V::select(x.lt(V::of(0.6)), x, y), &|a, b| if a < 0.6 { a } else { b });
    let sum: f64 = (0..V::N).map(value).sum();
    assert!((x.total() - sum).abs() < 4.0 * eps * sum);
    let single: Vec<f32> = (0..32u8).map(|i| f32::from(i) * 0.25).collect();
    // SAFETY: enough floats behind the pointer.
    let loaded = lane(unsafe { V::load_single(single.as_ptr().add(1)) });
    assert_eq!(loaded, (1..=V::N).map(|i| i as f64 * 0.25).collect::<Vec<_>>());
    let mut doubles = vec![0.0; V::N];
    // SAFETY: `doubles` holds `N` numbers.
    unsafe { x.store_double(doubles.as_mut_ptr()) };
    assert_eq!(doubles, lane(x));
    let mut singles = vec![0.0f32; V::N];
    // SAFETY: `singles` holds `N` numbers.
    unsafe { x.store_single(singles.as_mut_ptr()) };
    assert_eq!(singles, lane(x).into_iter().map(|v| v as f32).collect::<Vec<_>>());
    // SAFETY: each address is followed by at least four numbers.
    let t = unsafe { V::transposed(|l| a.as_ptr().add(2 * l)) };
    for (k, word) in t.into_iter().enumerate() {
        assert_eq!(lane(word), (0..V::N).map(|l| value(2 * l + k)).collect::<Vec<_>>(), "word {k}");
    }
}

const DOUBLE: f64 = f64::EPSILON;
const SINGLE: f64 = f32::EPSILON as f64;

#[test]
fn plain_lanes() {
    exercise::<plain::Plain4>(DOUBLE);
    exercise::<plain::PlainSingle8>(SINGLE);
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx2_lanes() {
    if avx2::available() {
        exercise::<avx2::F64x4>(DOUBLE);
        exercise::<avx2::F32x8>(SINGLE);
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx512_lanes() {
    if avx512::available() {
        exercise::<avx512::F64x8>(DOUBLE);
        exercise::<avx512::F32x16>(SINGLE);
    }
}
