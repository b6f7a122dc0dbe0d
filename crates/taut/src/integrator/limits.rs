//! What bounds a time step, and how a run that left its bounds is recognised.

use crate::field::{Of, Quantity};
use crate::math::Real;
use crate::pass::{Fold, Reduce};
use crate::run::Run;

record! {
    /// Motion and density of a particle.
    Motion { v: Velocity, a: Acceleration, density: Density, rest: RestDensity }
    /// Motion and wave speed of a particle.
    Waves { v: Velocity, a: Acceleration, c2: WaveSpeedSquared }
}

/// Largest speed, acceleration and wave speed of all particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Largest speed, m/s.
    pub speed: f64,
    /// Largest acceleration, m/s^2.
    pub acceleration: f64,
    /// Largest wave speed in the metric of the list, m/s (0 where the formulation has none).
    pub wave_speed: f64,
    /// Whether every velocity and acceleration is a number, no particle is inverted and every density between a tenth
    /// and ten times that at rest.
    pub finite: bool,
}

/// Without wave speed.
struct MotionLimits;
/// With wave speed.
struct WaveLimits;

impl<const D: usize> Reduce<D, 5> for MotionLimits {
    type Reads = Motion<f64, D>;
    // The sum sees what a maximum may lose: every NaN ends up in it.
    const FOLDS: [Fold; 5] = [Fold::Max, Fold::Max, Fold::Sum, Fold::Min, Fold::Max];

    #[inline(always)]
    fn at<S: Real>(&self, p: &Of<Self::Reads, S, D>) -> [S; 5] {
        let (v, a) = (p.v.norm_squared(), p.a.norm_squared());
        let ratio = p.density / p.rest;
        [v, a, v + a, ratio, ratio]
    }
}

impl<const D: usize> Reduce<D, 4> for WaveLimits {
    type Reads = Waves<f64, D>;
    const FOLDS: [Fold; 4] = [Fold::Max, Fold::Max, Fold::Max, Fold::Sum];

    #[inline(always)]
    fn at<S: Real>(&self, p: &Of<Self::Reads, S, D>) -> [S; 4] {
        let (v, a) = (p.v.norm_squared(), p.a.norm_squared());
        [v, a, p.c2, v + a + p.c2]
    }
}

impl Limits {
    /// Of particles that carry a wave speed.
    pub fn with_waves<const D: usize>(run: &mut impl Run<D>) -> Self {
        let [v, a, c, sum] = run.reduce(&WaveLimits);
        Self::new(v, a, c, sum)
    }

    /// Of particles that do not.
    pub fn of_motion<const D: usize>(run: &mut impl Run<D>) -> Self {
        let [v, a, sum, thin, dense] = run.reduce(&MotionLimits);
        let limits = Self::new(v, a, 0.0, sum);
        Self { finite: limits.finite && thin > 0.1 && dense < 10.0, ..limits }
    }

    /// As numbers, to be kept; `finite` they are.
    pub(crate) fn saved(&self) -> [f64; 3] {
        [self.speed, self.acceleration, self.wave_speed]
    }

    /// From numbers that were kept.
    pub(crate) fn restored([speed, acceleration, wave_speed]: [f64; 3]) -> Self {
        Self { speed, acceleration, wave_speed, finite: true }
    }

    fn new(v: f64, a: f64, c: f64, sum: f64) -> Self {
        Self {
            speed: v.max(0.0).sqrt(),
            acceleration: a.max(0.0).sqrt(),
            wave_speed: c.max(0.0).sqrt(),
            finite: sum.is_finite(),
        }
    }
}

/// Which of the criteria of a time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// A wave may not cross more than a smoothing length: h / (c + |v|).
    Wave,
    /// Likewise the wave that the shear Laplacian of `ul-non-hourglass` makes.
    ShearWave,
    /// sqrt(h / |a|).
    Acceleration,
    /// The highest frequency of a body whose operator does not change: 2/omega.
    Operator,
}

impl Criterion {
    /// It, in symbols.
    #[must_use]
    pub const fn formula(self) -> &'static str {
        match self {
            Self::Wave => "h / (c + v)",
            Self::ShearWave => "1.5 h / (c_M + v)",
            Self::Acceleration => "sqrt(h / a)",
            Self::Operator => "2 / omega",
        }
    }
}

/// What bounds a time step: the criterion, and what it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounding {
    /// The one that gives the shortest step.
    pub criterion: Criterion,
    /// The largest wave speed c, m/s.
    pub wave_speed: f64,
    /// The largest speed |v|, m/s.
    pub speed: f64,
    /// The largest acceleration |a|, m/s^2.
    pub acceleration: f64,
}

/// The particle, by id, with the largest of a number (or length of a vector); `None` if all have the same.
pub(super) fn largest<const D: usize>(run: &impl Run<D>, field: Quantity) -> Option<u32> {
    let words = field.rank().words(D);
    let (mut most, mut least, mut place) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    for a in 0..run.particles().len() {
        let size: f64 = (0..words).map(|w| run.word(field, w, a).powi(2)).sum();
        least = least.min(size);
        if size > most || size.is_nan() {
            (most, place) = (size, a);
        }
    }
    (most > least).then(|| run.particles().ids()[place])
}
