//! Where the surface of a body is, seen from near it.

use crate::bounds::Bounds;
use crate::point::{Dimension, Point, add, dot, norm, scale, sub};
use crate::shape::Shape;

/// Step of the differences that give a normal, in spacings: far above the rounding of coordinates, and what the surface turns along it is
/// far below what particles can show.
const STEP: f64 = 1e-4;

/// How far beyond a foot it is looked whether the surface really is there, in spacings.
const BEYOND: f64 = 1e-3;

/// How far it is looked for other faces beside an edge, in spacings: farther than a particle moves before it looks again.
const ASIDE: f64 = 0.25;

/// The nearest part of the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wall {
    /// Signed distance to it, negative inside the body, m.
    pub(super) distance: f64,
    /// Which way is out; zero where several ways are.
    pub(super) normal: Point,
}

/// The surface of a shape. A union reports distances to what its parts have in common as well, where there is no surface
/// (see [`Shape::distance`]); so its parts are asked one by one, and each is believed only where the whole really ends.
pub(super) struct Walls<'a> {
    whole: &'a Shape,
    /// The parts with their bounds, if the distance of the whole cannot be trusted inside.
    faces: Vec<(Shape, Bounds)>,
    spacing: f64,
    axes: usize,
}

/// No wall: infinitely far.
const NONE: Wall = Wall { distance: f64::NEG_INFINITY, normal: [0.0; 3] };

impl<'a> Walls<'a> {
    pub(super) fn new(whole: &'a Shape, spacing: f64, dimension: Dimension) -> Self {
        let faces = if exact_inside(whole) { Vec::new() } else { faces(whole) };
        let bounded = |face: Shape| {
            let bounds = face.bounds();
            (face, bounds)
        };
        let faces = faces.into_iter().map(bounded).collect();
        Self { whole, faces, spacing, axes: dimension.axes() }
    }

    /// Whether the distance of the whole is the distance to its surface, seen from inside.
    pub(super) fn is_exact(&self) -> bool {
        self.faces.is_empty()
    }

    /// How far a place inside is from the surface at least.
    pub(super) fn room(&self, x: Point) -> f64 {
        -self.whole.distance(x)
    }

    /// The nearest surface. Where nothing but the inner faces of a union is near, it is as far as can be.
    pub(super) fn at(&self, x: Point) -> Wall {
        if self.is_exact() {
            return Wall { distance: self.whole.distance(x), normal: self.slope(self.whole, x) };
        }
        self.faces.iter().fold(NONE, |best, (face, bounds)| {
            let nearer = |wall: &Wall| wall.distance.abs() < best.distance.abs();
            let reached = bounds.squared(x).sqrt() <= best.distance.abs() + self.spacing;
            if reached { self.face(face, x).filter(nearer).unwrap_or(best) } else { best }
        })
    }

    /// The nearest wall, and those that meet it in a ridge close to `x`, as planes at their distances from there. In a groove
    /// (an edge that points inwards) the nearest is enough.
    pub(super) fn meeting(&self, x: Point, nearest: Wall) -> [Wall; 3] {
        let mut walls = [nearest, NONE, NONE];
        if nearest.distance < -self.spacing || nearest.normal == [0.0; 3] {
            return walls;
        }
        let mut found = 1;
        for way in self.tangents(nearest.normal) {
            let aside = scale(way, ASIDE * self.spacing);
            let seen = self.at(add(x, aside));
            let distance = seen.distance - dot(seen.normal, aside);
            let new = walls[..found].iter().all(|wall| dot(wall.normal, seen.normal) < 0.95);
            if found < 3 && new && distance <= nearest.distance + STEP * self.spacing {
                walls[found] = Wall { distance, normal: seen.normal };
                found += 1;
            }
        }
        walls
    }

    /// Directions along a surface: two in the plane, four in space.
    fn tangents(&self, [a, b, c]: Point) -> impl Iterator<Item = Point> {
        let along = if self.axes == 2 || a.abs() + b.abs() > c.abs() { [-b, a, 0.0] } else { [0.0, c, -b] };
        let along = scale(along, 1.0 / norm(along));
        let across = [b * along[2] - c * along[1], c * along[0] - a * along[2], a * along[1] - b * along[0]];
        [along, scale(along, -1.0), across, scale(across, -1.0)].into_iter().take(2 * self.axes - 2)
    }

    /// The surface of a part near `x`, if the whole ends there. If not, what the part shows a spacing farther away from there is asked.
    fn face(&self, face: &Shape, x: Point) -> Option<Wall> {
        let (distance, slope) = (face.distance(x), self.slope(face, x));
        self.believed(x, distance, slope).or_else(|| {
            let back = scale(slope, -self.spacing);
            let there = add(x, back);
            let (distance, slope) = (face.distance(there), self.slope(face, there));
            self.believed(x, distance - dot(slope, back), slope)
        })
    }

    /// A wall at the foot of `x`, if the whole ends there.
    fn believed(&self, x: Point, distance: f64, slope: Point) -> Option<Wall> {
        let foot = sub(x, scale(slope, distance));
        let beyond = |by: f64| self.whole.contains(add(foot, scale(slope, by * self.spacing)));
        let (before, after) = (beyond(-BEYOND), beyond(BEYOND));
        let side = if before { 1.0 } else { -1.0 };
        (before != after).then_some(Wall { distance: side * distance, normal: scale(slope, side) })
    }

