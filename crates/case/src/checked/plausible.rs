//! Values that are legal but look as if their unit were wrong.

use super::material::Material;
use crate::diagnostic::Diagnostic;
use crate::keys::material::{DENSITY, ELASTIC};
use crate::keys::shape::ANGLE;
use crate::source::Place;
use crate::written::{Node, Table, Value};

/// Densities of solids, kg/m^3: from aerogel to osmium, with room.
const DENSITIES: [f64; 2] = [1.5, 30e3];

/// Moduli of solids, Pa: from the softest gels to diamond, with room.
const MODULI: [f64; 2] = [50.0, 2e12];

/// From here on a solid is as good as incompressible.
const INCOMPRESSIBLE: f64 = 0.495;

/// Doubts about materials.
pub(super) fn materials(root: &Table, materials: &[Material]) -> Vec<Diagnostic> {
    materials.iter().flat_map(|material| of_material(root, material)).collect()
}

fn of_material(root: &Table, material: &Material) -> Vec<Diagnostic> {
    let table = table(root, "material").and_then(|all| table(all, &material.name));
    let place = |key: &str| table.and_then(|t| t.get(key)).map(|node| node.place);
    let (name, e, mut found) = (&material.name, &material.elastic, Vec::new());
    let density = material.density;
    if let Some(place) = place(DENSITY.name).filter(|_| !within(density, DENSITIES)) {
        found.push(unusual(place, format!("a density of {density} kg/m^3 is none of a solid"), "1.1 g/cm^3"));
    }
    let moduli = [(0, e.youngs_modulus), (2, e.bulk_modulus), (3, e.shear_modulus)];
    for (key, value) in moduli {
        if let Some(place) = place(ELASTIC[key].name).filter(|_| !within(value, MODULI)) {
            let message = format!("`{}` of {value} Pa is none of a solid", ELASTIC[key].name);
            found.push(unusual(place, message, "17 MPa"));
        }
    }
    if e.poisson_ratio >= INCOMPRESSIBLE {
        let message = format!("the Poisson ratio of `{name}` is {:.5}, close to 0.5", e.poisson_ratio);
        let share = (e.bulk_modulus / e.shear_modulus).sqrt();
        let place = place(ELASTIC[1].name).unwrap_or(material.place);
        found.push(Diagnostic::at(place, message).help(format!(
            "pressure waves are {share:.0} times faster than shear waves, so time steps are short and pressures rough; 0.49 is often near enough"
        )));
    }
    found
}

fn unusual(place: Place, message: String, example: &str) -> Diagnostic {
    Diagnostic::at(place, message)
        .label("is the unit right?")
        .help(format!("plain numbers are SI; other units stand in the text, as in \"{example}\""))
}

fn within(value: f64, [least, most]: [f64; 2]) -> bool {
    (least..=most).contains(&value)
}

fn table<'a>(table: &'a Table, key: &str) -> Option<&'a Table> {
    match table.get(key).map(|node| &node.value) {
        Some(Value::Table(table)) => Some(table),
        _ => None,
    }
}

/// Angles beyond a full turn that are written as plain numbers: degrees, most likely.
pub(super) fn angles(root: &Table) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for entry in &root.entries {
        search(&entry.node, &mut found);
    }
    found
}

fn search(node: &Node, found: &mut Vec<Diagnostic>) {
    match &node.value {
        Value::Array(items) => items.iter().for_each(|item| search(item, found)),
        Value::Table(table) => {
            for entry in &table.entries {
                let number = match entry.node.value {
                    Value::Number(number) => number,
                    Value::Integer(number) => number as f64,
                    _ => 0.0,
                };
                if entry.key == ANGLE.name && number.abs() > std::f64::consts::TAU {
                    let message = format!("an angle of {number} rad is more than a full turn");
                    found.push(unusual(entry.node.place, message, "30 deg"));
                }
                search(&entry.node, found);
            }
        }
        _ => {}
    }
}
