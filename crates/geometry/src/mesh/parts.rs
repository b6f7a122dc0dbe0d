//! The pieces of a surface that overlap, each for itself.

use super::Mesh;
use super::edges::{Edges, NONE, neighbours};
use super::surface::Surface;

/// The pieces, if the mesh unites several; else the mesh.
pub(super) fn parts(mesh: &Mesh) -> Vec<Mesh> {
    if !mesh.is_united() {
        return vec![mesh.clone()];
    }
    let piece = |faces: Vec<[u32; 3]>| {
        let mut surface = Surface { points: mesh.points().to_vec(), faces };
        surface.compact();
        Mesh::of(surface)
    };
    // What is no body for itself leaves the mesh as it is.
    let pieces: Result<Vec<Mesh>, _> = pieces(mesh.faces()).into_iter().map(piece).collect();
    pieces.unwrap_or_else(|_| vec![mesh.clone()])
}

/// Triangles that hang together by their edges, in the order of the first of each.
fn pieces(faces: &[[u32; 3]]) -> Vec<Vec<[u32; 3]>> {
    let neighbours = neighbours(&Edges::of(faces), faces.len());
    let mut seen = vec![false; faces.len()];
    let mut pieces = Vec::new();
    for seed in 0..faces.len() {
        if std::mem::replace(&mut seen[seed], true) {
            continue;
        }
        let (mut piece, mut queue) = (Vec::new(), vec![seed]);
        while let Some(face) = queue.pop() {
            piece.push(faces[face]);
            for next in neighbours[face].into_iter().filter(|&next| next != NONE) {
                if !std::mem::replace(&mut seen[next as usize], true) {
                    queue.push(next as usize);
                }
            }
        }
        pieces.push(piece);
    }
    pieces
}
