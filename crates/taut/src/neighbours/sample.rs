//! Particle sets for tests.

/// Borrows columns.
pub fn slices<const D: usize>(columns: &[Vec<f64>; D]) -> [&[f64]; D] {
    std::array::from_fn(|axis| columns[axis].as_slice())
}

/// A lattice of `count` particles per axis with spacing `dp`; the last axis runs fastest.
pub fn lattice<const D: usize>(count: [usize; D], dp: f64) -> [Vec<f64>; D] {
    let mut columns = std::array::from_fn(|_| Vec::new());
    for mut k in 0..count.iter().product::<usize>() {
        for axis in (0..D).rev() {
            columns[axis].push((k % count[axis]) as f64 * dp);
            k /= count[axis];
        }
    }
    columns
}

/// `n` particles anywhere in the unit cube; the numbers follow from `seed` (splitmix64).
pub fn random<const D: usize>(n: usize, seed: u64) -> [Vec<f64>; D] {
    let mut state = seed;
    std::array::from_fn(|_| (0..n).map(|_| uniform(&mut state)).collect())
}

fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut bits = *state;
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Runs `work` on a pool of its own.
pub fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}
