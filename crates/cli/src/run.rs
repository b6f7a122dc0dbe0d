//! `taut run`.

use crate::Failure;
use crate::arguments::RunOptions;
use crate::builtin::{colour, read};
use crate::pictures;
use crate::progress::Watcher;
use crate::say;
use case::Case;
use case::run::{RunError, Settings, run as run_case};
use output::Summary;
use std::path::PathBuf;

/// Runs a case, draws its pictures, says where everything is.
pub fn run(options: &RunOptions) -> Result<(), Failure> {
    refuse_later(options)?;
    let case = read(&options.case)?;
    let out = options.out.clone().unwrap_or_else(|| PathBuf::from("out").join(&case.name));
    let settings = Settings {
        out: out.clone(),
        threads: options.threads.map(usize::from),
        numbers: options.precision.into(),
    };
    let mut watcher = Watcher::new(options.quiet);
    if !options.quiet {
        say::warnings(&case);
    }
    let ended = run_case(&case, &settings, &mut watcher);
    watcher.finish();
    if matches!(ended, Ok(_) | Err(RunError::Diverged { .. })) {
        pictures::draw(&case, &watcher.kept, &out)?;
    }
    match ended {
        Ok(summary) => {
            if !options.quiet {
                tell(&case, &summary, &out);
            }
            Ok(())
        }
        Err(RunError::Case(error)) => Err(Failure::Input(error.render(colour()))),
        Err(error) if error.is_input() => Err(Failure::Input(error.to_string())),
        Err(error) => Err(Failure::Run(error.to_string())),
    }
}

fn refuse_later(options: &RunOptions) -> Result<(), Failure> {
    if options.resume {
        return Err(Failure::Input("`--resume` comes in a later version.".to_string()));
    }
    Ok(())
}

fn tell(case: &Case, summary: &Summary, out: &std::path::Path) {
    say!(
        "{}: {} particles, {} steps to t = {:.6} s in {:.1} s ({:.2} million particle-steps/s)",
        case.name,
        summary.particles,
        summary.steps,
        summary.end_time,
        summary.wall_seconds,
        summary.particle_steps_per_second / 1e6
    );
    if let Some(s) = &summary.quasi_static {
        say!(
            "  {} of {} increments at rest; unbalanced forces at most {:.1e} of the stress",
            s.converged,
            s.increments,
            s.worst_force
        );
    }
    for (name, measured) in &summary.measured {
        match (measured.value, &measured.reason) {
            (Some(value), _) if measured.unit == "1" => say!("  {name} = {value:.6}"),
            (Some(value), _) => say!("  {name} = {value:.6} {}", measured.unit),
            (None, reason) => say!("  {name}: {}", reason.as_deref().unwrap_or("not known")),
        }
    }
    let d = &summary.disorder;
    say!("  zigzag_rms {:.5} at worst, broken bonds {:.4}", d.zigzag_rms.worst, d.broken.worst);
    say!("results in {}: end.png, summary.json, particles/particles.pvd for ParaView", out.display());
}
