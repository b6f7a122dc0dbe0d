//! Turning what is written into numbers: plain, with a unit, or an expression of the parameters.

use super::field::{FieldExpression, VectorField};
use super::mesh::Meshes;
use crate::diagnostic::Diagnostic;
use crate::expression::{Expression, ExpressionError, Names};
use crate::keys::{Key, Kind, Range};
use crate::source::{Files, Place};
use crate::units::{Dimension, Quantity};
use crate::written::{Node, Section, Value};

/// What numbers are read with.
#[derive(Debug, Default)]
pub(crate) struct Scope {
    /// 2 or 3.
    pub dimension: usize,
    /// Names and SI values, in the order of the file.
    pub parameters: Vec<(String, f64)>,
    /// The files that the case refers to.
    pub files: Files,
    /// Those of them that are meshes.
    pub meshes: Meshes,
    /// For parameters that were given with a unit: what they are.
    pub units: Vec<(String, Quantity)>,
}

/// The variables of a field.
const PLACE_AND_TIME: [&str; 4] = ["x", "y", "z", "t"];

impl Scope {
    /// A number in SI. A quantity has to have the dimension; a plain number is taken to be in SI.
    pub(crate) fn number(&self, node: &Node, what: &str, dimension: Dimension) -> Result<f64, Diagnostic> {
        let number = self.expression(node, what, dimension, &[])?.eval(&[]);
        if number.is_finite() {
            Ok(number)
        } else {
            Err(Diagnostic::at(node.place, format!("{what} is {number}, expected a finite number")))
        }
    }

    /// The number of a key, within its range.
    pub(crate) fn of(&self, node: &Node, key: &Key) -> Result<f64, Diagnostic> {
        let Kind::Number(dimension, range) = key.kind else { return Err(mistyped(node, key)) };
        let number = self.number(node, &key.quoted(), dimension)?;
        let wrong = |what: &str| Diagnostic::at(node.place, format!("`{}` {what}, found {number}", key.name));
        match range {
            Range::Positive | Range::Share | Range::Smoothing if number <= 0.0 => {
                Err(wrong("has to be positive").label("expected a number > 0"))
            }
            Range::Share if number > 1.0 => Err(wrong("has to lie in (0, 1]")),
            Range::Smoothing if number < 0.6 => Err(wrong("has to be at least 0.6")
                .help("with less hardly any particle has neighbours; 1.15 and 1.3 are usual")),
            Range::Smoothing if number > 4.0 => Err(wrong("has to be at most 4")
                .help("with more every particle has thousands of neighbours; 1.15 and 1.3 are usual")),
            Range::NotNegative if number < 0.0 => Err(wrong("must not be negative")),
            _ => Ok(number),
        }
    }

    /// The number of a key that has to be there.
    pub(crate) fn need(&self, section: &Section<'_>, key: &Key) -> Result<f64, Diagnostic> {
        section.need(key.name).and_then(|node| self.of(node, key))
    }

    /// The number of a key that need not be there.
    pub(crate) fn get(&self, section: &Section<'_>, key: &Key) -> Result<Option<f64>, Diagnostic> {
        section.get(key.name).map(|node| self.of(node, key)).transpose()
    }

    /// A number greater than zero.
    pub(crate) fn positive(&self, node: &Node, what: &str, dimension: Dimension) -> Result<f64, Diagnostic> {
        let number = self.number(node, what, dimension)?;
        if number > 0.0 {
            Ok(number)
        } else {
            Err(Diagnostic::at(node.place, format!("{what} has to be positive, found {number}"))
                .label("expected a number > 0"))
        }
    }

    /// One number per axis; the third is 0 in 2D.
    pub(crate) fn vector(&self, node: &Node, key: &Key) -> Result<[f64; 3], Diagnostic> {
        let Some(dimension) = key.kind.dimension() else { return Err(mistyped(node, key)) };
        let mut vector = [0.0; 3];
        for (i, item) in self.components(node, key)?.iter().enumerate() {
            vector[i] = self.number(item, &key.quoted(), dimension)?;
        }
        Ok(vector)
    }

