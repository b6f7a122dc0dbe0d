//! Filling a shape with particles.

mod concentric;
mod fitted;
mod lattice;
mod reckon;

pub use fitted::{Fit, Quality, fit, thickness};
pub use reckon::reckon;

use crate::point::{Dimension, Point};
use crate::problem::ShapeError;
use crate::shape::Shape;

/// The largest number of particles, or of lattice cells to look at, that [`fill`] takes on.
pub const MAX_PARTICLES: usize = 1 << 31;

/// Particles: where they are and what each stands for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Points {
    /// Positions in metres.
    pub x: Vec<Point>,
    /// Volumes in m^3, in 2D areas in m^2; one per position.
    pub volume: Vec<f64>,
}

impl Points {
    /// The number of particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// The volume of all particles together, in m^3, in 2D m^2.
    pub fn total_volume(&self) -> f64 {
        self.volume.iter().sum()
    }
}

/// How particles are placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fill {
    /// On a square lattice along the axes, at the centres of its cells: `origin + (i + 1/2) spacing` for whole i,
    /// wherever that is inside the shape. Every particle has the volume of its cell.
    ///
    /// A particle on the surface (up to a millionth of the spacing) counts as inside on the lower faces of
    /// boxes and polygons and at the `from` end of cylinders, and as outside on the other faces and on round
    /// surfaces. So a box of n spacings holds n particles wherever it lies on the lattice, and a ball around
    /// a particle keeps its symmetry.
    ///
    /// The positions run through the axes in turn, fastest along the axis on which the shape is shortest and
    /// slowest along the longest; between axes of the same length x is faster than y, and y than z.
    Lattice {
        /// A corner of a cell. Particles in 2D have z = 0 whatever its z.
        origin: Point,
    },
    /// In layers around the centre of a ring or a ball, which may be moved, turned and magnified.
    ///
    /// The wall is cut into `m = round(wall / spacing)` layers of thickness `dr = wall / m`, from the inside out.
    /// In 2D layer k has the radius `r = inner + (k + 1/2) dr` and `round(2 pi r / spacing)` particles at equal
    /// angles, with every second layer shifted by half of that angle. In 3D it has the radius at which
    /// `4 pi r^2 dr` is its volume and `round(4 pi r^2 / spacing^2)` particles on a Fibonacci spiral.
    /// The particles of a layer share its exact volume. No particle sits at the centre of a ball.
    Concentric,
    /// Fitted to the surface: as many particles as the body has cells settle until the sum of V grad W, closed by the integral of grad W
    /// over the outside of the body, is next to nothing everywhere, while those at the surface stay half a spacing inside. All
    /// have the same volume, and together that of the body.
    Fitted,
    /// The layers of [`Fill::Concentric`] in 2D with as many particles each, one behind the other: row j at the angle
    /// `2 pi j / around`, with its exact sector of the layer. Particles are the farther apart the farther out they are.
    Polar {
        /// Particles of a layer, at least 3.
        around: usize,
        /// Layers; `None` for the wall over the spacing, rounded.
        rings: Option<usize>,
    },
}

