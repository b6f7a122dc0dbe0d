//! Shapes of the case as shapes of the geometry crate.

use crate::ShapeSpec;
use geometry::{Dimension, Shape};

/// The dimension, as the geometry crate has it.
pub fn dimension<const D: usize>() -> Dimension {
    if D == 2 { Dimension::Two } else { Dimension::Three }
}

/// The same shape.
pub fn shape(spec: &ShapeSpec) -> Shape {
    let all = |specs: &[ShapeSpec]| specs.iter().map(shape).collect::<Vec<_>>();
    let one = |spec: &ShapeSpec| Box::new(shape(spec));
    match spec {
        ShapeSpec::Box { min, max } => Shape::Box { min: *min, max: *max },
        ShapeSpec::Ball { center, radius } => Shape::Ball { center: *center, radius: *radius },
        ShapeSpec::Ring { center, inner, outer } if *inner == 0.0 => {
            Shape::Ball { center: *center, radius: *outer }
        }
        ShapeSpec::Ring { center, inner, outer } => {
            Shape::Ring { center: *center, inner: *inner, outer: *outer }
        }
        ShapeSpec::Cylinder { from, to, radius } => Shape::Cylinder { from: *from, to: *to, radius: *radius },
        ShapeSpec::Polygon { points, height } => Shape::Polygon { points: points.clone(), height: *height },
        ShapeSpec::Stent(stent) => Shape::Stent(*stent),
        ShapeSpec::Mesh { mesh, .. } => Shape::Mesh(mesh.clone()),
        ShapeSpec::Union(specs) => Shape::Union(all(specs)),
        ShapeSpec::Intersection(specs) => Shape::Intersection(all(specs)),
        ShapeSpec::Difference(specs) => {
            let mut shapes = all(specs);
            let first = if shapes.is_empty() { Shape::Union(Vec::new()) } else { shapes.remove(0) };
            Shape::Difference(Box::new(first), shapes)
        }
        ShapeSpec::Translate { by, shape } => Shape::Translate { by: *by, shape: one(shape) },
        ShapeSpec::Rotate { angle, axis, about, shape } => {
            Shape::Rotate { angle: *angle, axis: *axis, about: *about, shape: one(shape) }
        }
        ShapeSpec::Scale { factor, about, shape } => {
            Shape::Scale { factor: *factor, about: *about, shape: one(shape) }
        }
    }
}

/// Lengths of the edges of the box around a shape, m.
pub fn bounds(spec: &ShapeSpec) -> [f64; 3] {
    shape(spec).bounds().extent()
}
