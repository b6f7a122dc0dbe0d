//! Running a case: the only time loop of the project.

mod alarm;
mod audit;
mod books;
mod contact;
mod convergence;
pub mod curves;
mod diagnosis;
mod error;
mod frames;
mod history;
mod measures;
mod memory;
mod reactions;
mod recorder;
mod sheet;
mod trial;
mod watcher;
mod writer;

pub use error::RunError;
pub use trial::{Estimate, estimate};

use crate::Case;
use crate::build::{Built, build, increments};
use alarm::Alarm;
use books::Books;
use convergence::Convergence;
use output::manifest::Machine;
use output::{Frame, Manifest, ResultDir, Summary};
use recorder::Recorder;
use sheet::{WriterGone, sheets};
use std::path::PathBuf;
use std::time::Instant;
use taut::integrator::{Cause, Diverged};
use taut::run::InstructionSet;
use taut::simulation::{Increment, Numbers, QuasiStatic, Simulation, Totals};
use watcher::Watcher;
use writer::Writer;

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

/// Somebody who watches a run: `stepped` from the run itself, `warned` and `framed` from the thread that writes.
pub trait Observer: Send {
    /// The run is about to begin with so many particles.
    fn started(&mut self, _case: &Case, _particles: usize, _threads: usize) {}
    /// A doubt about the case or the run.
    fn warned(&mut self, _warning: &str) {}
    /// An increment of a quasi-static run is over, of so many.
    fn settled(&mut self, _increment: &Increment, _of: u32) {}
    /// Where the run stands; called after every step.
    fn stepped(&mut self, _progress: &Progress) {}
    /// A frame was written.
    fn framed(&mut self, _frame: Frame) {}
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
    let threads = settings.threads.unwrap_or_else(|| useful_threads(built.particles())).max(1);
    let pool = pool(threads)?;
    let results = ResultDir::create(&settings.out)?;
    observer.started(case, built.particles(), threads);
    pool.install(|| in_pool(case, built, &results, (&pool, observer)))
}

/// As many threads as there are cores, but none without particles enough.
fn useful_threads(particles: usize) -> usize {
    cores().min((particles / PARTICLES_PER_THREAD).max(1))
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn pool(threads: usize) -> Result<rayon::ThreadPool, RunError> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(RunError::threads)
}

fn in_pool(
    case: &Case,
    built: Built,
    results: &ResultDir,
    (threads, observer): (&rayon::ThreadPool, &mut dyn Observer),
) -> Result<Summary, RunError> {
    for warning in &built.warnings {
        observer.warned(warning);
    }
    let machine = Machine::here(InstructionSet::best().name());
    let precision = built.numbers.name();
    Manifest::new(case.case_text_as_run(), machine, threads.current_num_threads(), precision)
        .write(results)?;
    let Built { solvers, contact, drives, grips, damping, probes, watch, numbers, warnings, across, .. } =
        built;
    let writer = Writer::create(case, results, watch, warnings)?;
    // A pool, since a thread that waits for another pool goes on working for its own, as the writer needs it to.
    let desk = pool(1)?;
    let (watcher, clock) = (Watcher::new(observer), Instant::now());
    let mut simulation = Simulation::new(solvers, drives).damped(damping).touching(contact);
    simulation.hold(grips);
    let mut convergence = increments(case).map(|_| Convergence::create(results)).transpose()?;
    let (outbox, inbox) = sheets();
    let shared = (threads.current_num_threads() >= cores()).then_some(threads);
    let alarm = writer.alarm.clone();
    let mut written = None;
    let marched = desk.in_place_scope(|scope| {
        let (written, watcher) = (&mut written, &watcher);
        scope.spawn(move |_| *written = Some(writer.work(inbox, watcher, shared)));
        let convergence = convergence.as_mut();
        let march = March { case, simulation: &mut simulation, convergence, watcher, alarm: &alarm, clock };
        march.finish(Recorder::new(case, probes, outbox))
    });
    let writer = written.transpose()?;
    let (Some(writer), Ok((start, stopped))) = (writer, marched) else {
        return Err(RunError::Writer);
    };
    let wall = clock.elapsed().as_secs_f64();
    let across = &across;
    let simulation = &simulation;
    let books = Books { case, results, simulation, across, numbers, writer, start, wall, convergence };
    match stopped {
        None => books.done(),
        Some(diverged) => Err(books.diverged(diverged)?),
    }
}

/// The time loop.
struct March<'a> {
    case: &'a Case,
    simulation: &'a mut Simulation,
    convergence: Option<&'a mut Convergence>,
    watcher: &'a Watcher<'a>,
    alarm: &'a Alarm,
    clock: Instant,
}

/// Totals at the start, and why the run stopped before its end.
type Marched = Result<(Option<Totals>, Option<Diverged>), WriterGone>;

impl March<'_> {
    fn finish(mut self, mut recorder: Recorder<'_>) -> Marched {
        let stopped = self.steps(&mut recorder)?;
        let start = recorder.start;
        match stopped {
            // Disorder is no wrong number: the state as it stopped is as good as any.
            None | Some(Diverged { cause: Cause::Disordered, .. }) => recorder.end(self.simulation)?,
            Some(_) => recorder.abandon(self.simulation)?,
        }
        Ok((start, stopped))
    }

    fn steps(&mut self, recorder: &mut Recorder<'_>) -> Result<Option<Diverged>, WriterGone> {
        if let Err(diverged) = self.simulation.begin() {
            return Ok(Some(diverged));
        }
        recorder.begin(self.simulation)?;
        if let Some(increments) = increments(self.case) {
            let own = self.case.damping.is_none();
            let statics = QuasiStatic::new(self.simulation, increments, own);
            return self.settle(recorder, statics);
        }
        let end = self.case.time.end;
        while self.simulation.time() < end {
            if let Err(diverged) = self.simulation.step() {
                return Ok(Some(diverged));
            }
            recorder.after_step(self.simulation)?;
            self.stepped();
            if let Some(stopped) = self.alarm.stops(self.simulation) {
                return Ok(Some(stopped));
            }
        }
        Ok(None)
    }

    /// From equilibrium to equilibrium; only equilibria are noted.
    fn settle(
        &mut self,
        recorder: &mut Recorder<'_>,
        mut statics: QuasiStatic,
    ) -> Result<Option<Diverged>, WriterGone> {
        let of = self.case.quasi_static.map_or(0, |s| s.increments);
        while !statics.is_done() {
            match statics.step(self.simulation) {
                Err(diverged) => return Ok(Some(diverged)),
                Ok(None) => {}
                Ok(Some(increment)) => {
                    recorder.after_step(self.simulation)?;
                    if let Some(convergence) = self.convergence.as_deref_mut() {
                        convergence.push(increment);
                    }
                    self.watcher.with(|observer| observer.settled(&increment, of));
                }
            }
            self.stepped();
            if let Some(stopped) = self.alarm.stops(self.simulation) {
                return Ok(Some(stopped));
            }
        }
        Ok(None)
    }

    fn stepped(&self) {
        let wall = self.clock.elapsed().as_secs_f64();
        let (time, end) = (self.simulation.time(), self.case.time.end);
        let progress = Progress { time, end, step: self.simulation.steps(), wall };
        self.watcher.with(|observer| observer.stepped(&progress));
    }
}
