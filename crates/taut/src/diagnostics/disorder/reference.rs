//! The reference arrangement that states are compared with.

use super::error::{DisorderError, length};
use super::gradient::{LeastSquares, points};
use super::symmetric::Square;
use super::{Disorder, bonds, pieces, shell, spacing, zigzag};
use crate::neighbours::{Adjacency, CellGrid, Search, check_positions};

/// A reference arrangement, with everything that can be worked out once, and room for the work on a state.
///
/// Measuring asks for no memory after the first time; the grid of [`Disorder::spacing_min`] alone may grow, if
/// particles spread out later. Results are the same for any number of threads.
#[derive(Debug, Clone)]
pub struct Reference<const D: usize> {
    squares: LeastSquares<D>,
    shells: Adjacency,
    bonds: Vec<[u32; 2]>,
    dp: Vec<f64>,
    room: Room<D>,
}

/// Room for the work on a state.
#[derive(Debug, Clone)]
struct Room<const D: usize> {
    x: Vec<[f64; D]>,
    f: Vec<Square<D>>,
    zigzag: Vec<f64>,
    ranked: Vec<f64>,
    broken: Vec<bool>,
    parent: Vec<u32>,
    grid: CellGrid<D>,
}

impl<const D: usize> Reference<D> {
    /// Takes the particles at `x0` (columns, m) as reference. `body` and `dp` hold the body and the spacing (m)
    /// of each; F is fitted over neighbours of the same body within `support` (m), the radius of the kernel.
    ///
    /// # Errors
    /// Columns of unequal length, coordinates, spacings or a support that are not usable numbers, too many
    /// particles or pairs to number.
    pub fn new(x0: [&[f64]; D], body: &[u32], dp: &[f64], support: f64) -> Result<Self, DisorderError> {
        let n = x0[0].len();
        length("the column of bodies", body.len(), n)?;
        length("the column of spacings", dp.len(), n)?;
        if let Some(particle) = dp.iter().position(|&dp| !(dp > 0.0 && dp.is_finite())) {
            return Err(DisorderError::Spacing { particle, value: dp[particle] });
        }
        let (mut search, mut neighbours, mut near) =
            (Search::new(), Adjacency::default(), Adjacency::default());
        search.pairs(x0, support, Some(body), &mut neighbours)?;
        let largest = dp.iter().copied().reduce(f64::max).unwrap_or(support);
        search.pairs(x0, bonds::REACH * largest, Some(body), &mut near)?;
        let squares = LeastSquares::new(x0, support, neighbours);
        let shells = shell::shells(&squares, &near, dp);
        let bonds = bonds::bonds(&squares, &near, dp);
        let room = Room {
            x: Vec::with_capacity(n),
            f: vec![[[0.0; D]; D]; n],
            zigzag: vec![0.0; n],
            ranked: Vec::with_capacity(n),
            broken: vec![false; bonds.len()],
            parent: Vec::with_capacity(n),
            grid: CellGrid::new(),
        };
        Ok(Self { squares, shells, bonds, dp: dp.to_vec(), room })
    }

    /// Number of particles.
    pub fn particles(&self) -> usize {
        self.dp.len()
    }

    /// Whether particle `i` has a full nearest shell, that is whether its zigzag counts: on a lattice if all
    /// 2 D neighbours along the axes are there; elsewhere if it has at least 2 D neighbours within 1.2 dp and
    /// the unit vectors to all neighbours in the support, weighted, have a mean shorter than 0.18.
    pub fn has_full_shell(&self, i: usize) -> bool {
        !self.shells.of(i).is_empty()
    }

    /// The bonds, as pairs of particles, the smaller first.
    pub fn bonds(&self) -> &[[u32; 2]] {
        &self.bonds
    }

    /// Measures the state at `x` (columns, m, in the order of the reference).
    ///
    /// # Errors
    /// Columns of another length than the reference, coordinates that are not usable numbers.
    pub fn measure(&mut self, x: [&[f64]; D]) -> Result<Disorder, DisorderError> {
        self.check(x)?;
        let room = &mut self.room;
        points(x, &mut room.x);
        self.squares.gradients(&room.x, &mut room.f);
        zigzag::amplitudes((&self.squares, &self.shells, &self.dp), &room.f, &room.x, &mut room.zigzag);
        let shells = &self.shells;
        let counted = room.zigzag.iter().enumerate().filter(|&(i, _)| !shells.of(i).is_empty());
        room.ranked.clear();
        room.ranked.extend(counted.map(|(_, amplitude)| amplitude));
        let (zigzag_rms, zigzag_99, zigzag_max) = zigzag::summary(&mut room.ranked);

        let among = (&self.squares, self.bonds.as_slice(), self.dp.as_slice());
        let bond_min = bonds::inspect(among, &room.f, &room.x, &mut room.broken);
        let broken = room.broken.iter().filter(|&&broken| broken).count();
        let whole = self.bonds.iter().zip(&room.broken).filter(|&(_, broken)| !broken);
        Ok(Disorder {
            zigzag_rms,
            zigzag_99,
            zigzag_max,
            bond_min,
            spacing_min: spacing::smallest(&mut room.grid, x, &self.dp, bond_min)?,
            broken: broken as f64 / self.bonds.len().max(1) as f64,
            pieces: pieces::pieces(self.dp.len(), whole.map(|(&bond, _)| bond), &mut room.parent),
        })
    }

    /// The particle with the largest zigzag of the state that was measured last; `None` if none has a full nearest shell.
    pub fn most_zigzag(&self) -> Option<usize> {
        let counted = (0..self.particles()).filter(|&i| self.has_full_shell(i));
        counted.max_by(|&i, &j| self.room.zigzag[i].total_cmp(&self.room.zigzag[j]))
    }

    /// Writes the zigzag amplitude of every particle at `x` into `out`, in spacings; 0 for particles without a
    /// full nearest shell.
    ///
    /// # Errors
    /// As [`Reference::measure`], and `out` of another length.
    pub fn zigzag_field(&mut self, x: [&[f64]; D], out: &mut [f64]) -> Result<(), DisorderError> {
        self.check(x)?;
        length("the field to write", out.len(), self.dp.len())?;
        points(x, &mut self.room.x);
        self.squares.gradients(&self.room.x, &mut self.room.f);
        zigzag::amplitudes((&self.squares, &self.shells, &self.dp), &self.room.f, &self.room.x, out);
        Ok(())
    }

    /// The deformation gradients at `x` by least squares, rows first, in the order of the reference: for output of
    /// formulations that carry none.
    ///
    /// # Errors
    /// As [`Reference::measure`].
    pub fn deformation(&mut self, x: [&[f64]; D]) -> Result<&[[[f64; D]; D]], DisorderError> {
        self.check(x)?;
        points(x, &mut self.room.x);
        self.squares.gradients(&self.room.x, &mut self.room.f);
        Ok(&self.room.f)
    }

    /// The deformation gradients of the state that was looked at last; zero before the first one.
    pub fn last_deformation(&self) -> &[[[f64; D]; D]] {
        &self.room.f
    }

    fn check(&self, x: [&[f64]; D]) -> Result<(), DisorderError> {
        for column in x {
            length("a column of positions", column.len(), self.dp.len())?;
        }
        Ok(check_positions(x)?)
    }
}
