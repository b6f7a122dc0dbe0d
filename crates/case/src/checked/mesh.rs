//! Shapes whose surface is a file of triangles.

use std::cell::RefCell;

use super::scope::Scope;
use super::shape::ShapeSpec;
use crate::diagnostic::Diagnostic;
use crate::keys::{Words, shape};
use crate::source::Place;
use crate::written::{Section, choice, text};
use geometry::{Mesh, MeshFormat};

/// Larger mesh files are not read, bytes: the most triangles that are taken on, as text.
pub(crate) const LARGEST_MESH: u64 = 2 << 30;

/// A mesh file, as it was read and mended.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFile {
    /// Its path, as the case says it: relative to the case file.
    pub file: String,
    /// What kind of file it is.
    pub format: MeshFormat,
    /// The unit of its coordinates, m.
    pub(super) unit: f64,
    /// The body, in metres.
    pub mesh: Mesh,
}

/// A unit of length, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeshUnit(f64);

impl Words for MeshUnit {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("m", Self(1.0), "metres"),
        ("cm", Self(1e-2), "centimetres"),
        ("mm", Self(1e-3), "millimetres"),
        ("um", Self(1e-6), "micrometres"),
        ("in", Self(0.0254), "inches"),
        ("ft", Self(0.3048), "feet"),
    ];
}

/// The meshes of a case, each read once, and what is doubtful about them.
#[derive(Debug, Default)]
pub(crate) struct Meshes {
    read: RefCell<Vec<MeshFile>>,
    doubts: RefCell<Vec<Diagnostic>>,
}

impl Meshes {
    /// All that were read.
    pub(crate) fn all(&self) -> Vec<MeshFile> {
        self.read.borrow().clone()
    }

    /// What is doubtful about them.
    pub(crate) fn doubts(&self) -> Vec<Diagnostic> {
        self.doubts.borrow().clone()
    }

    /// The mesh of a file, from before or now.
    fn get(&self, scope: &Scope, (name, place): (&str, Place), unit: f64) -> Result<Mesh, Diagnostic> {
        let known = |read: &&MeshFile| read.file == name && read.unit == unit;
        if let Some(read) = self.read.borrow().iter().find(known) {
            return Ok(read.mesh.clone());
        }
        let wrong = |message: String| Diagnostic::at(place, message);
        let bytes = scope.files.read(name, LARGEST_MESH).map_err(|reason| {
            wrong(format!("cannot read the mesh {}: {reason}", scope.files.path(name).display()))
                .help("its path is relative to the case file")
        })?;
        let (mesh, format) = Mesh::read(&bytes, name, unit)
            .map_err(|error| wrong(format!("the mesh {name} cannot be used: {error}")))?;
        let doubts =
            mesh.report().doubts("m").into_iter().map(|doubt| wrong(format!("the mesh {name}: {doubt}")));
        self.doubts.borrow_mut().extend(doubts);
        let read = MeshFile { file: name.to_string(), format, unit, mesh: mesh.clone() };
        self.read.borrow_mut().push(read);
        Ok(mesh)
    }
}

/// The shape that a file of triangles encloses.
pub(super) fn mesh(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("mesh"))?;
    let node = section.need(shape::FILE.name)?;
    let name = text(node, &shape::FILE.quoted())?;
    let unit = section
        .need(shape::UNIT.name)
        .map_err(|missing| missing.help("mesh files do not say their unit; most are in \"mm\""))?;
    let MeshUnit(unit) = choice(unit, shape::UNIT.name, MeshUnit::WORDS)?;
    let mesh = scope.meshes.get(scope, (name, node.place), unit)?;
    Ok(ShapeSpec::Mesh { file: name.to_string(), mesh })
}
