//! Particles in layers around a centre.

use super::{FillError, Points, affordable, extent};
use crate::point::{Dimension, Point, Turn, add, stretch};
use crate::shape::Shape;
use std::f64::consts::PI;

/// The golden angle in radians: the turn from one particle of the spiral to the next.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

pub(super) fn polar(
    shape: &Shape,
    (around, rings): (usize, Option<usize>),
    spacing: f64,
    dimension: Dimension,
) -> Result<Points, FillError> {
    match dimension {
        Dimension::Three => Err(FillError::Polar),
        Dimension::Two if around < 3 => Err(FillError::Around(around)),
        Dimension::Two => layered(shape, (spacing, dimension, rings), |points, layer, _| {
            circle(points, layer, (around, 0.0))
        }),
    }
}

pub(super) fn concentric(shape: &Shape, spacing: f64, dimension: Dimension) -> Result<Points, FillError> {
    layered(shape, (spacing, dimension, None), |points, [below, above], (k, spacing)| match dimension {
        Dimension::Two => {
            let count = (PI * (below + above) / spacing).round().max(1.0) as usize;
            circle(points, [below, above], (count, if k % 2 == 1 { PI / count as f64 } else { 0.0 }));
        }
        Dimension::Three => sphere(points, [below, above], spacing),
    })
}

/// Layer by layer from the inside out: `place(points, radii, (number, spacing))`.
fn layered(
    shape: &Shape,
    (spacing, dimension, layers): (f64, Dimension, Option<usize>),
    place: impl Fn(&mut Points, [f64; 2], (usize, f64)),
) -> Result<Points, FillError> {
    let core = core(shape)?;
    let wall = Wall { inner: core.inner, outer: core.outer, spacing: spacing / core.factor };
    affordable(wall.estimate(dimension), shape, spacing, dimension)?;
    let layers = layers.unwrap_or_else(|| wall.layers());
    if layers == 0 {
        return Err(FillError::Empty { spacing, extent: extent(shape, dimension) });
    }
    let mut points = Points::default();
    for k in 0..layers {
        place(&mut points, wall.radii(k, layers), (k, wall.spacing));
    }
    let growth = core.factor.powi(dimension.axes() as i32);
    for (x, volume) in points.x.iter_mut().zip(&mut points.volume) {
        *x = placed(shape, add(core.center, *x));
        *volume *= growth;
    }
    Ok(points)
}

/// The ring or ball within the motions, and by how much they magnify it.
struct Core {
    center: Point,
    inner: f64,
    outer: f64,
    factor: f64,
}

fn core(shape: &Shape) -> Result<Core, FillError> {
    match shape {
        Shape::Ball { center, radius } => {
            Ok(Core { center: *center, inner: 0.0, outer: *radius, factor: 1.0 })
        }
        Shape::Ring { center, inner, outer } => {
            Ok(Core { center: *center, inner: *inner, outer: *outer, factor: 1.0 })
        }
        Shape::Translate { shape, .. } | Shape::Rotate { shape, .. } => core(shape),
        Shape::Scale { factor, shape, .. } => core(shape).map(|c| Core { factor: c.factor * factor, ..c }),
        _ => Err(FillError::NotConcentric(shape.name())),
    }
}

/// Where the motions take a point of the ring or ball.
fn placed(shape: &Shape, x: Point) -> Point {
    match shape {
        Shape::Translate { by, shape } => add(placed(shape, x), *by),
        Shape::Rotate { angle, axis, about, shape } => {
            Turn { angle: *angle, axis: *axis, about: *about }.apply(placed(shape, x))
        }
        Shape::Scale { factor, about, shape } => stretch(placed(shape, x), *about, *factor),
        _ => x,
    }
}

struct Wall {
    inner: f64,
    outer: f64,
    spacing: f64,
}

impl Wall {
    /// The volume in cells of the spacing. It bounds the number of layers too, whose count squared it exceeds.
    fn estimate(&self, dimension: Dimension) -> f64 {
        let (inner, outer) = (self.inner / self.spacing, self.outer / self.spacing);
        match dimension {
            Dimension::Two => PI * (outer - inner) * (outer + inner),
            Dimension::Three => {
                4.0 / 3.0 * PI * (outer - inner) * (outer * outer + outer * inner + inner * inner)
            }
        }
    }

