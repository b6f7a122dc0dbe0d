//! Running a case: the only time loop of the project.

mod alarm;
mod audit;
mod books;
mod checkpoint;
mod compare;
mod contact;
mod convergence;
mod costs;
mod couples;
pub mod curves;
mod diagnosis;
mod error;
mod frames;
mod history;
mod kept;
mod measures;
mod memory;
mod reactions;
mod recorder;
mod setup;
mod sheet;
mod trial;
mod watcher;
mod writer;

pub(crate) use books::mass as masses;
pub use checkpoint::{Checkpoints, INTERVAL, Interrupted, ResumeError, Stop};
pub use error::RunError;
pub(crate) use frames::Framer;
pub(crate) use measures::fields as fields_measured;
pub use trial::{Estimate, estimate};

use crate::Case;
use crate::build::{Built, build, increments};
use alarm::Alarm;
use books::Books;
use checkpoint::{Schedule, Settling};
use convergence::Convergence;
use output::{Frame, ResultDir, Summary};
use recorder::Recorder;
use setup::{Setup, again, anew};
use sheet::{WriterGone, sheets};
use std::path::PathBuf;
use std::time::Instant;
use taut::integrator::{Cause, Diverged};
use taut::simulation::{Increment, Numbers, QuasiStatic, Simulation, Totals};
use watcher::Watcher;

/// How to run a case.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The result directory; must not exist, or be empty.
    pub out: PathBuf,
    /// Threads; `None` for as many as the particles can use.
    pub threads: Option<usize>,
    /// What sums over neighbours are computed with.
    pub numbers: Numbers,
    /// When checkpoints are written.
    pub checkpoints: Checkpoints,
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
    /// The run goes on after these frames: time, s, and file of each.
    fn went_on(&mut self, _frames: &[(f64, PathBuf)]) {}
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
/// A case that cannot be built, a result directory that is taken, a write that fails, a run that diverges or is asked to stop; the last
/// two leave frames, probes and summary, and a run that was stopped a checkpoint.
pub fn run(case: &Case, settings: &Settings, observer: &mut dyn Observer) -> Result<Summary, RunError> {
    let built = built(case, (settings.threads, settings.numbers))?;
    let pool = pool_for(settings.threads, &built)?;
    let results = ResultDir::create(&settings.out)?;
    observer.started(case, built.particles(), pool.current_num_threads());
    for warning in &built.warnings {
        observer.warned(warning);
    }
    pool.install(|| {
        let setup = anew(case, &results, built)?;
        in_pool((case, &results), setup, (&pool, &settings.checkpoints), observer)
    })
}

/// Goes on with a run that was interrupted, to the end that it would have had: the same bits, on any number of threads.
///
/// # Errors
/// As [`run`], and a checkpoint that does not fit the case.
pub fn resume(
    run: Interrupted,
    threads: Option<usize>,
    checkpoints: &Checkpoints,
    observer: &mut dyn Observer,
) -> Result<Summary, RunError> {
    let Interrupted { case, numbers, notices, results, manifest, found } = run;
    let built = built(&case, (threads, numbers))?;
    let pool = pool_for(threads, &built)?;
    observer.started(&case, built.particles(), pool.current_num_threads());
    for notice in &notices {
        observer.warned(notice);
    }
    let file = |(index, &time)| (time, output::Series::file(results.path(), index));
    let frames: Vec<(f64, PathBuf)> = found.books.frames.iter().enumerate().map(file).collect();
    observer.went_on(&frames);
    pool.install(|| {
        let setup = again((&case, manifest), &results, found, built)?;
        in_pool((&case, &results), setup, (&pool, checkpoints), observer)
    })
}

/// Builds a case on so many threads, or on all cores: how many particles there will be is not known yet.
fn built(case: &Case, (threads, numbers): (Option<usize>, Numbers)) -> Result<Built, RunError> {
    Ok(pool(threads.unwrap_or_else(cores).max(1))?.install(|| build(case, numbers))?)
}

/// So many threads, or as many as the particles can use.
fn pool_for(threads: Option<usize>, built: &Built) -> Result<rayon::ThreadPool, RunError> {
    pool(threads.unwrap_or_else(|| useful_threads(built.particles())).max(1))
}

/// Does some work on as many threads as so many particles can use.
///
/// # Errors
/// If threads cannot be started.
pub fn on_useful_threads<T: Send>(particles: f64, work: impl FnOnce() -> T + Send) -> Result<T, RunError> {
    Ok(pool(useful_threads(particles as usize))?.install(work))
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
    (case, results): (&Case, &ResultDir),
    setup: Setup<'_>,
    (threads, checkpoints): (&rayon::ThreadPool, &Checkpoints),
    observer: &mut dyn Observer,
) -> Result<Summary, RunError> {
    let Setup { mut simulation, probes, writer, remembered, settling, before, numbers, across } = setup;
    // A pool, since a thread that waits for another pool goes on working for its own, as the writer needs it to.
    let desk = pool(1)?;
    let (watcher, clock) = (Watcher::new(observer), Clock { since: Instant::now(), before });
    let mut convergence = match (&settling, increments(case)) {
        (_, None) => None,
        (None, Some(_)) => Some(Convergence::create(results)?),
        (Some(settling), Some(_)) => Some(Convergence::again(results, &settling.increments)?),
    };
    let (outbox, inbox) = sheets();
    let shared = (threads.current_num_threads() >= cores()).then_some(threads);
    let alarm = writer.alarm.clone();
    let (schedule, stop) = (Schedule::new(checkpoints.every), &checkpoints.stop);
    let mut written = None;
    let marched = desk.in_place_scope(|scope| {
        let (written, watcher) = (&mut written, &watcher);
        scope.spawn(move |_| *written = Some(writer.work(inbox, watcher, shared)));
        let convergence = convergence.as_mut();
        let simulation = &mut simulation;
        let march =
            March { case, simulation, convergence, settling, watcher, alarm: &alarm, clock, stop, schedule };
        let recorder = Recorder::new(case, probes, outbox);
        march.finish(match remembered {
            Some(remembered) => recorder.remembering(remembered),
            None => recorder,
        })
    });
    let writer = written.transpose()?;
    let (Some(writer), Ok((start, schedule, ended))) = (writer, marched) else {
        return Err(RunError::Writer);
    };
    let (wall, across, simulation) = (clock.wall(), &across, &mut simulation);
    let books =
        Books { case, results, simulation, across, numbers, writer, start, schedule, wall, convergence };
    match ended {
        Ended::Done => books.done(),
        Ended::Stopped => Err(books.stopped()?),
        Ended::Diverged(diverged) => Err(books.diverged(diverged)?),
    }
}

