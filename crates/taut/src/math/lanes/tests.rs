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

/// Sums of rows, packing, and distances on the fine grid. Whole numbers: everything is exact.
fn exercise_pairs<V: Lanes>() {
    let row =
        |r: usize| -> Vec<V::E> { (0..V::N).map(|l| V::E::from_f64((1 + r * 7 + l * 3) as f64)).collect() };
    // SAFETY: every row holds `N` numbers.
    let rows: Vec<V> = (0..8).map(|r| unsafe { V::load(row(r).as_ptr()) }).collect();
    let mut totals = [0.0; 8];
    V::totals(&rows, &mut totals);
    for (r, total) in totals.into_iter().enumerate() {
        assert_eq!(total, row(r).into_iter().map(Element::to_f64).sum::<f64>(), "row {r}");
        assert_eq!(total, rows[r].total());
    }

    let ids: Vec<u32> = (0..V::N as u32).map(|l| 100 + l).collect();
    for bits in 0..1_u32 << V::N.min(8) {
        let (mut to, mut to_ids) = (vec![0.0; V::N], vec![0; V::N]);
        // SAFETY: `N` numbers behind each pointer.
        unsafe { rows[0].compress(bits, ids.as_ptr(), (to.as_mut_ptr(), to_ids.as_mut_ptr())) };
        let wanted: Vec<usize> = (0..V::N).filter(|l| bits >> l & 1 == 1).collect();
        for (k, &l) in wanted.iter().enumerate() {
            assert_eq!((f64::from(to[k]), to_ids[k]), (row(0)[l].to_f64(), ids[l]), "lanes {bits:b}");
        }
    }
    assert_eq!(V::bits(rows[0].lt(V::of(8.0))), 0b111, "lanes hold 1, 4, 7, 10, ...");

    // Coordinates just below and above 2^32 are neighbours.
    let coordinate = |l: usize, which: usize| (7 * l as u32 + 3 * which as u32).wrapping_sub(10);
    let packed: Vec<V::E> =
        (0..V::N).map(|l| V::E::packed(&[coordinate(l, 0), coordinate(l, 1)][..V::E::COORDINATES])).collect();
    for step in [1.0, 0.25, 2.0f64.powi(-40)] {
        // SAFETY: `N` numbers behind the pointer.
        let offsets = unsafe { V::load(packed.as_ptr()).offsets(5 | 5 << 32, step) };
        for (which, lanes) in offsets.into_iter().enumerate().take(V::E::COORDINATES) {
            assert_eq!(packed[1].coordinate(which), coordinate(1, which));
            let mut apart = vec![V::E::default(); V::N];
            // SAFETY: as above.
            unsafe { lanes.store(apart.as_mut_ptr()) };
            for (l, apart) in apart.into_iter().enumerate() {
                let steps = 15.0 - 7.0 * l as f64 - 3.0 * which as f64;
                assert_eq!(apart.to_f64(), steps * step, "lane {l}");
            }
        }
    }
}

const DOUBLE: f64 = f64::EPSILON;
const SINGLE: f64 = f32::EPSILON as f64;

#[test]
fn plain_lanes() {
    exercise::<plain::Plain4>(DOUBLE);
    exercise::<plain::PlainSingle8>(SINGLE);
    exercise_pairs::<plain::Plain4>();
    exercise_pairs::<plain::PlainSingle8>();
}

#[cfg(target_arch = "aarch64")]
#[test]
fn neon_lanes() {
    exercise::<neon::F64x4>(DOUBLE);
    exercise::<neon::F32x8>(SINGLE);
    exercise_pairs::<neon::F64x4>();
    exercise_pairs::<neon::F32x8>();
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx2_lanes() {
    if avx2::available() {
        exercise::<avx2::F64x4>(DOUBLE);
        exercise::<avx2::F32x8>(SINGLE);
        exercise_pairs::<avx2::F64x4>();
        exercise_pairs::<avx2::F32x8>();
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx512_lanes() {
    if avx512::available() {
        exercise::<avx512::F64x8>(DOUBLE);
        exercise::<avx512::F32x16>(SINGLE);
        exercise_pairs::<avx512::F64x8>();
        exercise_pairs::<avx512::F32x16>();
    }
}
