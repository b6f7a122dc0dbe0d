//! Closing the books: `summary.json`.

use super::error::RunError;
use super::measures::Evidence;
use super::writer::Writer;
use crate::Case;
use output::summary::{Balance, Energy, Failure, Momentum, Status};
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
    pub simulation: &'a Simulation,
    /// What it computed with.
    pub numbers: Numbers,
    /// What was written.
    pub writer: Writer<'a>,
    /// Energies and momenta at the start; `None` for a run that never started.
    pub start: Option<Totals>,
    /// Wall time, s.
    pub wall: f64,
}

impl Books<'_> {
    /// Closes the books of a run that reached its end.
    ///
    /// # Errors
    /// If the summary cannot be written.
    pub fn done(self) -> Result<Summary, RunError> {
        let results = self.results;
        let summary = Summary { status: Status::Done, ..self.summary() };
        summary.write(results)?;
        Ok(summary)
    }

    /// Closes the books of a run that diverged; hands back the error to report.
    ///
    /// # Errors
    /// If the summary cannot be written.
    pub fn diverged(self, diverged: Diverged) -> Result<RunError, RunError> {
        let results = self.results;
        let summary = if self.start.is_none() { self.nothing() } else { self.summary() };
        failed(summary, &diverged).write(results)?;
        Ok(RunError::Diverged { diverged: Box::new(diverged), results: results.path().to_path_buf() })
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
        let (simulation, writer) = (self.simulation, &self.writer);
        let mut snapshot = Snapshot::default();
        let end = simulation.snapshot(&mut snapshot);
        let start = self.start.unwrap_or_default();
        let evidence = Evidence {
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
            particle_steps_per_second: n * steps as f64 / self.wall.max(1e-9),
            energy: energy(&start, &end, writer.energies.clone()),
            momentum: Momentum {
                linear: Balance::new(start.momentum, end.momentum),
                angular: Balance::new(start.angular_momentum, end.angular_momentum),
            },
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
fn mass(simulation: &Simulation) -> Vec<f64> {
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

fn energy(start: &Totals, end: &Totals, history: Vec<[f64; 4]>) -> Energy {
    let initial = start.kinetic + start.strain + start.contact;
    let at_end = end.kinetic + end.strain + end.contact;
    Energy {
        initial,
        at_end,
        kinetic: end.kinetic,
        strain: end.strain,
        contact: end.contact,
        dissipated: end.dissipated,
        external_work: end.external_work,
        residual: initial + end.external_work - end.dissipated - at_end,
        history,
    }
}

fn failed(summary: Summary, diverged: &Diverged) -> Summary {
    let error = Failure {
        message: diverged.to_string(),
        hint: Some(diverged.cause.hint().to_string()),
        time: Some(diverged.time),
    };
    Summary { status: Status::Diverged, error: Some(error), ..summary }
}
