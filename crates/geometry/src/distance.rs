//! Signed distances of the primitives, all exact.

use crate::bounds::Bounds;
use crate::point::{Point, add, dot, norm, scale, sub, unit};
use crate::polygon;

/// To a box along the axes. Corners at the same z: to the rectangle's column along z.
pub(crate) fn cuboid(min: Point, max: Point, x: Point) -> f64 {
    let face = |i: usize| (min[i] - x[i]).max(x[i] - max[i]);
    if min[2] == max[2] { product([face(0), face(1)]) } else { product([face(0), face(1), face(2)]) }
}

/// To a sphere.
pub(crate) fn ball(center: Point, radius: f64, x: Point) -> f64 {
    norm(sub(x, center)) - radius
}

/// To a cylinder with flat ends.
pub(crate) fn cylinder(ends: [Point; 2], radius: f64, x: Point) -> f64 {
    let along = sub(ends[1], ends[0]);
    let Some(u) = unit(along) else { return f64::INFINITY };
    let v = sub(x, ends[0]);
    let t = dot(u, v);
    let r = norm(sub(v, scale(u, t)));
    product([r - radius, (-t).max(t - norm(along))])
}

/// The smallest box around a cylinder: a disc across `u` reaches `radius sqrt(1 - u_i^2)` along axis i.
pub(crate) fn cylinder_bounds(ends: [Point; 2], radius: f64) -> Bounds {
    let u = unit(sub(ends[1], ends[0])).unwrap_or([0.0; 3]);
    let reach = u.map(|c| radius * (1.0 - c * c).max(0.0).sqrt());
    Bounds::around(ends.iter().flat_map(|&end| [sub(end, reach), add(end, reach)]))
}

/// To a polygon, or to the prism over it between the two heights.
pub(crate) fn prism(points: &[[f64; 2]], height: Option<[f64; 2]>, x: Point) -> f64 {
    let side = polygon::distance(points, [x[0], x[1]]);
    height.map_or(side, |[low, high]| product([side, (low - x[2]).max(x[2] - high)]))
}

/// To the product of sets in orthogonal subspaces, from the distance to each: outside, by Pythagoras over those
/// that are positive; inside, to the nearest face.
fn product<const N: usize>(parts: [f64; N]) -> f64 {
    let outside = parts.iter().map(|d| d.max(0.0).powi(2)).sum::<f64>().sqrt();
    let inside = parts.iter().fold(f64::NEG_INFINITY, |m, &d| m.max(d)).min(0.0);
    outside + inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_by_hand() {
        let d = |x| cuboid([0.0; 3], [4.0, 4.0, 2.0], x);
        assert_eq!(d([2.0, 2.0, 0.5]), -0.5);
        assert_eq!(d([2.0, 4.0, 1.0]), 0.0);
        assert_eq!(d([7.0, 8.0, 1.0]), 5.0);
        assert_eq!(d([-1.0, -2.0, 4.0]), 3.0);
    }

    #[test]
    fn a_rectangle_has_no_face_across_z() {
        assert_eq!(cuboid([0.0; 3], [4.0, 2.0, 0.0], [1.5, 1.0, 0.0]), -1.0);
    }

    #[test]
    fn a_slanted_cylinder_by_hand() {
        let ends = [[0.0; 3], [3.0, 4.0, 0.0]];
        let d = |x| cylinder(ends, 1.0, x);
        // the axis (3, 4)/5 is not exact in f64: a few roundings of coordinates of order 10
        let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(close(d([1.5, 2.0, 0.0]), -1.0));
        assert!(close(d([1.5, 2.0, 3.0]), 2.0));
        assert!(close(d([-3.0, -4.0, 0.0]), 5.0));
        assert!(close(d([6.0, 8.0, 13.0]), 13.0));
        let bounds = cylinder_bounds(ends, 1.0);
        assert!(close(bounds.min[0], -0.8) && close(bounds.max[1], 4.6) && close(bounds.max[2], 1.0));
    }

    #[test]
    fn a_prism_by_hand() {
        let triangle = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
        assert_eq!(prism(&triangle, Some([0.0, 1.0]), [1.0, 1.0, 0.75]), -0.25);
        assert_eq!(prism(&triangle, Some([0.0, 1.0]), [1.0, -3.0, 5.0]), 5.0);
        assert_eq!(prism(&triangle, None, [1.0, 0.5, 0.0]), -0.5);
    }
}
