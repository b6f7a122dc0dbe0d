//! The volumes of shapes whose volume has a formula, or is that of their triangles.

use crate::point::{Dimension, norm, sub};
use crate::polygon;
use crate::shape::Shape;
use std::f64::consts::PI;

/// The volume in m^3 (in 2D the area in m^2), if there is a formula.
pub(crate) fn volume(shape: &Shape, dimension: Dimension) -> Option<f64> {
    let ball = |radius: f64| match dimension {
        Dimension::Two => PI * radius.powi(2),
        Dimension::Three => 4.0 / 3.0 * PI * radius.powi(3),
    };
    match shape {
        Shape::Box { min, max } => Some((0..dimension.axes()).map(|i| max[i] - min[i]).product()),
        Shape::Ball { radius, .. } => Some(ball(*radius)),
        Shape::Ring { inner, outer, .. } => Some(ball(*outer) - ball(*inner)),
        Shape::Cylinder { from, to, radius } => Some(PI * radius * radius * norm(sub(*to, *from))),
        Shape::Polygon { points, height } => {
            let thickness = height.map_or(1.0, |[low, high]| high - low);
            Some(polygon::area(points).abs() * thickness)
        }
        Shape::Translate { shape, .. } | Shape::Rotate { shape, .. } => volume(shape, dimension),
        Shape::Scale { factor, shape, .. } => {
            volume(shape, dimension).map(|v| v * factor.powi(dimension.axes() as i32))
        }
        // What overlaps would count twice.
        Shape::Mesh(mesh) => (!mesh.meets_itself()).then(|| mesh.volume()),
        Shape::Stent(_) | Shape::Union(_) | Shape::Intersection(_) | Shape::Difference(..) => None,
    }
}
