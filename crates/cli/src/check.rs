//! `taut check`.

use crate::Failure;
use crate::arguments::TrialOptions;
use crate::builtin::{colour, read};
use crate::{mesh, say};
use case::Case;
use case::run::{Estimate, RunError, estimate};
use report::{Picture, View, encoded, picture};

/// Prints what a run would be.
pub fn check(options: &TrialOptions) -> Result<(), Failure> {
    let (case, e) = reckoned(options)?;
    say::warnings(&case);
    say!("{}: {}", case.name, case.title);
    for (body, across) in case.bodies.iter().zip(&e.across) {
        if let Some(material) = case.material_of(body) {
            let (formulation, speed) = (body.scheme.formulation.name(), material.wave_speed());
            say!("  body {}: {}, {formulation}, wave speed {speed:.4} m/s", body.name, material.name);
            say!("              {across} particles across its thinnest part");
        }
    }
    for tool in &case.tools {
        say!("  tool {}: rigid", tool.name);
    }
    mesh::of_case(&case);
    print(&case, &e);
    for warning in &e.warnings {
        say!("  warning: {warning}");
    }
    Ok(())
}

/// The case, and what a run would cost.
pub fn reckoned(options: &TrialOptions) -> Result<(Case, Estimate), Failure> {
    let case = read(&options.case)?;
    let estimate = estimate(&case, options.precision.into()).map_err(|error| match error {
        RunError::Case(error) => Failure::Input(error.render(colour())),
        error if error.is_input() => Failure::Input(error.to_string()),
        other => Failure::Run(other.to_string()),
    })?;
    Ok((case, estimate))
}

fn print(case: &Case, e: &Estimate) {
    say!("  particles   {} with {:.1} neighbours", e.particles, e.neighbours);
    if let Some(memory) = memory(case, e) {
        say!("  memory      about {:.0} MB", (memory / 1e6).max(1.0));
    }
    say!("  disk        about {:.0} MB of frames", (e.disk / 1e6).max(1.0));
    say!("  time step   {:.4e} s, about {:.0} steps to {} s", e.dt, e.steps, case.time.end);
    say!("  run time    about {} on {}", duration(e.seconds), threads(e.threads));
    let [look, frame, checkpoint] = e.costs;
    say!(
        "  output      about {:.1} % of that: a frame costs {frame:.0} steps, a look at disorder {look:.0}{}",
        100.0 * e.output,
        match checkpoint {
            0.0 => String::new(),
            checkpoint => format!(", a checkpoint {checkpoint:.0}"),
        }
    );
    if let Some(spacing) = e.tried {
        say!("  (too large to try: reckoned from the same case with a spacing of {spacing:.4e} m;");
        say!("  doubts about its particles are told when it runs)");
    }
}

/// Memory that a run takes, bytes: a picture is drawn as a run would, which keeps three frames for its pictures.
fn memory(case: &Case, e: &Estimate) -> Option<f64> {
    let view = (case.dimension == 3).then(View::default);
    let _others = vec![e.frame.clone(); 2];
    drop(encoded(&picture(&e.frame, &Picture { view, ..Picture::default() })));
    e.memory()
}

/// A number of threads.
pub fn threads(n: usize) -> String {
    if n == 1 { "one thread".to_string() } else { format!("{n} threads") }
}

/// A duration as people say it.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{:.0} s", s.ceil()),
        s if s < 5940.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
