//! Triangles as a file.

use crate::point::{Point, Turn, add, stretch, sub, unit};
use crate::shape::Shape;
use crate::triangles;

/// Triangles as a binary STL file: 80 bytes of a title, their number, and for each its normal and corners in single precision, in metres.
///
/// Format: <https://www.fabbers.com/tech/STL_Format>.
pub fn stl(triangles: &[[Point; 3]]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(84 + 50 * triangles.len());
    bytes.extend(format!("{:80}", "taut, lengths in metres").into_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for [a, b, c] in triangles {
        let ([p, q, r], [s, t, u]) = (sub(*b, *a), sub(*c, *a));
        let normal = unit([q * u - r * t, r * s - p * u, p * t - q * s]).unwrap_or([0.0; 3]);
        for coordinate in [normal, *a, *b, *c].as_flattened() {
            bytes.extend((*coordinate as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

impl Shape {
    /// The surface as triangles whose corners run counterclockwise seen from outside, closed. `None` for polygons and combinations, which have
    /// none.
    pub fn surface(&self) -> Option<Vec<[Point; 3]>> {
        let moved = |shape: &Self, to: &dyn Fn(Point) -> Point| {
            let mut surface = shape.surface()?;
            surface.as_flattened_mut().iter_mut().for_each(|x| *x = to(*x));
            Some(surface)
        };
        match self {
            Self::Box { min, max } => Some(triangles::cuboid(*min, *max)),
            Self::Ball { center, radius } => Some(triangles::ball(*center, *radius)),
            Self::Ring { center, inner, outer } => Some(triangles::hollow(*center, *inner, *outer)),
            Self::Cylinder { from, to, radius } => Some(triangles::cylinder([*from, *to], *radius)),
            Self::Stent(stent) => Some(stent.surface()),
            Self::Mesh(mesh) => {
                let corners = |face: &[u32; 3]| face.map(|corner| mesh.points()[corner as usize]);
                Some(mesh.faces().iter().map(corners).collect())
            }
            Self::Translate { by, shape } => moved(shape, &|x| add(x, *by)),
            Self::Rotate { angle, axis, about, shape } => {
                moved(shape, &|x| Turn { angle: *angle, axis: *axis, about: *about }.apply(x))
            }
            Self::Scale { factor, about, shape } => moved(shape, &|x| stretch(x, *about, *factor)),
            Self::Polygon { .. } | Self::Union(_) | Self::Intersection(_) | Self::Difference(..) => None,
        }
    }
}
