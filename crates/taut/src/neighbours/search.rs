//! All pairs closer than a radius, found in parallel.

use rayon::prelude::*;

use super::adjacency::Adjacency;
use super::error::{self, SearchError};
use super::grid::CellGrid;

/// Particles per piece of work. Fixed, so that the work is cut the same way for any number of threads.
const CHUNK: usize = 1024;
/// Pieces that are found before they are copied into the list; bounds the memory beside the list.
const WAVE: usize = 256;

/// Finds lists of neighbours. Keeps its buffers: after the first search, memory is asked for only when the
/// number of particles or pairs outgrows all earlier ones.
#[derive(Debug, Clone, Default)]
pub struct Search<const D: usize> {
    grid: CellGrid<D>,
    staged: Vec<Vec<u32>>,
}

impl<const D: usize> Search<D> {
    /// A search without buffers.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes into `list` every pair a != b with |x_a - x_b| < `radius` (strictly; x as columns in m); with
    /// `same` given (one tag per particle, for instance its body) only pairs of equal tag.
    ///
    /// # Errors
    /// As [`CellGrid::build`], and 2^32 pairs or more. The list is then not to be used.
    pub fn pairs(
        &mut self,
        x: [&[f64]; D],
        radius: f64,
        same: Option<&[u32]>,
        list: &mut Adjacency,
    ) -> Result<(), SearchError> {
        self.grid.build(x, radius)?;
        match same {
            None => fill(Finder { grid: &self.grid, x, pair: |_, _| true }, &mut self.staged, list),
            Some(tag) => {
                error::length("the column of tags", tag.len(), x[0].len())?;
                let pair = |a: usize, b: usize| tag[a] == tag[b];
                fill(Finder { grid: &self.grid, x, pair }, &mut self.staged, list)
            }
        }
    }
}

impl<const D: usize> Search<D> {
    /// The same with a rule of the caller's own for which pairs count; it has to be the same for (a, b) and (b, a).
    ///
    /// # Errors
    /// As [`Search::pairs`].
    pub fn pairs_of(
        &mut self,
        x: [&[f64]; D],
        radius: f64,
        pair: impl Fn(usize, usize) -> bool + Sync,
        list: &mut Adjacency,
    ) -> Result<(), SearchError> {
        self.grid.build(x, radius)?;
        fill(Finder { grid: &self.grid, x, pair }, &mut self.staged, list)
    }
}

/// What all threads read: the grid, the positions by particle, and which pairs count.
struct Finder<'a, Pair, const D: usize> {
    grid: &'a CellGrid<D>,
    x: [&'a [f64]; D],
    pair: Pair,
}

impl<Pair: Fn(usize, usize) -> bool, const D: usize> Finder<'_, Pair, D> {
    /// Finds the neighbours of the particles from `first` on, as many as there are `counts`: numbers into
    /// `counts`, the neighbours themselves into `ids`, which grows as needed.
    fn stage(&self, first: usize, counts: &mut [u32], ids: &mut Vec<u32>) {
        let mut filled = 0;
        for (offset, count) in counts.iter_mut().enumerate() {
            let before = filled;
            filled = self.neighbours(first + offset, filled, ids);
            ids[before..filled].sort_unstable();
            *count = (filled - before) as u32;
        }
        ids.truncate(filled);
    }

    /// Writes the neighbours of `a` into `ids` from `filled` on and returns where they end.
    fn neighbours(&self, a: usize, mut filled: usize, ids: &mut Vec<u32>) -> usize {
        let (point, first) = (self.x.map(|column| column[a]), filled);
        let near = self.grid.near(point);
        let room = filled + self.grid.ranges(&near).map(|range| range.len()).sum::<usize>();
        if ids.len() < room {
            ids.resize(room, 0);
        }
        let square = self.grid.radius() * self.grid.radius();
        let positions = self.grid.positions();
        for range in self.grid.ranges(&near) {
            let columns = positions.map(|column| &column[range.clone()]);
            for (k, &id) in self.grid.ids()[range.clone()].iter().enumerate() {
                let distance = (0..D).fold(0.0, |sum, axis| {
                    let step = point[axis] - columns[axis][k];
                    sum + step * step
                });
                // Written always, kept only if it counts: no branch to mispredict.
                ids[filled] = id;
                filled += usize::from((distance < square) & (a != id as usize));
            }
        }
        self.those_that_count(a, (first, filled), ids)
    }

    /// Keeps the pairs of `a` that count, from `first` to `end`, and returns where they end. The caller's rule reads here and there, so it is asked
    /// about what is near only: a fifth of the candidates.
    fn those_that_count(&self, a: usize, (first, end): (usize, usize), ids: &mut [u32]) -> usize {
        let mut kept = first;
        for k in first..end {
            ids[kept] = ids[k];
            kept += usize::from((self.pair)(a, ids[k] as usize));
        }
        kept
    }
}

/// Fills `list` wave by wave: find in parallel, then copy in parallel.
fn fill<Pair, const D: usize>(
    finder: Finder<'_, Pair, D>,
    staged: &mut Vec<Vec<u32>>,
    list: &mut Adjacency,
) -> Result<(), SearchError>
where
    Pair: Fn(usize, usize) -> bool + Sync,
{
    let n = finder.x[0].len();
    if staged.len() < n.div_ceil(CHUNK).min(WAVE) {
        staged.resize_with(n.div_ceil(CHUNK).min(WAVE), Vec::new);
    }
    list.id.clear();
    list.start.clear();
    list.start.resize(n + 1, 0);
    for (wave, counts) in list.start[1..].chunks_mut(WAVE * CHUNK).enumerate() {
        let staged = &mut staged[..counts.len().div_ceil(CHUNK)];
        let pieces = counts.par_chunks_mut(CHUNK).zip(staged.par_iter_mut()).enumerate();
        pieces.for_each(|(k, (counts, ids))| finder.stage((wave * WAVE + k) * CHUNK, counts, ids));
        append(staged, &mut list.id)?;
    }
    let mut sum = 0;
    for count in &mut list.start {
        sum += *count;
        *count = sum;
    }
    Ok(())
}

/// Appends all pieces to `id`.
fn append(pieces: &[Vec<u32>], id: &mut Vec<u32>) -> Result<(), SearchError> {
    let before = id.len();
    let end = before + pieces.iter().map(Vec::len).sum::<usize>();
    if end > u32::MAX as usize {
        return Err(SearchError::TooMany { what: "pairs", found: end as u64 });
    }
    id.resize(end, 0);
    copy(pieces, &mut id[before..]);
    Ok(())
}

/// Copies the pieces one after the other into `out`, halves in parallel.
fn copy(pieces: &[Vec<u32>], out: &mut [u32]) {
    match pieces {
        [] => {}
        [piece] => out.copy_from_slice(piece),
        _ => {
            let (left, right) = pieces.split_at(pieces.len() / 2);
            let (into_left, into_right) = out.split_at_mut(left.iter().map(Vec::len).sum());
            rayon::join(|| copy(left, into_left), || copy(right, into_right));
        }
    }
}
