//! What a run writes down as it goes.

use super::Observer;
use super::error::RunError;
use super::frames::frame;
use super::history::DisorderHistory;
use super::measures::{Evidence, Series};
use crate::Case;
use crate::build::{Built, ProbePoint, Watch};
use output::manifest::Machine;
use output::summary::{Balance, Energy, Failure, Momentum, Status};
use output::{Manifest, ProbeTable, ResultDir, Summary};
use taut::field::Quantity;
use taut::integrator::Diverged;
use taut::run::InstructionSet;
use taut::simulation::{Drive, Numbers, Simulation, Snapshot, Solver, Totals};

/// The books of a run.
pub struct Recorder<'a> {
    case: &'a Case,
    results: &'a ResultDir,
    frames: output::Series,
    tables: Vec<ProbeTable>,
    points: Vec<ProbePoint>,
    series: Vec<Series>,
    watch: Box<dyn Watch>,
    disorder: DisorderHistory,
    energies: Vec<[f64; 4]>,
    snapshot: Snapshot,
    deformation: Vec<[f64; 9]>,
    mass: Vec<f64>,
    particles: u64,
    numbers: Numbers,
    start: Totals,
    contact: Contact,
    warnings: Vec<String>,
    due: Due,
}

/// When what is due next, s.
#[derive(Clone, Debug, Default)]
struct Due {
    frame: f64,
    disorder: f64,
    probes: Vec<f64>,
    framed: f64,
}

/// The first touch of two bodies: when their gap falls below the support of the kernel, linear between samples.
#[derive(Clone, Copy, Debug, Default)]
struct Contact {
    support: f64,
    last: Option<(f64, f64)>,
    time: Option<f64>,
}

impl Contact {
    fn look(&mut self, time: f64, gap: Option<f64>) {
        let Some(gap) = gap.filter(|_| self.time.is_none()) else { return };
        if gap < self.support {
            self.time = Some(
                self.last
                    .map_or(time, |(t, before)| t + (time - t) * (before - self.support) / (before - gap)),
            );
        }
        self.last = Some((time, gap));
    }
}

type Parts<'a> = (Recorder<'a>, Vec<Box<dyn Solver>>, Vec<Box<dyn Drive>>);

