//! How long a step takes.

use super::body::{Size, body};
use super::subject::Subject;
use crate::memory;
use std::time::Instant;
use taut::simulation::Simulation;

/// One step that was timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Its time, s.
    pub seconds: f64,
    /// Whether it made new lists.
    pub relisted: bool,
}

/// What the samples say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// Time of a step, the mean of the fastest batch, s. What disturbs a machine only ever makes it slower.
    pub best: f64,
    /// The same of the median batch, s.
    pub median: f64,
    /// Steps that share a list; infinite where there is only one.
    pub steps_per_list: f64,
    /// Share of the time that goes into new lists (search, kernel, correction), where they last for several steps.
    pub relist_share: Option<f64>,
}

/// Batches that the samples are cut into where no list says how.
const BATCHES: usize = 12;

impl Timing {
    /// From samples in their order. A batch is, with dual stepping, everything from one list to the next.
    pub fn new(samples: &[Sample], dual: bool) -> Self {
        let batches: Vec<&[Sample]> = if dual {
            let starts: Vec<usize> = (0..samples.len()).filter(|&i| samples[i].relisted).collect();
            starts.windows(2).map(|w| &samples[w[0]..w[1]]).collect()
        } else {
            samples.chunks(samples.len().div_ceil(BATCHES).max(1)).collect()
        };
        let mean = |batch: &&[Sample]| batch.iter().map(|s| s.seconds).sum::<f64>() / batch.len() as f64;
        let mut means: Vec<f64> = batches.iter().map(mean).collect();
        means.sort_by(f64::total_cmp);
        let steps: usize = batches.iter().map(|batch| batch.len()).sum();
        let lists = batches.iter().flat_map(|batch| batch.iter()).filter(|s| s.relisted).count();
        Self {
            best: means.first().copied().unwrap_or(f64::NAN),
            median: median(means.into_iter()),
            steps_per_list: steps as f64 / lists as f64,
            relist_share: if dual { Some(share(&batches.concat())) } else { None },
        }
    }
}

/// What a step with a new list takes longer than one without, over what all steps that share it take.
fn share(samples: &[Sample]) -> f64 {
    let of = |relisted: bool| {
        let these: Vec<f64> = samples.iter().filter(|s| s.relisted == relisted).map(|s| s.seconds).collect();
        (these.len() as f64, median(these.into_iter()))
    };
    let ((lists, with), (others, without)) = (of(true), of(false));
    lists * (with - without).max(0.0) / (lists * with + others * without)
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A subject that has been brought to life, and what that took.
pub struct Living {
    simulation: Simulation,
    dual: bool,
    /// Particles.
    pub particles: usize,
    /// Mean number of neighbours.
    pub neighbours: f64,
    /// Most bytes that the body ever took, for each particle; `None` if the program does not count.
    pub bytes: Option<f64>,
}

impl Living {
    /// Makes the body and takes a few steps, in the pool that the calling thread belongs to.
    pub fn start(subject: &Subject, size: Size) -> Result<Self, String> {
        let before = memory::restart();
        let body = body(subject, size).ok_or("this formulation cannot carry rubber")?;
        let mut simulation = Simulation::start(vec![body], Vec::new()).map_err(|d| d.to_string())?;
        let lists = |s: &Simulation| s.solvers().iter().map(|s| s.lists()).sum::<u64>();
        let (first, mut steps) = (lists(&simulation), 0);
        // Every buffer has its size after three steps, and after the second list.
        while steps < 3 || (subject.is_dual() && lists(&simulation) < first + 2) {
            simulation.step().map_err(|d| d.to_string())?;
            steps += 1;
        }
        let particles = simulation.len();
        let bytes = memory::peak().map(|peak| peak.saturating_sub(before) as f64 / particles as f64);
        let neighbours = simulation.solvers()[0].neighbours();
        Ok(Self { simulation, dual: subject.is_dual(), particles, neighbours, bytes })
    }

    /// Times steps for so many seconds, and to the end of a list.
    pub fn time(&mut self, seconds: f64) -> Result<Timing, String> {
        let mut samples = Vec::new();
        let (whole, mut lists) = (Instant::now(), 0);
        while whole.elapsed().as_secs_f64() < seconds || samples.len() < BATCHES || (self.dual && lists < 3) {
            let before = self.simulation.solvers()[0].lists();
            let clock = Instant::now();
            self.simulation.step().map_err(|d| d.to_string())?;
            let seconds = clock.elapsed().as_secs_f64();
            let relisted = self.simulation.solvers()[0].lists() > before;
            lists += usize::from(relisted);
            samples.push(Sample { seconds, relisted });
        }
        Ok(Timing::new(&samples, self.dual))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(seconds: &[f64], every: usize) -> Vec<Sample> {
        let sample = |(i, &seconds): (usize, &f64)| Sample { seconds, relisted: i % every == 1 };
        seconds.iter().enumerate().map(sample).collect()
    }

    #[test]
    fn whole_lists_are_batches() {
        // Lists are new at 1, 5 and 9: what comes before the first and after the last belongs to no whole one.
        let timing = Timing::new(&samples(&[9., 5., 1., 1., 1., 5., 1., 2., 1., 7., 9.], 4), true);
        assert_eq!((timing.best, timing.median, timing.steps_per_list), (2.0, 2.25, 4.0));
        // 5 instead of 1 once, in 5 + 3: half of the time.
        assert_eq!(timing.relist_share, Some(0.5));
    }

    #[test]
    fn other_steps_are_cut_evenly_and_the_best_part_counts() {
        let mut seconds = vec![2.0; 24];
        (seconds[4], seconds[5], seconds[10]) = (1.0, 1.0, 8.0);
        let timing = Timing::new(&samples(&seconds, 1000), false);
        assert_eq!((timing.best, timing.median, timing.relist_share), (1.0, 2.0, None));
    }
}
