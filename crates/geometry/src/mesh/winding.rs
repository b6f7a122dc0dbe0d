//! The generalised winding number (Jacobson et al. 2013): how often a surface goes around a point, 1 inside of a closed one and 0
//! outside; for one with gaps something between. Summed over a tree, with far triangles as one dipole (Barill et al. 2018).

use super::surface::{area_vector, middle};
use super::tree::Tree;
use crate::bounds::Bounds;
use crate::point::{Point, add, dot, norm, scale, sub};
use std::f64::consts::PI;

/// From so many radii on, triangles are one dipole.
const FAR: f64 = 3.0;

/// Triangles seen from afar.
#[derive(Debug, Clone, Copy)]
struct Dipole {
    /// Their middle, weighted by area.
    centre: Point,
    /// The sum of their areas, along their normals.
    area: Point,
    /// No corner is further from the middle.
    radius: f64,
}

/// A dipole for every node of a tree.
#[derive(Debug, Clone)]
pub(super) struct Dipoles(Vec<Dipole>);

impl Dipoles {
    pub fn new(tree: &Tree) -> Self {
        let mut sums = vec![([0.0; 3], [0.0; 3], 0.0); tree.nodes.len()];
        // Children stand behind their parents.
        for (at, node) in tree.nodes.iter().enumerate().rev() {
            sums[at] = if node.child > 0 {
                let [a, b] = [node.child, node.child + 1].map(|child| sums[child as usize]);
                (add(a.0, b.0), add(a.1, b.1), a.2 + b.2)
            } else {
                let part = |corners: &[Point; 3]| {
                    let area = scale(area_vector(*corners), 0.5);
                    (area, scale(middle(corners), norm(area)), norm(area))
                };
                let join = |a: (Point, Point, f64), b: (Point, Point, f64)| {
                    (add(a.0, b.0), add(a.1, b.1), a.2 + b.2)
                };
                tree.leaf(node).map(|(_, corners)| part(corners)).fold(([0.0; 3], [0.0; 3], 0.0), join)
            };
        }
        let dipole = |(&(area, moment, size), bounds): (&(Point, Point, f64), &Bounds)| {
            let centre =
                if size > 0.0 { scale(moment, 1.0 / size) } else { middle(&[bounds.min, bounds.max]) };
            let reach = |i: usize| (bounds.max[i] - centre[i]).max(centre[i] - bounds.min[i]);
            Dipole { centre, area, radius: norm([reach(0), reach(1), reach(2)]) }
        };
        Self(sums.iter().zip(tree.nodes.iter().map(|node| &node.bounds)).map(dipole).collect())
    }

    /// The winding number at `x`.
    pub fn winding(&self, tree: &Tree, x: Point) -> f64 {
        let mut waiting = [0_u32; super::tree::DEEPEST];
        let (mut count, mut angle) = (1, 0.0);
        while count > 0 {
            count -= 1;
            let at = waiting[count] as usize;
            let (node, dipole) = (&tree.nodes[at], &self.0[at]);
            let way = sub(dipole.centre, x);
            let squared = dot(way, way);
            if squared > (FAR * dipole.radius).powi(2) {
                angle += dot(dipole.area, way) / (squared * squared.sqrt());
            } else if node.child > 0 {
                [waiting[count], waiting[count + 1]] = [node.child, node.child + 1];
                count += 2;
            } else {
                angle += tree.leaf(node).map(|(_, corners)| solid_angle(corners, x)).sum::<f64>();
            }
        }
        angle / (4.0 * PI)
    }
}

/// The solid angle of a triangle seen from `x`, positive from behind (van Oosterom and Strackee 1983).
fn solid_angle(corners: &[Point; 3], x: Point) -> f64 {
    let [a, b, c] = corners.map(|corner| sub(corner, x));
    let [la, lb, lc] = [a, b, c].map(norm);
    let volume = dot(a, super::surface::cross(b, c));
    let denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * volume.atan2(denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::surface::Surface;

    /// A sphere of radius 1, n triangles around it; every `skip`-th is missing.
    fn sphere(n: u32, skip: usize) -> Tree {
        let point = |i: u32, j: u32| {
            let (a, b) = (PI * f64::from(i) / f64::from(n), 2.0 * PI * f64::from(j % n) / f64::from(n));
            [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]
        };
        let mut surface = Surface::default();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            let pair = [[a, b, c], [a, c, d]].into_iter().filter(|t| norm(area_vector(*t)) > 1e-9);
            pair.for_each(|corners| surface.push(corners).unwrap());
        }
        let mut kept = (0..).map(|index: usize| skip == 0 || !index.is_multiple_of(skip));
        surface.faces.retain(|_| kept.next().unwrap_or(true));
        Tree::new(&surface)
    }

    #[test]
    fn dipoles_agree_with_the_sum_over_all_triangles() {
        for skip in [0, 7, 2] {
            let tree = sphere(40, skip);
            let dipoles = Dipoles::new(&tree);
            for k in 0..200 {
                let x = [
                    0.011 * f64::from(k) - 1.0,
                    0.3 * f64::from(k % 7) - 1.0,
                    0.17 * f64::from(k % 11) - 1.0,
                ];
                let all: f64 = tree.corners.iter().map(|corners| solid_angle(corners, x)).sum();
                // A dipole errs by the second moment of its triangles over the distance, (radius/distance)^2 = 1/9 of
                // its part of the angle, with either sign; a twentieth of a turn of all together is far from deciding.
                let error = dipoles.winding(&tree, x) - all / (4.0 * PI);
                assert!(error.abs() < 0.05, "{error} at {x:?}");
            }
        }
    }

    #[test]
    fn closed_is_a_whole_number_and_half_a_sphere_is_half_at_its_middle() {
        let tree = sphere(40, 0);
        let dipoles = Dipoles::new(&tree);
        assert!((dipoles.winding(&tree, [0.1, 0.2, 0.3]) - 1.0).abs() < 0.02);
        assert!(dipoles.winding(&tree, [2.0, 1.0, 0.5]).abs() < 0.02);
        let half = sphere(40, 2);
        assert!((Dipoles::new(&half).winding(&half, [0.0; 3]) - 0.5).abs() < 0.05);
    }
}
