//! `[[boundary]]` and `[[gravity]]`: what is imposed on bodies.

use super::choices::Axis;
use super::field::{FieldExpression, VectorField};
use super::names::{find, part_name};
use super::scope::{Scope, place_of};
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, Words, boundary, gravity, initial};
use crate::source::Place;
use crate::written::{Node, Section, Value, choice};

/// Particles whose motion is prescribed.
#[derive(Debug, Clone)]
pub struct Boundary {
    /// Its name; a number if the file gives none.
    pub name: String,
    /// Number of the body; `None` for all.
    pub body: Option<usize>,
    /// Particles whose reference position is in here ...
    pub region: ShapeSpec,
    /// ... and not in here.
    pub except: Option<ShapeSpec>,
    /// What is prescribed.
    pub constraint: Constraint,
    /// Its header in the case file.
    pub place: Place,
}

/// What a boundary prescribes, per axis; the third has no meaning in 2D.
#[derive(Debug, Clone)]
pub enum Constraint {
    /// Nothing moves.
    Fixed,
    /// Nothing moves along the axes that are true.
    Fix([bool; 3]),
    /// Velocity, m/s; `None` leaves an axis free.
    Velocity([Option<FieldExpression>; 3]),
    /// Displacement from the reference position, m; `None` leaves an axis free.
    Displacement([Option<FieldExpression>; 3]),
}

impl Constraint {
    /// The axes along which it prescribes something.
    #[must_use]
    pub fn axes(&self) -> [bool; 3] {
        match self {
            Self::Fixed => [true; 3],
            Self::Fix(axes) => *axes,
            Self::Velocity(fields) | Self::Displacement(fields) => {
                std::array::from_fn(|i| fields[i].is_some())
            }
        }
    }

    /// Whether what it holds moves.
    #[must_use]
    pub fn is_led(&self) -> bool {
        matches!(self, Self::Velocity(_) | Self::Displacement(_))
    }
}

/// A velocity at the start in a region; it replaces that of the body.
#[derive(Debug, Clone)]
pub struct Initial {
    /// Velocity, m/s, a function of the reference position only.
    pub velocity: VectorField,
    /// Number of the body; `None` for all.
    pub body: Option<usize>,
    /// Particles whose reference position is in here.
    pub region: ShapeSpec,
    /// Its header in the case file.
    pub place: Place,
}

/// A body force.
#[derive(Debug, Clone)]
pub struct Gravity {
    /// Force per mass, m/s^2.
    pub acceleration: VectorField,
    /// Number of the body; `None` for all.
    pub body: Option<usize>,
    /// Particles whose reference position is in here; `None` for all.
    pub region: Option<ShapeSpec>,
    /// Its header in the case file.
    pub place: Place,
}

/// What loads are read with.
pub(crate) struct LoadReader<'a, 'b> {
    pub scope: &'a Scope,
    pub shapes: &'b mut ShapeReader<'a>,
    /// Names of all bodies of the case, also of wrong ones.
    pub bodies: &'b [Option<&'a str>],
    /// Boundaries so far.
    pub boundaries: usize,
}

