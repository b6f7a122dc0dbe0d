//! `taut run`.

use crate::Failure;
use crate::arguments::{ReportOptions, RunOptions};
use crate::builtin::{colour, read};
use crate::pictures;
use crate::progress::Watcher;
use crate::rebuild::report;
use crate::say;
use crate::signals;
use case::Case;
use case::run::{Checkpoints, Interrupted, ResumeError, RunError, Settings};
use case::run::{resume as resume_case, run as run_case};
use output::checkpoint::kept;
use output::{ResultDir, Summary};
use std::path::{Path, PathBuf};

/// Runs a case, or goes on with one; draws its pictures, says where everything is.
pub fn run(options: &RunOptions) -> Result<(), Failure> {
    let signals = signals::watch();
    let checkpoints = Checkpoints { every: options.checkpoint_every, stop: signals.stop.clone() };
    let threads = options.threads.map(usize::from);
    let mut watcher = Watcher::new(options.quiet);
    let (case, out, ended);
    match &options.resume {
        Some(place) => {
            let run = match Interrupted::find(place) {
                Err(ResumeError::Done(dir)) if undrawn(&dir) => return redraw(dir, options.quiet),
                found => found.map_err(unusable)?,
            };
            if !options.quiet {
                let (time, step) = run.stands_at();
                complain!("going on from {}: t = {time:.6e} s, step {step}", run.checkpoint().display());
            }
            (case, out) = (run.case.clone(), run.results().to_path_buf());
            ended = resume_case(run, threads, &checkpoints, &mut watcher);
        }
        None => {
            case = read(&options.case)?;
            out = options.out.clone().unwrap_or_else(|| PathBuf::from("out").join(&case.name));
            let numbers = options.precision.into();
            let settings = Settings { out: out.clone(), threads, numbers, checkpoints };
            if !options.quiet {
                say::warnings(&case);
            }
            ended = run_case(&case, &settings, &mut watcher);
        }
    }
    watcher.finish();
    if matches!(ended, Ok(_) | Err(RunError::Diverged { .. } | RunError::Interrupted { .. })) {
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
        Err(error @ RunError::Interrupted { .. }) => {
            Err(Failure::Stopped(error.to_string(), signals.status()))
        }
        Err(error) if error.is_input() => Err(Failure::Input(format!("{error}{}", way_on(&out)))),
        // It would end there again.
        Err(error @ RunError::Diverged { .. }) => Err(Failure::Run(error.to_string())),
        Err(error) => Err(Failure::Run(format!("{error}{}", way_on(&out)))),
    }
}

/// Whether a run that has come to its end was killed before its pictures were drawn.
fn undrawn(results: &Path) -> bool {
    let tables = std::fs::read_dir(results.join("probes")).into_iter().flatten().flatten();
    let names =
        tables.filter_map(|table| Some(table.file_name().to_str()?.strip_suffix(".csv")?.to_string()));
    let plots = names.map(|name| format!("{name}.svg"));
    let pictures = ["start.png", "end.png", "audit.svg"].map(str::to_string);
    !pictures.into_iter().chain(plots).all(|name| results.join(name).exists())
}

/// Draws what such a run did not come to.
fn redraw(results: PathBuf, quiet: bool) -> Result<(), Failure> {
    if !quiet {
        complain!("the run in {} has come to its end; its pictures are drawn now", results.display());
    }
    // A picture that was begun when the run was killed.
    if let Ok(directory) = ResultDir::reopen(&results) {
        directory.sweep();
    }
    report(&ReportOptions::usual(results, quiet))
}

fn unusable(error: ResumeError) -> Failure {
    match error {
        ResumeError::Case(error) => Failure::Input(error.render(colour())),
        error => Failure::Input(error.to_string()),
    }
}

/// What can be done where a run has left a checkpoint, if it has.
fn way_on(out: &Path) -> String {
    match kept(out).is_empty() {
        true => String::new(),
        false => format!("\nto go on from the last checkpoint there: taut run --resume {}", out.display()),
    }
}

fn tell(case: &Case, summary: &Summary, out: &Path) {
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
