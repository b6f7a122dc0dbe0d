//! The checked case.

use std::path::Path;
use std::sync::Arc;

use output::limited::{LONGEST_TEXT, read_text};

use super::body::Body;
use super::choices::{Formulation, Kernel, Plane};
use super::contact::Contact;
use super::curves;
use super::force::Load;
use super::load::{Boundary, Gravity, Initial};
use super::material::Material;
use super::measure::Measure;
use super::mesh::MeshFile;
use super::probe::Probe;
use super::read;
use super::shape::ShapeSpec;
use super::statics::{Damping, Statics};
use super::time::{Monitor, Time};
use super::tool::Tool;
use crate::diagnostic::{CaseError, Diagnostic, render_warnings};
use crate::source::{Overrides, Place, Shelf, Sources, UsedFile};
use output::Manifest;

/// A case with everything known: numbers in SI units, names looked up, expressions compiled.
#[derive(Debug, Clone)]
pub struct Case {
    /// Short name, of `a-z`, `0-9` and `-`; also the name of the output folder.
    pub name: String,
    /// One line about it; the name if the file gives none.
    pub title: String,
    /// 2 or 3.
    pub dimension: usize,
    /// What two dimensions mean; `None` in 3D.
    pub plane: Option<Plane>,
    /// Formulation of bodies that do not name their own.
    pub formulation: Formulation,
    /// Distance of particles, m.
    pub spacing: f64,
    /// The kernel.
    pub kernel: Kernel,
    /// Whether a shear stress is integrated where motion does not need one.
    pub shear_stress: bool,
    /// Names and SI values of `[parameters]`, in the order of the file.
    pub parameters: Vec<(String, f64)>,
    /// Materials, in the order of the file.
    pub materials: Vec<Material>,
    /// Named regions, in alphabetical order.
    pub regions: Vec<(String, ShapeSpec)>,
    /// Bodies, at least one.
    pub bodies: Vec<Body>,
    /// Rigid bodies; their numbers follow those of the bodies.
    pub tools: Vec<Tool>,
    /// What the case says about who touches whom.
    pub contacts: Vec<Contact>,
    /// Prescribed motion.
    pub boundaries: Vec<Boundary>,
    /// Velocities at the start, by region.
    pub initial: Vec<Initial>,
    /// Body forces.
    pub gravity: Vec<Gravity>,
    /// Forces on particles and surfaces.
    pub loads: Vec<Load>,
    /// How long the run is.
    pub time: Time,
    /// Damping of all motion.
    pub damping: Option<Damping>,
    /// Whether equilibria are looked for, and how.
    pub quasi_static: Option<Statics>,
    /// The watch over disorder.
    pub monitor: Monitor,
    /// Recorded points.
    pub probes: Vec<Probe>,
    /// Named results.
    pub measures: Vec<Measure>,
    /// Files of triangles that shapes are made of.
    pub meshes: Vec<MeshFile>,
    /// All files that the case refers to but reference curves: with the case they make the run.
    pub files: Vec<UsedFile>,
    /// What is legal but doubtful.
    pub warnings: Vec<Diagnostic>,
    pub(super) sources: Arc<Sources>,
    pub(super) as_run: String,
}

impl Case {
    /// Reads and checks the case file at `path`.
    ///
    /// # Errors
    /// The file cannot be read, or what [`Case::parse`] refuses.
    pub fn read(path: &Path, overrides: &Overrides) -> Result<Self, CaseError> {
        let name = path.display().to_string();
        match read_text(path, LONGEST_TEXT) {
            Ok(text) => {
                let folder = path.parent().unwrap_or(Path::new("."));
                Self::parse(&name, &text, overrides)?.with_references(|file| curves::in_folder(folder, file))
            }
            Err(error) => {
                let message = format!("cannot read the case file {name}: {error}");
                Err(CaseError::new(vec![Diagnostic::nowhere(message)], Arc::new(Sources::new(&name, ""))))
            }
        }
    }

    /// Checks a case given as text; `name` is what diagnostics call the file. Its reference curves are not looked for:
    /// [`Case::with_references`].
    ///
    /// # Errors
    /// Everything that is wrong with the file or the overrides, each with its place.
    pub fn parse(name: &str, text: &str, overrides: &Overrides) -> Result<Self, CaseError> {
        read::case(Sources::new(name, text), overrides)
    }

    /// The case of a run, with the files that it kept in `results`.
    ///
    /// # Errors
    /// As [`Case::parse`]; and files that are not there any more, or not as they were.
    pub(crate) fn again(name: &str, manifest: &Manifest, results: &Path) -> Result<Self, CaseError> {
        let shelf = Shelf::Kept(results.to_path_buf(), manifest.files.clone());
        read::case(Sources::new(name, &manifest.case).with(shelf), &Overrides::default())
    }

    /// The case file after the overrides, as TOML: what has to be kept to repeat the run.
    pub fn case_text_as_run(&self) -> &str {
        &self.as_run
    }

    /// The name of a body or tool.
    pub fn name_of(&self, body: usize) -> &str {
        match self.bodies.get(body) {
            Some(body) => &body.name,
            None => self.tools.get(body - self.bodies.len()).map_or("", |tool| &tool.name),
        }
    }

    /// The material of a body.
    pub fn material_of(&self, body: &Body) -> Option<&Material> {
        self.materials.iter().find(|material| material.name == body.material)
    }

    /// An error about a place of this case, for what shows only when it is built (an empty body, a probe
    /// outside of its body).
    pub fn error_at(&self, place: Place, message: impl Into<String>, help: Option<String>) -> CaseError {
        let diagnostic = Diagnostic { help, ..Diagnostic::at(place, message) };
        CaseError::new(vec![diagnostic], Arc::clone(&self.sources))
    }

    /// Several errors at once.
    pub(super) fn errors(&self, diagnostics: Vec<Diagnostic>) -> CaseError {
        CaseError::new(diagnostics, Arc::clone(&self.sources))
    }

    /// The warnings as a person reads them, in colour when asked; the empty text when there are none.
    pub fn render_warnings(&self, colour: bool) -> String {
        render_warnings(&self.warnings, &self.sources, colour)
    }
}
