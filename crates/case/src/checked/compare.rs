//! Measures of whole fields at the end of a run, held against formulas.

use super::field::{FieldExpression, VectorField};
use super::measure::{MeasureReader, Measured};
use super::names::find;
use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::Diagnostic;
use crate::keys::{Words, measure as keys};
use crate::written::{Node, Section, Value, choice};

/// A field at the end of a run, over some of the particles.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// What is made of it.
    pub statistic: Statistic,
    /// The field, and what it should be; `None` if it is not compared.
    pub field: Compared,
    /// Number of the body; `None` for all.
    pub body: Option<usize>,
    /// Particles whose reference position is in here; `None` for all.
    pub region: Option<ShapeSpec>,
    /// Whether a translation and a small turn, those that fit best, are taken out of the displacements before.
    pub aligned: bool,
}

/// What is made of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// The largest difference over the largest expected value.
    ErrorMax,
    /// The root mean square of the difference over the largest expected value.
    ErrorRms,
    /// The mean over the expected mean.
    Ratio,
    /// The largest value.
    Largest,
}

/// A field, and what it should be.
#[derive(Debug, Clone)]
pub enum Compared {
    /// Displacement, m.
    Displacement(Option<VectorField>),
    /// Von Mises stress, Pa.
    VonMises(Option<FieldExpression>),
}

/// Fields whose largest value can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Seen {
    Displacement,
    VonMises,
}

impl Words for Seen {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("displacement", Self::Displacement, "present minus reference position, m"),
        ("von-mises", Self::VonMises, "von Mises stress, Pa"),
    ];
}

impl MeasureReader<'_> {
    /// The comparison that a section describes.
    pub(super) fn comparison(
        &self,
        kind: Measured,
        section: &Section<'_>,
        shapes: &mut ShapeReader<'_>,
    ) -> Result<Comparison, Diagnostic> {
        let statistic = match kind {
            Measured::ErrorMax => Statistic::ErrorMax,
            Measured::ErrorRms => Statistic::ErrorRms,
            Measured::Ratio => Statistic::Ratio,
            _ => Statistic::Largest,
        };
        let field = match statistic {
            Statistic::Largest => {
                match choice(section.need(keys::FIELD.name)?, keys::FIELD.name, Seen::WORDS)? {
                    Seen::Displacement => Compared::Displacement(None),
                    Seen::VonMises => Compared::VonMises(None),
                }
            }
            _ => compared(self.scope, section)?,
        };
        let body = section.get(keys::BODY.name).map(|node| find(node, keys::BODY.name, self.bodies));
        let region = section.get(keys::REGION.name).map(|node| shapes.shape(node));
        let aligned = section.get(keys::ALIGNED.name).map(flag).transpose()?.unwrap_or(false);
        Ok(Comparison { statistic, field, body: body.transpose()?, region: region.transpose()?, aligned })
    }
}

fn compared(scope: &Scope, section: &Section<'_>) -> Result<Compared, Diagnostic> {
    match (section.get(keys::DISPLACEMENT.name), section.get(keys::VON_MISES.name)) {
        (Some(node), None) => {
            Ok(Compared::Displacement(Some(scope.vector_field(node, &keys::DISPLACEMENT)?)))
        }
        (None, Some(node)) => Ok(Compared::VonMises(Some(scope.field(node, &keys::VON_MISES)?))),
        (other, _) => {
            let place = other.map_or(section.place, |node| node.place);
            let message = "a field is compared with exactly one of `displacement` and `von_mises`";
            Err(Diagnostic::at(place, message).help("for example von_mises = \"abs(k*y)\""))
        }
    }
}

fn flag(node: &Node) -> Result<bool, Diagnostic> {
    match node.value {
        Value::Bool(flag) => Ok(flag),
        _ => {
            let message = format!("`aligned` has to be `true` or `false`, found {}", node.found());
            Err(Diagnostic::at(node.place, message))
        }
    }
}
