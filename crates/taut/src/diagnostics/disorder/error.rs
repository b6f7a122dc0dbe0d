//! Why disorder could not be measured.

use crate::neighbours::SearchError;

/// What is wrong with a reference arrangement or with a state to be measured.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DisorderError {
    /// Positions or the support radius are not usable.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// The spacing of a particle is not a positive number.
    #[error(
        "particle {particle} has the spacing {value}; it must be positive (hint: set it when particles are made)"
    )]
    Spacing {
        /// Index of the particle.
        particle: usize,
        /// Its spacing, in m.
        value: f64,
    },
    /// A column does not have one entry per particle.
    #[error(
        "{column} has {found} entries for {expected} particles (hint: pass the columns of one set of particles)"
    )]
    Length {
        /// What the column holds.
        column: &'static str,
        /// Its length.
        found: usize,
        /// The number of particles of the reference.
        expected: usize,
    },
}

/// Checks that a column has one entry for each of `expected` particles.
pub(super) fn length(column: &'static str, found: usize, expected: usize) -> Result<(), DisorderError> {
    if found == expected { Ok(()) } else { Err(DisorderError::Length { column, found, expected }) }
}
