//! Who runs passes: threads and SIMD lanes ([`Cpu`]), and a plain serial loop as the oracle ([`Serial`]).

mod cpu;
mod serial;
mod sweeper;

pub use cpu::{Cpu, Double, InstructionSet, Precision, Single};
pub use serial::Serial;
pub use sweeper::Sweeper;

use crate::field::Quantity;
use crate::kernel::Kernel;
use crate::neighbours::SearchError;
use crate::particles::Particles;
use crate::pass::{Now, PairSum, Reduce, Update};

/// Most numbers that one record may have.
pub const MAX_WORDS: usize = 64;

/// How a pair list is made.
#[derive(Clone, Copy, Debug)]
pub struct Relist {
    /// The field of positions: [`Quantity::ReferencePosition`] or [`Quantity::Position`].
    pub positions: Quantity,
    /// The kernel whose gradient the list holds; its support is the search radius.
    pub kernel: Kernel,
    /// Which particles may be neighbours.
    pub among: Among,
}

/// Which particles may be neighbours of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Among {
    /// All of them: bodies feel each other.
    All,
    /// Only particles of the same body.
    SameBody,
}

/// One number of all particles, in the precision that it is kept in.
#[derive(Clone, Copy, Debug)]
pub enum Numbers<'a> {
    /// In double precision.
    Double(&'a [f64]),
    /// In single precision.
    Single(&'a [f32]),
}

impl<'a> Numbers<'a> {
    /// The numbers, if they are in double precision.
    #[must_use]
    pub fn double(self) -> Option<&'a [f64]> {
        match self {
            Self::Double(numbers) => Some(numbers),
            Self::Single(_) => None,
        }
    }

    /// The number of one particle.
    #[inline(always)]
    #[must_use]
    pub fn at(self, place: usize) -> f64 {
        match self {
            Self::Double(numbers) => numbers[place],
            Self::Single(numbers) => f64::from(numbers[place]),
        }
    }
}

/// A back-end: it owns the particles and their pair list, and runs passes over them.
pub trait Run<const D: usize>: Send + Sync {
    /// The particles. In a single run only what is integrated in time is up to date here; [`Run::word`] always is.
    fn particles(&self) -> &Particles<D>;

    /// The particles, to write from outside of passes.
    fn particles_mut(&mut self) -> &mut Particles<D>;

    /// One number of one particle, as it is now.
    fn word(&self, field: Quantity, word: usize, place: usize) -> f64 {
        self.particles().column(field, word)[place]
    }

    /// One number of all particles, as it is now.
    fn numbers(&self, field: Quantity, word: usize) -> Numbers<'_> {
        Numbers::Double(self.particles().column(field, word))
    }

    /// Sets one number of one particle.
    fn set_word(&mut self, field: Quantity, word: usize, (place, value): (usize, f64)) {
        self.particles_mut().column_mut(field, word)[place] = value;
    }

    /// Finds the neighbours anew and evaluates the kernel of every pair, with the present `Volume` of b.
    ///
    /// # Errors
    /// If a position is not a number.
    fn relist(&mut self, how: &Relist) -> Result<(), SearchError>;

    /// Mean number of neighbours in the last [`Run::relist`].
    fn neighbours(&self) -> f64;

    /// The place of the particle with the fewest neighbours in the last [`Run::relist`], and how many those are; `None` if all
    /// stand on a lattice, which nobody leaves, or nobody counts.
    fn loneliest(&self) -> Option<(usize, usize)> {
        None
    }

    /// For every particle: `sum` over its neighbours, and what follows from it.
    fn pairs<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(&mut self, sum: &P, then: &U, now: Now<f64>);

    /// An update of every particle.
    fn each<U: Update<D, Sum = ()>>(&mut self, update: &U, now: Now<f64>);

    /// `K` numbers of all particles.
    fn reduce<R: Reduce<D, K>, const K: usize>(&mut self, reduce: &R) -> [f64; K];
}
