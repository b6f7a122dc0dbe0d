//! Reading the shapes that are not made of others.

use super::scope::Scope;
use super::shape::ShapeSpec;
use crate::diagnostic::Diagnostic;
use crate::source::Place;
use crate::units::Dimension;
use crate::written::{Node, Section, Value};

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
        ("cylinder", _) => Err(only_3d(place, kind).help("its cross-section in 2D is a `ball` or a `box`")),
        _ => polygon(scope, section),
    }
}

fn only_3d(place: Place, kind: &str) -> Diagnostic {
    Diagnostic::at(place, format!("the shape `{kind}` exists in 3D only, and the case has dimension = 2"))
}

fn point(scope: &Scope, section: &Section<'_>, key: &str) -> Result<[f64; 3], Diagnostic> {
    scope.vector(section.need(key)?, &format!("`{key}`"), Dimension::LENGTH)
}

fn length(scope: &Scope, section: &Section<'_>, key: &str) -> Result<f64, Diagnostic> {
    scope.positive(section.need(key)?, &format!("`{key}`"), Dimension::LENGTH)
}

fn cuboid(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_first(&["min", "max"])?;
    let min = point(scope, section, "min")?;
    let max = point(scope, section, "max")?;
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
    section.only_first(&["center", "radius"])?;
    let center = point(scope, section, "center")?;
    Ok(ShapeSpec::Ball { center, radius: length(scope, section, "radius")? })
}

fn shell(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_first(&["center", "inner", "outer"])?;
    let center = point(scope, section, "center")?;
    let inner = scope.not_negative(section.need("inner")?, "`inner`", Dimension::LENGTH)?;
    let outer = length(scope, section, "outer")?;
    if inner >= outer {
        let message = format!("the inner radius {inner} has to be smaller than the outer radius {outer}");
        return Err(Diagnostic::at(section.need("inner")?.place, message));
    }
    Ok(ShapeSpec::Ring { center, inner, outer })
}

fn cylinder(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_first(&["from", "to", "radius"])?;
    let from = point(scope, section, "from")?;
    let to = point(scope, section, "to")?;
    if from == to {
        return Err(Diagnostic::at(
            section.need("to")?.place,
            "the cylinder has no length: `from` equals `to`",
        ));
    }
    Ok(ShapeSpec::Cylinder { from, to, radius: length(scope, section, "radius")? })
}

fn polygon(scope: &Scope, section: &Section<'_>) -> Result<ShapeSpec, Diagnostic> {
    section.only_first(&["points", "height"])?;
    let node = section.need("points")?;
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
        return match section.get("height") {
            None => Ok(None),
            Some(node) => Err(Diagnostic::at(node.place, "a polygon in 2D has no `height`")),
        };
    }
    let node = section.need("height")?;
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
