//! Values over time, with the worst of them.

use output::summary::{Disorder, Worst};
use taut::diagnostics::disorder;

/// Which end of the scale is bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bad {
    Large,
    Small,
}

/// Histories of all measures of disorder.
#[derive(Clone, Debug, Default)]
pub struct DisorderHistory {
    samples: Vec<(f64, disorder::Disorder)>,
}

impl DisorderHistory {
    /// Adds a sample.
    pub fn push(&mut self, time: f64, sample: disorder::Disorder) {
        self.samples.push((time, sample));
    }

    /// Zigzag (root mean square) of the first and of the last sample, and the time of that, s.
    pub fn zigzag(&self) -> Option<(f64, f64, f64)> {
        let ((_, first), (time, last)) = (self.samples.first()?, self.samples.last()?);
        Some((first.zigzag_rms, last.zigzag_rms, *time))
    }

    fn worst(&self, bad: Bad, value: impl Fn(&disorder::Disorder) -> f64) -> Worst {
        let history: Vec<[f64; 2]> = self.samples.iter().map(|(t, d)| [*t, value(d)]).collect();
        let badness = |[_, v]: &[f64; 2]| if bad == Bad::Large { *v } else { -*v };
        // The first sample that attains it: a measure that never changes is at its worst from the start.
        let worse =
            |a: [f64; 2], b: [f64; 2]| if badness(&b).total_cmp(&badness(&a)).is_gt() { b } else { a };
        let [time, worst] = history.iter().copied().reduce(worse).unwrap_or([0.0, f64::NAN]);
        Worst { worst, time, history }
    }

    /// The block `disorder` of the summary.
    pub fn summary(&self) -> Disorder {
        Disorder {
            zigzag_rms: self.worst(Bad::Large, |d| d.zigzag_rms),
            zigzag_99: self.worst(Bad::Large, |d| d.zigzag_99),
            zigzag_max: self.worst(Bad::Large, |d| d.zigzag_max),
            bond_min: self.worst(Bad::Small, |d| d.bond_min),
            spacing_min: self.worst(Bad::Small, |d| d.spacing_min),
            broken: self.worst(Bad::Large, |d| d.broken),
            pieces: self.worst(Bad::Large, |d| d.pieces as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(zigzag: f64, spacing: f64) -> disorder::Disorder {
        disorder::Disorder {
            zigzag_rms: zigzag,
            zigzag_99: zigzag,
            zigzag_max: zigzag,
            bond_min: spacing,
            spacing_min: spacing,
            broken: 0.0,
            pieces: 1,
        }
    }

    #[test]
    fn the_worst_is_the_first_sample_that_attains_it() {
        let mut history = DisorderHistory::default();
        for (time, zigzag, spacing) in [(0.0, 0.1, 1.0), (1.0, 0.3, 0.9), (2.0, 0.3, 0.8), (3.0, 0.2, 0.8)] {
            history.push(time, sample(zigzag, spacing));
        }
        let summary = history.summary();
        assert_eq!((summary.zigzag_rms.worst, summary.zigzag_rms.time), (0.3, 1.0));
        assert_eq!((summary.spacing_min.worst, summary.spacing_min.time), (0.8, 2.0));
        assert_eq!((summary.broken.worst, summary.broken.time), (0.0, 0.0));
    }
}
