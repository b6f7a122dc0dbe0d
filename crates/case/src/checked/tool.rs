//! `[[tool]]`: rigid bodies that move as they are told.

use super::field::{FieldExpression, VectorField};
use super::fill::{self, Fill};
use super::names::part_name;
use super::scope::{Scope, place_of};
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, tool as keys};
use crate::source::Place;
use crate::written::{Node, Section};

/// A rigid body.
#[derive(Debug, Clone)]
pub struct Tool {
    /// Its name.
    pub name: String,
    /// Where it is at the start.
    pub shape: ShapeSpec,
    /// How particles fill it.
    pub fill: Fill,
    /// How it moves.
    pub course: Course,
    /// How it turns; `None` if it does not.
    pub turn: Option<Turn>,
    /// Its header in the case file.
    pub place: Place,
}

/// How a tool moves: functions of time only.
#[derive(Debug, Clone)]
pub enum Course {
    /// Displacement from the start, m.
    Displacement(VectorField),
    /// Velocity, m/s.
    Velocity(VectorField),
}

/// How a tool turns.
#[derive(Debug, Clone)]
pub struct Turn {
    /// Angle, rad, a function of time only.
    pub angle: FieldExpression,
    /// A point of the axis, m.
    pub about: [f64; 3],
    /// Direction of the axis, of length 1.
    pub axis: [f64; 3],
}

/// One tool; what is wrong with it is noted.
pub(crate) fn read(
    section: &Section<'_>,
    shapes: &mut ShapeReader<'_>,
    problems: &mut Problems,
) -> Option<Tool> {
    let scope = shapes.scope;
    section.only(keys::TABLE.keys, problems);
    let name = problems.keep(part_name(section));
    let shape = problems.keep(section.need(keys::SHAPE.name).and_then(|node| shapes.shape(node)));
    let fill = problems.keep(fill::read(scope, section.get(keys::FILL.name)));
    let course = problems.keep(course(scope, section));
    let turn = problems.keep(turn(shapes, section));
    Some(Tool {
        name: name?.to_string(),
        shape: shape?,
        fill: fill?,
        course: course?,
        turn: turn?,
        place: section.place,
    })
}

fn course(scope: &Scope, section: &Section<'_>) -> Result<Course, Diagnostic> {
    match (section.get(keys::DISPLACEMENT.name), section.get(keys::VELOCITY.name)) {
        (Some(_), Some(node)) => Err(Diagnostic::at(
            node.place,
            "a tool moves in one way, found both `displacement` and `velocity`",
        )),
        (Some(node), None) => {
            let field = scope.vector_field(node, &keys::DISPLACEMENT)?;
            timely(scope.components(node, &keys::DISPLACEMENT)?, &field.components, &keys::DISPLACEMENT)?;
            Ok(Course::Displacement(field))
        }
        (None, Some(node)) => {
            let field = scope.vector_field(node, &keys::VELOCITY)?;
            timely(scope.components(node, &keys::VELOCITY)?, &field.components, &keys::VELOCITY)?;
            Ok(Course::Velocity(field))
        }
        (None, None) => Ok(Course::Displacement(VectorField::default())),
    }
}

fn turn(shapes: &ShapeReader<'_>, section: &Section<'_>) -> Result<Option<Turn>, Diagnostic> {
    let Some(node) = section.get(keys::ANGLE.name) else {
        let idle =
            [&keys::ABOUT, &keys::AXIS].into_iter().find_map(|key| Some((key, section.get(key.name)?)));
        return match idle {
            None => Ok(None),
            Some((key, node)) => Err(Diagnostic::at(
                node.place,
                format!("`{}` belongs to a turn, and this tool has no `angle`", key.name),
            )
            .help("for example angle = \"2*pi*t\"")),
        };
    };
    let angle = shapes.scope.field(node, &keys::ANGLE)?;
    timely(std::slice::from_ref(node), std::slice::from_ref(&angle), &keys::ANGLE)?;
    let about =
        section.get(keys::ABOUT.name).map(|node| shapes.scope.vector(node, &keys::ABOUT)).transpose()?;
    let upright = shapes.scope.dimension == 3 && section.get(keys::AXIS.name).is_none();
    let axis = if upright { [0.0, 0.0, 1.0] } else { shapes.axis(section)? };
    Ok(Some(Turn { angle, about: about.unwrap_or_default(), axis }))
}

/// Refuses places in what is a function of time, and values that are no numbers at the start.
fn timely(nodes: &[Node], fields: &[FieldExpression], key: &Key) -> Result<(), Diagnostic> {
    for (node, field) in nodes.iter().zip(fields) {
        if let Some(name) = field.place_variable() {
            let message = format!("`{}` of a tool depends on the time `t` only: a tool is rigid", key.name);
            return Err(Diagnostic::at(place_of(node, name), message));
        }
        if !field.eval([0.0; 3], 0.0).is_finite() {
            let message = format!("`{}` is not a number when the run starts", field.text());
            return Err(Diagnostic::at(node.place, message));
        }
    }
    Ok(())
}
