//! Stents: tubes cut into cells, after Palmaz and Schatz.

mod surface;

use crate::bounds::Bounds;
use crate::point::Point;
use crate::problem::ShapeProblem as Problem;
use std::f64::consts::PI;

/// A tube along x from x = 0, with its axis on the x axis, out of which slots were cut radially, as a laser does; spread open, so that the slots
/// are six-sided cells. The cut is drawn on the unrolled middle surface, from lines that are `strut` wide:
///
/// ```text
///        \    /                 struts lead from row to row in zigzag,
///         \__/   __ bridge      bridges along the axis join them;
///         /  \                  every second row is shifted by half a cell
///        /    \
/// ```
///
/// There are `2 along + 1` rows of `around` bridges, the first and last of half length and round at their ends. A bridge of each even
/// row (the first is 0) is where y is largest and z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stent {
    /// Length along x.
    pub length: f64,
    /// Outer diameter.
    pub diameter: f64,
    /// Thickness of the wall.
    pub thickness: f64,
    /// Cells around the axis.
    pub around: usize,
    /// Cells one after the other along the axis.
    pub along: usize,
    /// Width of struts and bridges.
    pub strut: f64,
    /// Length of bridges.
    pub bridge: f64,
}

impl Stent {
    /// The most cells in either direction: with more, a description is a mistake.
    pub const MOST_CELLS: usize = 1000;

    pub(crate) fn problem(&self) -> Option<Problem> {
        for (name, value) in [
            ("length", self.length),
            ("diameter", self.diameter),
            ("thickness", self.thickness),
            ("strut", self.strut),
            ("bridge", self.bridge),
        ] {
            if !value.is_finite() {
                return Some(Problem::NotFinite { name, value });
            }
            if value <= 0.0 {
                return Some(Problem::NotPositive { name, value });
            }
        }
        for (name, count, least) in [("around", self.around, 2), ("along", self.along, 1)] {
            if !(least..=Self::MOST_CELLS).contains(&count) {
                return Some(Problem::Count { name, count, least, most: Self::MOST_CELLS });
            }
        }
        let (half, slope) = (self.half_pitch(), self.step() - self.bridge);
        let crowded =
            |name, value: f64, room: f64| (value >= room).then_some(Problem::NoRoom { name, value, room });
        crowded("thickness", self.thickness, 0.5 * self.diameter)
            .or_else(|| crowded("bridge", self.bridge, self.step()))
            // A cell ends in a corner as far from its strut as that is wide: of what is left there has to be something.
            .or_else(|| crowded("strut", self.strut, half * slope / half.hypot(slope)))
    }

    pub(crate) fn bounds(&self) -> Bounds {
        let r = 0.5 * self.diameter;
        Bounds { min: [0.0, -r, -r], max: [self.length, r, r] }
    }

    /// Radius of the middle surface.
    fn middle(&self) -> f64 {
        0.5 * (self.diameter - self.thickness)
    }

    /// Half of the distance of two bridges of a row.
    fn half_pitch(&self) -> f64 {
        PI * self.middle() / self.around as f64
    }

    /// Distance of two rows.
    fn step(&self) -> f64 {
        (self.length - self.strut) / (2 * self.along) as f64
    }

    /// The middle of a row.
    fn row(&self, k: usize) -> f64 {
        0.5 * self.strut + k as f64 * self.step()
    }

    /// At most the distance to the surface: exact across walls, at most a hundredth or so (half of thickness over radius) too small along
    /// them, since arcs count by the radius of the inner side.
    pub(crate) fn distance(&self, x: Point) -> f64 {
        let (r, middle) = (x[1].hypot(x[2]), self.middle());
        let drawn = self.drawn(x[0], middle * x[2].atan2(x[1]));
        let inner = middle - 0.5 * self.thickness;
        let along = if drawn > 0.0 {
            // Chords instead of arcs, and how much they shrink towards the axis.
            let shrunk = ((r * inner).sqrt() / middle).min(1.0);
            shrunk * 2.0 * middle * (0.5 * drawn / middle).min(0.5 * PI).sin()
        } else {
            drawn * inner / middle
        };
        let across = (r - middle).abs() - 0.5 * self.thickness;
        if along > 0.0 && across > 0.0 { along.hypot(across) } else { along.max(across) }
    }

