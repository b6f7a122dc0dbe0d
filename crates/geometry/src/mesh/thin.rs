//! How thin the thinnest part of a body is.

use super::sign::normal;
use super::tree::Tree;
use crate::point::{Point, add, dot, scale};

/// Rays that are sent at most.
const RAYS: usize = 200_000;

/// A wall has surfaces that look in opposite directions, within 60 degrees: at the edge of a wedge nothing is thin.
const OPPOSITE: f64 = -0.5;

/// Where on a triangle rays start: its middle, and near its corners.
const STARTS: [[f64; 3]; 4] = [[1.0 / 3.0; 3], [0.8, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.8]];

/// A thin part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thin {
    /// How thick it is.
    pub thickness: f64,
    /// A point on its surface.
    pub at: Point,
}

/// The shortest way through the body along a normal of its surface, from sample points of its triangles to where the surface looks
/// the other way.
pub(super) fn thinnest(tree: &Tree) -> Option<Thin> {
    let every = (STARTS.len() * tree.corners.len()).div_ceil(RAYS).max(1);
    let mut thinnest: Option<Thin> = None;
    for (at, corners) in tree.corners.iter().enumerate().step_by(every) {
        let n = normal(corners);
        if n == [0.0; 3] {
            continue;
        }
        for weights in STARTS {
            let start = (0..3).fold([0.0; 3], |x, k| add(x, scale(corners[k], weights[k])));
            let Some(hit) = tree.first(start, scale(n, -1.0), at) else { continue };
            let (first, facing) = (hit.along, dot(n, normal(&tree.corners[hit.at])));
            if facing <= OPPOSITE && thinnest.is_none_or(|thin| first < thin.thickness) {
                thinnest = Some(Thin { thickness: first, at: start });
            }
        }
    }
    thinnest
}