    /// The direction in which a distance grows, by central differences; zero where it is none.
    fn slope(&self, shape: &Shape, x: Point) -> Point {
        let e = STEP * self.spacing;
        let mut slope = [0.0; 3];
        for axis in 0..self.axes {
            let at = |by: f64| {
                let mut x = x;
                x[axis] += by;
                shape.distance(x)
            };
            slope[axis] = (at(e) - at(-e)) / (2.0 * e);
        }
        let length = norm(slope);
        if length > 0.5 { scale(slope, 1.0 / length) } else { [0.0; 3] }
    }
}

/// Whether the distance to the surface is exact inside.
fn exact_inside(shape: &Shape) -> bool {
    match shape {
        Shape::Union(parts) => parts.len() == 1 && exact_inside(&parts[0]),
        Shape::Intersection(parts) => parts.iter().all(exact_inside),
        Shape::Difference(first, cuts) => exact_inside(first) && cuts.iter().all(exact_outside),
        Shape::Translate { shape, .. } | Shape::Rotate { shape, .. } | Shape::Scale { shape, .. } => {
            exact_inside(shape)
        }
        Shape::Mesh(mesh) => !mesh.meets_itself(),
        _ => true,
    }
}

/// The same outside.
fn exact_outside(shape: &Shape) -> bool {
    match shape {
        Shape::Union(parts) => parts.iter().all(exact_outside),
        Shape::Intersection(parts) => parts.len() == 1 && exact_outside(&parts[0]),
        Shape::Difference(..) => false,
        Shape::Translate { shape, .. } | Shape::Rotate { shape, .. } | Shape::Scale { shape, .. } => {
            exact_outside(shape)
        }
        Shape::Mesh(mesh) => !mesh.meets_itself(),
        _ => true,
    }
}

/// The parts whose surfaces make up that of the shape, where they stand.
fn faces(shape: &Shape) -> Vec<Shape> {
    let around = |inner: &Shape, wrap: &dyn Fn(Box<Shape>) -> Shape| {
        faces(inner).into_iter().map(|face| wrap(Box::new(face))).collect()
    };
    match shape {
        Shape::Union(parts) | Shape::Intersection(parts) => parts.iter().flat_map(faces).collect(),
        Shape::Difference(first, cuts) => std::iter::once(&**first).chain(cuts).flat_map(faces).collect(),
        Shape::Translate { by, shape } => around(shape, &|shape| Shape::Translate { by: *by, shape }),
        Shape::Rotate { angle, axis, about, shape } => {
            around(shape, &|shape| Shape::Rotate { angle: *angle, axis: *axis, about: *about, shape })
        }
        Shape::Scale { factor, about, shape } => {
            around(shape, &|shape| Shape::Scale { factor: *factor, about: *about, shape })
        }
        Shape::Mesh(mesh) => mesh.parts().iter().cloned().map(Shape::Mesh).collect(),
        _ => vec![shape.clone()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(min: [f64; 2], max: [f64; 2]) -> Shape {
        Shape::Box { min: [min[0], min[1], 0.0], max: [max[0], max[1], 0.0] }
    }

    #[test]
    fn a_union_has_no_surface_where_its_parts_touch() {
        // Two halves of the square from 0 to 4; 1e-6 is what central differences of 1e-4 leave of 4.
        let halves = Shape::Union(vec![rectangle([0.0, 0.0], [2.0, 4.0]), rectangle([2.0, 0.0], [4.0, 4.0])]);
        let walls = Walls::new(&halves, 1.0, Dimension::Two);
        for (x, distance, normal) in [
            ([1.9, 0.5, 0.0], -0.5, [0.0, -1.0]),
            ([2.0, 3.75, 0.0], -0.25, [0.0, 1.0]),
            ([3.75, 2.0, 0.0], -0.25, [1.0, 0.0]),
            ([4.25, 1.0, 0.0], 0.25, [1.0, 0.0]),
        ] {
            let wall = walls.at(x);
            assert!((wall.distance - distance).abs() < 1e-6, "{x:?}: {}", wall.distance);
            assert!((wall.normal[0] - normal[0]).abs() + (wall.normal[1] - normal[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn cuts_and_motions_keep_what_is_exact() {
        let square = rectangle([0.0; 2], [4.0; 2]);
        let hole = Shape::Ball { center: [2.0, 2.0, 0.0], radius: 1.0 };
        let plate = Shape::Difference(Box::new(square.clone()), vec![hole]);
        let moved = Shape::Translate { by: [1.0, 0.0, 0.0], shape: Box::new(plate.clone()) };
        let walls = Walls::new(&moved, 0.1, Dimension::Two);
        assert!(walls.is_exact());
        let wall = walls.at([3.0, 3.25, 0.0]);
        // Differences of a circle of 12 steps radius: (1e-5)^2 of curvature.
        assert!((wall.distance + 0.25).abs() < 1e-12 && (wall.normal[1] + 1.0).abs() < 1e-6);
        let twice = Shape::Union(vec![plate, square]);
        let walls = Walls::new(&twice, 0.1, Dimension::Two);
        assert!(!walls.is_exact());
        // The hole is filled by the second part.
        assert!((walls.at([2.0, 3.4, 0.0]).distance + 0.6).abs() < 1e-6);
    }
}
