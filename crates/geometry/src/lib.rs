//! Shapes, their signed distances and combinations, and how they are filled with particles.
//!
//! Lengths are in metres and a point is always `[x, y, z]`. In 2D everything lies in the plane z = 0: coordinates
//! that a plane case leaves out are 0, and the two shapes that have faces across z lose them. A [`Shape::Box`]
//! whose corners have the same z is a rectangle and a [`Shape::Polygon`] without `height` is a plane polygon; both
//! extend without end along z, so that their distance depends on x and y alone. Balls and rings need no
//! such rule. [`Shape::validate`] holds a shape against the dimension it is meant for; the other methods
//! never panic, but what they return for a shape that fails it means nothing.
//!
//! ```
//! use geometry::{Dimension, Fill, Shape, fill};
//!
//! let ring = Shape::Ring { center: [0.0; 3], inner: 0.03, outer: 0.04 };
//! ring.validate(Dimension::Two)?;
//! assert!(ring.contains([0.035, 0.0, 0.0]) && !ring.contains([0.0; 3]));
//! assert_eq!(fill(&ring, &Fill::Concentric, 0.001, Dimension::Two)?.len(), 2199);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bounds;
mod distance;
mod fill;
mod measure;
mod mesh;
mod point;
mod polygon;
mod problem;
mod shape;
mod stent;
mod stl;
mod triangles;
mod validate;

pub use bounds::Bounds;
pub use fill::{Fill, FillError, Fit, MAX_PARTICLES, Points, Quality, fill, fit, reckon, thickness};
pub use mesh::{
    Crossings, Hole, MAX_COMPONENTS, MAX_TRIANGLES, Mended, Mesh, MeshError, MeshFormat, MeshReport, Thin,
};
pub use point::{Dimension, Point};
pub use problem::{ShapeError, ShapeProblem};
pub use shape::Shape;
pub use stent::Stent;
pub use stl::stl;
