//! How each body is marched in time: the formulation and what depends on it.

use super::body::Body;
use super::choices::{Calibration, Family, Formulation, Normalisation, StepRule, Stepping};
use super::defaults;
use super::scope::Scope;
use super::time::flag;
use crate::diagnostic::{Diagnostic, Problems, did_you_mean};
use crate::keys::{Words, case, time};
use crate::source::Place;
use crate::written::{Node, Table, Value, choice, optional, text};

/// How a body is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scheme {
    /// The formulation.
    pub formulation: Formulation,
    /// Smoothing length over spacing.
    pub smoothing: f64,
    /// Fraction of the stable time step that is taken, in (0, 1].
    pub cfl: f64,
    /// What only this family of formulations has.
    pub march: March,
}

/// What only one family of formulations has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum March {
    /// Total Lagrangian.
    Total {
        /// How the step is bounded.
        step: StepRule,
        /// Factors of the hourglass-free force.
        calibration: Calibration,
        /// Strength of Ganzenmueller's hourglass control.
        alpha: f64,
        /// Factor of the Kelvin-Voigt damping.
        kelvin_voigt: f64,
    },
    /// Small strain.
    Small {
        /// What is done at the edge.
        normalisation: Normalisation,
        /// The time step, s; `None` for the stable one.
        dt: Option<f64>,
    },
    /// Updated Lagrangian.
    Updated {
        /// How neighbours are renewed.
        stepping: Stepping,
        /// Floor of the advection speed, m/s.
        reference_speed: f64,
        /// Strength of artificial stress.
        artificial_stress: f64,
    },
}

/// What the case says about schemes, before a body asks.
#[derive(Debug, Clone)]
pub(crate) struct Schemes {
    /// Of a body that does not name its own.
    pub formulation: Formulation,
    /// Whether what the case says about it makes sense.
    pub known: bool,
    smoothing: Option<f64>,
    cfl: Option<f64>,
    step: Option<(StepRule, Place)>,
    stepping: Option<(Stepping, Place)>,
    reference_speed: Option<(f64, Place)>,
    calibration: Option<(Calibration, Place)>,
    alpha: Option<(f64, Place)>,
    artificial_stress: Option<(f64, Place)>,
    kelvin_voigt: Option<(f64, Place)>,
    shear_stress: Option<(bool, Place)>,
    normalisation: Option<(Normalisation, Place)>,
    dt: Option<(f64, Place)>,
}

impl Schemes {
    /// Reads the keys of the case; a wrong one is noted and left out.
    pub(crate) fn read(root: &Table, scope: &Scope, problems: &mut Problems) -> Self {
        let times = match root.get("time").map(|node| &node.value) {
            Some(Value::Table(table)) => Some(table),
            _ => None,
        };
        let of_time = |key| times.and_then(|table: &Table| table.get(key));
        let formulation = optional(root.get(case::FORMULATION.name), problems, read_formulation);
        let smoothing = optional(root.get(case::SMOOTHING.name), problems, |n| scope.of(n, &case::SMOOTHING));
        let cfl = optional(of_time(time::CFL.name), problems, |n| cfl(scope, n));
        Self {
            known: formulation.is_some() || root.get(case::FORMULATION.name).is_none(),
            formulation: formulation.map_or(defaults::FORMULATION, |(formulation, _)| formulation),
            smoothing: smoothing.map(|(value, _)| value),
            cfl: cfl.map(|(value, _)| value),
            step: optional(of_time(time::STEP.name), problems, |n| {
                choice(n, time::STEP.name, StepRule::WORDS)
            }),
            stepping: optional(root.get(case::STEPPING.name), problems, |n| {
                choice(n, case::STEPPING.name, Stepping::WORDS)
            }),
            reference_speed: optional(root.get(case::REFERENCE_SPEED.name), problems, |n| {
                scope.of(n, &case::REFERENCE_SPEED)
            }),
            calibration: optional(root.get(case::CALIBRATION.name), problems, |n| {
                choice(n, case::CALIBRATION.name, Calibration::WORDS)
            }),
            alpha: optional(root.get(case::ALPHA.name), problems, |n| scope.of(n, &case::ALPHA)),
            artificial_stress: optional(root.get(case::ARTIFICIAL_STRESS.name), problems, |n| {
                scope.of(n, &case::ARTIFICIAL_STRESS)
            }),
            kelvin_voigt: optional(root.get(case::KELVIN_VOIGT.name), problems, |n| {
                scope.of(n, &case::KELVIN_VOIGT)
            }),
            shear_stress: optional(root.get(case::SHEAR_STRESS.name), problems, |n| {
                flag(n, &case::SHEAR_STRESS)
            }),
            normalisation: optional(root.get(case::NORMALISATION.name), problems, |n| {
                choice(n, case::NORMALISATION.name, Normalisation::WORDS)
            }),
            dt: optional(of_time(time::DT.name), problems, |n| scope.of(n, &time::DT)),
        }
    }

