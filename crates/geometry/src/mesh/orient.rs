//! Triangles that are duplicates, pieces that hang together, and which way round they go.

use super::MeshError;
use super::edges::{Edges, NONE, neighbours};
use super::surface::Surface;

/// From this share of triangles on that come in both directions, both directions are a way of saying that the surface has two
/// sides; below it, such a pair is a wall between two bodies that touch.
const TWO_SIDED: f64 = 0.9;

/// Takes away triangles with two corners at one point; how many.
pub(super) fn drop_points(surface: &mut Surface) -> usize {
    let before = surface.faces.len();
    surface.faces.retain(|&[a, b, c]| a != b && b != c && c != a);
    before - surface.faces.len()
}

/// Takes away triangles that are there twice, and pairs of opposite ones (the wall between two bodies that touch); how many.
pub(super) fn drop_duplicates(surface: &mut Surface) -> usize {
    let mut keyed: Vec<([u32; 3], bool, u32)> =
        surface.faces.iter().zip(0..).map(|(&face, i)| key(face, i)).collect();
    keyed.sort_unstable();
    let groups = || keyed.chunk_by(|a, b| a.0 == b.0);
    let opposite = |group: &&[([u32; 3], bool, u32)]| group[0].1 != group[group.len() - 1].1;
    let paired: usize = groups().filter(opposite).map(<[_]>::len).sum();
    let two_sided = paired as f64 >= TWO_SIDED * surface.faces.len() as f64;
    let mut keep = vec![false; surface.faces.len()];
    for group in groups() {
        let even = group.iter().filter(|(_, even, _)| *even).count();
        let odd = group.len() - even;
        if even != odd || two_sided {
            let wanted = even >= odd;
            let kept = group.iter().find(|(_, even, _)| *even == wanted);
            kept.into_iter().for_each(|&(_, _, face)| keep[face as usize] = true);
        }
    }
    let before = surface.faces.len();
    let mut kept = keep.into_iter();
    surface.faces.retain(|_| kept.next().unwrap_or(false));
    before - surface.faces.len()
}

/// The corners in ascending order, whether an even permutation led there, and the number of the triangle.
fn key([a, b, c]: [u32; 3], face: u32) -> ([u32; 3], bool, u32) {
    let mut sorted = [a, b, c];
    sorted.sort_unstable();
    let even = [[a, b, c], [b, c, a], [c, a, b]].contains(&sorted);
    (sorted, even, face)
}

/// The pieces of a surface, and which triangles go which way.
pub(super) struct Pieces {
    /// The piece of every triangle.
    pub of: Vec<u32>,
    /// How many pieces there are.
    pub count: usize,
    /// Triangles that were turned against their file.
    pub turned: Vec<bool>,
}

/// Turns triangles so that neighbours go the same way round; each piece still has one of two directions.
pub(super) fn orient(surface: &mut Surface) -> Result<Pieces, MeshError> {
    let edges = Edges::of(&surface.faces);
    let count = surface.faces.len();
    let neighbours = neighbours(&edges, count);
    let mut agree = vec![[true; 3]; count];
    for group in edges.groups() {
        if let [a, b] = group {
            let same = a.forward != b.forward;
            agree[a.face as usize][usize::from(a.side)] = same;
            agree[b.face as usize][usize::from(b.side)] = same;
        }
    }
    let mut pieces = Pieces { of: vec![NONE; count], count: 0, turned: vec![false; count] };
    let (mut contradictions, mut queue) = (0_usize, Vec::new());
    for seed in 0..count {
        if pieces.of[seed] != NONE {
            continue;
        }
        pieces.of[seed] = pieces.count as u32;
        queue.push(seed);
        while let Some(face) = queue.pop() {
            for side in 0..3 {
                let next = neighbours[face][side];
                if next == NONE {
                    continue;
                }
                let next = next as usize;
                // Neighbours that agree are both turned or both not.
                let wanted = pieces.turned[face] == agree[face][side];
                if pieces.of[next] == NONE {
                    pieces.of[next] = pieces.count as u32;
                    pieces.turned[next] = wanted;
                    queue.push(next);
                } else if pieces.turned[next] != wanted {
                    contradictions += 1;
                }
            }
        }
        pieces.count += 1;
    }
    if contradictions > 0 {
        return Err(MeshError::OneSided(contradictions.div_ceil(2)));
    }
    for (face, _) in surface.faces.iter_mut().zip(&pieces.turned).filter(|(_, turned)| **turned) {
        face.swap(1, 2);
    }
    Ok(pieces)
}
