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

    fn worst(&self, bad: Bad, value: impl Fn(&disorder::Disorder) -> f64) -> Worst {
        let history: Vec<[f64; 2]> = self.samples.iter().map(|(t, d)| [*t, value(d)]).collect();
        let badness = |[_, v]: &[f64; 2]| if bad == Bad::Large { *v } else { -*v };
        let worst = history.iter().max_by(|a, b| badness(a).total_cmp(&badness(b)));
        let [time, worst] = worst.copied().unwrap_or([0.0, f64::NAN]);
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
