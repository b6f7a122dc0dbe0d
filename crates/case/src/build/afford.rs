//! Whether a case fits into the memory of this machine, before anything is made.

use super::shapes;
use crate::{Case, CaseError};

/// Bytes that a particle needs at least, in 2D and 3D: less than was measured for any formulation (2.2 and 2.8 kB), since a case that
/// fits must not be refused.
const LEAST: [f64; 2] = [1800.0, 2300.0];

/// About how many particles the case has, from its shapes alone.
#[must_use]
pub fn reckon(case: &Case) -> f64 {
    let dimension = if case.dimension == 2 { shapes::dimension::<2>() } else { shapes::dimension::<3>() };
    let shapes = case.bodies.iter().map(|b| &b.shape).chain(case.tools.iter().map(|tool| &tool.shape));
    shapes.map(|shape| geometry::reckon(&shapes::shape(shape), case.spacing, dimension)).sum()
}

/// Memory that can be had, bytes; `None` where the system does not say.
#[must_use]
pub fn available_memory() -> Option<f64> {
    let table = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = table.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.split_whitespace().next()?.parse::<f64>().ok().map(|kilobytes| 1024.0 * kilobytes)
}

/// Refuses a case that needs more memory than there is.
pub fn check<const D: usize>(case: &Case) -> Result<(), CaseError> {
    let Some(available) = available_memory() else { return Ok(()) };
    let count = reckon(case);
    let needed = count * LEAST[D - 2];
    // What is no number has a better message when the shape is filled.
    if !needed.is_finite() || needed <= available || count > geometry::MAX_PARTICLES as f64 {
        return Ok(());
    }
    let message = format!(
        "about {count:.1e} particles need at least {:.0} GB of memory, and {:.0} GB are free",
        needed / 1e9,
        available / 1e9
    );
    Err(case.error_at(case.bodies[0].place, message, Some("choose a larger spacing".to_string())))
}
