//! On which side of the surface a point is, by pseudo-normals (Baerentzen and Aanaes 2005): the normal of the triangle, the sum of
//! two at an edge, and at a corner all of them, each with its angle there. Exact for closed surfaces that do not meet themselves.

use super::closest::Part;
use super::edges::{Edges, NONE, neighbours};
use super::surface::{Surface, area_vector};
use super::tree::{Nearest, Tree};
use crate::point::{Point, add, dot, norm, scale, sub, unit};

/// Normals of what a nearest point can lie on.
#[derive(Debug, Clone)]
pub(super) struct Normals {
    /// The triangles of the tree across each edge of a triangle of the tree.
    across: Vec<[u32; 3]>,
    /// The points of each triangle of the tree.
    corners: Vec<[u32; 3]>,
    /// Of every point.
    at: Vec<Point>,
}

impl Normals {
    /// Of a closed surface.
    pub fn new(surface: &Surface, tree: &Tree) -> Self {
        let mut at = vec![[0.0; 3]; surface.points.len()];
        for &face in &surface.faces {
            let corners = surface.corners(face);
            let normal = normal(&corners);
            for k in 0..3 {
                let weighted = scale(normal, angle(&corners, k));
                let sum = &mut at[face[k] as usize];
                *sum = add(*sum, weighted);
            }
        }
        let mut place = vec![NONE; surface.faces.len()];
        for (at, &face) in tree.faces.iter().enumerate() {
            place[face as usize] = at as u32;
        }
        let by_face = neighbours(&Edges::of(&surface.faces), surface.faces.len());
        let moved = |face: &u32| {
            by_face[*face as usize]
                .map(|other| if other == NONE { place[*face as usize] } else { place[other as usize] })
        };
        let across = tree.faces.iter().map(moved).collect();
        let corners = tree.faces.iter().map(|&face| surface.faces[face as usize]).collect();
        Self { across, corners, at }
    }

    /// Whether `x` is behind the surface, of which `nearest` is the point nearest to it.
    pub fn behind(&self, tree: &Tree, nearest: &Nearest, x: Point) -> bool {
        let own = || normal(&tree.corners[nearest.at]);
        let normal = match nearest.foot.part {
            Part::Face => own(),
            Part::Edge(side) => {
                let other = self.across[nearest.at][usize::from(side)];
                add(own(), normal(&tree.corners[other as usize]))
            }
            Part::Corner(k) => self.at[self.corners[nearest.at][usize::from(k)] as usize],
        };
        dot(sub(x, nearest.foot.x), normal) < 0.0
    }
}

/// Of length 1; zero for a triangle without area.
pub(super) fn normal(corners: &[Point; 3]) -> Point {
    unit(area_vector(*corners)).unwrap_or([0.0; 3])
}

/// The angle at a corner.
fn angle(corners: &[Point; 3], k: usize) -> f64 {
    let (u, v) = (sub(corners[(k + 1) % 3], corners[k]), sub(corners[(k + 2) % 3], corners[k]));
    norm(super::surface::cross(u, v)).atan2(dot(u, v))
}
