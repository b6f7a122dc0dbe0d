//! Time integration: position Verlet for both families, and the time steps they may take.

mod diverged;
mod limits;
mod outside;
mod relax;
mod solver;
mod total;
mod updated;

pub use diverged::{Cause, Diverged};
pub use limits::{Bounding, Criterion, Limits};
pub use outside::{Held, Impulse, cross};
pub use relax::{Relax, Unrest};
pub use solver::{Seen, Solver};
pub use total::{Total, TotalOptions, WaveSpeed};
pub use updated::{Stepping, Updated, UpdatedOptions};
