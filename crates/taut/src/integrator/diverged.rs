//! A run that cannot go on: which particle, which criterion, and how it is found.

use crate::field::Quantity;
use crate::run::Run;

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
    /// A particle that had neighbours has fewer than there are dimensions: no gradient can be formed any more.
    Lost,
    /// More energy than twice what was put in.
    Gained,
    /// The time step fell below a thousandth of the first one.
    Collapsed,
    /// The particles are more disordered than the case allows.
    Disordered,
}

impl Cause {
    /// What must hold, in words.
    #[must_use]
    pub const fn criterion(self) -> &'static str {
        match self {
            Self::Inverted => "the determinant of the deformation gradient is positive",
            Self::NotFinite => "every number is finite",
            Self::Density => "the density stays between a tenth and ten times that at rest",
            Self::Speed => "no particle is faster than ten wave speeds",
            Self::Unlisted => "the neighbours can be listed",
            Self::Lost => "a particle has at least as many neighbours as there are dimensions",
            Self::Gained => "the bodies have at most twice the energy that was put into them",
            Self::Collapsed => "the time step is at least a thousandth of the first one",
            Self::Disordered => "the disorder stays within the thresholds of [monitor]",
        }
    }

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
                "particles were pressed together or torn apart: with ul-nested (and ul-artificial-stress) this is tensile instability, \
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
            Self::Lost => {
                "a particle left its body: the body is torn, which with ul-nested (and ul-artificial-stress) is tensile instability; \
                 otherwise try a smaller [time] cfl or a slower load"
            }
            Self::Gained => {
                "the motion feeds itself, as it does when the time step is too long or a zero-energy mode grows: try a smaller \
                 [time] cfl, or a formulation that is free of hourglass modes"
            }
            Self::Collapsed => {
                "a particle is squeezed or stretched without end, so that waves cross it in no time: the load is beyond what this \
                 resolution can carry, or particles are pressed through each other"
            }
            Self::Disordered => "zero-energy modes grow: try a formulation that is free of hourglass modes",
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
    /// Stable id of the particle, as in the files; in a simulation of several solvers those of later ones follow.
    pub particle: u32,
    /// Index of its body.
    pub body: usize,
    /// Its reference position, m.
    pub position: [f64; 3],
    /// Name of the field that went wrong first.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What the value had to stay above or below; not a number if it only had to be finite.
    pub bound: f64,
    /// Time, s.
    pub time: f64,
    /// Number of the step.
    pub step: u64,
    /// What happened.
    pub cause: Cause,
}

impl Diverged {
    /// A value of the particle stored at `place` that went beyond its bound.
    pub(crate) fn of<const D: usize>(
        run: &impl Run<D>,
        (place, cause): (usize, Cause),
        (field, value, bound): (&'static str, f64, f64),
    ) -> Self {
        let p = run.particles();
        let x = p.vector_at(Quantity::ReferencePosition, place);
        Self {
            particle: p.ids()[place],
            body: run.word(Quantity::Body, 0, place) as usize,
            position: std::array::from_fn(|i| if i < D { x[i] } else { 0.0 }),
            field,
            value,
            bound,
            time: 0.0,
            step: 0,
            cause,
        }
    }

    /// The same with the id that it has behind so many particles of other solvers.
    pub(crate) fn after(self, first: u32) -> Self {
        Self { particle: self.particle + first, ..self }
    }

    /// A pair list that could not be made although every position is a number.
    pub(crate) fn unlisted() -> Self {
        Self {
            particle: 0,
            body: 0,
            position: [0.0; 3],
            field: "number of pairs",
            value: f64::NAN,
            bound: f64::NAN,
            time: 0.0,
            step: 0,
            cause: Cause::Unlisted,
        }
    }
}

/// A test of one field: what it means if a value fails it, and whether it does.
pub(crate) struct Check<'a> {
    pub field: Quantity,
    pub cause: Cause,
    /// What a bad value of the particle at a place had to stay within; `None` if it is within.
    pub beyond: &'a dyn Fn(usize, f64) -> Option<f64>,
}

/// Nothing but finite.
pub(crate) fn not_finite(_: usize, value: f64) -> Option<f64> {
    (!value.is_finite()).then_some(f64::NAN)
}

/// Finds the first particle (by id) with something wrong in one of the fields; `None` if all is well.
pub(crate) fn culprit<const D: usize>(run: &impl Run<D>, checks: &[Check<'_>]) -> Option<Diverged> {
    let p = run.particles();
    for check in checks {
        let words = check.field.rank().words(D);
        let found = (0..p.len())
            .flat_map(|a| (0..words).map(move |w| (a, w)))
            .map(|(a, w)| (a, run.word(check.field, w, a)))
            .filter_map(|(a, value)| Some((a, value, (check.beyond)(a, value)?)))
            .min_by_key(|&(a, ..)| p.ids()[a]);
        if let Some((place, value, bound)) = found {
            return Some(Diverged::of(run, (place, check.cause), (check.field.name(), value, bound)));
        }
    }
    None
}