    /// Whether a shear stress is integrated that is only to be looked at.
    pub(crate) fn shear_stress(&self) -> bool {
        self.shear_stress.is_none_or(|(wanted, _)| wanted)
    }

    /// The scheme of a body with its own formulation (or none).
    pub(crate) fn of(&self, own: Option<Formulation>) -> Scheme {
        let formulation = own.unwrap_or(self.formulation);
        let march = match formulation.family() {
            Family::Total if formulation == Formulation::SmallStrain => March::Small {
                normalisation: self.normalisation.map_or(defaults::NORMALISATION, |(n, _)| n),
                dt: self.dt.map(|(dt, _)| dt),
            },
            Family::Total => March::Total {
                step: self.step.map_or(defaults::STEP, |(step, _)| step),
                calibration: self.calibration.map_or(defaults::CALIBRATION, |(calibration, _)| calibration),
                alpha: self.alpha.map_or(defaults::ALPHA, |(alpha, _)| alpha),
                kelvin_voigt: self.kelvin_voigt.map_or(defaults::KELVIN_VOIGT, |(factor, _)| factor),
            },
            Family::Updated => March::Updated {
                stepping: self.stepping.map_or(defaults::stepping(formulation), |(stepping, _)| stepping),
                reference_speed: self.reference_speed.map_or(defaults::REFERENCE_SPEED, |(speed, _)| speed),
                artificial_stress: self.artificial_stress.map_or(defaults::ARTIFICIAL_STRESS, |(eps, _)| eps),
            },
        };
        Scheme {
            formulation,
            smoothing: self.smoothing.unwrap_or(defaults::smoothing(formulation)),
            cfl: self.cfl.unwrap_or(defaults::cfl(formulation)),
            march,
        }
    }

    /// Refuses keys of a family that no body of the case belongs to.
    pub(crate) fn refuse_useless(&self, bodies: &[Body], problems: &mut Problems) {
        let used = |family| bodies.iter().any(|body| body.scheme.formulation.family() == family);
        let one_only = [
            ("shear_stress", self.shear_stress.map(|(_, place)| place), Formulation::UlNonHourglass),
            ("alpha", self.alpha.map(|(_, place)| place), Formulation::TlGanzenmueller),
            ("calibration", self.calibration.map(|(_, place)| place), Formulation::TlHourglassFree),
            ("normalisation", self.normalisation.map(|(_, place)| place), Formulation::SmallStrain),
            ("dt", self.dt.map(|(_, place)| place), Formulation::SmallStrain),
        ];
        for (key, place, formulation) in one_only {
            let used = bodies.iter().any(|body| body.scheme.formulation == formulation);
            if let Some(place) = place.filter(|_| !used) {
                problems.0.push(useless(key, formulation.name(), place));
            }
        }
        let pushed = bodies.iter().any(|body| body.scheme.formulation.has_artificial_stress());
        if let Some((_, place)) = self.artificial_stress.filter(|_| !pushed) {
            let owners = "ul-artificial-stress and ul-artificial-stress-corrected";
            problems.0.push(useless("artificial_stress", owners, place));
        }
        let updated_only = [
            ("stepping", self.stepping.map(|(_, place)| place)),
            ("reference_speed", self.reference_speed.map(|(_, place)| place)),
        ];
        for (key, place) in updated_only {
            if let Some(place) = place.filter(|_| !used(Family::Updated)) {
                problems.0.push(useless(key, "updated Lagrangian formulations (ul-*)", place));
            }
        }
        let steps = |body: &Body| matches!(body.scheme.march, March::Total { .. });
        let total_only = [
            ("step", self.step.map(|(_, place)| place)),
            ("kelvin_voigt", self.kelvin_voigt.map(|(_, place)| place)),
        ];
        for (key, place) in total_only {
            if let Some(place) = place.filter(|_| !bodies.iter().any(steps)) {
                problems.0.push(useless(key, "total Lagrangian formulations (tl-*)", place));
            }
        }
    }
}

fn useless(key: &str, family: &str, place: Place) -> Diagnostic {
    Diagnostic::at(place, format!("`{key}` belongs to {family}, and no body of this case uses one"))
        .help("remove it, or choose another formulation")
}

fn cfl(scope: &Scope, node: &Node) -> Result<f64, Diagnostic> {
    scope.of(node, &time::CFL).map_err(|error| match error.label.is_empty() {
        true => error.label("no explicit step is stable beyond 1"),
        false => error,
    })
}

/// The formulation that a text names.
pub(crate) fn read_formulation(node: &Node) -> Result<Formulation, Diagnostic> {
    let (name, place) = (text(node, "formulation")?, node.place);
    if let Some((_, formulation, _)) = Formulation::WORDS.iter().find(|(n, ..)| *n == name) {
        return Ok(*formulation);
    }
    let names = Formulation::WORDS.iter().map(|(n, ..)| *n);
    Err(Diagnostic::at(place, format!("unknown formulation `{name}`")).help(did_you_mean(name, names)))
}
