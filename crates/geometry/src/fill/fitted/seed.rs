//! Where particles begin: in the middle of what the body fills of the cells of a lattice.

use super::grid::{Block, Grid, PER_SPACING, Place, SIDE};
use crate::point::{Dimension, Point, add, scale};

/// The particles to begin with, as many as the body has cells. Cells that the body fills have one each. Of those that it cuts, shares are
/// added up along the curve on which they lie, and a particle is set whenever half of a cell is owed: so there are as many particles as
/// volume, everywhere, also in walls thinner than a cell.
pub(super) fn seeds(grid: &Grid, dimension: Dimension) -> Vec<Point> {
    let mut seeds = Vec::new();
    let mut owed = 0.0;
    for (place, block) in &grid.blocks {
        for start in starts(dimension) {
            let (share, middle) = part(grid, (*place, block), start, dimension);
            owed += share;
            if share > 0.0 && owed >= 0.5 {
                let aside = if share < 1.0 { aside(seeds.len(), grid, dimension) } else { [0.0; 3] };
                seeds.push(add(middle, aside));
                owed -= 1.0;
            }
        }
    }
    seeds
}

/// A hundredth of a cell in a direction of its own for each particle, so that those of two cells that a wall holds at one place are not on
/// top of each other, where nothing would part them.
fn aside(number: usize, grid: &Grid, dimension: Dimension) -> Point {
    let mut x = [0.0; 3];
    for (axis, irrational) in (0..dimension.axes()).zip([0.618_033_988_7, 0.414_213_562_4, 0.732_050_807_6]) {
        x[axis] = 0.02 * grid.cell * ((number as f64 * irrational).fract() - 0.5);
    }
    x
}

/// The lattice of the same cells: their middles, as far as they are inside.
pub(super) fn lattice(grid: &Grid, dimension: Dimension, inside: impl Fn(Point) -> bool) -> Vec<Point> {
    let half = 0.5 * (PER_SPACING as f64 - 1.0) * grid.cell;
    let to = if dimension == Dimension::Two { [half, half, 0.0] } else { [half; 3] };
    let middles = grid.blocks.iter().flat_map(|(place, _)| {
        starts(dimension)
            .map(|[i, j, k]| add(grid.middle_of(*place, (k * grid.side[1] + j) * grid.side[0] + i), to))
    });
    middles.filter(|&x| inside(x)).collect()
}

/// The first cell of every spacing-wide part of a block.
fn starts(dimension: Dimension) -> impl Iterator<Item = [usize; 3]> {
    let across = SIDE / PER_SPACING;
    let deep = if dimension == Dimension::Two { 1 } else { across };
    (0..across * across * deep)
        .map(move |i| [i % across, i / across % across, i / across / across].map(|c| c * PER_SPACING))
}

/// The filled share of such a part, and the middle of what is filled.
fn part(
    grid: &Grid,
    (place, block): (Place, &Block),
    [i, j, k]: [usize; 3],
    dimension: Dimension,
) -> (f64, Point) {
    let deep = if dimension == Dimension::Two { 1 } else { PER_SPACING };
    let (mut share, mut middle) = (0.0, [0.0; 3]);
    for n in 0..PER_SPACING * PER_SPACING * deep {
        let [a, b, c] = [n % PER_SPACING, n / PER_SPACING % PER_SPACING, n / PER_SPACING / PER_SPACING];
        let index = ((k + c) * grid.side[1] + j + b) * grid.side[0] + i + a;
        let filled = match block {
            Block::Full => 1.0,
            Block::Cut(shares) => f64::from(shares[index]),
        };
        share += filled;
        middle = add(middle, scale(grid.middle_of(place, index), filled));
    }
    let parts = (PER_SPACING * PER_SPACING * deep) as f64;
    (share / parts, if share > 0.0 { scale(middle, 1.0 / share) } else { middle })
}
