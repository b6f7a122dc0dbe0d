//! What a run will cost, from a few steps of it.

use super::error::RunError;
use crate::Case;
use crate::build::build;
use std::time::Instant;
use taut::simulation::{Numbers, Simulation};

/// Steps tried.
const TRIAL: u32 = 20;

/// What a run will cost.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Particles.
    pub particles: usize,
    /// Mean number of neighbours.
    pub neighbours: f64,
    /// Memory, bytes.
    pub memory: f64,
    /// The first time step, s.
    pub dt: f64,
    /// Steps at that time step.
    pub steps: f64,
    /// Wall time at the speed of a few trial steps on one thread, s.
    pub seconds: f64,
    /// What is doubtful.
    pub warnings: Vec<String>,
}

/// Builds the case, takes a few steps, and reckons.
///
/// # Errors
/// As [`run`](super::run), but nothing is written.
pub fn estimate(case: &Case, numbers: Numbers) -> Result<Estimate, RunError> {
    let built = build(case, numbers)?;
    let (particles, warnings) = (built.particles(), built.warnings);
    let stopped = |diverged| RunError::Diverged { diverged: Box::new(diverged), results: "nowhere".into() };
    let mut simulation = Simulation::start(built.solvers, built.drives).map_err(stopped)?;
    let dt = simulation.dt();
    let clock = Instant::now();
    let mut taken = 0;
    while taken < TRIAL && simulation.time() < case.time.end {
        simulation.step().map_err(stopped)?;
        taken += 1;
    }
    let per_step = clock.elapsed().as_secs_f64() / f64::from(taken.max(1));
    let steps = (case.time.end / dt).ceil();
    let neighbours = simulation.solvers().iter().map(|s| s.neighbours() * s.len() as f64).sum::<f64>()
        / particles.max(1) as f64;
    // Of a pair: D + 2 numbers and two indices in the list, one more index for disorder; of a particle: about 110 numbers.
    let pair = 8.0 * (case.dimension as f64 + 2.0) * 1.1 + 12.0;
    Ok(Estimate {
        particles,
        neighbours,
        memory: particles as f64 * (neighbours * pair + 8.0 * 110.0 + 500.0),
        dt,
        steps,
        seconds: per_step * steps,
        warnings,
    })
}
