//! Quantities such as `17 MPa`: a number, its SI value, and its dimension.

mod dimension;
mod quantity;
mod unit;

pub use dimension::Dimension;
pub use quantity::{Quantity, UnitError};
