//! What a run will cost, from a few steps of it.

use super::checkpoint::{INTERVAL, draft};
use super::costs::{Costs, Rates};
use super::error::RunError;
use super::frames::Framer;
use super::memory::{peak, present};
use super::{pool, useful_threads};
use crate::Case;
use crate::build::{Built, available_memory, build, reckon};
use output::Frame;
use std::time::Instant;
use taut::simulation::{Numbers, Simulation, Snapshot};

/// Steps tried at least; more until [`TRIED`] seconds have passed.
const TRIAL: u32 = 20;
/// Seconds of trial steps.
const TRIED: f64 = 0.5;
/// A case with more particles than this is tried with a larger spacing, which leaves about as many.
const TRIABLE: f64 = 300_000.0;

/// What a run will cost.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Particles.
    pub particles: usize,
    /// Mean number of neighbours.
    pub neighbours: f64,
    /// The first time step, s.
    pub dt: f64,
    /// Steps at that time step.
    pub steps: f64,
    /// Threads that a run would use.
    pub threads: usize,
    /// Wall time at the speed of the trial steps, s.
    pub seconds: f64,
    /// Size of the frames on disk, bytes.
    pub disk: f64,
    /// The part of the run that output takes.
    pub output: f64,
    /// What a look at disorder, a frame and a checkpoint cost, in steps.
    pub costs: [f64; 3],
    /// Particles across the thinnest part of each body.
    pub across: Vec<usize>,
    /// What is doubtful.
    pub warnings: Vec<String>,
    /// The initial state.
    pub frame: Frame,
    /// The spacing that was tried, m, where the case itself is too large to try.
    pub tried: Option<f64>,
    /// Memory of the program before the case was built, bytes.
    before: f64,
    /// Particles of the case for each one tried.
    ratio: f64,
}

impl Estimate {
    /// Memory that a run takes at most, bytes: what trying it took until now, scaled to the case. `None` where the system
    /// does not say.
    #[must_use]
    pub fn memory(&self) -> Option<f64> {
        Some(self.before + self.ratio * (peak()? - self.before))
    }
}

/// Builds the case, takes a few steps and a look as a run would, and reckons. A case that is large is tried with a larger spacing.
///
/// # Errors
/// As [`run`](super::run), but nothing is written; and a case that needs more memory than there is.
pub fn estimate(case: &Case, numbers: Numbers) -> Result<Estimate, RunError> {
    let before = present().unwrap_or(0.0);
    let count = reckon(case);
    if count.is_finite() && count > TRIABLE {
        let scale = (count / TRIABLE).powf(1.0 / case.dimension as f64);
        let mut coarse = case.clone();
        coarse.spacing *= scale;
        // What is lost or too thin at the larger spacing is not the case's fault; then it has to be tried itself.
        if let Ok(built) = build(&coarse, numbers) {
            let tried = Some(coarse.spacing);
            let one = of_built(&coarse, built, before)?;
            let (ratio, across) =
                (count / one.particles as f64, |n: &usize| (*n as f64 * scale).round() as usize);
            let large = Estimate {
                particles: count as usize,
                dt: one.dt / scale,
                steps: (one.steps * scale).ceil(),
                seconds: one.seconds * scale * ratio,
                disk: one.disk * ratio,
                across: one.across.iter().map(across).collect(),
                warnings: Vec::new(),
                tried,
                ratio,
                ..one
            };
            return afford(large);
        }
    }
    of_built(case, build(case, numbers)?, before)
}

/// Refuses what will not fit.
fn afford(estimate: Estimate) -> Result<Estimate, RunError> {
    match (estimate.memory(), available_memory()) {
        (Some(needed), Some(available)) if needed > available => {
            Err(RunError::TooLarge { particles: estimate.particles, needed, available })
        }
        _ => Ok(estimate),
    }
}

fn of_built(case: &Case, built: Built, before: f64) -> Result<Estimate, RunError> {
    let threads = useful_threads(built.particles());
    pool(threads)?.install(|| tried(case, built, (threads, before)))
}

