//! Wavefront OBJ: points (`v`) and faces of three or more of them (`f`).

use super::text::{lines, point, short, wrong};
use super::{MeshError, Surface};
use crate::mesh::MAX_TRIANGLES;

/// Lines that say nothing about the surface.
const OTHER: &[&str] = &[
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "l",
    "p",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "lod",
    "bevel",
    "shadow_obj",
];

/// Lines of curved surfaces, which are no triangles.
const CURVED: &[&str] =
    &["curv", "curv2", "surf", "cstype", "deg", "parm", "trim", "hole", "scrv", "end", "con", "bmat", "step"];

pub(super) fn read(bytes: &[u8]) -> Result<Surface, MeshError> {
    let mut surface = Surface::default();
    for (number, line) in lines(bytes) {
        let line = line?;
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.ends_with('\\') {
            return Err(wrong(number, "lines that go on in the next are not read".to_string()));
        }
        let mut words = line.split_whitespace();
        match words.next() {
            None => {}
            Some("v") => {
                if surface.points.len() >= 3 * MAX_TRIANGLES {
                    return Err(MeshError::TooMany);
                }
                surface.points.push(point(words, number)?);
            }
            Some("f") => face(&mut surface, words, number)?,
            Some(word) if OTHER.contains(&word) => {}
            Some(word) if CURVED.contains(&word) => {
                let problem = format!("`{word}` belongs to a curved surface; save the part as triangles");
                return Err(wrong(number, problem));
            }
            Some(word) => {
                return Err(wrong(number, format!("`{}` is no word of an OBJ file", short(word))));
            }
        }
    }
    Ok(surface)
}

/// A face as a fan of triangles around its first corner.
fn face<'a>(
    surface: &mut Surface,
    words: impl Iterator<Item = &'a str>,
    line: usize,
) -> Result<(), MeshError> {
    let (mut first, mut before, mut count) = (0, 0, 0);
    for word in words {
        let corner = index(word, surface.points.len(), line)?;
        match count {
            0 => first = corner,
            1 => {}
            _ => surface.push_face([first, before, corner])?,
        }
        before = corner;
        count += 1;
    }
    if count < 3 {
        return Err(wrong(line, format!("a face needs 3 corners, and this one has {count}")));
    }
    Ok(())
}

/// The point of `7`, `7/1` or `7/1/2`; negative numbers count back from the last point.
fn index(word: &str, points: usize, line: usize) -> Result<u32, MeshError> {
    let number = word.split('/').next().unwrap_or_default();
    let index: i64 =
        number.parse().map_err(|_| wrong(line, format!("`{}` is no number of a point", short(word))))?;
    let from = if index < 0 { points as i64 } else { -1 };
    match index.checked_add(from).and_then(|at| u32::try_from(at).ok()) {
        Some(at) if (at as usize) < points && index != 0 => Ok(at),
        _ => Err(wrong(line, format!("there is no point {index}: {points} stand before this line"))),
    }
}
