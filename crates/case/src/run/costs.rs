//! What output costs, measured beside the steps of the same run.

use super::checkpoint::{INTERVAL, draft};
use super::error::RunError;
use super::frames::Framer;
use crate::Case;
use crate::build::Watch;
use output::Frame;
use std::time::Instant;
use taut::simulation::{Simulation, Snapshot};

/// Each is timed so often; the median counts.
const TIMES: usize = 5;

/// How long what a run writes keeps its threads busy, s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Costs {
    /// A look at disorder.
    pub look: f64,
    /// A frame.
    pub frame: f64,
    /// A checkpoint.
    pub checkpoint: f64,
}

/// How often a run does what.
#[derive(Clone, Copy, Debug)]
pub struct Rates {
    /// Steps of the run.
    pub steps: f64,
    /// Wall time of one, s.
    pub per_step: f64,
    /// Frames.
    pub frames: f64,
}

impl Costs {
    /// Times each of them in the present state of the simulation, on the threads that call.
    ///
    /// # Errors
    /// If the disorder cannot be measured, or a frame not be packed.
    pub fn measured(
        (case, simulation, watch): (&Case, &mut Simulation, &mut dyn Watch),
        rates: &Rates,
    ) -> Result<Self, RunError> {
        let (mut snapshot, mut deformation) = (Snapshot::default(), Vec::new());
        let (mut framer, mut rehearsal) = (Framer::new(case), output::Rehearsal::default());
        let apart = (rates.steps / rates.frames) as u64;
        let look = median(|| {
            simulation.snapshot(&mut snapshot);
            Ok(watch.measure(&snapshot).map(drop)?)
        })?;
        let frame = median(|| {
            simulation.snapshot(&mut snapshot);
            watch.deformation(&snapshot, &mut deformation);
            let frame: Frame = framer.frame(&snapshot, &deformation, simulation.steps());
            Ok(rehearsal.size(&frame, apart).map(drop)?)
        })?;
        // A run that is over sooner makes none.
        let makes_any = rates.steps * rates.per_step > INTERVAL.as_secs_f64();
        let pack = || {
            drop(draft(simulation));
            Ok(())
        };
        let checkpoint = if makes_any { median(pack)? } else { 0.0 };
        Ok(Self { look, frame, checkpoint })
    }

    /// The part of a run that they take, at the rates of the case.
    #[must_use]
    pub fn share(&self, case: &Case, rates: &Rates) -> f64 {
        let run = rates.steps * rates.per_step;
        let looks = match case.monitor.apart.0 {
            0 => case.time.end / case.monitor.interval,
            steps => rates.frames.min(rates.steps / steps as f64),
        };
        let checkpoints = (run / INTERVAL.as_secs_f64()).floor();
        (looks * self.look + rates.frames * self.frame + checkpoints * self.checkpoint) / run
    }
}

/// Seconds that some work takes.
fn median(mut work: impl FnMut() -> Result<(), RunError>) -> Result<f64, RunError> {
    let mut seconds = [0.0; TIMES];
    for seconds in &mut seconds {
        let clock = Instant::now();
        work()?;
        *seconds = clock.elapsed().as_secs_f64();
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds[TIMES / 2])
}