impl<'a> Recorder<'a> {
    /// Opens the files of a run and takes the built case apart.
    pub fn create(case: &'a Case, built: Built, results: &'a ResultDir) -> Result<Parts<'a>, RunError> {
        let threads = rayon::current_num_threads();
        let machine = Machine::here(InstructionSet::best().name());
        Manifest::new(case.case_text_as_run(), machine, threads, built.numbers.name()).write(results)?;
        let mut tables = Vec::new();
        for probe in &case.probes {
            let unit = if probe.quantity == crate::Quantity::Velocity { "m/s" } else { "m" };
            let columns: Vec<(&str, &str)> =
                ["x", "y", "z"].into_iter().take(case.dimension).map(|axis| (axis, unit)).collect();
            tables.push(ProbeTable::create(results, &probe.name, &columns)?);
        }
        let support = 2.0 * case.spacing * case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max);
        let recorder = Self {
            case,
            results,
            frames: output::Series::create(results)?,
            tables,
            points: built.probes,
            series: vec![Series::default(); case.probes.len()],
            watch: built.watch,
            disorder: DisorderHistory::default(),
            energies: Vec::new(),
            snapshot: Snapshot::default(),
            deformation: Vec::new(),
            mass: Vec::new(),
            particles: built.body.len() as u64,
            numbers: built.numbers,
            start: Totals::default(),
            contact: Contact { support, ..Contact::default() },
            warnings: built.warnings,
            due: Due { probes: vec![0.0; case.probes.len()], framed: f64::NEG_INFINITY, ..Due::default() },
        };
        Ok((recorder, built.solvers, built.drives))
    }

    /// Writes down the state before the first step.
    pub fn begin(&mut self, simulation: &Simulation, observer: &mut dyn Observer) -> Result<(), RunError> {
        self.start = simulation.totals();
        self.mass = vec![0.0; simulation.len()];
        let mut first = 0;
        for solver in simulation.solvers() {
            for (place, &id) in solver.ids().iter().enumerate() {
                self.mass[first + id as usize] = solver.scalar(Quantity::Mass, place);
            }
            first += solver.len();
        }
        self.after_step(simulation, observer)
    }

    /// Writes down whatever is due.
    pub fn after_step(
        &mut self,
        simulation: &Simulation,
        observer: &mut dyn Observer,
    ) -> Result<(), RunError> {
        let time = simulation.time();
        for i in 0..self.points.len() {
            if time >= self.due.probes[i] {
                self.due.probes[i] += self.case.probes[i].interval;
                self.sample(i, simulation)?;
            }
        }
        let (frame, disorder) = (time >= self.due.frame, time >= self.due.disorder);
        if frame || disorder {
            simulation.snapshot(&mut self.snapshot);
        }
        if disorder {
            self.due.disorder = later(self.due.disorder, self.case.monitor.interval, time);
            self.look(simulation, observer)?;
        }
        if frame {
            self.due.frame = later(self.due.frame, self.case.time.output, time);
            self.write_frame(simulation.steps(), observer)?;
        }
        Ok(())
    }

    fn sample(&mut self, i: usize, simulation: &Simulation) -> Result<(), RunError> {
        let value = self.points[i].value(simulation.solvers());
        self.tables[i].push(simulation.time(), &value[..self.case.dimension])?;
        let series = &mut self.series[i];
        series.times.push(simulation.time());
        for (column, v) in series.values.iter_mut().zip(value) {
            column.push(v);
        }
        Ok(())
    }

    fn look(&mut self, simulation: &Simulation, observer: &mut dyn Observer) -> Result<(), RunError> {
        let (time, totals) = (simulation.time(), simulation.totals());
        self.energies.push([time, totals.kinetic, totals.strain, totals.kinetic + totals.strain]);
        let observed = self.watch.measure(&self.snapshot)?;
        self.contact.look(time, observed.gap);
        let zigzag = observed.disorder.zigzag_rms;
        let warned = self.warnings.iter().any(|w| w.starts_with("disorder"));
        if self.case.monitor.zigzag.is_some_and(|limit| zigzag > limit) && !warned {
            let warning =
                format!("disorder: zigzag_rms is {zigzag:.4} at t = {time:.6} s; zero-energy modes grow");
            observer.warned(&warning);
            self.warnings.push(warning);
        }
        self.disorder.push(time, observed.disorder);
        Ok(())
    }

    fn write_frame(&mut self, step: u64, observer: &mut dyn Observer) -> Result<(), RunError> {
        self.watch.deformation(&self.snapshot, &mut self.deformation)?;
        let frame = frame(&self.snapshot, &self.deformation, self.case.spacing, step);
        self.frames.write(&frame)?;
        self.due.framed = self.snapshot.time;
        for table in &mut self.tables {
            table.flush()?;
        }
        observer.framed(&frame);
        Ok(())
    }

    /// Closes the books of a run that reached its end.
    pub fn end(
        mut self,
        simulation: &Simulation,
        wall: f64,
        observer: &mut dyn Observer,
    ) -> Result<Summary, RunError> {
        let time = simulation.time();
        simulation.snapshot(&mut self.snapshot);
        if time > self.due.framed {
            self.look(simulation, observer)?;
            self.write_frame(simulation.steps(), observer)?;
        }
        let summary = self.summary(simulation, wall);
        let summary = Summary { status: Status::Done, ..summary };
        summary.write(self.results)?;
        Ok(summary)
    }

    /// Closes the books of a run that diverged; hands back the error to report.
    pub fn diverged(
        mut self,
        simulation: &Simulation,
        diverged: Diverged,
        wall: f64,
    ) -> Result<RunError, RunError> {
        for table in &mut self.tables {
            table.flush()?;
        }
        let summary = self.summary(simulation, wall);
        summary.failed(&diverged).write(self.results)?;
        Ok(self.stopped(diverged))
    }

    /// Closes the books of a run whose initial state is not admissible.
    pub fn never_started(self, diverged: Diverged) -> Result<RunError, RunError> {
        let nothing = Summary {
            case: self.case.name.clone(),
            formulation: self.formulations(),
            dimension: self.case.dimension as u32,
            particles: self.particles,
            threads: rayon::current_num_threads() as u32,
            precision: self.numbers.name().to_string(),
            warnings: self.warnings.clone(),
            ..Summary::default()
        };
        nothing.failed(&diverged).write(self.results)?;
        Ok(self.stopped(diverged))
    }

    fn stopped(&self, diverged: Diverged) -> RunError {
        RunError::Diverged { diverged: Box::new(diverged), results: self.results.path().to_path_buf() }
    }

    /// Names of the formulations, in the order of the bodies.
    fn formulations(&self) -> String {
        let mut names: Vec<&str> = self.case.bodies.iter().map(|b| b.scheme.formulation.name()).collect();
        names.dedup();
        names.join("+")
    }

    fn summary(&mut self, simulation: &Simulation, wall: f64) -> Summary {
        let end = simulation.totals();
        let evidence = Evidence {
            series: &self.series,
            start: self.start,
            end,
            snapshot: &self.snapshot,
            mass: &self.mass,
            contact: self.contact.time,
        };
        let (n, steps) = (simulation.len() as f64, simulation.steps());
        let neighbours: f64 = simulation.solvers().iter().map(|s| s.neighbours() * s.len() as f64).sum();
        Summary {
            case: self.case.name.clone(),
            formulation: self.formulations(),
            dimension: self.case.dimension as u32,
            particles: simulation.len() as u64,
            neighbours_mean: neighbours / n,
            steps,
            end_time: simulation.time(),
            wall_seconds: wall,
            particle_steps_per_second: n * steps as f64 / wall.max(1e-9),
            threads: rayon::current_num_threads() as u32,
            precision: self.numbers.name().to_string(),
            energy: Energy { history: std::mem::take(&mut self.energies), ..energy(&self.start, &end) },
            momentum: Momentum {
                linear: Balance::new(self.start.momentum, end.momentum),
                angular: Balance::new(self.start.angular_momentum, end.angular_momentum),
            },
            disorder: self.disorder.summary(),
            measured: evidence.measured(self.case),
            warnings: self.warnings.clone(),
            ..Summary::default()
        }
    }
}

/// The next multiple of an interval after `time`.
fn later(due: f64, interval: f64, time: f64) -> f64 {
    due + interval * ((time - due) / interval).floor().max(0.0) + interval
}

fn energy(start: &Totals, end: &Totals) -> Energy {
    let initial = start.kinetic + start.strain;
    let at_end = end.kinetic + end.strain;
    Energy {
        initial,
        at_end,
        kinetic: end.kinetic,
        strain: end.strain,
        dissipated: end.dissipated,
        external_work: end.external_work,
        residual: initial + end.external_work - end.dissipated - at_end,
        history: Vec::new(),
    }
}

/// A summary of a run that stopped.
trait Stopped {
    fn failed(self, diverged: &Diverged) -> Self;
}

impl Stopped for Summary {
    fn failed(self, diverged: &Diverged) -> Self {
        let error = Failure {
            message: diverged.to_string(),
            hint: Some(diverged.cause.hint().to_string()),
            time: Some(diverged.time),
        };
        Self { status: Status::Diverged, error: Some(error), ..self }
    }
}
