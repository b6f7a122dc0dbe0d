//! What can be wrong with positions and radii.

/// Largest coordinate and radius a search accepts: squares of larger ones leave the range of `f64`.
pub(super) const LARGEST: f64 = 1e150;

/// Why a search was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SearchError {
    /// A coordinate is not a number, or too large to square.
    #[error(
        "particle {particle} stands at {value} along axis {axis}; positions must be numbers below 1e150 \
         (hint: the run has diverged, or the particle was never placed)"
    )]
    Position {
        /// Index of the particle in the columns.
        particle: usize,
        /// Axis of the coordinate, from 0.
        axis: usize,
        /// The coordinate, in m.
        value: f64,
    },
    /// The search radius is not a positive number.
    #[error(
        "the search radius is {0}; it must lie between 1e-150 and 1e150 (hint: check the particle spacing)"
    )]
    Radius(f64),
    /// A column does not have one entry per particle.
    #[error("{column} has {found} entries for {expected} particles (hint: all columns must be equally long)")]
    Length {
        /// What the column holds.
        column: &'static str,
        /// Its length.
        found: usize,
        /// The number of particles, which is the length of the first column of positions.
        expected: usize,
    },
    /// More particles or pairs than a list of 32-bit indices can number.
    #[error(
        "{found} {what} do not fit a list of 2^32 entries (hint: use fewer particles or a smaller radius)"
    )]
    TooMany {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        found: u64,
    },
}

/// Number of particles in `x`, after checking that the columns are equally long and not too long.
pub(super) fn particles<const D: usize>(x: [&[f64]; D]) -> Result<usize, SearchError> {
    let n = x[0].len();
    for column in x {
        length("a column of positions", column.len(), n)?;
    }
    if n >= u32::MAX as usize {
        return Err(SearchError::TooMany { what: "particles", found: n as u64 });
    }
    Ok(n)
}

/// Checks that a column has one entry for each of `expected` particles.
pub(super) fn length(column: &'static str, found: usize, expected: usize) -> Result<(), SearchError> {
    if found == expected { Ok(()) } else { Err(SearchError::Length { column, found, expected }) }
}

/// Checks that every coordinate is a number of a size that can be squared; names the first that is not.
pub fn check_positions<const D: usize>(x: [&[f64]; D]) -> Result<(), SearchError> {
    let wrong = |value: f64| value.is_nan() || value.abs() > LARGEST;
    let first = (0..D).filter_map(|axis| x[axis].iter().position(|&v| wrong(v)).map(|a| (a, axis))).min();
    match first {
        None => Ok(()),
        Some((particle, axis)) => Err(SearchError::Position { particle, axis, value: x[axis][particle] }),
    }
}

/// Checks that a radius is positive and that it can be squared.
pub(super) fn radius(radius: f64) -> Result<(), SearchError> {
    if (1.0 / LARGEST..=LARGEST).contains(&radius) { Ok(()) } else { Err(SearchError::Radius(radius)) }
}
