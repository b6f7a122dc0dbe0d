//! Loops that do nothing but multiply and add, or nothing but move memory: the two limits of any other loop.

use crate::math::Lanes;
#[cfg(target_arch = "aarch64")]
use crate::math::neon;
use crate::math::plain::{Plain4, PlainSingle8};
#[cfg(target_arch = "x86_64")]
use crate::math::{avx2, avx512};
use crate::run::InstructionSet;
use rayon::prelude::*;
use std::hint::black_box;

/// Sums that do not wait for each other: two units of four or five cycles each need eight or ten.
const CHAINS: usize = 12;

/// Operations of one lane in one round: a multiplication and an addition in every chain.
pub const FLOPS_PER_ROUND: u64 = 2 * CHAINS as u64;

/// `rounds` rounds of multiply-adds in double precision, on one thread. Gives the lanes, and the sum of all chains: each adds
/// one in every round, so it is `lanes * CHAINS * rounds`.
#[must_use]
pub fn multiply_add_double(set: InstructionSet, rounds: u32) -> (usize, f64) {
    match set {
        // SAFETY: this variant is only made where the machine has AVX2 and FMA.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => (avx2::F64x4::N, unsafe { with_avx2::<avx2::F64x4>(rounds) }),
        // SAFETY: this variant is only made where the machine has AVX-512.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => (avx512::F64x8::N, unsafe { with_avx512::<avx512::F64x8>(rounds) }),
        #[cfg(target_arch = "aarch64")]
        InstructionSet::Neon => (neon::F64x4::N, chains::<neon::F64x4>(rounds)),
        InstructionSet::Plain => (Plain4::N, chains::<Plain4>(rounds)),
    }
}

/// The same in single precision; sums are exact up to 2^24 rounds.
#[must_use]
pub fn multiply_add_single(set: InstructionSet, rounds: u32) -> (usize, f64) {
    match set {
        // SAFETY: this variant is only made where the machine has AVX2 and FMA.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => (avx2::F32x8::N, unsafe { with_avx2::<avx2::F32x8>(rounds) }),
        // SAFETY: this variant is only made where the machine has AVX-512.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => (avx512::F32x16::N, unsafe { with_avx512::<avx512::F32x16>(rounds) }),
        #[cfg(target_arch = "aarch64")]
        InstructionSet::Neon => (neon::F32x8::N, chains::<neon::F32x8>(rounds)),
        InstructionSet::Plain => (PlainSingle8::N, chains::<PlainSingle8>(rounds)),
    }
}

/// x <- 1 x + 1 in every lane of every chain. The compiler does not learn that both are one.
#[inline(always)]
fn chains<L: Lanes>(rounds: u32) -> f64 {
    let (factor, step) = (black_box(L::one()), black_box(L::one()));
    let mut x = [L::zero(); CHAINS];
    for _ in 0..rounds {
        for x in &mut x {
            *x = x.mul_add(factor, step);
        }
    }
    x.into_iter().map(Lanes::total).sum()
}

/// # Safety
/// The machine has what AVX2 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2")]
unsafe fn with_avx2<L: Lanes>(rounds: u32) -> f64 {
    chains::<L>(rounds)
}

/// # Safety
/// The machine has what AVX-512 lanes need.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma,popcnt,bmi1,bmi2")]
unsafe fn with_avx512<L: Lanes>(rounds: u32) -> f64 {
    chains::<L>(rounds)
}

/// a = b + factor c, on all threads of the pool it is called from. Moves 24 bytes for each number, as McCalpin's STREAM
/// counts them.
pub fn triad(a: &mut [f64], b: &[f64], c: &[f64], factor: f64) {
    const PIECE: usize = 1 << 16;
    let pieces = a.par_chunks_mut(PIECE).zip(b.par_chunks(PIECE)).zip(c.par_chunks(PIECE));
    pieces.for_each(|((a, b), c)| {
        for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
            *a = b + factor * c;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_instruction_set_does_every_operation() {
        for set in InstructionSet::all() {
            for (lanes, sum) in [multiply_add_double(set, 1000), multiply_add_single(set, 1000)] {
                let flops = FLOPS_PER_ROUND as f64 * lanes as f64 * 1000.0;
                // A flop in two is an addition of one; whole numbers below 2^24 are exact.
                assert_eq!(2.0 * sum, flops, "{}", set.name());
            }
        }
    }

    #[test]
    fn triad_reaches_every_number() {
        let n = 100_000;
        let b: Vec<f64> = (0..n).map(f64::from).collect();
        let (mut a, c) = (vec![f64::NAN; b.len()], vec![2.0; b.len()]);
        triad(&mut a, &b, &c, 0.5);
        assert!(a.iter().zip(&b).all(|(a, b)| *a == b + 1.0));
    }
}
