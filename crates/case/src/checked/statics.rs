//! `[damping]` and `[quasi_static]`.

use super::body::Body;
use super::choices::Family;
use super::defaults;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, damping, quasi_static};
use crate::written::{Section, Table, Value};

/// Damping of all motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// By the splitting random-choice method.
    Splitting {
        /// Viscosity, Pa s; `None` for sqrt(rho E) L / 4 of each body.
        viscosity: Option<f64>,
        /// Share of the steps in which it acts.
        probability: f64,
        /// Which random choice.
        seed: u64,
    },
    /// By a force against the velocity.
    Viscous {
        /// Over the momentum, 1/s.
        rate: f64,
    },
}

/// Loads in increments, each held until the bodies are at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statics {
    /// How many increments.
    pub increments: u32,
    /// What counts as equilibrium.
    pub tolerance: f64,
    /// Most steps that an increment is held.
    pub max_steps: u64,
}

/// Both tables, if they are there.
pub(crate) fn read(
    root: &Table,
    scope: &Scope,
    (bodies, problems): (&[Body], &mut Problems),
) -> (Option<Damping>, Option<Statics>) {
    let damping = section(root, damping::TABLE.header, bodies, problems).and_then(|section| {
        section.only(damping::TABLE.keys, problems);
        if let Some(node) = section.get(damping::RATE.name) {
            for other in [damping::VISCOSITY, damping::PROBABILITY, damping::SEED] {
                if let Some(other) = section.get(other.name) {
                    let message = "`rate` is another damping than that of viscosity, probability and seed";
                    problems.0.push(Diagnostic::at(other.place, message).help("give one of the two"));
                }
            }
            let rate = problems.keep(scope.of(node, &damping::RATE))?;
            return Some(Damping::Viscous { rate });
        }
        let viscosity = problems.keep(scope.get(&section, &damping::VISCOSITY));
        let probability = problems.keep(scope.get(&section, &damping::PROBABILITY));
        let seed = problems.keep(count(&section, &damping::SEED, u64::MAX));
        let (probability, seed) =
            (probability?.unwrap_or(defaults::PROBABILITY), seed?.unwrap_or(defaults::SEED));
        Some(Damping::Splitting { viscosity: viscosity?, probability, seed })
    });
    let statics = section(root, quasi_static::TABLE.header, bodies, problems).and_then(|section| {
        section.only(quasi_static::TABLE.keys, problems);
        let increments = problems.keep(count(&section, &quasi_static::INCREMENTS, u32::MAX.into()));
        let tolerance = problems.keep(scope.get(&section, &quasi_static::TOLERANCE));
        let max_steps = problems.keep(count(&section, &quasi_static::MAX_STEPS, u64::MAX));
        Some(Statics {
            increments: increments?.unwrap_or(defaults::INCREMENTS) as u32,
            tolerance: tolerance?.unwrap_or(defaults::TOLERANCE),
            max_steps: max_steps?.unwrap_or(defaults::MAX_STEPS),
        })
    });
    (damping, statics)
}

/// The section of a table that only total Lagrangian bodies can have.
fn section<'a>(
    root: &'a Table,
    header: &'static str,
    bodies: &[Body],
    problems: &mut Problems,
) -> Option<Section<'a>> {
    let section = problems.keep(Section::of(root.get(header.trim_matches(['[', ']']))?, header))?;
    if let Some(body) = bodies.iter().find(|body| body.scheme.formulation.family() != Family::Total) {
        let formulation = body.scheme.formulation.name();
        let message =
            format!("`{header}` is for total Lagrangian bodies, and `{}` uses {formulation}", body.name);
        problems.0.push(Diagnostic::at(section.place, message).help("remove it, or use tl-hourglass-free"));
    }
    Some(section)
}

/// A whole number from 1 to `most`.
fn count(section: &Section<'_>, key: &Key, most: u64) -> Result<Option<u64>, Diagnostic> {
    let Some(node) = section.get(key.name) else { return Ok(None) };
    let number = match node.value {
        Value::Integer(number) => u64::try_from(number).ok().filter(|n| (1..=most).contains(n)),
        _ => None,
    };
    number.map(Some).ok_or_else(|| {
        let message = format!("`{}` has to be a whole number from 1 on, found {}", key.name, node.found());
        Diagnostic::at(node.place, message)
    })
}
