//! From texts to the checked case, collecting what is wrong.

use std::sync::Arc;

use super::case::Case;
use super::forced::force;
use super::head::{Head, head};
use super::parts::parts;
use super::scope::Scope;
use super::{compatible, contact, parameters, statics, time};
use crate::diagnostic::{CaseError, Problems};
use crate::keys::case as keys;
use crate::source::{Overrides, Place, Sources, apply};
use crate::written::{Section, Table, parse_file, to_toml};

/// The case that the texts and overrides describe.
pub(super) fn case(mut sources: Sources, overrides: &Overrides) -> Result<Case, CaseError> {
    let mut problems = Problems::default();
    let read = overridden(overrides, &mut sources, &mut problems);
    let sources = Arc::new(sources);
    let case = read.and_then(|(root, as_run)| checked(&root, as_run, &sources, &mut problems));
    match case {
        Some(case) if problems.0.is_empty() => Ok(case),
        _ => Err(CaseError::new(problems.0, sources)),
    }
}

/// The tree with the overrides put in, and its text; `None` if one of them leads nowhere.
fn overridden(
    overrides: &Overrides,
    sources: &mut Sources,
    problems: &mut Problems,
) -> Option<(Table, String)> {
    let mut root = problems.keep(parse_file(sources.file_content()))?;
    if let Some(name) = &overrides.formulation {
        force(&mut root, name, sources);
    }
    for argument in &overrides.set {
        problems.keep(apply(&mut root, argument, sources));
    }
    let untouched = *overrides == Overrides::default();
    let as_run = if untouched { sources.file_content().to_string() } else { to_toml(&root) };
    problems.0.is_empty().then_some((root, as_run))
}

/// The case; `None` if a part is missing or wrong.
fn checked(root: &Table, as_run: String, sources: &Arc<Sources>, problems: &mut Problems) -> Option<Case> {
    let top = Section { table: root, place: Place::START, title: "the case".to_string() };
    top.only(keys::TABLE.keys, problems);
    let Head { name, title, dimension, plane, kernel } = head(&top, problems)?;
    let before = problems.0.len();
    let scope = Scope { files: sources.files(), ..parameters::read(root, dimension, problems) };
    if problems.0.len() > before {
        return None;
    }
    let spacing = problems.keep(scope.need(&top, &keys::SPACING));
    let times = time::read(root, &scope, problems);
    let parts = parts(root, &scope, problems);
    let named = top.get(keys::PLANE.name).map_or(Place::START, |node| node.place);
    compatible::planes(&parts.bodies, (plane, named), problems);
    let (damping, quasi_static) = statics::read(root, &scope, (&parts.bodies, problems));
    contact::refuse_statics(root, &parts.contacts, problems);
    let (time, monitor) = times?;
    Some(Case {
        name,
        title,
        dimension,
        plane,
        formulation: parts.formulation,
        spacing: spacing?,
        kernel,
        shear_stress: parts.shear_stress,
        parameters: scope.parameters,
        warnings: [scope.meshes.doubts(), parts.warnings(root, plane)].concat(),
        materials: parts.materials,
        regions: parts.regions,
        bodies: parts.bodies,
        tools: parts.tools,
        contacts: parts.contacts,
        boundaries: parts.boundaries,
        initial: parts.initial,
        gravity: parts.gravity,
        loads: parts.loads,
        time,
        damping,
        quasi_static,
        monitor,
        probes: parts.probes,
        measures: parts.measures,
        meshes: scope.meshes.all(),
        files: scope.files.used(),
        sources: Arc::clone(sources),
        as_run,
    })
}
