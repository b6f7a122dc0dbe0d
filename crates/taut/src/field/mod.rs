//! The glossary: every quantity stands here once, with its symbol, name, unit and rank. Storage, records, files and
//! the table in the manual come from it.

#[macro_use]
mod record;
mod glossary;
mod words;

pub use glossary::*;
pub use record::{Of, Record};
pub use words::{Sink, Source, Value};

use crate::math::{Real, Tensor, Vector};

/// How many numbers a quantity has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// One number.
    Scalar,
    /// One number for each axis.
    Vector,
    /// One number for each pair of axes, row by row.
    Tensor,
}

impl Rank {
    /// Numbers of this rank in `d` dimensions.
    #[must_use]
    pub const fn words(self, d: usize) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Vector => d,
            Self::Tensor => d * d,
        }
    }
}

/// The rank as a type: what a quantity of this rank looks like in numbers `S`.
pub trait Shape {
    /// The value, in numbers `S`, in `D` dimensions.
    type In<S: Real, const D: usize>: Value<S>;
    /// The rank as a value.
    const RANK: Rank;
}

/// Rank of scalars.
pub struct AsScalar;
/// Rank of vectors.
pub struct AsVector;
/// Rank of tensors.
pub struct AsTensor;

impl Shape for AsScalar {
    type In<S: Real, const D: usize> = S;
    const RANK: Rank = Rank::Scalar;
}
impl Shape for AsVector {
    type In<S: Real, const D: usize> = Vector<S, D>;
    const RANK: Rank = Rank::Vector;
}
impl Shape for AsTensor {
    type In<S: Real, const D: usize> = Tensor<S, D>;
    const RANK: Rank = Rank::Tensor;
}

/// A quantity of the glossary, as a type.
pub trait Field {
    /// Its rank.
    type Shape: Shape;
    /// Its entry.
    const ID: Quantity;
}

/// The value of field `F` in numbers `S`.
pub type In<F, S, const D: usize> = <<F as Field>::Shape as Shape>::In<S, D>;
