//! Lines and numbers of text files.

use super::{MeshError, Point};

/// The lines of a file with their numbers from 1; one that is no text in UTF-8 is an error.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Result<&str, MeshError>)> {
    bytes.split(|&b| b == b'\n').enumerate().map(|(index, line)| {
        let problem = || wrong(index + 1, "it is no text in UTF-8".to_string());
        (index + 1, std::str::from_utf8(line).map_err(|_| problem()))
    })
}

pub(super) fn wrong(line: usize, problem: String) -> MeshError {
    MeshError::Line { line, problem }
}

/// The first three of `words` as coordinates.
pub(super) fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Point, MeshError> {
    let mut x: Point = [0.0; 3];
    for (coordinate, axis) in x.iter_mut().zip(["x", "y", "z"]) {
        let Some(word) = words.next() else {
            return Err(wrong(line, format!("a corner has three coordinates, and {axis} is missing")));
        };
        *coordinate = word
            .parse()
            .map_err(|_| wrong(line, format!("{axis} is `{}`, which is no number", short(word))))?;
        if !coordinate.is_finite() {
            return Err(wrong(
                line,
                format!("{axis} is {coordinate}; every coordinate has to be a finite number"),
            ));
        }
    }
    Ok(x)
}

/// A word as it may stand in a message.
pub(super) fn short(word: &str) -> String {
    let start: String = word.chars().take(24).flat_map(char::escape_debug).collect();
    if word.chars().nth(24).is_some() { start + "..." } else { start }
}
