//! Who is near whom: a cell grid, the list of all pairs closer than a radius, a trivial search that the tests
//! compare with, and the order in which particles are stored.
//!
//! Positions come as columns, `x: [&[f64]; D]` with one entry per particle and axis. Every result is the same
//! for any number of threads.

mod adjacency;
mod error;
mod extent;
mod grid;
mod lattice;
mod order;
mod search;
mod trivial;

#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;

pub use adjacency::Adjacency;
pub use error::{SearchError, check_positions};
pub(crate) use extent::floor;
pub use grid::{CellGrid, Near};
pub use lattice::Lattice;
pub use order::storage_order;
pub use search::Search;
pub use trivial::trivial_pairs;
