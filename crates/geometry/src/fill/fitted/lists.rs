//! Who is near whom.

use crate::bounds::Bounds;
use crate::point::{Point, dot, sub};
use rayon::prelude::*;

/// Particles that a task works on; chunks do not depend on the number of threads, nor does any sum.
pub(super) const CHUNK: usize = 512;

/// The particles within a radius of each, found through a grid of cells.
pub(super) struct Lists {
    chunks: Vec<Chunk>,
}

/// The lists of a chunk: those of its n-th particle stand from `first[n]` on.
struct Chunk {
    first: Vec<u32>,
    near: Vec<u32>,
}

impl Lists {
    pub(super) fn new(x: &[Point], radius: f64) -> Self {
        let cells = Cells::new(x, radius);
        let chunk = |(number, part): (usize, &[Point])| {
            let mut chunk = Chunk { first: vec![0], near: Vec::new() };
            for (n, &here) in part.iter().enumerate() {
                let me = (number * CHUNK + n) as u32;
                cells.visit(here, |there, other| {
                    let way = sub(here, there);
                    if other != me && dot(way, way) < radius * radius {
                        chunk.near.push(other);
                    }
                });
                chunk.first.push(chunk.near.len() as u32);
            }
            chunk
        };
        Self { chunks: x.par_chunks(CHUNK).enumerate().map(chunk).collect() }
    }

    /// Those near a particle.
    pub(super) fn of(&self, i: usize) -> &[u32] {
        let (chunk, n) = (&self.chunks[i / CHUNK], i % CHUNK);
        &chunk.near[chunk.first[n] as usize..chunk.first[n + 1] as usize]
    }
}

/// Particles sorted into the cells of a grid.
pub(super) struct Cells {
    low: Point,
    edge: f64,
    count: [usize; 3],
    /// Where the particles of a cell begin in `sorted`.
    first: Vec<u32>,
    sorted: Vec<(Point, u32)>,
}

impl Cells {
    /// Cells at least as wide as the radius, and not many more than particles.
    pub(super) fn new(x: &[Point], radius: f64) -> Self {
        let bounds = Bounds::around(x.iter().copied());
        let lengths = if x.is_empty() { [0.0; 3] } else { bounds.extent() };
        let most = 4.0 * x.len() as f64 + 64.0;
        let mut edge = radius;
        while lengths.iter().map(|l| (l / edge).floor() + 1.0).product::<f64>() > most {
            edge *= 1.25;
        }
        let count = lengths.map(|l| (l / edge) as usize + 1);
        let mut cells = Self { low: bounds.min, edge, count, first: Vec::new(), sorted: Vec::new() };
        let of: Vec<usize> = x.par_iter().map(|&x| cells.index(cells.place(x))).collect();
        let mut first = vec![0_u32; count.iter().product::<usize>() + 1];
        of.iter().for_each(|&cell| first[cell + 1] += 1);
        (1..first.len()).for_each(|i| first[i] += first[i - 1]);
        let mut next = first.clone();
        cells.sorted = vec![([0.0; 3], 0); x.len()];
        for (i, (&x, &cell)) in x.iter().zip(&of).enumerate() {
            cells.sorted[next[cell] as usize] = (x, i as u32);
            next[cell] += 1;
        }
        cells.first = first;
        cells
    }

    fn place(&self, x: Point) -> [usize; 3] {
        std::array::from_fn(|axis| {
            (((x[axis] - self.low[axis]) / self.edge).max(0.0) as usize).min(self.count[axis] - 1)
        })
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.count[1] + j) * self.count[0] + i
    }

    /// Shows all that may be within the radius of a point.
    pub(super) fn visit(&self, x: Point, mut show: impl FnMut(Point, u32)) {
        let place = self.place(x);
        let around = |axis: usize| place[axis].saturating_sub(1)..(place[axis] + 2).min(self.count[axis]);
        for (k, j) in around(2).flat_map(|k| around(1).map(move |j| (k, j))) {
            // Cells along x follow each other.
            let row = around(0);
            let from = self.first[self.index([row.start, j, k])] as usize;
            let to = self.first[self.index([row.end - 1, j, k]) + 1] as usize;
            self.sorted[from..to].iter().for_each(|&(x, i)| show(x, i));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::norm;

    #[test]
    fn lists_are_what_looking_at_all_pairs_finds() {
        let place = |i: usize, by: f64| (i as f64 * by).sin();
        let x: Vec<Point> = (0..1200).map(|i| [place(i, 0.7), place(i, 1.9), 0.2 * place(i, 3.3)]).collect();
        for radius in [0.05, 0.2, 3.0] {
            let lists = Lists::new(&x, radius);
            for i in 0..x.len() {
                let mut found = lists.of(i).to_vec();
                found.sort_unstable();
                let near = |j: &u32| *j as usize != i && norm(sub(x[*j as usize], x[i])) < radius;
                assert_eq!(found, (0..x.len() as u32).filter(near).collect::<Vec<_>>());
            }
        }
    }
}
