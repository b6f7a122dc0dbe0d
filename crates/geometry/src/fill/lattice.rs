//! Particles at the cell centres of a lattice along the axes.

use super::{FillError, Points, affordable, extent, near_enough};
use crate::point::{Dimension, Point, Turn, add, scale, stretch, sub, unit};
use crate::shape::Shape;

/// Within this share of the spacing a particle counts as on the surface. Far above the rounding of coordinates,
/// which the reach keeps below 1e-7 spacings, and far below what a discretisation can resolve.
const ON_SURFACE: f64 = 1e-6;

pub(super) fn lattice(
    shape: &Shape,
    origin: Point,
    spacing: f64,
    dimension: Dimension,
) -> Result<Points, FillError> {
    if origin.iter().any(|x| !x.is_finite()) {
        return Err(FillError::Origin(origin));
    }
    let axes = axes(shape, origin, spacing, dimension)?;
    let x = inside(shape, &axes, order(shape, spacing, dimension), ON_SURFACE * spacing);
    if x.is_empty() {
        return Err(FillError::Empty { spacing, extent: extent(shape, dimension) });
    }
    let volume = vec![spacing.powi(dimension.axes() as i32); x.len()];
    Ok(Points { x, volume })
}

/// The coordinates of the cell centres along each axis, from below the bounds to above; in 2D just z = 0.
fn axes(
    shape: &Shape,
    origin: Point,
    spacing: f64,
    dimension: Dimension,
) -> Result<[Vec<f64>; 3], FillError> {
    let bounds = shape.bounds();
    let mut range = [[0.0_f64; 2]; 3];
    let mut cells = 1.0;
    for i in 0..dimension.axes() {
        let first = ((bounds.min[i] - origin[i]) / spacing).floor() - 1.0;
        let last = ((bounds.max[i] - origin[i]) / spacing).ceil() + 1.0;
        range[i] = [first, last];
        cells *= last - first;
    }
    affordable(cells, shape, spacing, dimension)?;
    near_enough(shape, origin, spacing, dimension)?;
    let centres = |i: usize| match dimension {
        Dimension::Two if i == 2 => vec![0.0],
        _ => (range[i][0] as i64..range[i][1] as i64)
            .map(|cell| origin[i] + (cell as f64 + 0.5) * spacing)
            .collect(),
    };
    Ok(std::array::from_fn(centres))
}

/// The axes from the fastest to the slowest: by length in whole cells, so that rounding cannot change the order.
fn order(shape: &Shape, spacing: f64, dimension: Dimension) -> [usize; 3] {
    let mut cells: Vec<f64> =
        extent(shape, dimension).iter().map(|length| (length / spacing).round()).collect();
    cells.resize(3, 0.0);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| cells[i].total_cmp(&cells[j]));
    order
}

fn inside(
    shape: &Shape,
    axes: &[Vec<f64>; 3],
    [fast, middle, slow]: [usize; 3],
    on_surface: f64,
) -> Vec<Point> {
    let mut x = Vec::new();
    let mut centre = [0.0; 3];
    for &c in &axes[slow] {
        centre[slow] = c;
        for &b in &axes[middle] {
            centre[middle] = b;
            for &a in &axes[fast] {
                centre[fast] = a;
                if owns(shape, centre, on_surface) {
                    x.push(centre);
                }
            }
        }
    }
    x
}

