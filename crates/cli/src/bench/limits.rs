//! The limits of the machine, measured.

use super::body::Size;
use serde::{Deserialize, Serialize};
use std::time::Instant;
use taut::machine::{FLOPS_PER_ROUND, multiply_add_double, multiply_add_single, triad};
use taut::run::InstructionSet;
use taut::simulation::Numbers;

/// What so many threads can do at best.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Threads.
    pub threads: usize,
    /// Floating-point operations in double precision, 1/s.
    pub double_flops: f64,
    /// The same in single precision.
    pub single_flops: f64,
    /// Memory moved by a triad, bytes/s.
    pub triad_bytes: f64,
}

/// The arrays of the triad; each far beyond the caches.
pub struct Arrays([Vec<f64>; 3]);

impl Arrays {
    /// Three arrays of 64 MiB, or of 32.
    pub fn new(size: Size) -> Self {
        let numbers = if size == Size::Full { 1 << 23 } else { 1 << 22 };
        Self([1.0, 2.0, 3.0].map(|x| vec![x; numbers]))
    }
}

/// Rounds of multiply-adds that are timed at once: a few milliseconds.
const ROUNDS: u32 = 1 << 19;
/// How often everything is timed; the fastest counts.
const REPEATS: usize = 7;

impl Limits {
    /// Measures in the pool that the calling thread belongs to.
    pub fn measure(arrays: &mut Arrays) -> Self {
        let (threads, set) = (rayon::current_num_threads(), InstructionSet::best());
        let flops = |one: fn(InstructionSet, u32) -> (usize, f64)| {
            let mut lanes = 0;
            let seconds = fastest(|| {
                lanes = rayon::broadcast(|_| one(set, ROUNDS).0).iter().sum();
            });
            (FLOPS_PER_ROUND * u64::from(ROUNDS)) as f64 * lanes as f64 / seconds
        };
        let (double_flops, single_flops) = (flops(multiply_add_double), flops(multiply_add_single));
        let [a, b, c] = &mut arrays.0;
        let seconds = fastest(|| triad(a, b, c, 0.5));
        Self { threads, double_flops, single_flops, triad_bytes: 24.0 * a.len() as f64 / seconds }
    }

    /// The better of two measurements: what disturbs a machine only ever makes it slower.
    pub fn or(self, other: &Self) -> Self {
        Self {
            threads: self.threads,
            double_flops: self.double_flops.max(other.double_flops),
            single_flops: self.single_flops.max(other.single_flops),
            triad_bytes: self.triad_bytes.max(other.triad_bytes),
        }
    }

    /// Operations in this precision, 1/s.
    pub fn flops(&self, numbers: Numbers) -> f64 {
        match numbers {
            Numbers::Double => self.double_flops,
            Numbers::Single => self.single_flops,
        }
    }
}

fn fastest(mut work: impl FnMut()) -> f64 {
    let timed = |_| {
        let clock = Instant::now();
        work();
        clock.elapsed().as_secs_f64()
    };
    (0..REPEATS).map(timed).fold(f64::INFINITY, f64::min)
}
