//! The surface of a stent as triangles.

use super::Stent;
use crate::point::Point;
use std::collections::HashMap;
use std::f64::consts::PI;

/// Pieces across a strut, and around its round ends.
const ACROSS: usize = 3;
const ROUND: usize = 8;

/// A point of the unrolled middle surface: x, and the angle around the axis times the middle radius.
type Drawn = [f64; 2];

/// The drawing, in triangles. Points that are the same have one number.
#[derive(Default)]
struct Drawing {
    points: Vec<Drawn>,
    numbers: HashMap<[i64; 2], u32>,
    triangles: Vec<[u32; 3]>,
}

impl Stent {
    /// The surface as triangles whose corners run counterclockwise seen from outside; closed, every corner to the last bit the same in all
    /// triangles that meet there.
    pub fn surface(&self) -> Vec<[Point; 3]> {
        let drawing = self.drawing();
        let inner = 0.5 * self.diameter - self.thickness;
        let place =
            |r: f64| -> Vec<Point> { drawing.points.iter().map(|&[x, s]| self.wrapped(x, s, r)).collect() };
        let (out, within) = (place(0.5 * self.diameter), place(inner));
        let mut surface = Vec::new();
        let mut open: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
        for &[a, b, c] in &drawing.triangles {
            let of = |side: &[Point], i: u32| side[i as usize];
            // Counterclockwise from x to s is clockwise from outside.
            surface.push([of(&out, a), of(&out, c), of(&out, b)]);
            surface.push([of(&within, a), of(&within, b), of(&within, c)]);
            for edge in [[a, b], [b, c], [c, a]] {
                // An edge inside of the drawing is met again the other way round.
                if open.remove(&[edge[1], edge[0]]).is_none() {
                    open.insert(edge, edge);
                }
            }
        }
        let mut edges: Vec<[u32; 2]> = open.into_values().collect();
        edges.sort_unstable();
        for [a, b] in edges.into_iter().map(|edge| edge.map(|i| i as usize)) {
            surface.push([out[a], out[b], within[a]]);
            surface.push([within[a], out[b], within[b]]);
        }
        surface
    }

    fn wrapped(&self, x: f64, s: f64, r: f64) -> Point {
        let (sin, cos) = (s / self.middle()).sin_cos();
        [x, r * cos, r * sin]
    }

    /// Struts and bridges are four-sided, what joins them is a triangle between the corners of three cells.
    fn drawing(&self) -> Drawing {
        let (half, last) = (self.half_pitch(), 2 * self.along);
        let mut drawing = Drawing::default();
        for (k, column) in (0..=last).flat_map(|k| (0..self.around).map(move |c| (k, c))) {
            let s = (2 * column + k % 2) as f64 * half;
            // What leads on to the next row, and what leads back: mirror images.
            if k < last {
                self.joint(&mut drawing, (self.row(k), s), 1.0);
            }
            if k > 0 {
                self.joint(&mut drawing, (self.row(k), s), -1.0);
            }
            match k {
                0 => self.tip(&mut drawing, (self.row(k), s), 1.0),
                _ if k == last => self.tip(&mut drawing, (self.row(k), s), -1.0),
                _ => {
                    let [a, b] = self.shoulders((self.row(k), s), 1.0);
                    let [c, d] = self.shoulders((self.row(k), s), -1.0);
                    drawing.quad(self, [c, a, b, d], 4);
                }
            }
        }
        drawing
    }

    /// Slope angle of struts.
    fn slope(&self) -> f64 {
        self.half_pitch().atan2(self.step() - self.bridge)
    }

    /// The corners of the cells at both sides of the end of a bridge, that at smaller s first.
    fn shoulders(&self, (x, s): (f64, f64), to: f64) -> [Drawn; 2] {
        let half = 0.5 * self.strut;
        let at = x + to * (0.5 * self.bridge - half * (0.5 * self.slope()).tan());
        [[at, s - half], [at, s + half]]
    }

    /// The corner of the cell between the two struts.
    fn crotch(&self, (x, s): (f64, f64), to: f64) -> Drawn {
        [x + to * (0.5 * self.bridge + 0.5 * self.strut / self.slope().sin()), s]
    }

    /// The triangle at the end of a bridge, and the strut that leads from there to the next row at larger s and, for those that lead on,
    /// also at smaller s.
    fn joint(&self, drawing: &mut Drawing, at: (f64, f64), to: f64) {
        let ([low, high], crotch) = (self.shoulders(at, to), self.crotch(at, to));
        drawing.corner(self, if to > 0.0 { [low, crotch, high] } else { [low, high, crotch] });
        if to < 0.0 {
            return;
        }
        for side in [-1.0, 1.0] {
            let next = (at.0 + self.step(), at.1 + side * self.half_pitch());
            let ([next_low, next_high], next_crotch) = (self.shoulders(next, -1.0), self.crotch(next, -1.0));
            let quad = if side > 0.0 {
                [crotch, next_low, next_crotch, high]
            } else {
                [low, next_crotch, next_high, crotch]
            };
            drawing.quad(self, quad, 12);
        }
    }

