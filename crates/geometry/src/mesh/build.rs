//! From the triangles of a file to a body: welded, cleaned, oriented, closed.

use super::edges::Edges;
use super::holes::{Hole, close};
use super::orient::{Pieces, drop_duplicates, drop_points, orient};
use super::surface::{Surface, area_vector, middle};
use super::tree::Tree;
use super::{MAX_COMPONENTS, MeshError};
use crate::point::{Point, dot, norm, sub};
use std::collections::HashMap;

/// A piece whose volume is smaller than this times its area to the power 3/2 is a sheet: a plate three millionths as thick as wide.
const SHEET: f64 = 1e-6;

/// Triangles that rays meet at most before pieces are no longer looked for in each other.
const MOST_MET: usize = 100_000_000;

/// Rays look along this direction, which no drawing has.
const ASKEW: Point = [0.532_791_846_2, 0.281_337_914_3, 0.798_146_235_7];

/// What was found and mended on the way from a file to a body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mended {
    /// Triangles of the file.
    pub triangles: usize,
    /// Points that were one but for rounding.
    pub welded: usize,
    /// Triangles without area: those that were taken away since they have two corners at one point, and those that stayed.
    pub degenerate: usize,
    /// Triangles that were there twice.
    pub duplicates: usize,
    /// Triangles turned against the file.
    pub turned: usize,
    /// Pieces of which all triangles were turned.
    pub inside_out: usize,
    /// Pieces that lie inside of another: cavities.
    pub cavities: usize,
    /// Triangles of pieces that enclose nothing and were taken away.
    pub sheets: usize,
    /// Holes that were closed, the largest first.
    pub holes: Vec<Hole>,
    /// Edges with more than two triangles.
    pub crowded: usize,
    /// Edges that are still open.
    pub open: usize,
}

/// Holes whose caps have more than this share of the area of the surface are large.
const LARGE: f64 = 0.01;

impl Mended {
    /// Holes that are so large that how they are closed decides what the body is; `area` is that of the surface.
    pub fn large_holes(&self, area: f64) -> usize {
        self.holes.iter().filter(|hole| hole.area > LARGE * area).count()
    }
}

/// Everything is done in the order of the file's coordinates, so that the result depends on the file alone.
pub(super) fn build(mut surface: Surface) -> Result<(Surface, Tree, usize, Mended), MeshError> {
    surface.check()?;
    let mut mended = Mended { triangles: surface.faces.len(), ..Mended::default() };
    surface.weld();
    mended.degenerate = drop_points(&mut surface);
    mended.duplicates = drop_duplicates(&mut surface);
    let loose = Edges::of(&surface.faces).loose_points();
    if !loose.is_empty() {
        mended.welded = surface.weld_close(&loose);
        mended.degenerate += drop_points(&mut surface);
        mended.duplicates += drop_duplicates(&mut surface);
    }
    let mut pieces = orient(&mut surface)?;
    if pieces.count > MAX_COMPONENTS {
        return Err(MeshError::Scattered { pieces: surface.faces.len(), components: pieces.count });
    }
    mended.holes = close(&mut surface, &mut pieces);
    drop_sheets(&mut surface, &mut pieces, &mut mended);
    if surface.faces.is_empty() {
        return Err(MeshError::Flat { triangles: mended.triangles });
    }
    surface.compact();
    let tree = Tree::new(&surface);
    let depth = depths(&surface, &tree, &pieces);
    let tree = turn_pieces(&mut surface, tree, (&mut pieces, &depth), &mut mended);
    (mended.crowded, mended.open) = Edges::of(&surface.faces).odd();
    mended.degenerate +=
        surface.faces.iter().filter(|&&face| area_vector(surface.corners(face)) == [0.0; 3]).count();
    Ok((surface, tree, pieces.count, mended))
}

