//! `[[body]]`.

use super::field::VectorField;
use super::fill::{self, Fill};
use super::load::start_velocity;
use super::names::{find, part_name};
use super::scheme::{Scheme, Schemes, read_formulation};
use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::body as keys;
use crate::source::Place;
use crate::written::{Node, Section};

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
        let fill = problems.keep(fill::read(self.scope, section.get(keys::FILL.name)));
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
