//! From numbers to cells: smallest, largest, and rounded down.

use rayon::prelude::*;

/// Numbers handed to a thread at a time.
const CHUNK: usize = 1 << 14;

/// Smallest and largest number of a column; NaN if one of them is; none gives infinities the wrong way round.
pub fn range(column: &[f64]) -> (f64, f64) {
    let join =
        |a: (f64, f64), b: (f64, f64)| (if b.0 < a.0 { b.0 } else { a.0 }, if b.1 > a.1 { b.1 } else { a.1 });
    let chunk = |column: &[f64]| {
        // Side by side, so that the compiler can use lanes. Zero times what is no number is none either.
        let (mut ranges, mut nought) = ([(f64::INFINITY, f64::NEG_INFINITY); 8], [0.0; 8]);
        for group in column.chunks(8) {
            for (l, &x) in group.iter().enumerate() {
                ranges[l] = join(ranges[l], (x, x));
                nought[l] += 0.0 * x;
            }
        }
        let (low, high) = ranges.into_iter().fold(ranges[0], join);
        let nought: f64 = nought.into_iter().sum();
        (low + nought, high + nought)
    };
    let none = || (f64::INFINITY, f64::NEG_INFINITY);
    column.par_chunks(CHUNK).map(chunk).reduce(none, |a, b| {
        if a.0.is_nan() {
            a
        } else if b.0.is_nan() {
            b
        } else {
            join(a, b)
        }
    })
}

/// The largest whole number that is not larger. (Without SSE 4.1 the one of the library is a call.)
#[inline(always)]
pub fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole - i64::from(x < whole as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn range_sees_everything_that_is_no_number() {
        let mut column: Vec<f64> = (0..40_000).map(|i| f64::from((i * 7919) % 40_000) - 100.0).collect();
        assert_eq!(range(&column), (-100.0, 39_899.0));
        assert_eq!(range(&[]), (f64::INFINITY, f64::NEG_INFINITY));
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            column[33_333] = wrong;
            assert!(range(&column).0.is_nan() && range(&column).1.is_nan(), "{wrong}");
        }
    }

    #[test]
    fn floor_is_that_of_the_library() {
        for x in [0.0, -0.0, 0.5, -0.5, 2.0, -2.0, 1e9 + 0.7, -1e9 - 0.7] {
            assert_eq!(floor(x), x.floor() as i64, "{x}");
        }
    }
}
