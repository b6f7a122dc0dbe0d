//! `[[body]]`.

use super::field::VectorField;
use super::load::start_velocity;
use super::names::{find, part_name};
use super::scheme::{Scheme, Schemes, read_formulation};
use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::source::Place;
use crate::units::Dimension;
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
        section.only(&["name", "material", "shape", "fill", "velocity", "formulation"], problems);
        let name = problems.keep(part_name(section));
        let material = problems.keep(self.material(section));
        let shape = problems.keep(section.need("shape").and_then(|node| self.shapes.shape(node)));
        let fill = problems.keep(self.fill(section.get("fill")));
        let velocity = problems.keep(self.velocity(section.get("velocity")));
        let own = problems.keep(section.get("formulation").map(read_formulation).transpose())?;
        Some(Body {
            name: name?.to_string(),
            material: material?,
            shape: shape?,
            fill: fill?,
            velocity: velocity?,
            scheme: self.schemes.of(own),
            place: section.place,
        })
    }

    fn material(&self, section: &Section<'_>) -> Result<String, Diagnostic> {
        let at = find(section.need("material")?, "material", self.materials)?;
        Ok(self.materials[at].unwrap_or_default().to_string())
    }

    fn fill(&self, node: Option<&Node>) -> Result<Fill, Diagnostic> {
        let Some(node) = node else { return Ok(Fill::Lattice { origin: [0.0; 3] }) };
        match &node.value {
            Value::Text(name) if name == "lattice" => Ok(Fill::Lattice { origin: [0.0; 3] }),
            Value::Text(name) if name == "concentric" => Ok(Fill::Concentric),
            Value::Table(_) => {
                let fill = Section::of(node, "`fill`")?;
                fill.only_first(&["lattice"])?;
                let lattice = Section::of(fill.need("lattice")?, "the fill `lattice`")?;
                lattice.only_first(&["origin"])?;
                let origin = self.scope.vector(lattice.need("origin")?, "`origin`", Dimension::LENGTH)?;
                Ok(Fill::Lattice { origin })
            }
            _ => Err(Diagnostic::at(node.place, format!("unknown fill, found {}", node.found()))
                .help("write \"lattice\", \"concentric\" or { lattice = { origin = [..] } }")),
        }
    }

    fn velocity(&self, node: Option<&Node>) -> Result<VectorField, Diagnostic> {
        node.map_or_else(|| Ok(VectorField::default()), |node| start_velocity(self.scope, node))
    }
}