    /// A list with one entry per axis.
    pub(crate) fn components<'a>(&self, node: &'a Node, key: &Key) -> Result<&'a [Node], Diagnostic> {
        let (wanted, what) = (self.dimension, key.quoted());
        match &node.value {
            Value::Array(items) if items.len() == wanted => Ok(items),
            _ => Err(Diagnostic::at(
                node.place,
                format!("{what} has to be a list of {wanted} (dimension = {wanted}), found {}", node.found()),
            )
            .label(format!("expected {wanted} entries"))),
        }
    }

    /// A function of place and time.
    pub(crate) fn field(&self, node: &Node, key: &Key) -> Result<FieldExpression, Diagnostic> {
        let Some(dimension) = key.kind.dimension() else { return Err(mistyped(node, key)) };
        let what = key.quoted();
        let expression = self.expression(node, &what, dimension, &PLACE_AND_TIME)?;
        if self.dimension == 2 && expression.uses(2) {
            return Err(Diagnostic::at(
                place_of(node, "z"),
                format!("{what} uses `z`, which a 2D case does not have"),
            ));
        }
        match expression.as_constant() {
            Some(value) if !value.is_finite() => {
                Err(Diagnostic::at(node.place, format!("{what} is {value}, expected a finite number")))
            }
            _ => Ok(FieldExpression::new(expression)),
        }
    }

    /// A function of place and time per axis; the third is 0 in 2D.
    pub(crate) fn vector_field(&self, node: &Node, key: &Key) -> Result<VectorField, Diagnostic> {
        let mut field = VectorField::default();
        for (i, item) in self.components(node, key)?.iter().enumerate() {
            field.components[i] = self.field(item, key)?;
        }
        Ok(field)
    }

    /// A number, a quantity, or an expression of the parameters and `variables`.
    fn expression(
        &self,
        node: &Node,
        what: &str,
        dimension: Dimension,
        variables: &[&str],
    ) -> Result<Expression, Diagnostic> {
        let text = match &node.value {
            Value::Integer(number) => return Ok(Expression::constant(*number as f64)),
            Value::Number(number) => return Ok(Expression::constant(*number)),
            Value::Text(text) => text,
            _ => {
                return Err(Diagnostic::at(
                    node.place,
                    format!("{what} has to be a number, found {}", node.found()),
                )
                .label("expected a number, a quantity or an expression")
                .help("for example 0.02, \"20 mm\" or \"2*L\""));
            }
        };
        if let Some(quantity) = self.quantity(node, text)? {
            check_dimension(node, what, &quantity, dimension)?;
            return Ok(Expression::constant(quantity.value));
        }
        let names = Names { variables, constants: &self.parameters };
        Expression::parse(text, &names).map_err(|error| expression_diagnostic(node, error))
    }

    /// A quantity: "17 MPa", or the name of a parameter that was given with a unit.
    fn quantity(&self, node: &Node, text: &str) -> Result<Option<Quantity>, Diagnostic> {
        match read_quantity(node, text)? {
            Some(quantity) => Ok(Some(quantity)),
            None => Ok(self.units.iter().find(|(name, _)| name == text.trim()).map(|(_, q)| q.clone())),
        }
    }
}

/// A key that is read as what it is not.
fn mistyped(node: &Node, key: &Key) -> Diagnostic {
    Diagnostic::at(node.place, format!("`{}` is read in a wrong way; please report this", key.name))
}

/// The quantity that a text is, if it has the form of one.
pub(crate) fn read_quantity(node: &Node, text: &str) -> Result<Option<Quantity>, Diagnostic> {
    Quantity::parse(text).transpose().map_err(|error| {
        let place = node.content.map_or(node.place, |content| node.place.part(content, &error.span));
        Diagnostic::at(place, error.message).help(error.hint)
    })
}

/// Where an expression names something, if it stands there without escapes; else the whole text.
pub(crate) fn place_of(node: &Node, name: &str) -> Place {
    let (Some(content), Value::Text(text)) = (node.content, &node.value) else { return node.place };
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let alone = |&(at, _): &(usize, &str)| {
        !text[..at].ends_with(is_letter) && !text[at + name.len()..].starts_with(is_letter)
    };
    let found = text.match_indices(name).find(alone);
    found.map_or(node.place, |(at, _)| node.place.part(content, &(at..at + name.len())))
}

/// Points at the part of the text that an expression's error is about.
pub(crate) fn expression_diagnostic(node: &Node, error: ExpressionError) -> Diagnostic {
    let place = node.content.map_or(node.place, |content| node.place.part(content, &error.span));
    let diagnostic = Diagnostic::at(place, error.message);
    match error.hint {
        Some(hint) => diagnostic.help(hint),
        None => diagnostic,
    }
}

fn check_dimension(node: &Node, what: &str, found: &Quantity, expected: Dimension) -> Result<(), Diagnostic> {
    if found.dimension == expected {
        return Ok(());
    }
    let found = format!("{} ({})", found.dimension.name(), found.unit);
    Err(Diagnostic::at(node.place, format!("{what}: expected {expected}, found {found}"))
        .label(format!("this is {found}")))
}
