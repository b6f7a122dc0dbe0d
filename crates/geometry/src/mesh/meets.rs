//! Where a surface meets itself.

use super::surface::{Surface, area_vector, cross};
use super::tree::Tree;
use crate::point::{Point, add, dot, norm, scale, sub};

/// Pairs of triangles that are compared at most; a surface that needs more is tangled.
const MOST: usize = 10_000_000;

/// Triangles no further apart than this share of the size of the mesh touch: a few roundings of coordinates of that size.
const TOUCHING: f64 = 1e-12;

/// Where a surface meets itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Crossings {
    /// Pairs of triangles that cross or touch without sharing what touches.
    pub pairs: usize,
    /// A point where one of them does.
    pub at: Option<Point>,
    /// Whether there were too many to look at all.
    pub tangled: bool,
}

/// Looks at all pairs of triangles whose boxes overlap.
pub(super) fn crossings(surface: &Surface, tree: &Tree) -> Crossings {
    let mut found = Crossings::default();
    let extent = tree.nodes[0].bounds.extent();
    let near = TOUCHING * norm(extent);
    let mut budget = MOST;
    let mut waiting = vec![(0_u32, 0_u32)];
    while let Some((a, b)) = waiting.pop() {
        if budget == 0 {
            return Crossings { tangled: true, ..found };
        }
        budget -= 1;
        let (one, other) = (&tree.nodes[a as usize], &tree.nodes[b as usize]);
        if !one.bounds.overlaps(&other.bounds.grown(near)) {
            continue;
        }
        match (one.child, other.child) {
            (0, 0) => {
                for (i, _) in tree.leaf(one) {
                    for (j, _) in tree.leaf(other).filter(|&(j, _)| a != b || i < j) {
                        budget = budget.saturating_sub(1);
                        if let Some(x) = pair(surface, tree, [i, j], near) {
                            found.pairs += 1;
                            found.at.get_or_insert(x);
                        }
                    }
                }
            }
            (child, _) if a == b => {
                waiting.extend([(child, child), (child + 1, child + 1), (child, child + 1)])
            }
            (0, child) => waiting.extend([(a, child), (a, child + 1)]),
            (child, 0) => waiting.extend([(child, b), (child + 1, b)]),
            (child, _) if one.range.len() >= other.range.len() => {
                waiting.extend([(child, b), (child + 1, b)])
            }
            (_, child) => waiting.extend([(a, child), (a, child + 1)]),
        }
    }
    found
}

/// A point where two triangles meet, other than at what they share.
fn pair(surface: &Surface, tree: &Tree, places: [usize; 2], near: f64) -> Option<Point> {
    let [f, g] = places.map(|at| surface.faces[tree.faces[at] as usize]);
    let [t, s] = places.map(|at| &tree.corners[at]);
    let shared: Vec<u32> = f.into_iter().filter(|corner| g.contains(corner)).collect();
    match *shared {
        [] => apart(t, s, near).or_else(|| apart(s, t, near)),
        [corner] => {
            let opposite = |face: [u32; 3], corners: &[Point; 3]| {
                let k = (0..3).find(|&k| face[k] == corner)?;
                Some([corners[(k + 1) % 3], corners[(k + 2) % 3]])
            };
            let through = |edge: Option<[Point; 2]>, corners: &[Point; 3]| pierced(edge?, corners, near);
            through(opposite(f, t), s).or_else(|| through(opposite(g, s), t))
        }
        [a, _] => folded(t, s).then(|| surface.points[a as usize]),
        _ => Some(t[0]),
    }
}

/// A point where an edge of `t` goes through `s` or touches it, or touches one of its edges.
fn apart(t: &[Point; 3], s: &[Point; 3], near: f64) -> Option<Point> {
    (0..3).find_map(|k| {
        let edge = [t[k], t[(k + 1) % 3]];
        pierced(edge, s, near).or_else(|| (0..3).find_map(|l| touching(edge, [s[l], s[(l + 1) % 3]], near)))
    })
}

/// Where a segment goes through a triangle, or ends on it.
fn pierced([p, q]: [Point; 2], t: &[Point; 3], near: f64) -> Option<Point> {
    let n = area_vector(*t);
    let size = norm(n);
    if size == 0.0 {
        return None;
    }
    let [above, below] = [p, q].map(|x| dot(sub(x, t[0]), n) / size);
    if above.abs() <= near && below.abs() <= near {
        // In the plane of the triangle: an end inside counts, and edges that cross are found elsewhere.
        return [p, q].into_iter().find(|&x| inside(x, t, n));
    }
    if above.min(below) > near || above.max(below) < -near {
        return None;
    }
    let x = add(p, scale(sub(q, p), (above / (above - below)).clamp(0.0, 1.0)));
    inside(x, t, n).then_some(x)
}

/// Whether a point in the plane of a triangle is inside of it.
fn inside(x: Point, t: &[Point; 3], n: Point) -> bool {
    (0..3).all(|k| dot(cross(sub(t[(k + 1) % 3], t[k]), sub(x, t[k])), n) >= 0.0)
}

/// Where two segments are as good as at one point.
fn touching([p, q]: [Point; 2], [r, s]: [Point; 2], near: f64) -> Option<Point> {
    let (u, v, w) = (sub(q, p), sub(s, r), sub(p, r));
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w));
    let det = uu * vv - uv * uv;
    // Parallel segments touch, if they do, where one of them ends; that end is found with another edge.
    if det <= 1e-14 * uu * vv {
        return None;
    }
    let (a, b) = ((uv * vw - vv * uw) / det, (uu * vw - uv * uw) / det);
    if !(0.0..=1.0).contains(&a) || !(0.0..=1.0).contains(&b) {
        return None;
    }
    let (x, y) = (add(p, scale(u, a)), add(r, scale(v, b)));
    (norm(sub(x, y)) <= near).then_some(x)
}

/// Whether two triangles with a common edge lie on each other: their normals are opposite within what single precision tells.
fn folded(t: &[Point; 3], s: &[Point; 3]) -> bool {
    let (n, m) = (area_vector(*t), area_vector(*s));
    let (across, along) = (norm(cross(n, m)), dot(n, m));
    along < 0.0 && across <= 4.0 * f64::from(f32::EPSILON) * -along
}
