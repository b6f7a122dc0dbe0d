//! `taut explain`.

use crate::Failure;
use crate::arguments::CaseOptions;
use crate::builtin::read;
use crate::check::{duration, reckoned, threads};
use crate::say;

/// Says in plain words what a case does, and what running it would take.
pub fn explain(options: &CaseOptions) -> Result<(), Failure> {
    let case = read(options)?;
    let e = reckoned(&case)?;
    say::warnings(&case);
    say!("{}", case::explain(&case));
    say!("Cost");
    say!("  - {} particles, about {:.0} steps of {:.3e} s.", e.particles, e.steps, e.dt);
    say!("  - About {} on {}.", duration(e.seconds), threads(e.threads));
    for warning in &e.warnings {
        say!("  - Warning: {warning}.");
    }
    Ok(())
}
