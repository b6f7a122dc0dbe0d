//! Reading the shapes that are not made of others.

use super::mesh::mesh;
use super::scope::Scope;
use super::shape::ShapeSpec;
use crate::diagnostic::Diagnostic;
use crate::keys::{Key, shape};
use crate::source::Place;
use crate::units::Dimension;
use crate::written::{Node, Section, Value};
use geometry::{Dimension as Space, Shape, Stent};

/// The shape of this kind; `place` is where the kind is named.
pub(super) fn solid(
    scope: &Scope,
    kind: &str,
    place: Place,
    section: &Section<'_>,
) -> Result<ShapeSpec, Diagnostic> {
    match (kind, scope.dimension) {
        ("box", _) => cuboid(scope, section),
        ("ball", _) => ball(scope, section),
        ("ring", _) | ("hollow-ball", 3) => shell(scope, section),
        ("hollow-ball", _) => Err(only_3d(place, kind).help("in 2D it is called `ring`")),
        ("cylinder", 3) => cylinder(scope, section),
        ("mesh", 3) => mesh(scope, section),
        ("mesh", _) => Err(only_3d(place, kind).help("in 2D draw its section as a `polygon`")),
        ("cylinder", _) => Err(only_3d(place, kind).help("its cross-section in 2D is a `ball` or a `box`")),
        ("stent", 3) => stent(scope, section),
        ("stent", _) => Err(only_3d(place, kind)),
        _ => polygon(scope, section),
    }
}

fn only_3d(place: Place, kind: &str) -> Diagnostic {
    Diagnostic::at(place, format!("the shape `{kind}` exists in 3D only, and the case has dimension = 2"))
}

fn point(scope: &Scope, section: &Section<'_>, key: &Key) -> Result<[f64; 3], Diagnostic> {
    scope.vector(section.need(key.name)?, key)
}

fn cuboid(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("box"))?;
    let min = point(scope, section, &shape::MIN)?;
    let max = point(scope, section, &shape::MAX)?;
    for axis in 0..scope.dimension {
        if min[axis] >= max[axis] {
            let name = ["x", "y", "z"][axis];
            let message = format!("the box is empty along {name}: min {} >= max {}", min[axis], max[axis]);
            return Err(Diagnostic::at(section.need("max")?.place, message));
        }
    }
    Ok(ShapeSpec::Box { min, max })
}

fn ball(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("ball"))?;
    let center = point(scope, section, &shape::CENTER)?;
    Ok(ShapeSpec::Ball { center, radius: scope.need(section, &shape::RADIUS)? })
}

fn shell(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("ring"))?;
    let center = point(scope, section, &shape::CENTER)?;
    let inner = scope.need(section, &shape::INNER)?;
    let outer = scope.need(section, &shape::OUTER)?;
    if inner >= outer {
        let message = format!("the inner radius {inner} has to be smaller than the outer radius {outer}");
        return Err(Diagnostic::at(section.need("inner")?.place, message));
    }
    Ok(ShapeSpec::Ring { center, inner, outer })
}

fn cylinder(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("cylinder"))?;
    let from = point(scope, section, &shape::FROM)?;
    let to = point(scope, section, &shape::TO)?;
    if from == to {
        return Err(Diagnostic::at(
            section.need("to")?.place,
            "the cylinder has no length: `from` equals `to`",
        ));
    }
    Ok(ShapeSpec::Cylinder { from, to, radius: scope.need(section, &shape::RADIUS)? })
}

fn stent(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("stent"))?;
    let cells = |key: &Key| -> Result<usize, Diagnostic> {
        let count = scope.need(section, key)?;
        if count.fract() != 0.0 || count > Stent::MOST_CELLS as f64 {
            let message =
                format!("`{}` is {count}; give a whole number up to {}", key.name, Stent::MOST_CELLS);
            return Err(Diagnostic::at(section.need(key.name)?.place, message));
        }
        Ok(count as usize)
    };
    let stent = Stent {
        length: scope.need(section, &shape::STENT_LENGTH)?,
        diameter: scope.need(section, &shape::DIAMETER)?,
        thickness: scope.need(section, &shape::THICKNESS)?,
        around: cells(&shape::AROUND)?,
        along: cells(&shape::ALONG)?,
        strut: scope.need(section, &shape::STRUT)?,
        bridge: scope.need(section, &shape::BRIDGE)?,
    };
    match Shape::Stent(stent).validate(Space::Three) {
        Ok(()) => Ok(ShapeSpec::Stent(stent)),
        Err(error) => Err(Diagnostic::at(section.place, error.to_string())),
    }
}

fn polygon(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_of(shape::keys("polygon"))?;
    let node = section.need(shape::POINTS.name)?;
    let points = match &node.value {
        Value::Array(items) if items.len() >= 3 => {
            items.iter().map(|item| pair(scope, item, "each point")).collect::<Result<Vec<_>, _>>()?
        }
        _ => {
            let message = format!("`points` has to be a list of at least 3 points, found {}", node.found());
            return Err(Diagnostic::at(node.place, message));
        }
    };
    Ok(ShapeSpec::Polygon { points, height: height(scope, section)? })
}

/// The height of a prism: required in 3D, refused in 2D.
fn height(scope: &Scope, section: &Section<'_>) -> Result<Option<[f64; 2]>, Diagnostic> {
    if scope.dimension == 2 {
        return match section.get(shape::HEIGHT.name) {
            None => Ok(None),
            Some(node) => Err(Diagnostic::at(node.place, "a polygon in 2D has no `height`")),
        };
    }
    let node = section.need(shape::HEIGHT.name)?;
    let height = pair(scope, node, "`height`")?;
    if height[0] >= height[1] {
        let message = format!("`height` has to rise, found {} to {}", height[0], height[1]);
        return Err(Diagnostic::at(node.place, message));
    }
    Ok(Some(height))
}

/// Two lengths, whatever the dimension of the case.
fn pair(scope: &Scope, node: &Node, what: &str) -> Result<[f64; 2], Diagnostic> {
    match &node.value {
        Value::Array(items) if items.len() == 2 => Ok([
            scope.number(&items[0], what, Dimension::LENGTH)?,
            scope.number(&items[1], what, Dimension::LENGTH)?,
        ]),
        _ => Err(Diagnostic::at(
            node.place,
            format!("{what} has to be a list of 2 numbers, found {}", node.found()),
        )),
    }
}