impl LoadReader<'_, '_> {
    /// One boundary.
    pub(crate) fn boundary(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Boundary> {
        self.boundaries += 1;
        section.only(boundary::TABLE.keys, problems);
        let name = section.get(boundary::NAME.name).map(|_| part_name(section)).transpose();
        let name = problems.keep(name);
        let body = problems.keep(self.body(section));
        let region =
            problems.keep(section.need(boundary::REGION.name).and_then(|node| self.shapes.shape(node)));
        let except = problems.keep(self.shape(section, boundary::EXCEPT.name));
        let constraint = problems.keep(self.constraint(section));
        let place = section.place;
        Some(Boundary {
            name: name?.map_or_else(|| format!("boundary-{}", self.boundaries), str::to_string),
            body: body?,
            region: region?,
            except: except?,
            constraint: constraint?,
            place,
        })
    }

    /// One body force.
    pub(crate) fn gravity(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Gravity> {
        section.only(gravity::TABLE.keys, problems);
        let body = problems.keep(self.body(section));
        let region = problems.keep(self.shape(section, gravity::REGION.name));
        let acceleration = problems.keep(
            section
                .need(gravity::ACCELERATION.name)
                .and_then(|node| self.scope.vector_field(node, &gravity::ACCELERATION)),
        );
        Some(Gravity { acceleration: acceleration?, body: body?, region: region?, place: section.place })
    }

    /// One velocity at the start.
    pub(crate) fn initial(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Initial> {
        section.only(initial::TABLE.keys, problems);
        let body = problems.keep(self.body(section));
        let region =
            problems.keep(section.need(initial::REGION.name).and_then(|node| self.shapes.shape(node)));
        let velocity = section.need(initial::VELOCITY.name);
        let velocity =
            problems.keep(velocity.and_then(|n| start_velocity(self.scope, n, &initial::VELOCITY)));
        Some(Initial { velocity: velocity?, body: body?, region: region?, place: section.place })
    }

    pub(super) fn body(&self, section: &Section<'_>) -> Result<Option<usize>, Diagnostic> {
        section.get("body").map(|node| find(node, "body", self.bodies)).transpose()
    }

    fn shape(&mut self, section: &Section<'_>, key: &str) -> Result<Option<ShapeSpec>, Diagnostic> {
        section.get(key).map(|node| self.shapes.shape(node)).transpose()
    }

    fn constraint(&self, section: &Section<'_>) -> Result<Constraint, Diagnostic> {
        let given: Vec<(&str, &Node)> =
            boundary::CONSTRAINTS.iter().filter_map(|key| Some((key.name, section.get(key.name)?))).collect();
        match given.as_slice() {
            [("fixed", node)] => fixed(node),
            [("fix", node)] => self.fix(node),
            [("velocity", node)] => Ok(Constraint::Velocity(self.per_axis(node, &boundary::CONSTRAINTS[2])?)),
            [(_, node)] => Ok(Constraint::Displacement(self.per_axis(node, &boundary::CONSTRAINTS[3])?)),
            _ => Err(wrong_count(section, &given)),
        }
    }

    /// The axes that a list names.
    fn fix(&self, node: &Node) -> Result<Constraint, Diagnostic> {
        let axes = &Axis::WORDS[..self.scope.dimension];
        let mut fixed = [false; 3];
        match &node.value {
            Value::Array(items) if !items.is_empty() => {
                for item in items {
                    fixed[choice(item, "axis", axes)?.index()] = true;
                }
                Ok(Constraint::Fix(fixed))
            }
            _ => Err(Diagnostic::at(
                node.place,
                format!("`fix` has to be a list of axes, found {}", node.found()),
            )
            .help("for example fix = [\"y\"]; fixed = true holds all axes")),
        }
    }

    /// An expression or "free" per axis.
    fn per_axis(&self, node: &Node, key: &Key) -> Result<[Option<FieldExpression>; 3], Diagnostic> {
        let mut fields = [None, None, None];
        for (i, item) in self.scope.components(node, key)?.iter().enumerate() {
            if !matches!(&item.value, Value::Text(text) if text == "free") {
                fields[i] = Some(self.scope.field(item, key)?);
            }
        }
        if fields.iter().all(Option::is_none) {
            return Err(Diagnostic::at(
                node.place,
                format!("`{}` leaves every axis free, so it prescribes nothing", key.name),
            ));
        }
        Ok(fields)
    }
}

/// A velocity that belongs to the start, so that it cannot use `t`.
pub(crate) fn start_velocity(scope: &Scope, node: &Node, key: &Key) -> Result<VectorField, Diagnostic> {
    let velocity = scope.vector_field(node, key)?;
    if let Some(axis) = velocity.components.iter().position(|c| c.depends_on_time()) {
        let component = &scope.components(node, key)?[axis];
        return Err(Diagnostic::at(
            place_of(component, "t"),
            "this velocity is that of the start, it cannot use `t`",
        )
        .help("prescribe a velocity that changes with time in a [[boundary]]"));
    }
    Ok(velocity)
}

fn fixed(node: &Node) -> Result<Constraint, Diagnostic> {
    match node.value {
        Value::Bool(true) => Ok(Constraint::Fixed),
        Value::Bool(false) => {
            Err(Diagnostic::at(node.place, "`fixed = false` prescribes nothing").help("remove this boundary"))
        }
        _ => Err(Diagnostic::at(node.place, format!("`fixed` has to be `true`, found {}", node.found()))),
    }
}

fn wrong_count(section: &Section<'_>, given: &[(&str, &Node)]) -> Diagnostic {
    let names: Vec<&str> = given.iter().map(|(name, _)| *name).collect();
    let (place, found) = match given.last() {
        None => (section.place, "none".to_string()),
        Some((_, node)) => (node.place, names.join(", ")),
    };
    Diagnostic::at(place, format!("a boundary prescribes exactly one thing, found {found}"))
        .help("give one of fixed = true, fix = [\"z\"], velocity = [..], displacement = [..]")
}
