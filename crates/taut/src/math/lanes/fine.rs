//! From whole numbers to doubles without a conversion.

/// What makes doubles of whole numbers of 32 bits: behind the exponent of 2^52 steps, whose last place is worth a step, they are the low bits of
/// 2^52 steps and so many more. Taking away as much again leaves the number times the step, without rounding.
#[derive(Clone, Copy, Debug)]
pub struct Fine {
    /// The bits of 2^52 steps.
    pub exponent: u64,
    /// What has to be taken away: 2^52 + 2^31 steps.
    pub shift: f64,
}

impl Fine {
    /// 2^31 in both halves of a word: added to distances of either sign, it leaves whole numbers from 0 on. (Exclusive or adds it, modulo 2^32.)
    pub const MIDDLE: u64 = 0x8000_0000_8000_0000;

    /// For steps of this size, a power of two.
    #[inline(always)]
    pub fn of(step: f64) -> Self {
        let ulps = (1_u64 << 52) as f64;
        Self { exponent: (step * ulps).to_bits(), shift: step * (ulps + (1_u64 << 31) as f64) }
    }
}