/// Volume and area of every piece.
fn sizes(surface: &Surface, pieces: &Pieces) -> Vec<(f64, f64)> {
    let mut sizes = vec![(0.0, 0.0); pieces.count];
    let mut origin: Vec<Option<Point>> = vec![None; pieces.count];
    for (&face, &piece) in surface.faces.iter().zip(&pieces.of) {
        let corners = surface.corners(face);
        // About a point of the piece, so that a piece far from the origin keeps its digits.
        let from = *origin[piece as usize].get_or_insert(corners[0]);
        let area = area_vector(corners);
        let size = &mut sizes[piece as usize];
        size.0 += dot(area, sub(corners[0], from)) / 6.0;
        size.1 += 0.5 * norm(area);
    }
    sizes
}

/// Takes away pieces that enclose nothing.
fn drop_sheets(surface: &mut Surface, pieces: &mut Pieces, mended: &mut Mended) {
    let flat: Vec<bool> =
        sizes(surface, pieces).iter().map(|(volume, area)| volume.abs() <= SHEET * area.powf(1.5)).collect();
    let mut new = vec![0; flat.len()];
    let mut count = 0;
    for (piece, _) in flat.iter().enumerate().filter(|(_, flat)| !**flat) {
        new[piece] = count;
        count += 1;
    }
    let stays: Vec<bool> = pieces.of.iter().map(|&piece| !flat[piece as usize]).collect();
    mended.sheets = stays.iter().filter(|stays| !**stays).count();
    fn keep<T>(list: &mut Vec<T>, stays: &[bool]) {
        let mut stays = stays.iter();
        list.retain(|_| stays.next().is_some_and(|stays| *stays));
    }
    keep(&mut surface.faces, &stays);
    keep(&mut pieces.turned, &stays);
    keep(&mut pieces.of, &stays);
    pieces.of.iter_mut().for_each(|piece| *piece = new[*piece as usize]);
    pieces.count = count as usize;
}

/// In how many others each piece lies: those that rays from three of its triangles leave through an odd number of times.
fn depths(surface: &Surface, tree: &Tree, pieces: &Pieces) -> Vec<usize> {
    if pieces.count == 1 {
        return vec![0];
    }
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); pieces.count];
    for (face, &piece) in pieces.of.iter().enumerate() {
        members[piece as usize].push(face as u32);
    }
    let mut left = MOST_MET;
    let around = |(piece, faces): (usize, &Vec<u32>)| {
        let mut all: HashMap<u32, usize> = HashMap::new();
        for face in [faces[0], faces[faces.len() / 2], faces[faces.len() - 1]] {
            let mut crossed: HashMap<u32, usize> = HashMap::new();
            let start = middle(&surface.corners(surface.faces[face as usize]));
            tree.ray(start, ASKEW, |hit| {
                *crossed.entry(pieces.of[tree.faces[hit.at] as usize]).or_default() += 1;
                left = left.saturating_sub(1);
                left > 0
            });
            for (other, _) in
                crossed.into_iter().filter(|&(other, times)| times % 2 == 1 && other as usize != piece)
            {
                *all.entry(other).or_default() += 1;
            }
        }
        if left > 0 { all.values().filter(|&&times| times == 3).count() } else { 0 }
    };
    members.iter().enumerate().map(around).collect()
}

/// Turns pieces inside out that lie the wrong way round: out of the body, and in a cavity into it.
fn turn_pieces(
    surface: &mut Surface,
    tree: Tree,
    (pieces, depth): (&mut Pieces, &[usize]),
    mended: &mut Mended,
) -> Tree {
    let volumes = sizes(surface, pieces);
    let turn: Vec<bool> =
        volumes.iter().zip(depth).map(|((volume, _), depth)| (*volume < 0.0) != (depth % 2 == 1)).collect();
    mended.cavities = depth.iter().filter(|depth| *depth % 2 == 1).count();
    let mut kept = vec![false; turn.len()];
    for ((face, piece), turned) in surface.faces.iter_mut().zip(&pieces.of).zip(&mut pieces.turned) {
        if turn[*piece as usize] {
            face.swap(1, 2);
            *turned = !*turned;
        }
        kept[*piece as usize] |= !*turned;
    }
    mended.turned = pieces.turned.iter().filter(|turned| **turned).count();
    mended.inside_out = kept.iter().filter(|kept| !**kept).count();
    if turn.contains(&true) { Tree::new(surface) } else { tree }
}
