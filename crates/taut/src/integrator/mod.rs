//! Time integration: position Verlet for both families, and the time steps they may take.

mod limits;
mod relax;
mod solver;
mod total;
mod updated;

pub use limits::{Cause, Diverged, Limits};
pub use relax::{Relax, Unrest};
pub use solver::{Seen, Solver};
pub use total::{Total, TotalOptions, WaveSpeed};
pub use updated::{Stepping, Updated, UpdatedOptions};
