//! Why a run did not come to its end.

use crate::CaseError;
use output::OutputError;
use std::path::{Path, PathBuf};
use taut::diagnostics::disorder::DisorderError;
use taut::integrator::Diverged;

/// A run that failed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The case is wrong.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// Something could not be written.
    #[error("{cause}\nhint: {}", cause.hint())]
    Output {
        /// What happened.
        #[from]
        cause: OutputError,
    },
    /// The run diverged; what it had is in `results`.
    #[error("{diverged}\nwhat was written up to then is in {}; read diagnosis.md there", results.display())]
    Diverged {
        /// What happened.
        diverged: Box<Diverged>,
        /// Where the results are.
        results: PathBuf,
    },
    /// Somebody asked the run to stop; what it had is in `results`.
    #[error("{}", stopped(*time, *step, results, checkpoint))]
    Interrupted {
        /// Time, s.
        time: f64,
        /// Steps taken.
        step: u64,
        /// Where the results are.
        results: PathBuf,
        /// The checkpoint to go on from, or why there is none.
        checkpoint: Result<PathBuf, String>,
    },
    /// A checkpoint does not fit the case that it claims to belong to.
    #[error("cannot go on from {}: {reason}{hint}", path.display())]
    Checkpoint {
        /// The checkpoint.
        path: PathBuf,
        /// Why.
        reason: String,
        /// What to do, on a line of its own.
        hint: String,
    },
    /// A few steps, taken to see what a run will cost, diverged; nothing was written.
    #[error("the first steps of this case fail: {diverged}{}", listed(warnings))]
    Tried {
        /// What happened.
        diverged: Box<Diverged>,
        /// What was doubtful before.
        warnings: Vec<String>,
    },
    /// The arrangement of particles could not be measured.
    #[error("the disorder of the particles cannot be measured: {0}")]
    Disorder(#[from] DisorderError),
    /// There is not memory enough.
    #[error(
        "about {:.1e} particles need {:.1} GB of memory, and {:.1} GB are free\nhint: choose a larger spacing",
        *particles as f64, needed / 1e9, available / 1e9
    )]
    TooLarge {
        /// Particles.
        particles: usize,
        /// Bytes needed.
        needed: f64,
        /// Bytes free.
        available: f64,
    },
    /// The writer stopped and did not say why.
    #[error("the results are no longer written\nhint: this is a mistake in the program: please report it")]
    Writer,
    /// Threads could not be started.
    #[error("cannot start threads: {0}\nhint: try fewer with --threads")]
    Threads(String),
}

/// What is said of a run that was asked to stop.
fn stopped(time: f64, step: u64, results: &Path, checkpoint: &Result<PathBuf, String>) -> String {
    let told = format!("stopped at t = {time:.6e} s, after step {step}");
    match checkpoint {
        Ok(path) => format!(
            "{told}; the checkpoint is {}\nto go on: taut run --resume {}",
            path.display(),
            results.display()
        ),
        Err(why) => format!("{told}, but without a checkpoint: {why}"),
    }
}

/// Warnings below a message, a line each.
fn listed(warnings: &[String]) -> String {
    warnings.iter().map(|warning| format!("\nwarning: {warning}")).collect()
}

impl RunError {
    pub(super) fn threads(error: rayon::ThreadPoolBuildError) -> Self {
        Self::Threads(error.to_string())
    }

    /// The bodies cannot be started.
    pub(crate) fn unstarted(diverged: Diverged) -> Self {
        Self::Tried { diverged: Box::new(diverged), warnings: Vec::new() }
    }

    /// Whether the input is to blame, rather than the run.
    #[must_use]
    pub fn is_input(&self) -> bool {
        matches!(
            self,
            Self::Case(_)
                | Self::TooLarge { .. }
                | Self::Checkpoint { .. }
                | Self::Output { cause: OutputError::AlreadyExists { .. } | OutputError::Busy { .. } }
        )
    }
}
