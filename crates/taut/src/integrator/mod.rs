//! Time integration: position Verlet for both families, the time steps they may take, and rigid bodies, which are told where to be.

mod limits;
mod rigid;
mod solver;
mod total;
mod updated;

pub use limits::{Cause, Diverged, Limits};
pub use rigid::{Motion, Pose, Rigid};
pub use solver::{Seen, Solver};
pub use total::{Total, TotalOptions, WaveSpeed};
pub use updated::{Stepping, Updated, UpdatedOptions};