/// Why a shape cannot be filled. Lengths in metres.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FillError {
    /// The shape describes no region.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The spacing is no length.
    #[error("the particle spacing is {0} m; it must be a finite length greater than 0")]
    Spacing(f64),
    /// The origin of the lattice is no point.
    #[error("the origin of the lattice is {0:?}; give finite coordinates")]
    Origin(Point),
    /// The spacing is too coarse for the shape, or the shape is empty.
    #[error(
        "no particle fits inside: the shape spans {} m and the spacing is {spacing:?} m; \
         choose a spacing well below the thinnest part",
        times(extent)
    )]
    Empty {
        /// The spacing.
        spacing: f64,
        /// The lengths of the bounds along each axis, 2 or 3.
        extent: Vec<f64>,
    },
    /// The spacing is too fine for the shape.
    #[error(
        "about {count:.3e} particles would be needed: the shape spans {} m and the spacing is {spacing:?} m; \
         the limit is {:.2e}, choose a larger spacing",
        times(extent), MAX_PARTICLES as f64
    )]
    TooMany {
        /// The estimated number; infinite if it exceeds the range of numbers.
        count: f64,
        /// The spacing.
        spacing: f64,
        /// The lengths of the bounds along each axis, 2 or 3.
        extent: Vec<f64>,
    },
    /// The shape lies so far from the origin that coordinates cannot tell particles apart.
    #[error(
        "the shape lies {distance:.3e} m from the origin of the lattice, too far for a spacing of {spacing:?} m; \
         move it closer"
    )]
    TooFar {
        /// The largest coordinate difference.
        distance: f64,
        /// The spacing.
        spacing: f64,
    },
    /// The shape has no centre.
    #[error(
        "a {0} cannot be filled in layers: only a ring or a ball can (moved, turned, magnified); use a lattice"
    )]
    NotConcentric(&'static str),
    /// A polar layout in space.
    #[error("rings of as many particles are for two dimensions; in three use layers or a lattice")]
    Polar,
    /// Too few particles around.
    #[error("a ring of {0} particles does not close; take at least 3")]
    Around(usize),
}

/// The lengths to four digits, with ` x ` between them.
fn times(extent: &[f64]) -> String {
    let short = |length: &f64| format!("{length:.3e}").parse().unwrap_or(*length);
    extent.iter().map(|length| format!("{:?}", short(length))).collect::<Vec<_>>().join(" x ")
}

/// Fills `shape` with particles about `spacing` metres apart.
///
/// The result depends on the arguments only, in their order and to the last bit.
///
/// # Errors
/// See [`FillError`]; the number of particles is estimated before memory is taken for them.
pub fn fill(shape: &Shape, how: &Fill, spacing: f64, dimension: Dimension) -> Result<Points, FillError> {
    checked(shape, spacing, dimension)?;
    match *how {
        Fill::Lattice { origin } => lattice::lattice(shape, origin, spacing, dimension),
        Fill::Concentric => concentric::concentric(shape, spacing, dimension),
        Fill::Fitted => fitted::fitted(shape, spacing, dimension),
        Fill::Polar { around, rings } => concentric::polar(shape, (around, rings), spacing, dimension),
    }
}

/// Refuses what is no spacing and no shape.
fn checked(shape: &Shape, spacing: f64, dimension: Dimension) -> Result<(), FillError> {
    if !(spacing.is_finite() && spacing > 0.0) {
        return Err(FillError::Spacing(spacing));
    }
    Ok(shape.validate(dimension)?)
}

/// The farthest that a particle may be from the origin of the lattice or of space, in spacings: 1e9 times
/// the relative rounding 1.1e-16 is 1e-7.
const REACH: f64 = 1e9;

/// Refuses shapes that are too far away.
fn near_enough(shape: &Shape, origin: Point, spacing: f64, dimension: Dimension) -> Result<(), FillError> {
    let bounds = shape.bounds();
    let farthest = (0..dimension.axes())
        .flat_map(|i| [bounds.min[i], bounds.max[i], bounds.min[i] - origin[i], bounds.max[i] - origin[i]])
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    if farthest > REACH * spacing {
        return Err(FillError::TooFar { distance: farthest, spacing });
    }
    Ok(())
}

/// The lengths of the bounds along the axes of the dimension.
fn extent(shape: &Shape, dimension: Dimension) -> Vec<f64> {
    shape.bounds().extent()[..dimension.axes()].to_vec()
}

/// Refuses counts above the limit, and those that overflowed on the way.
fn affordable(count: f64, shape: &Shape, spacing: f64, dimension: Dimension) -> Result<(), FillError> {
    if count <= MAX_PARTICLES as f64 {
        return Ok(());
    }
    let count = if count.is_nan() { f64::INFINITY } else { count };
    Err(FillError::TooMany { count, spacing, extent: extent(shape, dimension) })
}
