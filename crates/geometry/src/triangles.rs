//! Surfaces of boxes and round shapes as triangles.

use crate::bounds::Bounds;
use crate::point::{Point, add, norm, scale, sub, unit};
use std::f64::consts::PI;

/// Corners around: chords are (pi/96)^2/2 = 5e-4 of the radius inside of their circle.
const AROUND: usize = 96;

/// The faces of a box, counterclockwise from outside, by its corners (bit k of a corner: at the upper end of axis k).
const FACES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Two triangles of each face.
pub(crate) fn cuboid(min: Point, max: Point) -> Vec<[Point; 3]> {
    let corners = Bounds { min, max }.corners();
    FACES
        .iter()
        .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]])
        .map(|t| t.map(|k| corners[k]))
        .collect()
}

/// A ball from half circles.
pub(crate) fn ball(center: Point, radius: f64) -> Vec<[Point; 3]> {
    let half = AROUND / 2;
    let along = |k: usize| match k {
        0 => [0.0, -radius],
        _ if k == half => [0.0, radius],
        _ => {
            let (sin, cos) = (PI * k as f64 / half as f64).sin_cos();
            [radius * sin, -radius * cos]
        }
    };
    turned(center, [0.0, 0.0, 1.0], &(0..=half).map(along).collect::<Vec<_>>())
}

/// What lies between two spheres: the inner one looks into the hole.
pub(crate) fn hollow(center: Point, inner: f64, outer: f64) -> Vec<[Point; 3]> {
    let hole = ball(center, inner).into_iter().map(|[a, b, c]| [a, c, b]);
    ball(center, outer).into_iter().chain(hole.filter(|_| inner > 0.0)).collect()
}

/// A cylinder; nothing without a length.
pub(crate) fn cylinder([from, to]: [Point; 2], radius: f64) -> Vec<[Point; 3]> {
    let way = sub(to, from);
    let Some(axis) = unit(way) else { return Vec::new() };
    let length = norm(way);
    turned(from, axis, &[[0.0, 0.0], [radius, 0.0], [radius, length], [0.0, length]])
}

/// A line of points [distance from the axis, place along it], which begins and ends on the axis, turned around it.
fn turned(origin: Point, axis: Point, line: &[[f64; 2]]) -> Vec<[Point; 3]> {
    let [a, b, c] = axis;
    let aside = unit(if a.abs() + b.abs() > c.abs() { [-b, a, 0.0] } else { [0.0, c, -b] })
        .unwrap_or([1.0, 0.0, 0.0]);
    let third = [b * aside[2] - c * aside[1], c * aside[0] - a * aside[2], a * aside[1] - b * aside[0]];
    let point = |[r, z]: [f64; 2], j: usize| {
        let (sin, cos) = (2.0 * PI * (j % AROUND) as f64 / AROUND as f64).sin_cos();
        let out = add(scale(aside, r * cos), scale(third, r * sin));
        add(add(origin, scale(axis, z)), out)
    };
    let strip = |ends: &[[f64; 2]], j: usize| {
        let [p, q] = [ends[0], ends[1]];
        let lower = [point(p, j), point(p, j + 1), point(q, j + 1)];
        let upper = [point(p, j), point(q, j + 1), point(q, j)];
        [(p[0] > 0.0).then_some(lower), (q[0] > 0.0).then_some(upper)].into_iter().flatten()
    };
    line.windows(2).flat_map(|ends| (0..AROUND).flat_map(move |j| strip(ends, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mesh, Shape, stl};

    #[test]
    fn surfaces_are_closed_and_enclose_the_shape() {
        let (center, ends) = ([1.0, 2.0, 3.0], [[1.0, 0.0, 0.0], [2.0, 2.0, 2.0]]);
        let sphere = |radius: f64| 4.0 / 3.0 * PI * radius.powi(3);
        for (shape, volume) in [
            (Shape::Box { min: [0.0; 3], max: [1.0, 2.0, 3.0] }, 6.0),
            (Shape::Ball { center, radius: 1.5 }, sphere(1.5)),
            (Shape::Ring { center, inner: 0.5, outer: 1.0 }, sphere(1.0) - sphere(0.5)),
            (Shape::Cylinder { from: ends[0], to: ends[1], radius: 0.5 }, PI * 0.25 * 3.0),
        ] {
            let surface = shape.surface().unwrap();
            let report = Mesh::read(&stl(&surface), "a.stl", 1.0).unwrap().0.report();
            assert!(report.is_closed() && report.mended.turned == 0, "{} {report:?}", shape.name());
            // Circles of n chords have 2/3 (pi/n)^2 less area; balls have it twice. Single precision is 1e-7.
            let less = 1.0 - report.volume / volume;
            assert!((-1e-6..2.0 * (PI / AROUND as f64).powi(2)).contains(&less), "{} {less:e}", shape.name());
            // Again from the mesh, triangle by triangle.
            let mesh = Shape::Mesh(Mesh::read(&stl(&surface), "a.stl", 1.0).unwrap().0);
            assert_eq!(mesh.surface().unwrap().len(), surface.len());
        }
    }
}
