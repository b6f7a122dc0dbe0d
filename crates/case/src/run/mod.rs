//! Running a case: the only time loop of the project.

pub mod curves;
mod error;
mod frames;
mod history;
mod measures;
mod record;
mod trial;

pub use error::RunError;
pub use trial::{Estimate, estimate};

use crate::Case;
use crate::build::{Built, build};
use output::{Frame, ResultDir, Summary};
use record::Recorder;
use std::path::PathBuf;
use std::time::Instant;
use taut::simulation::{Numbers, Simulation};

/// How to run a case.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The result directory; must not exist, or be empty.
    pub out: PathBuf,
    /// Threads; `None` for as many as the particles can use.
    pub threads: Option<usize>,
    /// What sums over neighbours are computed with.
    pub numbers: Numbers,
}

/// Where a run stands.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Time, s.
    pub time: f64,
    /// End of the run, s.
    pub end: f64,
    /// Steps taken.
    pub step: u64,
    /// Wall time since the first step, s.
    pub wall: f64,
}

/// Somebody who watches a run.
pub trait Observer: Send {
    /// The run is about to begin with so many particles.
    fn started(&mut self, _case: &Case, _particles: usize, _threads: usize) {}
    /// A doubt about the case or the run.
    fn warned(&mut self, _warning: &str) {}
    /// Where the run stands; called after every step.
    fn stepped(&mut self, _progress: &Progress) {}
    /// A frame was written.
    fn framed(&mut self, _frame: &Frame) {}
}

/// An observer that does not look.
pub struct Silent;
impl Observer for Silent {}

/// Fewest particles that are worth a thread of their own.
const PARTICLES_PER_THREAD: usize = 400;

/// Runs a case and writes everything it leaves behind.
///
/// # Errors
/// A case that cannot be built, a result directory that is taken, a write that fails, a run that diverges; the last leaves its
/// frames, probes and summary.
pub fn run(case: &Case, settings: &Settings, observer: &mut dyn Observer) -> Result<Summary, RunError> {
    let built = build(case, settings.numbers)?;
    let available = std::thread::available_parallelism().map_or(1, usize::from);
    let useful = (built.particles() / PARTICLES_PER_THREAD).max(1);
    let threads = settings.threads.unwrap_or_else(|| available.min(useful)).max(1);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(RunError::threads)?;
    let results = ResultDir::create(&settings.out)?;
    observer.started(case, built.particles(), threads);
    pool.install(|| in_pool(case, built, &results, observer))
}

fn in_pool(
    case: &Case,
    built: Built,
    results: &ResultDir,
    observer: &mut dyn Observer,
) -> Result<Summary, RunError> {
    for warning in &built.warnings {
        observer.warned(warning);
    }
    let (mut recorder, solvers, drives) = Recorder::create(case, built, results)?;
    let clock = Instant::now();
    let mut simulation = match Simulation::start(solvers, drives) {
        Ok(simulation) => simulation,
        Err(diverged) => return Err(recorder.never_started(diverged)?),
    };
    recorder.begin(&simulation, observer)?;
    while simulation.time() < case.time.end {
        let stepped = simulation.step();
        if let Err(diverged) = stepped {
            return Err(recorder.diverged(&simulation, diverged, clock.elapsed().as_secs_f64())?);
        }
        recorder.after_step(&simulation, observer)?;
        let wall = clock.elapsed().as_secs_f64();
        let (time, step) = (simulation.time(), simulation.steps());
        observer.stepped(&Progress { time, end: case.time.end, step, wall });
    }
    recorder.end(&simulation, clock.elapsed().as_secs_f64(), observer)
}
