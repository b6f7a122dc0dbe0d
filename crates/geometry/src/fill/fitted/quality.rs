//! How good a filling is.

use super::Bed;
use super::lists::{CHUNK, Lists};
use super::relax::Basin;
use crate::fill::{FillError, Points};
use crate::point::{Dimension, Point, norm, sub};
use crate::shape::Shape;
use rayon::prelude::*;

/// How good a filling is. Lengths in spacings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Root mean square of the sum of V grad W plus the integral of grad W over the outside, times the spacing, of the particles farther than a
    /// spacing from the surface; 0 where they are arranged so that a constant field has no gradient.
    pub interior: f64,
    /// The largest of these.
    pub interior_max: f64,
    /// The root mean square of sum V grad W, times the spacing, of the particles that nothing of the surface reaches; `None` without such.
    /// A constant stress pulls them with twice that times stress over spacing.
    pub deep: Option<f64>,
    /// The root mean square over all particles.
    pub residual: f64,
    /// The volume of all particles over that of the body, less 1.
    pub volume_error: f64,
    /// Number of particles times a cube of the spacing over the volume of the body, less 1: the volume error without renormalisation.
    pub count_error: f64,
    /// Particles within a spacing of the surface.
    pub at_surface: usize,
    /// Root mean square of their distance from half a spacing inside.
    pub surface: f64,
    /// The largest.
    pub surface_max: f64,
    /// The smallest distance between two particles.
    pub spacing_min: f64,
    /// Particles that have less than 0.45 spacings to the surface, since the wall is thinner there or they stand on an edge.
    pub thin: usize,
}

impl Quality {
    /// How good particles are as a filling of a shape, however they were made.
    ///
    /// # Errors
    /// As for [`fill`](crate::fill).
    pub fn measure(
        shape: &Shape,
        points: &Points,
        spacing: f64,
        dimension: Dimension,
    ) -> Result<Self, FillError> {
        Ok(Bed::new(shape, spacing, dimension)?.quality(points))
    }

    pub(super) fn of(basin: &Basin, points: &Points, volume: f64) -> Self {
        let lists = Lists::new(&points.x, basin.kernel.reach());
        let parts: Vec<Tally> = (0..points.len().div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let range = chunk * CHUNK..points.len().min((chunk + 1) * CHUNK);
                range.map(|i| Tally::one(basin, points, i, lists.of(i))).fold(Tally::default(), Tally::plus)
            })
            .collect();
        let all = parts.into_iter().fold(Tally::default(), Tally::plus);
        let mean = |sum: f64, count: usize| (sum / count.max(1) as f64).sqrt();
        let dp = basin.spacing;
        Self {
            interior: mean(all.interior, all.inner) * dp,
            interior_max: all.interior_max.sqrt() * dp,
            deep: (all.deepest > 0).then(|| mean(all.deep, all.deepest) * dp),
            residual: mean(all.residual, points.len()) * dp,
            volume_error: points.total_volume() / volume - 1.0,
            count_error: points.len() as f64 * basin.grid.lump() / volume - 1.0,
            at_surface: points.len() - all.inner,
            surface: mean(all.surface, points.len() - all.inner) / dp,
            surface_max: all.surface_max / dp,
            spacing_min: all.least / dp,
            thin: all.thin,
        }
    }
}

/// Sums of squares, and extremes.
#[derive(Clone, Copy)]
struct Tally {
    inner: usize,
    deepest: usize,
    deep: f64,
    interior: f64,
    interior_max: f64,
    residual: f64,
    surface: f64,
    surface_max: f64,
    least: f64,
    thin: usize,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            inner: 0,
            deepest: 0,
            deep: 0.0,
            interior: 0.0,
            interior_max: 0.0,
            residual: 0.0,
            surface: 0.0,
            surface_max: 0.0,
            least: f64::INFINITY,
            thin: 0,
        }
    }
}

impl Tally {
    fn one(basin: &Basin, points: &Points, i: usize, near: &[u32]) -> Self {
        let x: &[Point] = &points.x;
        let square = basin.residual(points, i, near);
        let distance = basin.walls.at(x[i]).distance;
        let (inside, deep) = (distance < -basin.spacing, basin.walls.room(x[i]) > basin.kernel.reach());
        let off = (distance + 0.5 * basin.spacing).abs();
        let least = near.iter().map(|&j| norm(sub(x[i], x[j as usize]))).fold(f64::INFINITY, f64::min);
        let inner = if inside { square } else { 0.0 };
        let surface = if inside { 0.0 } else { off };
        Self {
            inner: usize::from(inside),
            deepest: usize::from(deep),
            deep: if deep { square } else { 0.0 },
            interior: inner,
            interior_max: inner,
            residual: square,
            surface: surface * surface,
            surface_max: surface,
            least,
            thin: usize::from(distance > -0.45 * basin.spacing),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            inner: self.inner + other.inner,
            deepest: self.deepest + other.deepest,
            deep: self.deep + other.deep,
            interior: self.interior + other.interior,
            interior_max: self.interior_max.max(other.interior_max),
            residual: self.residual + other.residual,
            surface: self.surface + other.surface,
            surface_max: self.surface_max.max(other.surface_max),
            least: self.least.min(other.least),
            thin: self.thin + other.thin,
        }
    }
}