fn tried(case: &Case, built: Built, (threads, before): (usize, f64)) -> Result<Estimate, RunError> {
    let particles = built.particles();
    let Built { solvers, contact, drives, damping, grips, mut watch, warnings, across, .. } = built;
    let stopped = |diverged| RunError::Tried { diverged: Box::new(diverged), warnings: warnings.clone() };
    let mut simulation = Simulation::new(solvers, drives).damped(damping).touching(contact);
    simulation.hold(grips);
    simulation.begin().map_err(stopped)?;
    let (dt, first) = (simulation.dt(), looked_at(case, &mut simulation, watch.as_mut())?);
    let clock = Instant::now();
    let mut taken = 0;
    while (taken < TRIAL || clock.elapsed().as_secs_f64() < TRIED) && simulation.time() < case.time.end {
        simulation.step().map_err(stopped)?;
        taken += 1;
    }
    let per_step = clock.elapsed().as_secs_f64() / f64::from(taken.max(1));
    // A run holds two sheets, three frames for pictures, and one that is being written.
    let (last, sheet) = (looked_at(case, &mut simulation, watch.as_mut())?, first.1);
    // Threads hold back what they have freed: about a frame more, if there are several.
    let kept = vec![last.0.clone(); if threads > 1 { 3 } else { 2 }];
    let steps = steps(case, dt);
    // A run that is long enough packs checkpoints.
    let packed = (per_step * steps > INTERVAL.as_secs_f64()).then(|| draft(&simulation));
    let rates = Rates { steps, per_step, frames: frames(case, dt) };
    let bytes = output::Rehearsal::default().size(&last.0, (steps / rates.frames) as u64)? as f64;
    let neighbours = simulation.solvers().iter().map(|s| s.neighbours() * s.len() as f64).sum::<f64>()
        / particles.max(1) as f64;
    drop((sheet, last, kept, packed));
    let costs = Costs::measured((case, &mut simulation, watch.as_mut()), &rates)?;
    Ok(Estimate {
        particles,
        neighbours,
        dt,
        steps,
        threads,
        seconds: per_step * steps,
        disk: bytes * rates.frames,
        output: costs.share(case, &rates),
        costs: [costs.look, costs.frame, costs.checkpoint].map(|seconds| seconds / per_step),
        across,
        warnings,
        frame: first.0,
        tried: None,
        before,
        ratio: 1.0,
    })
}

/// Waves cross a body so often, about, while an increment of a quasi-static run grows and comes to rest: 9 to 50 in the built-in cases.
const CROSSINGS: f64 = 20.0;

/// Steps of a run. Those of a quasi-static one are a guess: it is not known before how soon it comes to rest.
fn steps(case: &Case, dt: f64) -> f64 {
    let Some(statics) = case.quasi_static else { return (case.time.end / dt).ceil() };
    let edges = case.bodies.iter().flat_map(|body| crate::build::bounds(&body.shape));
    let longest = edges.filter(|edge| edge.is_finite()).fold(case.spacing, f64::max);
    // A wave takes a step of 0.6 h, h = 1.15 spacings.
    f64::from(statics.increments) * CROSSINGS * longest / (0.69 * case.spacing)
}

/// Frames of a run with this time step, about.
fn frames(case: &Case, dt: f64) -> f64 {
    let (steps, time) = case.time.apart;
    let apart = if steps == 0 { 0.0 } else { time.min(steps as f64 * dt) };
    (case.time.end / case.time.output.max(apart)).ceil()
}

/// A frame of the present state, and the sheet that it came from.
fn looked_at(
    case: &Case,
    simulation: &mut Simulation,
    watch: &mut dyn crate::build::Watch,
) -> Result<(Frame, Snapshot), RunError> {
    let mut snapshot = Snapshot::default();
    simulation.snapshot(&mut snapshot);
    watch.measure(&snapshot)?;
    watch.gap(&snapshot)?;
    let mut deformation = Vec::new();
    watch.deformation(&snapshot, &mut deformation);
    Ok((Framer::new(case).frame(&snapshot, &deformation, simulation.steps()), snapshot))
}
