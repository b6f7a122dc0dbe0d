//! `taut explain`.

use crate::Failure;
use crate::arguments::TrialOptions;
use crate::check::{duration, reckoned, threads};
use crate::say;

/// Says in plain words what a case does, and what running it would take.
pub fn explain(options: &TrialOptions) -> Result<(), Failure> {
    let (case, e) = reckoned(options)?;
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
