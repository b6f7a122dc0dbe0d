//! Time integration: position Verlet for both families, the time steps they may take, and rigid bodies, which are told where to be.

mod diverged;
mod limits;
mod outside;
mod relax;
mod rigid;
mod solver;
mod spectrum;
mod tangent;
mod total;
mod updated;

pub use diverged::{Cause, Diverged};
pub use limits::{Bounding, Criterion, Limits};
pub use outside::{Held, Impulse, cross};
pub use relax::{Relax, Unrest};
pub use rigid::{Motion, Pose, Rigid};
pub use solver::{Seen, Solver};
pub use spectrum::{Stiffness, highest, scattered};
pub use total::{Total, TotalOptions, WaveSpeed};
pub use updated::{Stepping, Updated, UpdatedOptions};
