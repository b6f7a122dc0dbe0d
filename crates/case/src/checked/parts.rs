//! The parts of a case, each with what it refers to.

use super::body::{Body, BodyReader};
use super::choices::{Formulation, Plane};
use super::compatible;
use super::contact::{self, Contact};
use super::force::Load;
use super::load::{Boundary, Gravity, Initial, LoadReader};
use super::material::{self, Material};
use super::measure::{Measure, MeasureReader};
use super::names::part_names;
use super::plausible;
use super::probe::{Probe, ProbeReader};
use super::scheme::Schemes;
use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use super::tool::{self, Tool};
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::case;
use crate::source::Place;
use crate::written::{Section, Table, Value, list};

/// All parts that are right.
pub(super) struct Parts {
    pub formulation: Formulation,
    pub materials: Vec<Material>,
    pub regions: Vec<(String, ShapeSpec)>,
    pub bodies: Vec<Body>,
    pub tools: Vec<Tool>,
    pub contacts: Vec<Contact>,
    pub boundaries: Vec<Boundary>,
    pub initial: Vec<Initial>,
    pub gravity: Vec<Gravity>,
    pub loads: Vec<Load>,
    pub probes: Vec<Probe>,
    pub measures: Vec<Measure>,
    pub shear_stress: bool,
}

impl Parts {
    /// What is legal but doubtful.
    pub(super) fn warnings(&self, root: &Table, plane: Option<Plane>) -> Vec<Diagnostic> {
        let mut warnings = plausible::materials(root, &self.materials);
        warnings.extend(plausible::angles(root));
        warnings.extend(compatible::warnings(&self.bodies, &self.materials, plane));
        let stepping = root.get(case::STEPPING.name);
        warnings.extend(stepping.and_then(|node| compatible::frozen(&self.bodies, node.place)));
        warnings
    }
}

/// Reads all parts; what is wrong is noted.
pub(super) fn parts(root: &Table, scope: &Scope, problems: &mut Problems) -> Parts {
    let schemes = Schemes::read(root, scope, problems);
    let materials = material::read(root, scope, problems);
    let mut shapes = ShapeReader::new(scope, root, problems);
    let regions = shapes.all_regions(problems);
    let (body_sections, body_names) = named_list(root, "body", problems);
    let bodies = bodies(root, &body_sections, (&mut shapes, &schemes), problems);
    let (tool_sections, all_names) = tool_names(root, &body_sections, problems);
    let tools: Vec<Tool> =
        tool_sections.iter().filter_map(|s| tool::read(s, &mut shapes, problems)).collect();
    let contacts = contact::read(&list(root, "contact", problems), scope, &all_names, problems);
    if bodies.len() == body_sections.len() && tools.len() == tool_sections.len() {
        contact::check(&contacts, &bodies, &tools, problems);
    }
    // A wrong name is told where it stands; what its default does not go with is nobody's mistake.
    if schemes.known {
        compatible::check(&bodies, &materials, problems);
    }
    let mut loads = LoadReader { scope, shapes: &mut shapes, bodies: &body_names, boundaries: 0 };
    let (boundaries, held) = named_list(root, "boundary", problems);
    let boundaries = boundaries.iter().filter_map(|s| loads.boundary(s, problems)).collect();
    let gravity = list(root, "gravity", problems);
    let gravity = gravity.iter().filter_map(|s| loads.gravity(s, problems)).collect();
    let forces = list(root, "load", problems);
    let forces = forces.iter().filter_map(|s| loads.load(s, problems)).collect();
    let initial = list(root, "initial", problems);
    let initial = initial.iter().filter_map(|s| loads.initial(s, problems)).collect();
    let (probes, measures) = records(root, &mut shapes, [&body_names, &held, &all_names], problems);
    Parts {
        formulation: schemes.formulation,
        materials,
        regions,
        bodies,
        tools,
        contacts,
        boundaries,
        initial,
        gravity,
        loads: forces,
        probes,
        measures,
        shear_stress: schemes.shear_stress(),
    }
}

/// The sections of a list, and their names; a name that comes twice is noted.
fn named_list<'a>(
    root: &'a Table,
    key: &str,
    problems: &mut Problems,
) -> (Vec<Section<'a>>, Vec<Option<&'a str>>) {
    let sections = list(root, key, problems);
    let (names, twice) = part_names(&sections);
    problems.0.extend(twice);
    (sections, names)
}

/// The sections of tools, and the names of all bodies and then tools; a name that comes twice is noted.
fn tool_names<'a>(
    root: &'a Table,
    bodies: &[Section<'a>],
    problems: &mut Problems,
) -> (Vec<Section<'a>>, Vec<Option<&'a str>>) {
    let tools = list(root, "tool", problems);
    let (_, among_bodies) = part_names(bodies);
    let (names, twice) = part_names(&[bodies, tools.as_slice()].concat());
    problems.0.extend(twice.into_iter().skip(among_bodies.len()));
    (tools, names)
}

fn bodies<'a>(
    root: &'a Table,
    sections: &[Section<'a>],
    (shapes, schemes): (&mut ShapeReader<'a>, &Schemes),
    problems: &mut Problems,
) -> Vec<Body> {
    if root.get("body").is_none() {
        let help = "for example [[body]] with name, material and shape";
        problems.0.push(Diagnostic::at(Place::START, "missing `[[body]]`: a case needs a body").help(help));
    }
    let materials: Vec<Option<&str>> = match root.get("material").map(|node| &node.value) {
        Some(Value::Table(table)) => table.keys().map(Some).collect(),
        _ => Vec::new(),
    };
    let mut reader = BodyReader { scope: shapes.scope, shapes, schemes, materials: &materials };
    let bodies: Vec<Body> = sections.iter().filter_map(|section| reader.read(section, problems)).collect();
    if schemes.known && bodies.len() == sections.len() && !bodies.is_empty() {
        schemes.refuse_useless(&bodies, problems);
    }
    bodies
}

/// Probes, and the measures taken from them.
fn records<'a>(
    root: &'a Table,
    shapes: &mut ShapeReader<'a>,
    [bodies, boundaries, touching]: [&[Option<&'a str>]; 3],
    problems: &mut Problems,
) -> (Vec<Probe>, Vec<Measure>) {
    let scope = shapes.scope;
    let (sections, names) = named_list(root, "probe", problems);
    let mut reader = ProbeReader { shapes: &mut *shapes, bodies, boundaries, touching };
    let probes: Vec<Probe> = sections.iter().filter_map(|section| reader.read(section, problems)).collect();
    let (sections, _) = named_list(root, "measure", problems);
    let reader = MeasureReader { scope, bodies, probes: &names, checked: &probes };
    let measures =
        sections.iter().filter_map(|section| reader.read(section, (&mut *shapes, &mut *problems))).collect();
    (probes, measures)
}
