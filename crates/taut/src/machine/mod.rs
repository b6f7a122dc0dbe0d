//! What a machine can do, and what a formulation asks of it: the loops behind `taut bench`. Who times them stands outside.

mod count;
mod peak;
mod tally;

pub use count::Counted;
pub use peak::{FLOPS_PER_ROUND, multiply_add_double, multiply_add_single, triad};
pub use tally::{Operations, operations};