    /// The half bridge at an end, and its round tip.
    fn tip(&self, drawing: &mut Drawing, at: (f64, f64), to: f64) {
        let half = 0.5 * self.strut;
        let [low, high] = self.shoulders(at, to);
        let (a, b) = ([at.0, at.1 - half], [at.0, at.1 + half]);
        drawing.quad(self, if to > 0.0 { [a, low, high, b] } else { [low, a, b, high] }, 2);
        let round = |i: usize| {
            let (sin, cos) = (PI * i as f64 / ROUND as f64).sin_cos();
            [at.0 - to * half * sin, at.1 + half * cos]
        };
        let across = (0..=ACROSS).map(|i| mix(a, b, i as f64 / ACROSS as f64));
        let mut rim: Vec<u32> =
            across.chain((1..ROUND).map(round)).map(|p| drawing.number(self, p)).collect();
        if to < 0.0 {
            rim.reverse();
        }
        let top = rim.iter().position(|&i| i == drawing.number(self, round(ROUND / 2))).unwrap_or(0);
        for i in 1..rim.len() - 1 {
            let [p, q] = [(top + i) % rim.len(), (top + i + 1) % rim.len()];
            drawing.triangles.push([rim[top], rim[p], rim[q]]);
        }
    }
}

fn mix(a: Drawn, b: Drawn, t: f64) -> Drawn {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

impl Drawing {
    /// The number of a point; those a millionth of the strut apart, or a turn around the axis, are one.
    fn number(&mut self, stent: &Stent, [x, s]: Drawn) -> u32 {
        let (unit, turn) = (1e-6 * stent.strut, 2.0 * PI * stent.middle());
        let mut key = [(x / unit).round() as i64, (s.rem_euclid(turn) / unit).round() as i64];
        if key[1] == (turn / unit).round() as i64 {
            key[1] = 0;
        }
        *self.numbers.entry(key).or_insert_with(|| {
            self.points.push([x, s]);
            self.points.len() as u32 - 1
        })
    }

    /// A four-sided piece, its corners counterclockwise (x to s), the first and last at its beginning; cut into so many pieces along.
    fn quad(&mut self, stent: &Stent, [a, b, c, d]: [Drawn; 4], along: usize) {
        let mut at = |i: usize, j: usize| {
            let (t, u) = (i as f64 / along as f64, j as f64 / ACROSS as f64);
            self.number(stent, mix(mix(a, b, t), mix(d, c, t), u))
        };
        let numbers: Vec<Vec<u32>> = (0..=along).map(|i| (0..=ACROSS).map(|j| at(i, j)).collect()).collect();
        for (i, j) in (0..along).flat_map(|i| (0..ACROSS).map(move |j| (i, j))) {
            let [p, q, r, s] = [numbers[i][j], numbers[i + 1][j], numbers[i + 1][j + 1], numbers[i][j + 1]];
            self.triangles.extend([[p, q, r], [p, r, s]]);
        }
    }

    /// A triangle, its corners counterclockwise.
    fn corner(&mut self, stent: &Stent, [a, b, c]: [Drawn; 3]) {
        let mut at = |i: usize, j: usize| {
            let (t, u) = (i as f64 / ACROSS as f64, j as f64 / ACROSS as f64);
            let along = |k: usize| a[k] + t * (b[k] - a[k]) + u * (c[k] - a[k]);
            self.number(stent, [along(0), along(1)])
        };
        let numbers: Vec<Vec<u32>> =
            (0..=ACROSS).map(|i| (0..=ACROSS - i).map(|j| at(i, j)).collect()).collect();
        for (i, j) in (0..ACROSS).flat_map(|i| (0..ACROSS - i).map(move |j| (i, j))) {
            self.triangles.push([numbers[i][j], numbers[i + 1][j], numbers[i][j + 1]]);
            if j + 1 < ACROSS - i {
                self.triangles.push([numbers[i + 1][j], numbers[i + 1][j + 1], numbers[i][j + 1]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::PALMAZ;
    use super::*;
    use crate::point::{add, scale};

    #[test]
    fn the_surface_is_closed_looks_outwards_and_is_that_of_the_distance() {
        let surface = PALMAZ.surface();
        let mut edges: HashMap<[[u64; 3]; 2], i32> = HashMap::new();
        let mut volume = 0.0;
        for t in &surface {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let [from, to] = [t[a].map(f64::to_bits), t[b].map(f64::to_bits)];
                *edges.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { -1 };
                assert_ne!(from, to);
            }
            let [a, b, c] = *t;
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0;
        }
        assert!(edges.values().all(|&sum| sum == 0), "open or twisted");
        // What is drawn, times the thickness: 128 struts of hypot(q, step - bridge) and bridges, less what they share at joints. A coarse
        // bound here; how good it is shows in the distances.
        assert!(volume > 0.0);
        for t in &surface {
            let middle = scale(add(add(t[0], t[1]), t[2]), 1.0 / 3.0);
            // Sagittas: a third of a strut across (0.1^2/8/5), and a twelfth of a strut along (0.25^2/8/5); the round ends have 8 sides
            // (0.15 (1 - cos(pi/16))).
            assert!(PALMAZ.distance(middle).abs() < 0.004, "{middle:?} {}", PALMAZ.distance(middle));
        }
    }
}