/// The wall time of a run, with what it took before it was interrupted.
#[derive(Clone, Copy)]
struct Clock {
    since: Instant,
    before: f64,
}

impl Clock {
    /// Wall time of the run so far, s.
    fn wall(&self) -> f64 {
        self.before + self.since.elapsed().as_secs_f64()
    }
}

/// The time loop.
struct March<'a> {
    case: &'a Case,
    simulation: &'a mut Simulation,
    convergence: Option<&'a mut Convergence>,
    /// Where a quasi-static run stands, if it goes on, or has to stop.
    settling: Option<Settling>,
    watcher: &'a Watcher<'a>,
    alarm: &'a Alarm,
    clock: Clock,
    stop: &'a Stop,
    schedule: Schedule,
}

/// Why the loop ended.
enum Ended {
    Done,
    Stopped,
    Diverged(Diverged),
}

/// Totals at the start, the checkpoints, and why the loop ended.
type Marched = Result<(Option<Totals>, Schedule, Ended), WriterGone>;

impl March<'_> {
    fn finish(mut self, mut recorder: Recorder<'_>) -> Marched {
        let ended = self.steps(&mut recorder)?;
        let start = recorder.start;
        match ended {
            // A frame or a look that was not due would be missing in the run that goes on.
            Ended::Stopped => self.checkpoint(&mut recorder)?,
            // Disorder is no wrong number: the state as it stopped is as good as any.
            Ended::Done | Ended::Diverged(Diverged { cause: Cause::Disordered, .. }) => {
                recorder.end(self.simulation)?;
            }
            Ended::Diverged(_) => recorder.abandon(self.simulation)?,
        }
        Ok((start, self.schedule, ended))
    }

    fn steps(&mut self, recorder: &mut Recorder<'_>) -> Result<Ended, WriterGone> {
        if recorder.start.is_none() {
            if let Err(diverged) = self.simulation.begin() {
                return Ok(Ended::Diverged(diverged));
            }
            recorder.begin(self.simulation)?;
        }
        if let Some(increments) = increments(self.case) {
            let own = self.case.damping.is_none();
            let statics = QuasiStatic::new(self.simulation, increments, own);
            return self.settle(
                recorder,
                match &self.settling {
                    Some(settling) => statics.at(settling.state),
                    None => statics,
                },
            );
        }
        let end = self.case.time.end;
        while self.simulation.time() < end {
            if self.stop.is_requested() {
                return Ok(Ended::Stopped);
            }
            if let Err(diverged) = self.simulation.step() {
                return Ok(Ended::Diverged(diverged));
            }
            recorder.after_step(self.simulation)?;
            self.stepped();
            if let Some(stopped) = self.alarm.stops(self.simulation) {
                return Ok(Ended::Diverged(stopped));
            }
            if self.schedule.is_due(self.clock.since.elapsed()) {
                self.checkpoint(recorder)?;
            }
        }
        Ok(Ended::Done)
    }

    /// Writes a checkpoint now.
    fn checkpoint(&mut self, recorder: &mut Recorder<'_>) -> Result<(), WriterGone> {
        let began = self.clock.since.elapsed();
        recorder.checkpoint(self.simulation, self.settling.as_ref(), self.clock.wall())?;
        self.schedule.note(began, self.clock.since.elapsed());
        Ok(())
    }

    /// From equilibrium to equilibrium; only equilibria are noted.
    fn settle(&mut self, recorder: &mut Recorder<'_>, mut statics: QuasiStatic) -> Result<Ended, WriterGone> {
        let of = self.case.quasi_static.map_or(0, |s| s.increments);
        while !statics.is_done() {
            if self.stop.is_requested() {
                self.settling = self.settles(&statics);
                return Ok(Ended::Stopped);
            }
            match statics.step(self.simulation) {
                Err(diverged) => return Ok(Ended::Diverged(diverged)),
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
                return Ok(Ended::Diverged(stopped));
            }
            if self.schedule.is_due(self.clock.since.elapsed()) {
                self.settling = self.settles(&statics);
                self.checkpoint(recorder)?;
            }
        }
        Ok(Ended::Done)
    }

    /// Where a quasi-static run stands.
    fn settles(&self, statics: &QuasiStatic) -> Option<Settling> {
        let increments = self.convergence.as_ref().map(|convergence| convergence.saved());
        Some(Settling { state: statics.saved(), increments: increments? })
    }

    fn stepped(&self) {
        let wall = self.clock.wall();
        let (time, end) = (self.simulation.time(), self.case.time.end);
        let progress = Progress { time, end, step: self.simulation.steps(), wall };
        self.watcher.with(|observer| observer.stepped(&progress));
    }
}