    /// The signed distance on the unrolled middle surface. It is mirrored at the lines on which bridges lie, and between two of them there
    /// is but one zigzag of struts and bridges.
    fn drawn(&self, x: f64, s: f64) -> f64 {
        let half = self.half_pitch();
        let turns = s / (2.0 * half);
        let folded = (turns - turns.round()).abs() * 2.0 * half;
        let (step, last) = (self.step(), 2 * self.along);
        let near = ((x - 0.5 * self.strut) / step).floor().clamp(0.0, (last - 1) as f64) as usize;
        let gap = 0.5 * self.bridge;
        let mut nearest = f64::INFINITY;
        for k in near.saturating_sub(1)..(near + 2).min(last) {
            let (from, to) = (self.row(k), self.row(k + 1));
            let (low, high) = if k % 2 == 0 { (0.0, half) } else { (half, 0.0) };
            let corners = [[from, low], [from + gap, low], [to - gap, high], [to, high]];
            for ends in corners.windows(2) {
                nearest = nearest.min(to_line([ends[0], ends[1]], [x, folded]));
            }
        }
        nearest - 0.5 * self.strut
    }
}

/// The distance to the line between two points.
fn to_line([a, b]: [[f64; 2]; 2], x: [f64; 2]) -> f64 {
    let (line, to) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
    let length = line[0] * line[0] + line[1] * line[1];
    let t = if length > 0.0 { (to[0] * line[0] + to[1] * line[1]) / length } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    (to[0] - t * line[0]).hypot(to[1] - t * line[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) const PALMAZ: Stent =
        Stent { length: 20.0, diameter: 10.0, thickness: 0.1, around: 8, along: 4, strut: 0.3, bridge: 0.6 };

    #[test]
    fn a_bridge_of_the_middle_row_is_at_the_top_and_a_cell_beside_it() {
        assert_eq!(PALMAZ.problem(), None);
        let d = |x: Point| PALMAZ.distance(x);
        // In the middle of the wall, of a bridge and of a cell. 0.99 is the inner radius over the middle one.
        assert!((d([10.0, 4.95, 0.0]) + 0.05).abs() < 1e-12);
        assert!((d([10.0, 5.5, 0.0]) - 0.5).abs() < 1e-12);
        let half = PI / 8.0;
        assert!(d([10.0, 4.95 * half.cos(), 4.95 * half.sin()]) > 1.0);
        // The tips are at both ends, on the lines of even rows.
        assert!(d([0.001, 4.95, 0.0]) < 0.0 && d([-0.001, 4.95, 0.0]) > 0.0);
        assert!(d([19.999, 4.95, 0.0]) < 0.0 && d([20.001, 4.95, 0.0]) > 0.0);
        assert!(d([0.2, 4.95 * half.cos(), 4.95 * half.sin()]) > 0.5);
    }

    #[test]
    fn what_cannot_be_says_so() {
        let problem = |change: fn(&mut Stent)| {
            let mut stent = PALMAZ;
            change(&mut stent);
            stent.problem()
        };
        assert!(matches!(problem(|s| s.strut = 1.6), Some(Problem::NoRoom { name: "strut", .. })));
        assert!(matches!(problem(|s| s.bridge = 2.5), Some(Problem::NoRoom { name: "bridge", .. })));
        assert!(matches!(problem(|s| s.thickness = 5.0), Some(Problem::NoRoom { name: "thickness", .. })));
        assert!(matches!(problem(|s| s.around = 1), Some(Problem::Count { name: "around", .. })));
        assert!(matches!(problem(|s| s.length = f64::NAN), Some(Problem::NotFinite { .. })));
    }
}
