//! How many particles lie across the thinnest part of a body.

use super::bodies::{Group, padded};
use super::shapes::{dimension, shape};
use crate::{Body, Case, Fill, ShapeSpec};
use taut::simulation::Point;

/// A part counts as thin if at least this share of the particles is in it: the last rows of something round do not.
const SHARE: f64 = 0.03;

/// Particles of a body that are asked how thick it is there, at most.
const SAMPLE: usize = 4000;

/// Particles across the thinnest part of each body, in the order of the case.
pub fn across<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Vec<usize> {
    let points = |body: usize| -> Vec<&Point<D>> {
        groups.iter().flat_map(|g| &g.points).filter(|p| p.body as usize == body).collect()
    };
    case.bodies.iter().enumerate().map(|(i, body)| of_body(case, body, &points(i))).collect()
}

fn of_body<const D: usize>(case: &Case, body: &Body, points: &[&Point<D>]) -> usize {
    match (&body.fill, wall(&body.shape)) {
        (Fill::Concentric, Some(wall)) => ((wall / case.spacing).round() as usize).max(1),
        (Fill::Fitted | Fill::Saved(_), _) => through(case, body, points),
        _ => on_lattice(points, case.spacing),
    }
}

/// From ways straight through the body, from particles at the surface: the smallest that a fair share of them has.
fn through<const D: usize>(case: &Case, body: &Body, points: &[&Point<D>]) -> usize {
    let shape = shape(&body.shape);
    let most = points.len() as f64 * case.spacing;
    let every = points.len().div_ceil(SAMPLE).max(1);
    let way =
        |p: &&Point<D>| geometry::thickness(&shape, padded(p.x), (case.spacing, most), dimension::<D>());
    let mut ways: Vec<f64> = points.iter().step_by(every).filter_map(way).collect();
    ways.sort_by(f64::total_cmp);
    let thin = ways.get((SHARE * ways.len() as f64) as usize).map_or(0.0, |way| way / case.spacing);
    (thin.round() as usize).clamp(1, points.len().max(1))
}

/// Thickness of the wall of a ring, or diameter of a ball, m.
fn wall(shape: &ShapeSpec) -> Option<f64> {
    match shape {
        ShapeSpec::Ball { radius, .. } => Some(2.0 * radius),
        ShapeSpec::Ring { inner, outer, .. } if *inner == 0.0 => Some(2.0 * outer),
        ShapeSpec::Ring { inner, outer, .. } => Some(outer - inner),
        ShapeSpec::Translate { shape, .. } | ShapeSpec::Rotate { shape, .. } => wall(shape),
        ShapeSpec::Scale { factor, shape, .. } => wall(shape).map(|w| w * factor),
        _ => None,
    }
}

/// Every particle is in a row along each axis; the shortest of its rows is its thickness, and the thinnest part is the smallest
/// thickness that a fair share of the particles has.
fn on_lattice<const D: usize>(points: &[&Point<D>], spacing: f64) -> usize {
    let Some(first) = points.first() else { return 0 };
    let cell = |p: &Point<D>| -> [i64; D] {
        std::array::from_fn(|k| ((p.x[k] - first.x[k]) / spacing).round() as i64)
    };
    let cells: Vec<[i64; D]> = points.iter().map(|p| cell(p)).collect();
    let mut shortest = vec![usize::MAX; cells.len()];
    let mut order: Vec<usize> = (0..cells.len()).collect();
    for axis in 0..D {
        let key = |i: usize| {
            let mut key = cells[i];
            key.swap(0, axis);
            key.rotate_left(1);
            key
        };
        order.sort_unstable_by_key(|&i| key(i));
        let next = |a: usize, b: usize| (0..D).all(|k| cells[b][k] - cells[a][k] == i64::from(k == axis));
        for row in order.chunk_by(|&a, &b| next(a, b)) {
            for &i in row {
                shortest[i] = shortest[i].min(row.len());
            }
        }
    }
    shortest.sort_unstable();
    shortest[(SHARE * shortest.len() as f64) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use taut::math::Vector;

    fn lattice<const D: usize>(inside: impl Fn([f64; D]) -> bool) -> usize {
        let range = |k: usize| if k < D { -15..15 } else { 0..1 };
        let mut points = Vec::new();
        for i in range(0) {
            for j in range(1) {
                for k in range(2) {
                    let x: [f64; D] = std::array::from_fn(|a| 0.1 * (f64::from([i, j, k][a]) + 0.5));
                    if inside(x) {
                        points.push(Point::at(Vector(x), 0.01));
                    }
                }
            }
        }
        on_lattice(&points.iter().collect::<Vec<_>>(), 0.1)
    }

    #[test]
    fn strips_frames_and_slabs() {
        assert_eq!(lattice::<2>(|[_, y]| y.abs() < 0.2), 4);
        assert_eq!(lattice::<2>(|[x, y]| x.abs().max(y.abs()) > 1.2), 3, "a frame");
        assert_eq!(lattice::<2>(|[x, y]| y.abs() < 0.1 || x < 0.0), 2, "a strip on a block");
        assert_eq!(lattice::<3>(|[_, _, z]| z.abs() < 0.25), 4);
        assert_eq!(lattice::<3>(|[x, _, _]| x.abs() < 0.05 + 1e-9), 2);
    }

    #[test]
    fn something_round_is_not_thin_at_its_poles() {
        assert!(lattice::<2>(|[x, y]| x * x + y * y < 1.4 * 1.4) >= 8);
        assert!(lattice::<3>(|[x, y, z]| x * x + y * y + z * z < 1.4 * 1.4) >= 6);
    }
}
