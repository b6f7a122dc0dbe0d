//! What a form that does not keep angular momentum does to it: the moment of its pair forces, summed up over the looks.

use super::audit::length;
use output::summary::Couples as Summary;
use taut::simulation::Totals;

/// How many numbers [`Couples::saved`] gives.
pub const NUMBERS: usize = 10;

/// The moment of the pair forces and its impulse since the start, by the trapezoidal rule between looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Couples {
    /// Time of the last look, s.
    time: f64,
    /// The moment then, N m.
    moment: [f64; 3],
    /// Sum of the sizes of the couples of all particles then, N m.
    size: f64,
    /// Impulse of the moment, N m s.
    impulse: [f64; 3],
    /// Impulse of the sizes, N m s.
    bound: f64,
    /// The largest of what is missing of the angular momentum beside that impulse, kg m^2/s.
    rest: f64,
}

impl Couples {
    /// Takes down a look, with what is missing of the angular momentum.
    pub fn look(&mut self, time: f64, now: &Totals, missing: [f64; 3]) {
        let half = 0.5 * (time - self.time);
        self.bound += half * (self.size + now.couples);
        for i in 0..3 {
            self.impulse[i] += half * (self.moment[i] + now.couple[i]);
        }
        let rest = length(std::array::from_fn(|i| missing[i] - self.impulse[i]));
        // A value that is not a number stays: it is the worst.
        self.rest = if rest > self.rest || rest.is_nan() { rest } else { self.rest };
        (self.time, self.moment, self.size) = (time, now.couple, now.couples);
    }

    /// The block of the summary; `missing` is the largest of what is missing of the angular momentum, `scale` what that is small or large against.
    pub fn summary(&self, missing: f64, scale: f64) -> Summary {
        let over = |value: f64, by: f64| if value == 0.0 { 0.0 } else { value / by };
        Summary {
            impulse: self.impulse,
            bound: self.bound,
            share: if self.bound > 0.0 { missing / self.bound } else { f64::NAN },
            worst_residual: over(self.rest, scale),
        }
    }

    /// As numbers, to be kept.
    pub fn saved(&self) -> [f64; NUMBERS] {
        let ([a, b, c], [d, e, f]) = (self.moment, self.impulse);
        [self.time, a, b, c, self.size, d, e, f, self.bound, self.rest]
    }

    /// From numbers that were kept.
    pub fn restored(&[time, a, b, c, size, d, e, f, bound, rest]: &[f64; NUMBERS]) -> Self {
        Self { time, moment: [a, b, c], size, impulse: [d, e, f], bound, rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A moment that grows evenly is summed up exactly, what it explains is not missing beside it, and it survives being kept.
    #[test]
    fn an_even_moment_is_summed_up_exactly() {
        let mut couples = Couples::default();
        for time in [0.0, 0.5, 2.0] {
            let now = Totals { couple: [0.0, 0.0, 3.0 * time], couples: 4.0 * time, ..Totals::default() };
            couples.look(time, &now, [0.0, 0.25, 1.5 * time * time]);
            couples = Couples::restored(&couples.saved());
        }
        let summary = couples.summary(6.0, 10.0);
        assert_eq!(summary.impulse, [0.0, 0.0, 6.0]);
        assert_eq!((summary.bound, summary.share, summary.worst_residual), (8.0, 0.75, 0.025));
    }

    /// A form without couples has no bound, and no share of it.
    #[test]
    fn nothing_has_no_share() {
        let summary = Couples::default().summary(1e-17, 1.0);
        assert!(summary.share.is_nan() && summary.bound == 0.0);
    }
}
