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

/// Why a run cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The deformation gradient of a particle has no positive determinant.
    Inverted,
    /// A number that is not finite.
    NotFinite,
    /// The density left the range from a tenth to ten times its value at rest.
    Density,
    /// A speed above ten wave speeds.
    Speed,
    /// The pair list could not be made.
    Unlisted,
}

impl Cause {
    /// What it probably comes from and what to try.
    #[must_use]
    pub const fn hint(self) -> &'static str {
        match self {
            Self::Inverted => {
                "a particle turned inside out: the time step is too long for this stretch (try [time] step = \"stretch\" or a \
                 smaller cfl), or the load is beyond what this resolution can carry"
            }
            Self::NotFinite => {
                "the step became unstable: try a smaller [time] cfl; with a nested formulation, the disorder of \
                 zero-energy modes ends like this too"
            }
            Self::Density => {
                "particles were pressed together or torn apart: with ul-nested this is tensile instability, \
                 otherwise try a smaller [time] cfl or a slower impact"
            }
            Self::Unlisted => {
                "the neighbours cannot be listed: more than 2^32 pairs, or a smoothing length that is no length; use fewer \
                 particles or a smaller `smoothing`"
            }
            Self::Speed => {
                "a speed above ten wave speeds: the initial or prescribed velocity is far beyond what the material can follow, or the \
                 time step is too long (try a smaller [time] cfl)"
            }
        }
    }
}

/// A run that had to stop.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "diverged at t = {time:.6e} s (step {step}): {field} of particle {particle} (body {body}, at {position:?} m) is {value}; \
     likely cause: {}",
    cause.hint()
)]
pub struct Diverged {
    /// Stable id of the particle, as in the files.
    pub particle: u32,
    /// Index of its body.
    pub body: usize,
    /// Its reference position, m.
    pub position: [f64; 3],
    /// Name of the field that went wrong first.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// Time, s.
    pub time: f64,
    /// Number of the step.
    pub step: u64,
    /// What happened.
    pub cause: Cause,
}

impl Diverged {
    /// A pair list that could not be made although every position is a number.
    pub(crate) fn unlisted() -> Self {
        Self {
            particle: 0,
            body: 0,
            position: [0.0; 3],
            field: "number of pairs",
            value: f64::NAN,
            time: 0.0,
            step: 0,
            cause: Cause::Unlisted,
        }
    }
}

/// A test of one field: what it means if a value fails it, and whether it does.
pub(crate) type Check<'a> = (Quantity, Cause, &'a dyn Fn(usize, f64) -> bool);

/// Finds the first particle (by id) with something wrong in one of the fields; `None` if all is well.
pub(crate) fn culprit<const D: usize>(run: &impl Run<D>, checks: &[Check<'_>]) -> Option<Diverged> {
    let p = run.particles();
    for &(field, cause, wrong) in checks {
        let words = field.rank().words(D);
        let found = (0..p.len())
            .flat_map(|a| (0..words).map(move |w| (a, w)))
            .map(|(a, w)| (a, run.word(field, w, a)))
            .filter(|&(a, value)| wrong(a, value))
            .min_by_key(|&(a, _)| p.ids()[a]);
        if let Some((place, value)) = found {
            let x = p.vector_at(Quantity::ReferencePosition, place);
            return Some(Diverged {
                particle: p.ids()[place],
                body: run.word(Quantity::Body, 0, place) as usize,
                position: std::array::from_fn(|i| if i < D { x[i] } else { 0.0 }),
                field: field.name(),
                value,
                time: 0.0,
                step: 0,
                cause,
            });
        }
    }
    None
}
