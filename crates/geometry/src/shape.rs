//! The shapes, and what can be asked of them.

use crate::bounds::Bounds;
use crate::mesh::Mesh;
use crate::point::{Point, Turn, add, stretch, sub};
use crate::stent::Stent;
use crate::{distance, polygon};

/// A region of space, or of the plane z = 0. Lengths in metres; the boundary belongs to the region.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A box along the axes; with `min` and `max` at the same z a rectangle (see the crate's page).
    Box {
        /// The corner with the smallest coordinates.
        min: Point,
        /// The corner with the largest coordinates.
        max: Point,
    },
    /// A ball; in 2D a disc.
    Ball {
        /// The centre.
        center: Point,
        /// The radius.
        radius: f64,
    },
    /// What lies between two spheres (a hollow ball), in 2D between two circles (an annulus).
    Ring {
        /// The centre of both.
        center: Point,
        /// The radius of the hole.
        inner: f64,
        /// The radius of the outside.
        outer: f64,
    },
    /// A straight round cylinder with flat ends. Only in 3D.
    Cylinder {
        /// The centre of the first end.
        from: Point,
        /// The centre of the second end.
        to: Point,
        /// The radius.
        radius: f64,
    },
    /// A simple polygon, given in either sense and without repeating the first point; with `height` a prism.
    Polygon {
        /// The corners `[x, y]` in order.
        points: Vec<[f64; 2]>,
        /// Lowest and highest z of the prism: needed in 3D, absent in 2D.
        height: Option<[f64; 2]>,
    },
    /// A tube cut into cells. Only in 3D.
    Stent(Stent),
    /// What a surface of triangles encloses. Only in 3D.
    Mesh(Mesh),
    /// What lies in any of the shapes.
    Union(Vec<Shape>),
    /// What lies in all of the shapes.
    Intersection(Vec<Shape>),
    /// What lies in the first shape and in none of the others.
    Difference(Box<Shape>, Vec<Shape>),
    /// A shape moved without turning.
    Translate {
        /// The displacement.
        by: Point,
        /// What is moved.
        shape: Box<Shape>,
    },
    /// A shape turned by the right-hand rule.
    Rotate {
        /// The angle in radians.
        angle: f64,
        /// The direction of the axis, of any length; in 2D along z.
        axis: Point,
        /// A point of the axis.
        about: Point,
        /// What is turned.
        shape: Box<Shape>,
    },
    /// A shape magnified alike in all directions.
    Scale {
        /// The ratio of new to old lengths.
        factor: f64,
        /// The point that stays.
        about: Point,
        /// What is magnified.
        shape: Box<Shape>,
    },
}

impl Shape {
    /// The signed distance from `x` to the boundary, in metres, negative inside.
    ///
    /// Exact for boxes, balls, rings, cylinders, polygons and meshes (see [`Mesh::distance`]), moved, turned and magnified as they may be. For
    /// stents, unions, intersections and differences the magnitude is the true distance or less: a ball of that
    /// radius around `x` does not cross the boundary. Where surfaces of the combined shapes coincide, as
    /// where two boxes or two cuts are joined at a face, it is 0 also off the boundary.
    pub fn distance(&self, x: Point) -> f64 {
        match self {
            Self::Box { min, max } => distance::cuboid(*min, *max, x),
            Self::Ball { center, radius } => distance::ball(*center, *radius, x),
            Self::Ring { center, inner, outer } => {
                distance::ball(*center, *outer, x).max(-distance::ball(*center, *inner, x))
            }
            Self::Cylinder { from, to, radius } => distance::cylinder([*from, *to], *radius, x),
            Self::Polygon { points, height } => distance::prism(points, *height, x),
            Self::Stent(stent) => stent.distance(x),
            Self::Mesh(mesh) => mesh.distance(x),
            Self::Union(shapes) => nearest(shapes, x),
            Self::Intersection(shapes) => {
                shapes.iter().map(|s| s.distance(x)).fold(f64::NEG_INFINITY, f64::max)
            }
            Self::Difference(shape, cuts) => shape.distance(x).max(-nearest(cuts, x)),
            Self::Translate { by, shape } => shape.distance(sub(x, *by)),
            Self::Rotate { angle, axis, about, shape } => {
                shape.distance(Turn { angle: -angle, axis: *axis, about: *about }.apply(x))
            }
            Self::Scale { factor, about, shape } => factor * shape.distance(stretch(x, *about, 1.0 / factor)),
        }
    }

    /// Whether `x` lies inside or on the boundary.
    pub fn contains(&self, x: Point) -> bool {
        self.distance(x) <= 0.0
    }

