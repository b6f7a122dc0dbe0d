//! Closing the books: `summary.json`.

use super::checkpoint::Schedule;
use super::convergence::Convergence;
use super::diagnosis::Evidence;
use super::error::RunError;
use super::measures;
use super::writer::Writer;
use crate::Case;
use output::summary::{Failure, Settled, Status};
use output::{ResultDir, Summary};
use taut::field::Quantity;
use taut::integrator::Diverged;
use taut::simulation::{Numbers, Simulation, Snapshot, Totals};

/// What a summary is made of.
pub struct Books<'a> {
    /// The case.
    pub case: &'a Case,
    /// Where the results are.
    pub results: &'a ResultDir,
    /// The simulation, at its end.
    pub simulation: &'a mut Simulation,
    /// Particles across the thinnest part of each body.
    pub across: &'a [usize],
    /// What it computed with.
    pub numbers: Numbers,
    /// What was written.
    pub writer: Writer<'a>,
    /// Energies and momenta at the start; `None` for a run that never started.
    pub start: Option<Totals>,
    /// Its checkpoints.
    pub schedule: Schedule,
    /// Wall time, s.
    pub wall: f64,
    /// What became of the increments of a quasi-static run.
    pub convergence: Option<Convergence>,
}

impl Books<'_> {
    /// Closes the books of a run that reached its end.
    ///
    /// # Errors
    /// If the summary cannot be written.
    pub fn done(mut self) -> Result<Summary, RunError> {
        let results = self.results;
        let quasi_static = self.settle()?;
        let summary = Summary { status: Status::Done, quasi_static, ..self.summary() };
        summary.write(results)?;
        Ok(summary)
    }

    /// Closes the books of a run that was asked to stop, for the time being; hands back what to report.
    ///
    /// # Errors
    /// If the summary cannot be written.
    pub fn stopped(mut self) -> Result<RunError, RunError> {
        let results = self.results;
        let checkpoint = match self.writer.kept.take() {
            Some(Ok(path)) => Ok(path),
            Some(Err(error)) => Err(format!("{error}\nhint: {}", error.hint())),
            None => Err("it had not begun".to_string()),
        };
        let (time, step) = (self.simulation.time(), self.simulation.steps());
        Summary { status: Status::Interrupted, ..self.summary() }.write(results)?;
        Ok(RunError::Interrupted { time, step, results: results.path().to_path_buf(), checkpoint })
    }

    /// Closes the books of a run that diverged; hands back the error to report.
    ///
    /// # Errors
    /// If diagnosis or summary cannot be written.
    pub fn diverged(mut self, diverged: Diverged) -> Result<RunError, RunError> {
        let results = self.results;
        let quasi_static = self.settle()?;
        self.simulation.look();
        let Self { case, across, simulation, writer, .. } = &self;
        Evidence { case, across, simulation, writer, diverged: &diverged }.write(results)?;
        let summary = if self.start.is_none() { self.nothing() } else { self.summary() };
        Summary { quasi_static, ..failed(summary, &diverged) }.write(results)?;
        Ok(RunError::Diverged { diverged: Box::new(diverged), results: results.path().to_path_buf() })
    }

    /// What the summary says of increments; a warning goes to the others.
    fn settle(&mut self) -> Result<Option<Settled>, RunError> {
        let Some(convergence) = self.convergence.take() else { return Ok(None) };
        let (settled, warning) = convergence.settled(self.case)?;
        self.writer.warnings.extend(warning);
        Ok(Some(settled))
    }

    /// The summary of a run whose initial state is not admissible.
    fn nothing(self) -> Summary {
        Summary {
            case: self.case.name.clone(),
            formulation: formulations(self.case),
            dimension: self.case.dimension as u32,
            particles: self.simulation.len() as u64,
            threads: rayon::current_num_threads() as u32,
            precision: self.numbers.name().to_string(),
            warnings: self.writer.warnings,
            ..Summary::default()
        }
    }

    fn summary(self) -> Summary {
        let (simulation, writer) = (&mut *self.simulation, &self.writer);
        let mut snapshot = Snapshot::default();
        let end = simulation.snapshot(&mut snapshot);
        let start = self.start.unwrap_or_default();
        let evidence = measures::Evidence {
            series: &writer.series,
            start,
            end,
            snapshot: &snapshot,
            mass: &mass(simulation),
            contact: writer.contact(),
        };
        let (n, steps) = (simulation.len() as f64, simulation.steps());
        let neighbours: f64 = simulation.solvers().iter().map(|s| s.neighbours() * s.len() as f64).sum();
        Summary {
            neighbours_mean: neighbours / n,
            steps,
            end_time: simulation.time(),
            wall_seconds: self.wall,
            checkpoints: self.schedule.made,
            checkpoint_seconds: self.schedule.took.as_secs_f64(),
            particle_steps_per_second: n * steps as f64 / self.wall.max(1e-9),
            energy: writer.audit.energy(&start, &end),
            momentum: writer.audit.momentum(&start, &end),
            disorder: writer.disorder.summary(),
            measured: evidence.measured(self.case),
            ..self.nothing()
        }
    }
}

/// Names of the formulations, in the order of the bodies.
fn formulations(case: &Case) -> String {
    let mut names: Vec<&str> = case.bodies.iter().map(|b| b.scheme.formulation.name()).collect();
    names.dedup();
    names.join("+")
}

/// Masses in the order of ids, kg.
pub(crate) fn mass(simulation: &Simulation) -> Vec<f64> {
    let mut mass = vec![0.0; simulation.len()];
    let mut first = 0;
    for solver in simulation.solvers() {
        for (place, &id) in solver.ids().iter().enumerate() {
            mass[first + id as usize] = solver.scalar(Quantity::Mass, place);
        }
        first += solver.len();
    }
    mass
}

fn failed(summary: Summary, diverged: &Diverged) -> Summary {
    let error = Failure {
        message: diverged.to_string(),
        hint: Some(diverged.cause.hint().to_string()),
        time: Some(diverged.time),
    };
    Summary { status: Status::Diverged, error: Some(error), ..summary }
}
