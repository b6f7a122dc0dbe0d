//! `[[body]]`.

use super::field::VectorField;
use super::load::start_velocity;
use super::names::{find, part_name};
use super::scheme::{Scheme, Schemes, read_formulation};
use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, body as keys, fill};
use crate::source::Place;
use crate::written::{Node, Section, Value};

/// A deformable body.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// The name of its material.
    pub material: String,
    /// Where it is.
    pub shape: ShapeSpec,
    /// How particles fill it.
    pub fill: Fill,
    /// Velocity at the start, m/s, a function of the reference position only.
    pub velocity: VectorField,
    /// How it is solved.
    pub scheme: Scheme,
    /// Its header in the case file.
    pub place: Place,
}

/// How particles fill a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fill {
    /// A square lattice: particles in the middle of cells, of which one has a corner at `origin` (m).
    Lattice {
        /// The corner.
        origin: [f64; 3],
    },
    /// Layers around the centre of a ring or ball.
    Concentric,
    /// Layers with as many particles each.
    Polar {
        /// How many.
        around: u32,
        /// How many layers; `None` for the wall over the spacing.
        rings: Option<u32>,
    },
}

/// The filling that a node describes; a lattice from the origin if there is none.
pub(crate) fn read_fill(scope: &Scope, node: Option<&Node>) -> Result<Fill, Diagnostic> {
    let Some(node) = node else { return Ok(Fill::Lattice { origin: [0.0; 3] }) };
    match &node.value {
        Value::Text(name) if name == fill::LATTICE => Ok(Fill::Lattice { origin: [0.0; 3] }),
        Value::Text(name) if name == fill::CONCENTRIC => Ok(Fill::Concentric),
        Value::Table(_) => {
            let table = Section::of(node, "`fill`")?;
            table.only_first(&[fill::LATTICE, fill::POLAR])?;
            if let Some(node) = table.get(fill::POLAR) {
                return polar(scope, &Section::of(node, "the fill `polar`")?);
            }
            let lattice = Section::of(table.need(fill::LATTICE)?, "the fill `lattice`")?;
            lattice.only_first(&[fill::ORIGIN.name])?;
            let origin = scope.vector(lattice.need(fill::ORIGIN.name)?, &fill::ORIGIN)?;
            Ok(Fill::Lattice { origin })
        }
        _ => Err(Diagnostic::at(node.place, format!("unknown fill, found {}", node.found()))
            .help("write \"lattice\", \"concentric\", { lattice = { origin = [..] } } or { polar = { around = 36 } }")),
    }
}

/// As many particles in each layer: whole numbers, or expressions that give them.
fn polar(scope: &Scope, section: &Section<'_>) -> Result<Fill, Diagnostic> {
    section.only_first(&[fill::AROUND.name, fill::RINGS.name])?;
    let around = whole(scope, section.need(fill::AROUND.name)?, (&fill::AROUND, 3))?;
    let rings =
        section.get(fill::RINGS.name).map(|node| whole(scope, node, (&fill::RINGS, 1))).transpose()?;
    Ok(Fill::Polar { around, rings })
}

fn whole(scope: &Scope, node: &Node, (key, least): (&Key, u32)) -> Result<u32, Diagnostic> {
    let number = scope.of(node, key)?;
    if number.fract() == 0.0 && (f64::from(least)..=1e6).contains(&number) {
        return Ok(number as u32);
    }
    let message =
        format!("`{}` has to be a whole number from {least} to a million, found {number}", key.name);
    Err(Diagnostic::at(node.place, message))
}

/// What bodies are read with.
pub(crate) struct BodyReader<'a, 'b> {
    pub scope: &'a Scope,
    pub shapes: &'b mut ShapeReader<'a>,
    pub schemes: &'b Schemes,
    /// Names of all materials of the case, also of wrong ones.
    pub materials: &'b [Option<&'a str>],
}

impl BodyReader<'_, '_> {
    /// One body; what is wrong with it is noted.
    pub(crate) fn read(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Body> {
        section.only(keys::TABLE.keys, problems);
        let name = problems.keep(part_name(section));
        let material = problems.keep(self.material(section));
        let shape = problems.keep(section.need(keys::SHAPE.name).and_then(|node| self.shapes.shape(node)));
        let fill = problems.keep(read_fill(self.scope, section.get(keys::FILL.name)));
        let velocity = problems.keep(self.velocity(section.get(keys::VELOCITY.name)));
        let smoothing = problems.keep(self.scope.get(section, &keys::SMOOTHING));
        let own = problems.keep(section.get(keys::FORMULATION.name).map(read_formulation).transpose())?;
        Some(Body {
            name: name?.to_string(),
            material: material?,
            shape: shape?,
            fill: fill?,
            velocity: velocity?,
            scheme: match smoothing? {
                Some(smoothing) => Scheme { smoothing, ..self.schemes.of(own) },
                None => self.schemes.of(own),
            },
            place: section.place,
        })
    }

    fn material(&self, section: &Section<'_>) -> Result<String, Diagnostic> {
        let at = find(section.need(keys::MATERIAL.name)?, "material", self.materials)?;
        Ok(self.materials[at].unwrap_or_default().to_string())
    }

    fn velocity(&self, node: Option<&Node>) -> Result<VectorField, Diagnostic> {
        node.map_or_else(
            || Ok(VectorField::default()),
            |node| start_velocity(self.scope, node, &keys::VELOCITY),
        )
    }
}
