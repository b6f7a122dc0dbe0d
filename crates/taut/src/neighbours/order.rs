//! The order of particles along a Hilbert curve: particles close in the order are close in space.

use rayon::prelude::*;

use super::error::{self, SearchError};

/// Bits of the curve per axis; three axes fill 60 of the 64 bits of a key.
const BITS: u32 = 20;

/// Writes into `out` the particles in the order in which a Hilbert curve visits them.
///
/// The curve fills the smallest cube around all particles with 2^20 steps per axis; particles on the same step
/// keep their order. `x` are columns in m, D is 2 or 3.
///
/// # Errors
/// A coordinate that is not a usable number, columns of unequal length, 2^32 particles or more.
pub fn hilbert_order<const D: usize>(x: [&[f64]; D], out: &mut Vec<u32>) -> Result<(), SearchError> {
    const { assert!(D == 2 || D == 3, "the curve lives in two or three dimensions") };
    let n = error::particles(x)?;
    error::check_positions(x)?;
    let low = x.map(|column| column.iter().copied().fold(f64::INFINITY, f64::min));
    let high = x.map(|column| column.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let longest = (0..D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let steps = (1_u64 << BITS) as f64;
    let scale = if longest > 0.0 { steps / longest } else { 0.0 };
    let step = |axis: usize, a: usize| ((x[axis][a] - low[axis]) * scale).min(steps - 1.0) as u32;
    let keys: Vec<u64> =
        (0..n).into_par_iter().map(|a| key::<D>(std::array::from_fn(|axis| step(axis, a)))).collect();
    out.clear();
    out.extend(0..n as u32);
    out.par_sort_unstable_by_key(|&a| (keys[a as usize], a));
    Ok(())
}

/// How far along the curve a cell lies.
///
/// After J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707 (2004) 381: from the coarsest bit to
/// the finest, the turn and flip of the quadrant (octant) a cell lies in is undone for all finer bits; a Gray
/// code then numbers the quadrants.
fn key<const D: usize>(mut cell: [u32; D]) -> u64 {
    for level in (1..BITS).rev() {
        let finer = (1 << level) - 1;
        for axis in 0..D {
            if cell[axis] >> level & 1 == 1 {
                cell[0] ^= finer;
            } else {
                let differ = (cell[0] ^ cell[axis]) & finer;
                cell[0] ^= differ;
                cell[axis] ^= differ;
            }
        }
    }
    for axis in 1..D {
        cell[axis] ^= cell[axis - 1];
    }
    let odd = (1..BITS)
        .filter(|level| cell[D - 1] >> level & 1 == 1)
        .fold(0, |flips, level| flips ^ ((1 << level) - 1));
    let gray = cell.map(|bits| bits ^ odd);
    (0..BITS)
        .rev()
        .fold(0, |key, level| gray.iter().fold(key, |key, bits| key << 1 | u64::from(bits >> level & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::sample;

    fn steps<const D: usize>(side: usize) -> Vec<f64> {
        let columns = sample::lattice::<D>([side; D], 0.25);
        let x = sample::slices(&columns);
        let mut order = Vec::new();
        hilbert_order(x, &mut order).unwrap();
        let distance = |a: usize, b: usize| x.iter().map(|c| (c[a] - c[b]).powi(2)).sum::<f64>().sqrt();
        order.windows(2).map(|pair| distance(pair[0] as usize, pair[1] as usize)).collect()
    }

    #[test]
    fn consecutive_particles_of_a_full_lattice_are_neighbours() {
        // Multiples of a quarter: the distances are exact.
        assert!(steps::<2>(32).iter().all(|&step| step == 0.25));
        assert!(steps::<3>(16).iter().all(|&step| step == 0.25));
    }

    #[test]
    fn is_a_permutation_and_the_same_for_any_number_of_threads() {
        let columns = sample::random::<3>(5000, 11);
        let order = |threads| {
            let mut order = Vec::new();
            sample::on_threads(threads, || hilbert_order(sample::slices(&columns), &mut order).unwrap());
            order
        };
        let one = order(1);
        assert_eq!(one, order(3));
        let mut sorted = one.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..5000));
        assert_ne!(one, sorted);
    }

    #[test]
    fn coincident_particles_keep_their_order() {
        let mut order = Vec::new();
        hilbert_order([&[2.0; 4], &[3.0; 4]], &mut order).unwrap();
        assert_eq!(order, [0, 1, 2, 3]);
        hilbert_order::<2>([&[], &[]], &mut order).unwrap();
        assert!(order.is_empty());
        assert!(hilbert_order([&[0.0, f64::NAN], &[0.0, 0.0]], &mut order).is_err());
    }
}