    /// A box that encloses the shape: the smallest one for shapes that are not combined or turned, possibly
    /// a larger one for others. In 2D only x and y mean something.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Box { min, max } => Bounds { min: *min, max: *max },
            Self::Ball { center, radius } => Bounds { min: *center, max: *center }.grown(*radius),
            Self::Ring { center, outer, .. } => Bounds { min: *center, max: *center }.grown(*outer),
            Self::Cylinder { from, to, radius } => distance::cylinder_bounds([*from, *to], *radius),
            Self::Polygon { points, height } => polygon::bounds(points, height.unwrap_or([0.0; 2])),
            Self::Stent(stent) => stent.bounds(),
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Union(shapes) => shapes.iter().fold(Bounds::around([]), |b, s| b.join(&s.bounds())),
            Self::Intersection(shapes) => {
                shapes.iter().map(Shape::bounds).reduce(|a, b| a.meet(&b)).unwrap_or(Bounds::around([]))
            }
            Self::Difference(shape, _) => shape.bounds(),
            Self::Translate { by, shape } => carried(shape, |x| add(x, *by)),
            Self::Rotate { angle, axis, about, shape } => {
                carried(shape, |x| Turn { angle: *angle, axis: *axis, about: *about }.apply(x))
            }
            Self::Scale { factor, about, shape } => carried(shape, |x| stretch(x, *about, *factor)),
        }
    }

    /// The name of the kind of shape, as case files write it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Box { .. } => "box",
            Self::Ball { .. } => "ball",
            Self::Ring { .. } => "ring",
            Self::Cylinder { .. } => "cylinder",
            Self::Polygon { .. } => "polygon",
            Self::Stent(_) => "stent",
            Self::Mesh(_) => "mesh",
            Self::Union(_) => "union",
            Self::Intersection(_) => "intersection",
            Self::Difference(..) => "difference",
            Self::Translate { .. } => "translate",
            Self::Rotate { .. } => "rotate",
            Self::Scale { .. } => "scale",
        }
    }
}

fn nearest(shapes: &[Shape], x: Point) -> f64 {
    shapes.iter().map(|s| s.distance(x)).fold(f64::INFINITY, f64::min)
}

fn carried(shape: &Shape, to: impl Fn(Point) -> Point) -> Bounds {
    Bounds::around(shape.bounds().corners().map(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn square(min: f64, max: f64) -> Shape {
        Shape::Box { min: [min, min, 0.0], max: [max, max, 0.0] }
    }

    #[test]
    fn combinations_follow_the_sets() {
        let (a, b) = (square(0.0, 2.0), square(1.0, 3.0));
        let only_a = [0.5, 0.5, 0.0];
        let both = [1.5, 1.5, 0.0];
        let neither = [2.5, 0.5, 0.0];
        let union = Shape::Union(vec![a.clone(), b.clone()]);
        let meet = Shape::Intersection(vec![a.clone(), b.clone()]);
        let rest = Shape::Difference(Box::new(a), vec![b]);
        assert_eq!([only_a, both, neither].map(|x| union.contains(x)), [true, true, false]);
        assert_eq!([only_a, both, neither].map(|x| meet.contains(x)), [false, true, false]);
        assert_eq!([only_a, both, neither].map(|x| rest.contains(x)), [true, false, false]);
        assert_eq!(rest.distance(only_a), -0.5);
        assert_eq!(meet.bounds().extent(), [1.0, 1.0, 0.0]);
        assert_eq!(union.bounds().extent(), [3.0, 3.0, 0.0]);
        assert_eq!(rest.bounds().extent(), [2.0, 2.0, 0.0]);
    }

    #[test]
    fn a_ring_is_measured_to_the_nearer_circle() {
        let ring = Shape::Ring { center: [1.0, 0.0, 0.0], inner: 3.0, outer: 4.0 };
        assert_eq!(ring.distance([1.0, 0.0, 0.0]), 3.0);
        assert_eq!(ring.distance([4.25, 0.0, 0.0]), -0.25);
        assert_eq!(ring.distance([1.0, 6.0, 0.0]), 2.0);
        assert_eq!(ring.bounds().extent(), [8.0; 3]);
    }

    #[test]
    fn motions_carry_distance_and_bounds() {
        let moved = Shape::Translate { by: [10.0, 0.0, 0.0], shape: Box::new(square(0.0, 1.0)) };
        assert_eq!(moved.distance([10.5, 3.0, 0.0]), 2.0);
        let large = Shape::Scale { factor: 4.0, about: [10.0, 0.0, 0.0], shape: Box::new(moved) };
        assert_eq!(large.distance([12.0, 5.0, 0.0]), 1.0);
        assert_eq!(large.bounds().max, [14.0, 4.0, 0.0]);
        let turned = Shape::Rotate {
            angle: PI / 2.0,
            axis: [0.0, 0.0, 1.0],
            about: [10.0, 0.0, 0.0],
            shape: Box::new(large),
        };
        // cos(pi/2) is 6e-17 in f64, times coordinates of order 10
        assert!((turned.distance([5.0, 2.0, 0.0]) - 1.0).abs() < 1e-14);
        assert!((turned.bounds().min[0] - 6.0).abs() < 1e-14);
    }
}
