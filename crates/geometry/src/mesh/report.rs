//! What there is to say about a mesh.

use super::{Crossings, Hole, Mended, Mesh, Side, Thin};
use crate::bounds::Bounds;

/// What a mesh is, and what was mended. Lengths in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshReport {
    /// Triangles of the body, caps of holes included.
    pub triangles: usize,
    /// Points.
    pub points: usize,
    /// Pieces that do not hang together.
    pub pieces: usize,
    /// The box around it.
    pub bounds: Bounds,
    /// The volume, m^3.
    pub volume: f64,
    /// The area, m^2.
    pub area: f64,
    /// The thinnest part.
    pub thinnest: Option<Thin>,
    /// What was found and mended.
    pub mended: Mended,
    /// Where the surface meets itself.
    pub crossings: Crossings,
    /// Whether inside is told by the winding number, since normals cannot tell it everywhere.
    pub winding: bool,
}

impl MeshReport {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let inner = &*mesh.0;
        Self {
            triangles: mesh.faces().len(),
            points: mesh.points().len(),
            pieces: inner.pieces,
            bounds: mesh.bounds(),
            volume: mesh.volume(),
            area: mesh.area(),
            thinnest: mesh.thinnest(),
            mended: inner.mended.clone(),
            crossings: inner.crossings.clone(),
            winding: matches!(inner.side, Side::Winding(_)),
        }
    }

    /// Whether the file had a closed surface, every edge with two triangles.
    pub fn is_closed(&self) -> bool {
        self.mended.holes.is_empty() && self.mended.open == 0
    }

    /// What a user should know before trusting the body; each a sentence with a number.
    pub fn doubts(&self) -> Vec<String> {
        let Mended { holes, .. } = &self.mended;
        let mut doubts = Vec::new();
        if let Some(Hole { across, at, .. }) = holes.first() {
            let large = self.mended.large_holes(self.area);
            let how = if large > 0 {
                format!("; {large} of them so large that how they are closed shapes the body")
            } else {
                String::new()
            };
            doubts.push(format!(
                "it is open: {} closed by flat caps, the largest {across:.4e} m across at {}{how}",
                count(holes.len(), "hole was", "holes were"),
                place(*at)
            ));
        }
        doubts.extend(self.mending());
        if self.crossings.pairs > 0 {
            let least = if self.crossings.tangled { "at least " } else { "" };
            let at = self.crossings.at.map_or(String::new(), |at| format!(", first at {}", place(at)));
            doubts.push(format!("it meets itself: {least}{} of triangles cross or touch{at}; where it overlaps itself it is counted once", count(self.crossings.pairs, "pair", "pairs")));
        }
        doubts
    }

    /// What was mended, in sentences.
    fn mending(&self) -> Vec<String> {
        let m = &self.mended;
        let mut said = Vec::new();
        let mut say = |number: usize, one: &str, many: &str, rest: &str| {
            if number > 0 {
                said.push(format!("{}{rest}", count(number, one, many)));
            }
        };
        say(
            m.turned,
            "triangle was turned",
            "triangles were turned",
            " to look outwards like their neighbours",
        );
        say(m.inside_out, "piece was inside out", "pieces were inside out", "");
        say(
            m.duplicates,
            "triangle was",
            "triangles were",
            " there twice, or as the wall between parts that touch, and left out",
        );
        say(m.degenerate, "triangle has", "triangles have", " no area");
        say(
            m.sheets,
            "triangle belongs",
            "triangles belong",
            " to sheets that enclose nothing, and was left out",
        );
        say(m.welded, "corner was", "corners were", " joined across gaps of rounding size");
        say(m.crowded, "edge has", "edges have", " more than two triangles");
        say(m.open, "edge is", "edges are", " still open");
        said
    }
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn place([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4e}, {y:.4e}, {z:.4e}) m")
}
