//! Shapes with all numbers resolved.

use geometry::Mesh;

/// A shape, in metres and radians. Points have three coordinates; the third is 0 in 2D and has no meaning there.
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeSpec {
    /// All points between two corners (in 2D: a rectangle).
    Box {
        /// Corner of the smallest coordinates.
        min: [f64; 3],
        /// Corner of the largest coordinates.
        max: [f64; 3],
    },
    /// All points within a distance (in 2D: a disc).
    Ball {
        /// Centre.
        center: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// All points between two circles (in 3D: between two spheres).
    Ring {
        /// Centre.
        center: [f64; 3],
        /// Inner radius, may be 0.
        inner: f64,
        /// Outer radius.
        outer: f64,
    },
    /// 3D: all points within a distance of a straight axis, with flat ends.
    Cylinder {
        /// Centre of one end.
        from: [f64; 3],
        /// Centre of the other end.
        to: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// A closed polygon (2D), or the prism above it (3D).
    Polygon {
        /// Corners x, y, at least three; the last is joined to the first.
        points: Vec<[f64; 2]>,
        /// Lowest and highest z of the prism; `None` in 2D.
        height: Option<[f64; 2]>,
    },
    /// 3D: a tube cut into cells.
    Stent(geometry::Stent),
    /// 3D: what the triangles of a file enclose.
    Mesh {
        /// The path, as the case says it.
        file: String,
        /// The body, in metres.
        mesh: Mesh,
    },
    /// Points in any of the shapes.
    Union(Vec<ShapeSpec>),
    /// Points in all of the shapes.
    Intersection(Vec<ShapeSpec>),
    /// Points in the first shape and in none of the others.
    Difference(Vec<ShapeSpec>),
    /// A shape, moved.
    Translate {
        /// How far.
        by: [f64; 3],
        /// What.
        shape: Box<ShapeSpec>,
    },
    /// A shape, turned.
    Rotate {
        /// By how much, rad, right-handed about the axis.
        angle: f64,
        /// The axis, of length 1; z in 2D.
        axis: [f64; 3],
        /// A point of the axis.
        about: [f64; 3],
        /// What.
        shape: Box<ShapeSpec>,
    },
    /// A shape, made larger or smaller.
    Scale {
        /// By how much, > 0.
        factor: f64,
        /// The point that stays.
        about: [f64; 3],
        /// What.
        shape: Box<ShapeSpec>,
    },
}
