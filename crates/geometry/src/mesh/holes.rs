//! Holes: the loops of edges that have a triangle on one side only, and the caps that close them.

use super::edges::Edges;
use super::orient::Pieces;
use super::surface::{Surface, area_vector, middle};
use crate::bounds::Bounds;
use crate::point::{Point, norm};
use std::collections::HashMap;

/// A hole of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// Edges around it.
    pub edges: usize,
    /// The diagonal of the box around it.
    pub across: f64,
    /// The area of its cap.
    pub area: f64,
    /// The middle of its edges.
    pub at: Point,
}

/// An edge of a hole, in the direction of the cap: piece, from, to.
type Rim = (u32, u32, u32);

/// Closes all loops of edges with one triangle: with one triangle, or with a fan around the middle of the loop. For a flat loop
/// that is where the winding number of the open surface is 1/2.
pub(super) fn close(surface: &mut Surface, pieces: &mut Pieces) -> Vec<Hole> {
    let edges = Edges::of(&surface.faces);
    let mut rims: Vec<Rim> = edges
        .loose()
        .map(|side| {
            let [a, b] = side.way();
            (pieces.of[side.face as usize], b, a)
        })
        .collect();
    rims.sort_unstable();
    let mut holes = Vec::new();
    for (piece, corners) in loops(&rims) {
        let (before, points) = (surface.faces.len(), &surface.points);
        let ring: Vec<Point> = corners.iter().map(|&i| points[i as usize]).collect();
        if let [a, b, c] = *corners {
            surface.faces.push([a, b, c]);
        } else {
            let centre = surface.points.len() as u32;
            surface.points.push(middle(&ring));
            let next = corners.iter().cycle().skip(1);
            surface.faces.extend(corners.iter().zip(next).map(|(&a, &b)| [a, b, centre]));
        }
        pieces.of.resize(surface.faces.len(), piece);
        pieces.turned.resize(surface.faces.len(), false);
        let cap = surface.faces[before..].iter().map(|&face| 0.5 * norm(area_vector(surface.corners(face))));
        let across = norm(Bounds::around(ring.iter().copied()).extent());
        holes.push(Hole { edges: corners.len(), across, area: cap.sum(), at: middle(&ring) });
    }
    holes.sort_by(|a, b| b.across.total_cmp(&a.across));
    holes
}

/// The closed ways along sorted edges, each edge once. Where several go out of a point a way is cut at its first return.
fn loops(rims: &[Rim]) -> Vec<(u32, Vec<u32>)> {
    // How many of the edges out of a point were taken, at the first of them.
    let mut taken = vec![0; rims.len()];
    let mut found = Vec::new();
    for start in 0..rims.len() {
        let (piece, from, _) = rims[start];
        let mut path = vec![from];
        let mut place: HashMap<u32, usize> = HashMap::from([(from, 0)]);
        while let Some(&here) = path.last() {
            let first = rims.partition_point(|&(p, a, _)| (p, a) < (piece, here));
            let Some(next) = taken.get(first).map(|taken| first + taken) else { break };
            if rims.get(next).is_none_or(|&(p, a, _)| (p, a) != (piece, here)) {
                break;
            }
            taken[first] += 1;
            let to = rims[next].2;
            match place.get(&to) {
                Some(&at) => {
                    let ring = path[at..].to_vec();
                    path.truncate(at + 1);
                    ring[1..].iter().for_each(|corner| _ = place.remove(corner));
                    if ring.len() > 2 {
                        found.push((piece, ring));
                    }
                }
                None => {
                    place.insert(to, path.len());
                    path.push(to);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_that_touches_itself_is_two_loops() {
        let mut rims = vec![(0, 1, 2), (0, 2, 3), (0, 3, 1), (0, 1, 4), (0, 4, 5), (0, 5, 1), (1, 1, 9)];
        rims.sort_unstable();
        let found = loops(&rims);
        assert_eq!(found, [(0, vec![1, 2, 3]), (0, vec![1, 4, 5])]);
    }
}
