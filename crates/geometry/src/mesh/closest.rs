//! The point of a triangle that is nearest to a point.

use super::surface::{area_vector, cross};
use crate::point::{Point, add, dot, scale, sub};

/// What of a triangle a point lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Its inside.
    Face,
    /// The edge from this corner to the next.
    Edge(u8),
    /// This corner.
    Corner(u8),
}

/// A point of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    pub x: Point,
    pub part: Part,
}

/// The point of the triangle nearest to `x`: over the inside if the foot of the perpendicular falls there, else on an edge that has
/// the foot on its outer side. `None` if it is seen early that its squared distance is not below `least`.
pub(super) fn foot(corners: &[Point; 3], x: Point, least: f64) -> Option<Foot> {
    let [a, b, c] = *corners;
    let n = area_vector(*corners);
    let size = dot(n, n);
    let way = sub(x, a);
    let above = dot(way, n);
    if size > 0.0 && above * above >= least * size {
        return None;
    }
    // Areas of the triangles that x makes with the edges, as seen along the normal: all zero for a triangle without area.
    let part = |from: Point, to: Point| dot(cross(sub(to, from), sub(x, from)), n);
    let parts = [part(a, b), part(b, c), part(c, a)];
    if parts.iter().all(|&part| part > 0.0) {
        return Some(Foot { x: sub(x, scale(n, above / size)), part: Part::Face });
    }
    let mut best = Foot { x: a, part: Part::Corner(0) };
    let mut nearest = f64::INFINITY;
    for side in (0..3).filter(|&side| parts[side] <= 0.0) {
        let foot = on_edge(corners, side, x);
        let way = sub(foot.x, x);
        let squared = dot(way, way);
        if squared < nearest {
            (best, nearest) = (foot, squared);
        }
    }
    Some(best)
}

fn on_edge(corners: &[Point; 3], side: usize, x: Point) -> Foot {
    let next = (side + 1) % 3;
    let (from, to) = (corners[side], corners[next]);
    let edge = sub(to, from);
    let along = dot(sub(x, from), edge);
    let length = dot(edge, edge);
    if along <= 0.0 || length == 0.0 {
        Foot { x: from, part: Part::Corner(side as u8) }
    } else if along >= length {
        Foot { x: to, part: Part::Corner(next as u8) }
    } else {
        Foot { x: add(from, scale(edge, along / length)), part: Part::Edge(side as u8) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_the_inside_an_edge_and_a_corner() {
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let at = |x| foot(&corners, x, f64::INFINITY).unwrap();
        assert_eq!(at([1.0, 1.0, 5.0]), Foot { x: [1.0, 1.0, 0.0], part: Part::Face });
        assert_eq!(at([1.0, -1.0, 5.0]), Foot { x: [1.0, 0.0, 0.0], part: Part::Edge(0) });
        assert_eq!(at([3.0, 3.0, -1.0]), Foot { x: [2.0, 2.0, 0.0], part: Part::Edge(1) });
        assert_eq!(at([-1.0, 5.0, 0.0]), Foot { x: [0.0, 4.0, 0.0], part: Part::Corner(2) });
    }

    #[test]
    fn a_triangle_without_area_is_its_edges() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let at = |corners, x| foot(corners, x, f64::INFINITY).unwrap().x;
        assert_eq!(at(&corners, [2.0, 1.0, 0.0]), [2.0, 0.0, 0.0]);
        assert_eq!(at(&[[1.0; 3]; 3], [2.0, 1.0, 1.0]), [1.0; 3]);
    }

    #[test]
    fn what_is_too_far_by_its_plane_is_passed_over() {
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        assert_eq!(foot(&corners, [1.0, 1.0, 5.0], 24.9), None);
        assert!(foot(&corners, [1.0, 1.0, 5.0], 25.1).is_some());
    }
}
