//! What can be wrong with a shape.

/// A shape that describes no region, and where it stands.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct ShapeError {
    /// The way from the outermost shape to the faulty one, such as `union[1].rotate.ring`. The first shape of a
    /// difference is `difference[0]`.
    pub path: String,
    /// What is wrong with it.
    pub problem: ShapeProblem,
}

/// What can be wrong with a shape. Lengths in metres.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ShapeProblem {
    /// A number is infinite or not a number.
    #[error("`{name}` is {value}; give a finite number")]
    NotFinite {
        /// The entry.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A point or a vector leaves the plane of a 2D case.
    #[error("`{name}` has z = {z}; in 2D leave z out or make it 0")]
    OutOfPlane {
        /// The entry.
        name: &'static str,
        /// Its z.
        z: f64,
    },
    /// A box or a prism ends before it begins.
    #[error("along {axis} it runs from {low} to {high}; the first must be smaller than the second")]
    Inverted {
        /// `x`, `y` or `z`.
        axis: char,
        /// The end that should be the lower one.
        low: f64,
        /// The end that should be the higher one.
        high: f64,
    },
    /// A radius or a factor is zero or negative.
    #[error("`{name}` is {value}; it must be greater than 0")]
    NotPositive {
        /// The entry.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The hole of a ring has no radius.
    #[error("`inner` is {0}; it must be greater than 0 (write a ball for a ring without a hole)")]
    NoHole(f64),
    /// The hole of a ring reaches its outside.
    #[error("`inner` = {inner} is not smaller than `outer` = {outer}; swap them or make the wall thicker")]
    NoWall {
        /// The radius of the hole.
        inner: f64,
        /// The radius of the outside.
        outer: f64,
    },
    /// Too few or too many parts of a kind.
    #[error("`{name}` is {count}; it must be from {least} to {most}")]
    Count {
        /// The entry.
        name: &'static str,
        /// Its value.
        count: usize,
        /// The fewest.
        least: usize,
        /// The most.
        most: usize,
    },
    /// A part is larger than what is left for it.
    #[error("`{name}` is {value}, and the other measures leave room for less than {room}")]
    NoRoom {
        /// The entry.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be smaller than.
        room: f64,
    },
    /// A cylinder has both ends at the same point.
    #[error("`from` and `to` are the same point; move them apart by the length of the cylinder")]
    NoLength,
    /// A shape of space in a plane case.
    #[error("it exists in 3D only; in 2D use a ball for a disc, a box for a bar or a polygon")]
    OnlyInSpace,
    /// A mesh in a plane case.
    #[error("a mesh of triangles exists in 3D only; in 2D draw its section as a polygon")]
    MeshInPlane,
    /// An axis without direction.
    #[error("`axis` is zero; give a direction, such as [0, 0, 1]")]
    NoAxis,
    /// A rotation that leaves the plane.
    #[error("`axis` leaves the z axis; in 2D shapes turn within the plane: leave it out or use [0, 0, 1]")]
    AxisInPlane,
    /// A union or an intersection of nothing.
    #[error("it has no shapes; list at least one")]
    Nothing,
    /// Too few corners.
    #[error("it has {0} points; a polygon needs at least 3")]
    FewCorners(usize),
    /// Two corners in a row at the same place.
    #[error(
        "points {0} and {1} (counted from 0) are the same; the polygon closes itself, list each corner once"
    )]
    RepeatedCorner(usize, usize),
    /// Two edges that cross, touch or fold back.
    #[error(
        "the edges that leave points {0} and {1} (counted from 0) meet; list the corners around the boundary"
    )]
    Crossing(usize, usize),
    /// All corners on a line.
    #[error("its points lie on a line, so that it has no area")]
    NoArea,
    /// A plane polygon in a case of space.
    #[error("it has no `height`; in 3D give [lowest, highest] z")]
    NoHeight,
    /// A prism in a plane case.
    #[error("`height` is for 3D; leave it out in 2D")]
    HeightInPlane,
}
