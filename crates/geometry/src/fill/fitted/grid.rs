//! How much of each cell of a fine grid a body fills: the outside that closes kernel sums, the volume, and where particles begin.

use super::kernel::Kernel;
use super::wall::Walls;
use crate::fill::{FillError, affordable, extent};
use crate::point::{Dimension, Point, add, norm, scale};
use crate::shape::Shape;
use rayon::prelude::*;
use std::collections::HashMap;

/// Cells along the edge of a block.
pub(super) const SIDE: usize = 8;

/// Cells along a spacing. Two, so that eight cells make a start and kernel sums of the outside are good to a hundredth.
pub(super) const PER_SPACING: usize = 2;

/// The place of a block, counted from the corner of the body's bounds.
pub(super) type Place = [i32; 3];

/// What a block holds.
#[derive(Debug)]
pub(super) enum Block {
    /// Nothing but body.
    Full,
    /// The filled share of each cell, x fastest.
    Cut(Vec<f32>),
}

/// Blocks that the body reaches, and those of the outside that kernels reach from it.
pub(super) struct Grid {
    origin: Point,
    /// Edge of a cell, m.
    pub(super) cell: f64,
    /// Along the Morton curve.
    pub(super) blocks: Vec<(Place, Block)>,
    at: HashMap<Place, u32>,
    /// Cells of a block along each axis.
    pub(super) side: [usize; 3],
    dimension: Dimension,
}

impl Grid {
    /// Looks only at what is near the surface in fine steps: cubes are halved until they are blocks, and those that the surface is
    /// farther away from than the kernel reaches are left out.
    pub(super) fn new(
        (shape, walls): (&Shape, &Walls),
        spacing: f64,
        dimension: Dimension,
        kernel: &Kernel,
    ) -> Result<Self, FillError> {
        let cell = spacing / PER_SPACING as f64;
        let edge = SIDE as f64 * cell;
        let lengths = extent(shape, dimension);
        // A bound of what follows, for each block; and Morton curves end at 2^30.
        let count: f64 = lengths.iter().map(|l| (l / spacing).ceil() + 1.0).product();
        affordable(count, shape, spacing, dimension)?;
        let longest = lengths.iter().fold(0.0, |m: f64, l| m.max(l / edge));
        let flat = dimension == Dimension::Two;
        let bounds = shape.bounds();
        let mut grid = Self {
            origin: if flat { [bounds.min[0], bounds.min[1], 0.0] } else { bounds.min },
            cell,
            blocks: Vec::new(),
            at: HashMap::new(),
            side: if flat { [SIDE, SIDE, 1] } else { [SIDE; 3] },
            dimension,
        };
        let levels = (longest + 3.0).log2().ceil() as u32;
        let mut cubes = vec![if flat { [-1, -1, 0] } else { [-1; 3] }];
        for level in (0..=levels).rev() {
            let size = 1 << level;
            let near = |place: &Place| grid.reaches(shape, *place, size, kernel.reach());
            let parts = |place: Place| grid.halves(place, size);
            let kept = cubes.into_par_iter().filter(near);
            cubes = if level == 0 { kept.collect() } else { kept.flat_map_iter(parts).collect() };
        }
        let sampled = cubes.into_par_iter().map(|place| (place, grid.sample((shape, walls), place)));
        grid.blocks = sampled.collect();
        grid.at = grid.blocks.iter().zip(0..).map(|((place, _), i)| (*place, i)).collect();
        Ok(grid)
    }

    /// Half of the diagonal of a cube.
    fn radius(&self, edge: f64) -> f64 {
        0.5 * edge * (self.dimension.axes() as f64).sqrt()
    }

    fn middle(&self, place: Place, size: i32) -> Point {
        let edge = SIDE as f64 * self.cell;
        let mut x = [0.0; 3];
        for axis in 0..self.dimension.axes() {
            x[axis] = self.origin[axis] + (f64::from(place[axis]) + 0.5 * f64::from(size)) * edge;
        }
        x
    }

    /// Whether a kernel inside the body reaches the cube.
    fn reaches(&self, shape: &Shape, place: Place, size: i32, reach: f64) -> bool {
        let radius = self.radius(f64::from(size) * SIDE as f64 * self.cell);
        shape.distance(self.middle(place, size)) <= radius + reach
    }

    fn halves(&self, place: Place, size: i32) -> impl Iterator<Item = Place> {
        let axes = self.dimension.axes();
        (0..1 << axes)
            .map(move |half: i32| std::array::from_fn(|axis| place[axis] + ((half >> axis) & 1) * (size / 2)))
    }

    fn sample(&self, (shape, walls): (&Shape, &Walls), place: Place) -> Block {
        if shape.distance(self.middle(place, 1)) < -self.radius(SIDE as f64 * self.cell) {
            return Block::Full;
        }
        let shares = (0..self.side.iter().product()).map(|index| {
            let x = self.middle_of(place, index);
            self.share((shape, walls), x, self.cell, 0) as f32
        });
        Block::Cut(shares.collect())
    }

