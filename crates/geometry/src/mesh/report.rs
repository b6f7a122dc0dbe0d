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
    /// Whether it meets itself where closed pieces overlap.
    pub united: bool,
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
            united: mesh.is_united(),
            winding: matches!(inner.side, Side::Winding(_)),
        }
    }

    /// Whether the file had a closed surface, every edge with two triangles.
    pub fn is_closed(&self) -> bool {
        self.mended.holes.is_empty() && self.mended.open == 0
    }

    /// All of it, a line for each thing that can be asked; `unit` is the name of the unit of length.
    pub fn lines(&self, unit: &str) -> Vec<String> {
        let m = &self.mended;
        let [x, y, z] = self.bounds.extent().map(short);
        let (volume, area) = (short(self.volume), short(self.area));
        let closed = if self.is_closed() { "closed".to_string() } else { self.open(unit) };
        let turned = match m.turned {
            0 => "all triangles look outwards".to_string(),
            turned => format!("{} turned to look outwards", count(turned, "triangle was", "triangles were")),
        };
        let thin = match self.thinnest {
            Some(Thin { thickness, at }) => format!("{} {unit} at {}", short(thickness), place(at, unit)),
            None => "no two sides face away from each other".to_string(),
        };
        let inside = if self.winding { "winding number" } else { "normals of the nearest triangles" };
        vec![
            format!("triangles   {}, {} points", self.triangles, self.points),
            format!("size        {x} x {y} x {z} {unit}, from {}", place(self.bounds.min, unit)),
            format!("volume      {volume} {unit}^3, area {area} {unit}^2"),
            format!("thinnest    {thin}"),
            format!("pieces      {}", self.pieces_in_words()),
            format!("surface     {closed}"),
            format!("direction   {turned}"),
            format!("crossings   {}", self.crossings_in_words(unit)),
            format!("without area {}, twice there {}, in sheets {}", m.degenerate, m.duplicates, m.sheets),
            format!("inside by   {inside}"),
        ]
    }

    fn pieces_in_words(&self) -> String {
        match self.mended.cavities {
            0 => self.pieces.to_string(),
            cavities => format!(
                "{}, of which {} in another",
                self.pieces,
                count(cavities, "is a cavity", "are cavities")
            ),
        }
    }

    fn crossings_in_words(&self, unit: &str) -> String {
        let Crossings { pairs, at, tangled } = self.crossings;
        let least = if tangled { "at least " } else { "" };
        match at {
            None if tangled => "not all pairs were looked at: there are too many".to_string(),
            None => "none".to_string(),
            Some(at) => {
                let pairs =
                    count(pairs, "pair of triangles crosses or touches", "pairs of triangles cross or touch");
                format!("{least}{pairs}, first at {}", place(at, unit))
            }
        }
    }

    /// Holes in words.
    fn open(&self, unit: &str) -> String {
        let Mended { holes, open, .. } = &self.mended;
        let mut said = Vec::new();
        if let Some(Hole { across, edges, at, .. }) = holes.first() {
            let (holes, at) = (count(holes.len(), "hole was", "holes were"), place(*at, unit));
            said.push(format!(
                "{holes} closed by flat caps, the largest {} {unit} across with {edges} edges at {at}",
                short(*across)
            ));
        }
        if *open > 0 {
            said.push(format!("{} still open", count(*open, "edge is", "edges are")));
        }
        format!("open: {}", said.join("; "))
    }

    /// What a user should know before trusting the body, each with a number; `unit` is the name of the unit of length.
    pub fn doubts(&self, unit: &str) -> Vec<String> {
        let m = &self.mended;
        let mut doubts = Vec::new();
        if !self.is_closed() {
            let large = m.large_holes(self.area);
            let shape = if large > 0 {
                format!("; {large} so large that the body is what the caps make of it")
            } else {
                String::new()
            };
            doubts.push(format!("it is {}{shape}", self.open(unit)));
        }
        if self.crossings.at.is_some() || self.crossings.tangled {
            let told = self.crossings_in_words(unit);
            let rest = if self.united {
                format!(
                    "its {} are united, and walls inside of others are none",
                    count(self.pieces, "piece", "pieces")
                )
            } else {
                "join such parts in the program that drew them, or give each a file and unite them"
                    .to_string()
            };
            doubts.push(format!("it meets itself: {told}; {rest}"));
        }
        let mut say = |number: usize, one: &str, many: &str, rest: &str| {
            if number > 0 {
                doubts.push(format!("{}{rest}", count(number, one, many)));
            }
        };
        say(m.turned, "triangle was", "triangles were", " turned to look outwards");
        say(m.inside_out, "whole piece was", "whole pieces were", " the wrong way round");
        say(
            m.duplicates,
            "triangle was",
            "triangles were",
            " left out, being there twice or the wall between parts that touch",
        );
        say(m.sheets, "triangle was", "triangles were", " left out, in sheets that enclose nothing");
        say(m.welded, "corner was", "corners were", " moved by rounding errors to join others");
        say(m.crowded, "edge has", "edges have", " more than two triangles");
        doubts
    }
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

/// Four digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

fn place(at: [f64; 3], unit: &str) -> String {
    let [x, y, z] = at.map(short);
    format!("({x}, {y}, {z}) {unit}")
}
