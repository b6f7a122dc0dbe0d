//! The search that nobody can get wrong: every particle against every other.

use super::adjacency::Adjacency;
use super::error::{self, SearchError};

/// The same list as [`super::Search::pairs`] gives, by n^2 comparisons; the reference that tests compare with.
///
/// # Errors
/// As [`super::Search::pairs`].
pub fn trivial_pairs<const D: usize>(
    x: [&[f64]; D],
    radius: f64,
    same: Option<&[u32]>,
) -> Result<Adjacency, SearchError> {
    let n = error::particles(x)?;
    error::radius(radius)?;
    error::check_positions(x)?;
    error::length("the column of tags", same.map_or(n, <[u32]>::len), n)?;
    let mut list = Adjacency { start: vec![0], id: Vec::new() };
    for a in 0..n {
        for b in 0..n {
            let square: f64 = x.iter().map(|column| (column[a] - column[b]) * (column[a] - column[b])).sum();
            if a != b && square < radius * radius && same.is_none_or(|tag| tag[a] == tag[b]) {
                list.id.push(b as u32);
            }
        }
        list.start.push(list.id.len() as u32);
    }
    Ok(list)
}
