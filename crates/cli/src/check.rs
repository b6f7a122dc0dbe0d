//! `taut check`.

use crate::Failure;
use crate::arguments::CheckOptions;
use crate::builtin::{colour, read};
use crate::say;
use case::run::{Estimate, RunError, estimate};

/// Prints what a run would be.
pub fn check(options: &CheckOptions) -> Result<(), Failure> {
    let case = read(&options.case)?;
    let e = estimate(&case, options.precision.into()).map_err(|error| match error {
        RunError::Case(error) => Failure::Input(error.render(colour())),
        other => Failure::Run(other.to_string()),
    })?;
    say::warnings(&case);
    say!("{}: {}", case.name, case.title);
    for body in &case.bodies {
        if let Some(material) = case.material_of(body) {
            let elastic = &material.elastic;
            let speed =
                ((elastic.bulk_modulus + elastic.shear_modulus * 4.0 / 3.0) / material.density).sqrt();
            let formulation = body.scheme.formulation.name();
            say!("  body {}: {}, {formulation}, wave speed {speed:.4} m/s", body.name, material.name);
        }
    }
    print(&e, case.time.end);
    for warning in &e.warnings {
        say!("  warning: {warning}");
    }
    Ok(())
}

fn print(e: &Estimate, end: f64) {
    say!("  particles   {} with {:.1} neighbours", e.particles, e.neighbours);
    say!("  memory      about {:.0} MB", (e.memory / 1e6).max(1.0));
    say!("  time step   {:.4e} s, about {:.0} steps to {end} s", e.dt, e.steps);
    say!("  run time    about {} on one thread", duration(e.seconds));
}

/// A duration as people say it.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{:.0} s", s.ceil()),
        s if s < 5940.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