    fn layers(&self) -> usize {
        ((self.outer - self.inner) / self.spacing).round() as usize
    }

    fn radii(&self, k: usize, layers: usize) -> [f64; 2] {
        let at = |k: usize| self.inner + (self.outer - self.inner) * (k as f64 / layers as f64);
        [at(k), at(k + 1)]
    }
}

/// So many particles on the circle midway through a layer, from the angle `start` on, each with its sector of the layer,
/// (r_above^2 - r_below^2)/2 dtheta.
fn circle(points: &mut Points, [below, above]: [f64; 2], (count, start): (usize, f64)) {
    let r = 0.5 * (below + above);
    let step = 2.0 * PI / count as f64;
    points.x.extend((0..count).map(|j| {
        let (sin, cos) = (start + j as f64 * step).sin_cos();
        [r * cos, r * sin, 0.0]
    }));
    let sector = 0.5 * (above - below) * (above + below) * step;
    points.volume.resize(points.x.len(), sector);
}

/// Particles on a sphere within a shell: equal steps of z and of the golden angle, from pole to pole. The
/// radius is where 4 pi r^2 dr = 4/3 pi (r_above^3 - r_below^3).
fn sphere(points: &mut Points, [below, above]: [f64; 2], spacing: f64) {
    let r2 = (above * above + above * below + below * below) / 3.0;
    let count = (4.0 * PI * r2 / (spacing * spacing)).round().max(1.0) as usize;
    let r = r2.sqrt();
    points.x.extend((0..count).map(|j| {
        let z = 1.0 - (2 * j + 1) as f64 / count as f64;
        let across = (1.0 - z * z).sqrt();
        let (sin, cos) = (j as f64 * GOLDEN_ANGLE).sin_cos();
        [r * across * cos, r * across * sin, r * z]
    }));
    let share = 4.0 * PI * r2 * (above - below) / count as f64;
    points.volume.resize(points.x.len(), share);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fill::{Fill, fill};
    use crate::point::{norm, sub};
    use Dimension::{Three, Two};

    fn ring(inner: f64, outer: f64) -> Shape {
        Shape::Ring { center: [0.0; 3], inner, outer }
    }

    fn filled(shape: &Shape, spacing: f64, dimension: Dimension) -> Points {
        fill(shape, &Fill::Concentric, spacing, dimension).unwrap()
    }

    /// Sums of a few thousand shares, each rounded at 1e-16.
    const SUM: f64 = 1e-12;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= SUM * b.abs()
    }

    fn least_distance(x: &[Point]) -> f64 {
        let others = |i: usize| x[..i].iter().map(move |y| norm(sub(x[i], *y)));
        (0..x.len()).flat_map(others).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_rubber_ring_has_2199_particles() {
        let points = filled(&ring(0.03, 0.04), 0.001, Two);
        assert_eq!(points.len(), 2199);
        assert!(close(points.total_volume(), PI * (0.04_f64.powi(2) - 0.03_f64.powi(2))));
        assert!(points.x.iter().all(|&x| ring(0.03, 0.04).distance(x) < -0.00049));
    }

    #[test]
    fn second_layers_are_shifted_by_half_a_step() {
        let points = filled(&ring(1.0, 1.2), 0.1, Two);
        let second = points.x.iter().position(|x| x[0].hypot(x[1]) > 1.1).unwrap();
        assert_eq!((second, points.len()), (66, 66 + 72));
        assert_eq!(points.x[0], [1.05, 0.0, 0.0]);
        let angle = points.x[second][1].atan2(points.x[second][0]);
        assert!(close(angle, PI / 72.0));
    }

    #[test]
    fn polar_rings_are_alike_and_have_their_sectors() {
        let (a, b) = (2.5e-4, 5e-4);
        let points = fill(&ring(a, b), &Fill::Polar { around: 36, rings: None }, 2.5e-5, Two).unwrap();
        assert_eq!(points.len(), 360);
        assert!(close(points.total_volume(), PI * (b * b - a * a)));
        for (i, (x, volume)) in points.x.iter().zip(&points.volume).enumerate() {
            let (k, j) = (i / 36, i % 36);
            let (r, angle) = (a + (k as f64 + 0.5) * 2.5e-5, j as f64 * PI / 18.0);
            assert!(norm(sub(*x, [r * angle.cos(), r * angle.sin(), 0.0])) < 1e-18);
            assert!(close(*volume, r * 2.5e-5 * PI / 18.0));
        }
        let error = |around, dimension| {
            fill(&ring(a, b), &Fill::Polar { around, rings: None }, 2.5e-5, dimension).unwrap_err()
        };
        assert_eq!((error(36, Three), error(2, Two)), (FillError::Polar, FillError::Around(2)));
    }

    #[test]
    fn volumes_add_up_to_the_body() {
        let ball = Shape::Ball { center: [1.0, 2.0, 0.0], radius: 0.5 };
        for spacing in [0.5, 0.11, 0.03] {
            assert!(close(filled(&ball, spacing, Two).total_volume(), PI * 0.25));
            assert!(close(filled(&ball, spacing, Three).total_volume(), PI / 6.0));
            assert!(close(filled(&ring(0.3, 1.0), spacing, Two).total_volume(), PI * 0.91));
            assert!(close(filled(&ring(0.3, 1.0), spacing, Three).total_volume(), 4.0 / 3.0 * PI * 0.973));
        }
    }

    #[test]
    fn particles_keep_their_distance_and_their_share() {
        // layers are 1 dp apart and particles within a layer about as much; along the spiral
        // neighbours come as close as 0.7 dp
        for (shape, dimension) in [(ring(0.3, 0.4), Two), (ring(0.15, 0.25), Three)] {
            let dp = 0.02;
            let points = filled(&shape, dp, dimension);
            assert!(least_distance(&points.x) > 0.7 * dp, "{}", least_distance(&points.x) / dp);
            let cell = dp.powi(dimension.axes() as i32);
            // rounding a count of 94 or more moves the share by half of 1/94 at most
            assert!(points.volume.iter().all(|v| (v / cell - 1.0).abs() < 0.006));
        }
    }

    #[test]
    fn a_moved_ring_is_the_same_ring_elsewhere() {
        let still = filled(&ring(0.06, 0.08), 0.002, Two);
        let half = Shape::Scale { factor: 2.0, about: [0.0; 3], shape: Box::new(ring(0.03, 0.04)) };
        let turned =
            Shape::Rotate { angle: 0.3, axis: [0.0, 0.0, 1.0], about: [0.0; 3], shape: Box::new(half) };
        let moved = Shape::Translate { by: [0.5, -0.25, 0.0], shape: Box::new(turned) };
        let there = filled(&moved, 0.002, Two);
        assert_eq!(still.len(), there.len());
        assert!(close(there.total_volume(), still.total_volume()));
        let (sin, cos) = 0.3_f64.sin_cos();
        for (a, b) in still.x.iter().zip(&there.x) {
            let expected = [cos * a[0] - sin * a[1] + 0.5, sin * a[0] + cos * a[1] - 0.25, 0.0];
            // coordinates below 1, a handful of roundings
            assert!(norm(sub(*b, expected)) < 1e-15);
        }
    }

    #[test]
    fn what_cannot_be_layered_says_why() {
        let error = |shape: &Shape, spacing| fill(shape, &Fill::Concentric, spacing, Two).unwrap_err();
        let union = Shape::Union(vec![ring(1.0, 2.0)]);
        assert_eq!(error(&union, 0.1), FillError::NotConcentric("union"));
        assert!(matches!(error(&ring(1.0, 1.1), 0.5), FillError::Empty { .. }));
        assert!(matches!(error(&ring(1.0, 2.0), 1e-6), FillError::TooMany { .. }));
        assert!(matches!(error(&ring(1.0, 2.0), 1e-320), FillError::TooMany { .. }));
        assert!(matches!(error(&ring(1.0, 2.0), -1.0), FillError::Spacing(_)));
        assert!(matches!(error(&ring(2.0, 1.0), 0.1), FillError::Shape(_)));
    }
}
