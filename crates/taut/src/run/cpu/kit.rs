//! Which lanes a run uses: for each precision and instruction set, one type for pair sums and one for updates.

#[cfg(target_arch = "aarch64")]
use crate::math::neon;
use crate::math::plain::{Plain4, PlainSingle8};
use crate::math::{Element, Lanes};
#[cfg(target_arch = "x86_64")]
use crate::math::{avx2, avx512};
use crate::particles::Plain;

/// Lanes of one precision on one instruction set. Updates are always in double precision.
pub trait Kit {
    /// Lanes of pair sums over a stencil.
    type Pair: Lanes;
    /// Lanes of pair sums over a list. Half as many may be better: the last block of a particle is seldom full.
    type Listed: Lanes<E = <Self::Pair as Lanes>::E>;
    /// Lanes in which neighbours are searched for.
    type Search: Lanes<E = f32>;
    /// Lanes in which the weights of a list are made: as many as in a block of the list, or twice as many.
    type Weight: Lanes<E = f32>;
    /// Lanes of updates; as many as those of pair sums, or half.
    type Point: Lanes<E = f64>;
    /// Whether pair sums are in single precision.
    const MIXED: bool;
}

/// How numbers are kept.
pub trait Precision: Send + Sync + std::fmt::Debug + 'static {
    /// What pair sums read.
    type E: Element + Plain;
    /// Lanes without intrinsics.
    type Plain: Kit<Pair: Lanes<E = Self::E>>;
    /// Lanes of NEON.
    #[cfg(target_arch = "aarch64")]
    type Neon: Kit<Pair: Lanes<E = Self::E>>;
    /// Lanes of AVX2.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Kit<Pair: Lanes<E = Self::E>>;
    /// Lanes of AVX-512.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Kit<Pair: Lanes<E = Self::E>>;
    /// Whether pair sums are in single precision.
    const MIXED: bool;
}

/// Everything in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Double;

/// Pair sums in single precision; what is integrated in time, and all updates, in double.
#[derive(Clone, Copy, Debug)]
pub struct Single;

macro_rules! kits {
    ($($(#[$on:meta])* $kit:ident: $pair:ty, $listed:ty, $search:ty, $weight:ty, $point:ty, $mixed:literal;)*) => {$(
        /// A kit.
        $(#[$on])*
        #[derive(Clone, Copy, Debug)]
        pub struct $kit;
        $(#[$on])*
        impl Kit for $kit {
            type Pair = $pair;
            type Listed = $listed;
            type Search = $search;
            type Weight = $weight;
            type Point = $point;
            const MIXED: bool = $mixed;
        }
    )*};
}
kits! {
    PlainDouble: Plain4, Plain4, PlainSingle8, PlainSingle8, Plain4, false;
    PlainSingle: PlainSingle8, PlainSingle8, PlainSingle8, PlainSingle8, Plain4, true;
    #[cfg(target_arch = "aarch64")]
    NeonDouble: neon::F64x4, neon::F64x4, neon::F32x8, neon::F32x8, neon::F64x4, false;
    #[cfg(target_arch = "aarch64")]
    NeonSingle: neon::F32x8, neon::F32x8, neon::F32x8, neon::F32x8, neon::F64x4, true;
    #[cfg(target_arch = "x86_64")]
    Avx2Double: avx2::F64x4, avx2::F64x4, avx2::F32x8, avx2::F32x8, avx2::F64x4, false;
    #[cfg(target_arch = "x86_64")]
    Avx2Single: avx2::F32x8, avx2::F32x8, avx2::F32x8, avx2::F32x8, avx2::F64x4, true;
    #[cfg(target_arch = "x86_64")]
    Avx512Double: avx512::F64x8, avx512::F64x8, avx512::F32x16, avx2::F32x8, avx512::F64x8, false;
    #[cfg(target_arch = "x86_64")]
    Avx512Single: avx512::F32x16, avx2::F32x8, avx512::F32x16, avx2::F32x8, avx512::F64x8, true;
}

impl Precision for Double {
    type E = f64;
    type Plain = PlainDouble;
    #[cfg(target_arch = "aarch64")]
    type Neon = NeonDouble;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = Avx2Double;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = Avx512Double;
    const MIXED: bool = false;
}

impl Precision for Single {
    type E = f32;
    type Plain = PlainSingle;
    #[cfg(target_arch = "aarch64")]
    type Neon = NeonSingle;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = Avx2Single;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = Avx512Single;
    const MIXED: bool = true;
}

/// The instruction set that the lanes use, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// Whatever the base instruction set of the machine offers.
    Plain,
    /// NEON, which every 64-bit ARM processor has.
    #[cfg(target_arch = "aarch64")]
    Neon,
    /// AVX2 with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl InstructionSet {
    /// All that this machine has, the best first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let vector = [(Self::Avx512, avx512::available()), (Self::Avx2, avx2::available())];
        #[cfg(target_arch = "aarch64")]
        let vector = [(Self::Neon, true)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let vector: [(Self, bool); 0] = [];
        vector.into_iter().filter(|s| s.1).map(|s| s.0).chain([Self::Plain]).collect()
    }

    /// The best of this machine.
    #[must_use]
    pub fn best() -> Self {
        Self::all()[0]
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            #[cfg(target_arch = "aarch64")]
            Self::Neon => "neon",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2+fma",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => "avx512",
        }
    }

    /// Lanes of pair sums, double or single: how many neighbours or particles go side by side.
    #[must_use]
    pub const fn lanes<P: Precision>(self) -> usize {
        match self {
            Self::Plain => <P::Plain as Kit>::Pair::N,
            #[cfg(target_arch = "aarch64")]
            Self::Neon => <P::Neon as Kit>::Pair::N,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => <P::Avx2 as Kit>::Pair::N,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => <P::Avx512 as Kit>::Pair::N,
        }
    }
}
