//! `--formulation NAME`: one formulation for every body, whatever the file says.

use super::choices::{Family, Formulation};
use crate::keys::Words;
use crate::source::{Place, Sources};
use crate::written::{Node, Table, Value};

/// Writes the formulation into the tree. What the file says about formulations of single bodies, and keys that
/// only other formulations have, go: they were right for the file's own choice. An unknown name is refused later,
/// as one in the file is.
pub(super) fn force(root: &mut Table, name: &str, sources: &mut Sources) {
    let typed = format!("--formulation {name}");
    let (start, end) = (typed.len() - name.len(), typed.len());
    let place = Place { text: sources.add_argument(typed), start, end };
    root.set(
        "formulation",
        place,
        Node { value: Value::Text(name.to_string()), place, content: Some(start) },
    );
    if let Some(Value::Array(bodies)) = root.get_mut("body").map(|node| &mut node.value) {
        for body in bodies {
            if let Value::Table(body) = &mut body.value {
                body.remove("formulation");
            }
        }
    }
    let formulation = Formulation::WORDS.iter().find(|(n, ..)| *n == name).map(|(_, f, _)| *f);
    if formulation.is_some_and(|f| f != Formulation::TlGanzenmueller) {
        root.remove("alpha");
    }
    if formulation.is_some_and(|f| !f.has_artificial_stress()) {
        root.remove("artificial_stress");
    }
    if formulation.is_some_and(|f| f != Formulation::TlHourglassFree) {
        root.remove("calibration");
    }
    if formulation.is_some_and(|f| f != Formulation::SmallStrain) {
        root.remove("normalisation");
    }
    if let Some(Value::Table(time)) = root.get_mut("time").map(|node| &mut node.value) {
        match formulation {
            Some(Formulation::SmallStrain) => time.remove("step"),
            Some(_) => time.remove("dt"),
            None => {}
        }
    }
    match formulation.map(Formulation::family) {
        Some(Family::Total) => {
            root.remove("stepping");
            root.remove("reference_speed");
        }
        Some(Family::Updated) => {
            if let Some(Value::Table(time)) = root.get_mut("time").map(|node| &mut node.value) {
                time.remove("step");
            }
            root.remove("kelvin_voigt");
        }
        None => {}
    }
}
