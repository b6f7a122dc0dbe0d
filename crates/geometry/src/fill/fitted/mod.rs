//! Particles that fit a body.

mod grid;
mod kernel;
mod lists;
mod quality;
mod relax;
mod seed;
mod thickness;
mod wall;

pub use quality::Quality;
pub use thickness::thickness;

use super::{FillError, Points, extent};
use crate::measure;
use crate::point::Dimension;
use crate::shape::Shape;
use grid::Grid;
use kernel::Kernel;
use relax::{Basin, Settled};
use wall::Walls;

/// Particles that fit a body, and how well they do.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The particles.
    pub points: Points,
    /// How good they are.
    pub quality: Quality,
    /// How good a lattice of the same spacing is, from the corner of the bounds of the body.
    pub lattice: Quality,
    /// Steps of the relaxation.
    pub steps: usize,
    /// Whether the particles came to rest.
    pub at_rest: bool,
}

/// Fills a shape with particles that fit its surface (see [`Fill::Fitted`](super::Fill::Fitted)), and says how well they do.
///
/// # Errors
/// As for [`fill`](super::fill).
pub fn fit(shape: &Shape, spacing: f64, dimension: Dimension) -> Result<Fit, FillError> {
    let bed = Bed::new(shape, spacing, dimension)?;
    let (points, settled) = bed.settle()?;
    let (quality, lattice) = (bed.quality(&points), bed.quality(&bed.lattice()));
    Ok(Fit { quality, lattice, points, steps: settled.steps, at_rest: settled.at_rest })
}

/// The particles alone.
pub(super) fn fitted(shape: &Shape, spacing: f64, dimension: Dimension) -> Result<Points, FillError> {
    Ok(Bed::new(shape, spacing, dimension)?.settle()?.0)
}

/// A body, and what particles feel of it.
struct Bed<'a> {
    shape: &'a Shape,
    walls: Walls<'a>,
    grid: Grid,
    kernel: Kernel,
    spacing: f64,
    dimension: Dimension,
    /// Volume of the body.
    volume: f64,
}

impl<'a> Bed<'a> {
    fn new(shape: &'a Shape, spacing: f64, dimension: Dimension) -> Result<Self, FillError> {
        super::checked(shape, spacing, dimension)?;
        super::near_enough(shape, [0.0; 3], spacing, dimension)?;
        let (walls, kernel) = (Walls::new(shape, spacing, dimension), Kernel::new(spacing, dimension));
        let grid = Grid::new((shape, &walls), spacing, dimension, &kernel)?;
        let volume = measure::volume(shape, dimension).unwrap_or_else(|| grid.volume());
        Ok(Self { shape, walls, grid, kernel, spacing, dimension, volume })
    }

    /// Particles at rest.
    fn settle(&self) -> Result<(Points, Settled), FillError> {
        let seeds = seed::seeds(&self.grid, self.dimension);
        if seeds.is_empty() {
            let extent = extent(self.shape, self.dimension);
            return Err(FillError::Empty { spacing: self.spacing, extent });
        }
        let volume = self.volume / seeds.len() as f64;
        let mut settled = self.basin(volume).settle(seeds);
        let x = std::mem::take(&mut settled.x);
        Ok((Points { volume: vec![volume; x.len()], x }, settled))
    }

    fn basin(&self, volume: f64) -> Basin<'_> {
        let Self { walls, grid, kernel, spacing, .. } = self;
        Basin { walls, grid, kernel: *kernel, spacing: *spacing, volume }
    }

    fn quality(&self, points: &Points) -> Quality {
        Quality::of(&self.basin(0.0), points, self.volume)
    }

    /// The lattice that particles begin with, without its cut cells.
    fn lattice(&self) -> Points {
        let x = seed::lattice(&self.grid, self.dimension, |x| self.shape.contains(x));
        Points { volume: vec![self.grid.lump(); x.len()], x }
    }
}