/// Whether a particle at `x` belongs to the shape, with a rule for those within `near` of its surface: flat faces
/// own them on the lower side only, round surfaces not at all.
fn owns(shape: &Shape, x: Point, near: f64) -> bool {
    match shape {
        Shape::Box { .. } | Shape::Polygon { .. } | Shape::Mesh(_) => shape.contains(x.map(|c| c + near)),
        Shape::Ball { .. } | Shape::Ring { .. } | Shape::Stent(_) => shape.distance(x) < -near,
        Shape::Cylinder { from, to, radius } => {
            let forward = scale(unit(sub(*to, *from)).unwrap_or([0.0; 3]), near);
            Shape::Cylinder { from: *from, to: *to, radius: radius - near }.contains(add(x, forward))
        }
        Shape::Union(shapes) => shapes.iter().any(|s| owns(s, x, near)),
        Shape::Intersection(shapes) => shapes.iter().all(|s| owns(s, x, near)),
        Shape::Difference(shape, cuts) => owns(shape, x, near) && !cuts.iter().any(|s| owns(s, x, near)),
        Shape::Translate { by, shape } => owns(shape, sub(x, *by), near),
        Shape::Rotate { angle, axis, about, shape } => {
            owns(shape, Turn { angle: -angle, axis: *axis, about: *about }.apply(x), near)
        }
        Shape::Scale { factor, about, shape } => owns(shape, stretch(x, *about, 1.0 / factor), near / factor),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fill::{Fill, fill};
    use Dimension::{Three, Two};
    use std::collections::BTreeSet;

    fn rectangle(min: [f64; 2], max: [f64; 2]) -> Shape {
        Shape::Box { min: [min[0], min[1], 0.0], max: [max[0], max[1], 0.0] }
    }

    fn count(shape: &Shape, origin: Point, spacing: f64, dimension: Dimension) -> usize {
        fill(shape, &Fill::Lattice { origin }, spacing, dimension).map_or(0, |p| p.len())
    }

    #[test]
    fn a_clamped_plate_has_the_expected_counts() {
        let (height, length) = (0.02, 0.2);
        for (n, expected) in [(10, 1612), (20, 5792), (30, 12572), (40, 21952)] {
            let dp = height / f64::from(n);
            let half = height / 2.0;
            let grip = rectangle([-0.06 - 4.0 * dp, -half - 4.0 * dp], [0.0, half + 4.0 * dp]);
            let plate = Shape::Union(vec![grip, rectangle([-0.06, -half], [length, half])]);
            assert_eq!(count(&plate, [0.0, -half, 0.0], dp, Two), expected);
            assert_eq!(count(&plate, [0.0; 3], dp, Two), expected);
        }
    }

    #[test]
    fn n_spacings_hold_n_particles_wherever_the_box_lies() {
        for n in [1, 3, 7, 10, 11, 13, 30, 49] {
            let dp = 0.2 / f64::from(n);
            for shift in [0.0, 0.5, 0.25, 17.5, -1000.0] {
                let low = 0.1 + shift * dp;
                let square = rectangle([low, low], [low + 0.2, low + 0.2]);
                assert_eq!(count(&square, [0.1, 0.1, 0.0], dp, Two), (n * n) as usize, "{n} {shift}");
            }
        }
        let bar = Shape::Box { min: [0.0; 3], max: [0.02, 0.02, 0.06] };
        assert_eq!(count(&bar, [0.0; 3], 0.02 / 7.0, Three), 7 * 7 * 21);
    }

    #[test]
    fn a_turned_box_keeps_its_count() {
        let dp = 0.2 / 7.0;
        for quarters in 1..4 {
            let angle = f64::from(quarters) * std::f64::consts::FRAC_PI_2;
            let shape = Box::new(rectangle([0.0, 0.0], [0.2, 0.4]));
            let turned = Shape::Rotate { angle, axis: [0.0, 0.0, 1.0], about: [0.1, 0.1, 0.0], shape };
            assert_eq!(count(&turned, [0.0; 3], dp, Two), 7 * 14);
            assert_eq!(count(&turned, [dp / 2.0, dp / 2.0, 0.0], dp, Two), 7 * 14);
        }
    }

    #[test]
    fn a_ball_around_a_particle_is_symmetric() {
        let ball = Shape::Ball { center: [0.0; 3], radius: 5.0 };
        let points = fill(&ball, &Fill::Lattice { origin: [0.5; 3] }, 1.0, Two).unwrap();
        assert!(points.x.contains(&[4.0, 0.0, 0.0]) && points.x.contains(&[3.0, 3.0, 0.0]));
        assert!(!points.x.contains(&[5.0, 0.0, 0.0]) && !points.x.contains(&[3.0, 4.0, 0.0]));
        assert!(points.x.iter().all(|x| points.x.contains(&[-x[0], x[1], 0.0])));
        assert!(points.x.iter().all(|x| points.x.contains(&[x[1], -x[0], 0.0])));
    }

    #[test]
    fn a_cylinder_of_n_spacings_has_n_layers() {
        let cylinder = Shape::Cylinder { from: [0.0, 0.0, 0.9], to: [0.0; 3], radius: 0.31 };
        for n in [7, 8, 9, 10, 11] {
            let dp = 0.9 / f64::from(n);
            for origin in [[0.0; 3], [0.0, 0.0, dp / 2.0]] {
                let x = fill(&cylinder, &Fill::Lattice { origin }, dp, Three).unwrap().x;
                let layers: BTreeSet<i64> = x.iter().map(|x| (x[2] / dp * 2.0).round() as i64).collect();
                assert_eq!(layers.len(), n as usize);
            }
        }
    }

    #[test]
    fn a_box_drawn_in_micrometres_keeps_its_count() {
        for n in 1..40 {
            let drawn = Box::new(rectangle([0.1, 0.1], [0.3, 0.5]));
            let shape = Shape::Scale { factor: 1e-6, about: [0.0; 3], shape: drawn };
            let dp = 0.2e-6 / f64::from(n);
            let origin = [0.1e-6 + dp / 2.0, 0.1e-6 + dp / 2.0, 0.0];
            assert_eq!(count(&shape, origin, dp, Two), (2 * n * n) as usize);
        }
    }

    #[test]
    fn the_shortest_axis_runs_fastest() {
        let bar = Shape::Box { min: [0.0; 3], max: [2.0, 3.0, 1.0] };
        let x = fill(&bar, &Fill::Lattice { origin: [0.0; 3] }, 1.0, Three).unwrap().x;
        let expected = [
            [0.5, 0.5, 0.5],
            [1.5, 0.5, 0.5],
            [0.5, 1.5, 0.5],
            [1.5, 1.5, 0.5],
            [0.5, 2.5, 0.5],
            [1.5, 2.5, 0.5],
        ];
        assert_eq!(x, expected);
        let plate =
            fill(&rectangle([0.0; 2], [2.0; 2]), &Fill::Lattice { origin: [0.0; 3] }, 1.0, Two).unwrap().x;
        assert_eq!(plate, [[0.5, 0.5, 0.0], [1.5, 0.5, 0.0], [0.5, 1.5, 0.0], [1.5, 1.5, 0.0]]);
    }

    #[test]
    fn what_cannot_be_filled_says_why() {
        let plate = rectangle([0.0; 2], [0.2, 0.02]);
        let error = |spacing, origin| fill(&plate, &Fill::Lattice { origin }, spacing, Two).unwrap_err();
        assert_eq!(error(0.0, [0.0; 3]), FillError::Spacing(0.0));
        assert!(matches!(error(f64::NAN, [0.0; 3]), FillError::Spacing(_)));
        assert!(matches!(error(0.01, [f64::NAN, 0.0, 0.0]), FillError::Origin(_)));
        assert!(matches!(error(0.1, [0.0; 3]), FillError::Empty { .. }));
        assert!(matches!(error(1e-9, [0.0; 3]), FillError::TooMany { .. }));
        assert!(
            matches!(error(1e-320, [0.0; 3]), FillError::TooMany { count, .. } if count == f64::INFINITY)
        );
        assert!(matches!(error(0.001, [1e8, 0.0, 0.0]), FillError::TooFar { .. }));
        let message = error(0.1, [0.0; 3]).to_string();
        assert!(message.contains("spans 0.2 x 0.02 m") && message.contains("spacing is 0.1 m"), "{message}");
        let message = error(1e-6, [0.0; 3]).to_string();
        assert!(message.contains("4.000e9") && message.contains("limit is 2.15e9"), "{message}");
    }
}