    /// The filled share of a cell. Where the surface cuts it the cell is halved once; its parts count by how deep their middle lies if
    /// distances are right inside, and are halved once more to be counted by inside and outside if not.
    fn share(&self, (shape, walls): (&Shape, &Walls), x: Point, edge: f64, level: u32) -> f64 {
        let distance = shape.distance(x);
        if distance.abs() > self.radius(edge) {
            return if distance < 0.0 { 1.0 } else { 0.0 };
        }
        match level {
            1 if walls.is_exact() => return (0.5 - distance / edge).clamp(0.0, 1.0),
            2 => return if distance <= 0.0 { 1.0 } else { 0.0 },
            _ => {}
        }
        let axes = self.dimension.axes();
        let parts = (0..1 << axes).map(|half: usize| {
            let to = |axis: usize| (((half >> axis) & 1) as f64 - 0.5) * 0.5 * edge;
            let x = std::array::from_fn(|axis| x[axis] + if axis < axes { to(axis) } else { 0.0 });
            self.share((shape, walls), x, 0.5 * edge, level + 1)
        });
        parts.sum::<f64>() / f64::from(1 << axes)
    }

    /// The middle of a cell of a block.
    pub(super) fn middle_of(&self, place: Place, index: usize) -> Point {
        let [nx, ny, _] = self.side;
        let within = [index % nx, index / nx % ny, index / nx / ny];
        let mut x = [0.0; 3];
        for axis in 0..self.dimension.axes() {
            let cells = place[axis] as f64 * SIDE as f64 + within[axis] as f64 + 0.5;
            x[axis] = self.origin[axis] + cells * self.cell;
        }
        x
    }

    /// The volume of a cell.
    pub(super) fn cell_volume(&self) -> f64 {
        self.cell.powi(self.dimension.axes() as i32)
    }

    /// The volume of a cube of the spacing.
    pub(super) fn lump(&self) -> f64 {
        (PER_SPACING as f64 * self.cell).powi(self.dimension.axes() as i32)
    }

    /// The volume of the body, as the cells have it.
    pub(super) fn volume(&self) -> f64 {
        let cells = self.side.iter().product::<usize>() as f64;
        let filled = self.blocks.iter().map(|(_, block)| match block {
            Block::Full => cells,
            Block::Cut(shares) => shares.iter().map(|&share| f64::from(share)).sum(),
        });
        filled.sum::<f64>() * self.cell_volume()
    }

    /// What the outside within reach of `x` contributes to kernel sums there.
    pub(super) fn outside(&self, x: Point, kernel: &Kernel) -> Outside {
        let mut sum = Outside::default();
        let reach = kernel.reach();
        let mut cells = [[0_i32, 1]; 3];
        for axis in 0..self.dimension.axes() {
            let at = (x[axis] - self.origin[axis]) / self.cell - 0.5;
            let by = reach / self.cell;
            cells[axis] = [(at - by).ceil() as i32, (at + by).floor() as i32 + 1];
        }
        let side = self.side.map(|n| n as i32);
        let blocks =
            |axis: usize| cells[axis][0].div_euclid(side[axis])..=(cells[axis][1] - 1).div_euclid(side[axis]);
        for place in blocks(2).flat_map(|k| blocks(1).flat_map(move |j| blocks(0).map(move |i| [i, j, k]))) {
            let Some(Block::Cut(shares)) = self.at.get(&place).map(|&i| &self.blocks[i as usize].1) else {
                continue;
            };
            let range = |axis: usize| {
                let from = place[axis] * side[axis];
                (cells[axis][0].max(from) - from)..(cells[axis][1].min(from + side[axis]) - from)
            };
            for (k, j) in range(2).flat_map(|k| range(1).map(move |j| (k, j))) {
                for i in range(0) {
                    let index = ((k * side[1] + j) * side[0] + i) as usize;
                    let empty = 1.0 - f64::from(shares[index]);
                    if empty > 0.0 {
                        sum.add(x, self.middle_of(place, index), empty, kernel);
                    }
                }
            }
        }
        sum.times(self.cell_volume())
    }
}

/// Integrals over what lies outside of the body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Outside {
    /// Of grad W.
    pub(super) slope: Point,
    /// Of its gradient, symmetric: xx, yy, zz, yz, zx, xy.
    pub(super) curve: [f64; 6],
    /// Of the largest curvature.
    pub(super) stiffness: f64,
}

impl Outside {
    fn add(&mut self, x: Point, y: Point, share: f64, kernel: &Kernel) {
        let to = [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
        let r = norm(to);
        if r >= kernel.reach() || r == 0.0 {
            return;
        }
        let [across, along] = kernel.slopes(r);
        self.slope = add(self.slope, scale(to, share * across));
        self.stiffness += share * across.abs().max(along.abs());
        let e = scale(to, 1.0 / r);
        let bent = along - across;
        for axis in 0..3 {
            self.curve[axis] += share * (across + bent * e[axis] * e[axis]);
            self.curve[3 + axis] += share * bent * e[(axis + 1) % 3] * e[(axis + 2) % 3];
        }
    }

    fn times(self, volume: f64) -> Self {
        Self {
            slope: scale(self.slope, volume),
            curve: self.curve.map(|c| c * volume),
            stiffness: self.stiffness * volume,
        }
    }

    /// The slope a small way from there.
    pub(super) fn slope_at(&self, way: Point) -> Point {
        let [xx, yy, zz, yz, zx, xy] = self.curve;
        let [a, b, c] = way;
        let turned = [xx * a + xy * b + zx * c, xy * a + yy * b + yz * c, zx * a + yz * b + zz * c];
        add(self.slope, turned)
    }
}
