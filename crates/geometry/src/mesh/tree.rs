//! A tree of boxes around triangles: what is nearest, what a ray meets, who is near whom.

use super::closest::{Foot, foot};
use super::surface::{Surface, cross};
use crate::bounds::Bounds;
use crate::point::{Point, dot, sub};

/// Triangles of a leaf, at most.
const LEAF: usize = 4;

/// Halving 2^32 triangles gives no deeper tree, and a walk keeps at most one node of each depth and the last two.
pub(super) const DEEPEST: usize = 40;

/// A box around the triangles in `range`.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub bounds: Bounds,
    /// The triangles below it, as the tree numbers them.
    pub range: std::ops::Range<u32>,
    /// The first of its two children; 0 for a leaf.
    pub child: u32,
}

/// The tree.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    /// The triangle of the surface for each of the tree.
    pub faces: Vec<u32>,
    /// Corners, in the order of the tree.
    pub corners: Vec<[Point; 3]>,
}

/// The nearest point of the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    /// Square of the distance.
    pub squared: f64,
    /// The triangle of the tree.
    pub at: usize,
    /// Where on it.
    pub foot: Foot,
}

/// Where a ray meets the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// How far along the ray, in lengths of its direction.
    pub along: f64,
    /// The triangle of the tree.
    pub at: usize,
}

impl Tree {
    pub fn new(surface: &Surface) -> Self {
        let corners: Vec<[Point; 3]> = surface.faces.iter().map(|&face| surface.corners(face)).collect();
        let centres: Vec<Point> = corners.iter().map(|c| super::surface::middle(c)).collect();
        let mut faces: Vec<u32> = (0..corners.len() as u32).collect();
        let mut nodes = vec![Node { bounds: Bounds::around([]), range: 0..faces.len() as u32, child: 0 }];
        let mut at = 0;
        while at < nodes.len() {
            let range = nodes[at].range.clone();
            let inside = &mut faces[range.start as usize..range.end as usize];
            nodes[at].bounds = Bounds::around(inside.iter().flat_map(|&face| corners[face as usize]));
            if inside.len() > LEAF {
                let extent = Bounds::around(inside.iter().map(|&face| centres[face as usize])).extent();
                let axis = (0..3).fold(0, |longest, i| if extent[i] > extent[longest] { i } else { longest });
                let key = |face: &u32| centres[*face as usize][axis];
                let half = inside.len() / 2;
                inside.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
                let middle = range.start + half as u32;
                nodes[at].child = nodes.len() as u32;
                for range in [range.start..middle, middle..range.end] {
                    nodes.push(Node { bounds: Bounds::around([]), range, child: 0 });
                }
            }
            at += 1;
        }
        let corners = faces.iter().map(|&face| corners[face as usize]).collect();
        Self { nodes, faces, corners }
    }

    /// The triangles of a leaf.
    pub fn leaf(&self, node: &Node) -> impl Iterator<Item = (usize, &[Point; 3])> + use<'_> {
        let range = node.range.start as usize..node.range.end as usize;
        range.clone().zip(&self.corners[range])
    }

    /// The point of the surface nearest to `x`; `None` without triangles.
    pub fn nearest(&self, x: Point) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut least = f64::INFINITY;
        let mut waiting = [(0_u32, 0.0_f64); DEEPEST];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (at, squared) = waiting[count];
            if squared >= least {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.child == 0 {
                for (at, corners) in self.leaf(node) {
                    let Some(foot) = foot(corners, x, least) else { continue };
                    let way = sub(foot.x, x);
                    let squared = dot(way, way);
                    if squared < least {
                        least = squared;
                        best = Some(Nearest { squared, at, foot });
                    }
                }
                continue;
            }
            let [a, b] = [node.child, node.child + 1]
                .map(|child| (child, self.nodes[child as usize].bounds.squared(x)));
            // The nearer one is looked at first.
            let (far, near) = if a.1 < b.1 { (b, a) } else { (a, b) };
            waiting[count] = far;
            waiting[count + 1] = near;
            count += 2;
        }
        best
    }

    /// Where the ray from `x` along `way` first meets another triangle than `but`.
    pub fn first(&self, x: Point, way: Point, but: usize) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut waiting = vec![(0_u32, 0.0)];
        while let Some((at, enters)) = waiting.pop() {
            let least = best.map_or(f64::INFINITY, |hit| hit.along);
            if enters > least {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.child > 0 {
                let ways = [node.child, node.child + 1]
                    .map(|child| (child, self.nodes[child as usize].bounds.entered(x, way)));
                let mut ways: Vec<(u32, f64)> =
                    ways.into_iter().filter_map(|(child, enters)| Some((child, enters?))).collect();
                // The nearer one is looked at first.
                ways.sort_by(|a, b| b.1.total_cmp(&a.1));
                waiting.extend(ways);
                continue;
            }
            for (at, corners) in self.leaf(node).filter(|&(at, _)| at != but) {
                if let Some(along) = meet(corners, x, way)
                    && best.is_none_or(|hit| along < hit.along)
                {
                    best = Some(Hit { along, at });
                }
            }
        }
        best
    }

    /// Every place where the ray from `x` along `way` meets the surface, in any order; `tell` says whether to go on.
    pub fn ray(&self, x: Point, way: Point, mut tell: impl FnMut(Hit) -> bool) {
        let mut waiting = vec![0_u32];
        while let Some(at) = waiting.pop() {
            let node = &self.nodes[at as usize];
            if node.bounds.entered(x, way).is_none() {
                continue;
            }
            if node.child > 0 {
                waiting.extend([node.child, node.child + 1]);
                continue;
            }
            for (at, corners) in self.leaf(node) {
                if let Some(along) = meet(corners, x, way)
                    && !tell(Hit { along, at })
                {
                    return;
                }
            }
        }
    }
}

/// How far along a ray it meets a triangle (Moeller and Trumbore 1997).
fn meet(corners: &[Point; 3], x: Point, way: Point) -> Option<f64> {
    let [a, b, c] = *corners;
    let (u, v, from) = (sub(b, a), sub(c, a), sub(x, a));
    let p = cross(way, v);
    let det = dot(u, p);
    if det == 0.0 {
        return None;
    }
    let q = cross(from, u);
    let (s, t) = (dot(from, p) / det, dot(way, q) / det);
    let along = dot(v, q) / det;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && along > 0.0).then_some(along)
}

impl Bounds {
    /// Square of the distance from the box; 0 inside.
    pub(crate) fn squared(&self, x: Point) -> f64 {
        let mut squared = 0.0;
        for i in 0..3 {
            let out = (self.min[i] - x[i]).max(x[i] - self.max[i]).max(0.0);
            squared += out * out;
        }
        squared
    }

    /// Whether both have a point in common.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    /// How far along a ray from `x` the box begins; `None` if it misses it.
    fn entered(&self, x: Point, way: Point) -> Option<f64> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for i in 0..3 {
            if way[i] == 0.0 {
                if x[i] < self.min[i] || x[i] > self.max[i] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.min[i] - x[i]) / way[i], (self.max[i] - x[i]) / way[i]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        // A box without extent along an axis, seen through two roundings, is not missed.
        (enter <= leave + 1e-12 * leave.abs()).then_some(enter)
    }
}
