//! STL: triangles with corners of their own. The normals in the file are not used: the order of the corners says the same, and more
//! exactly.

use super::text::{lines, point, short, wrong};
use super::{MeshError, Point, Surface};
use crate::mesh::MAX_TRIANGLES;

/// Bytes before the triangles: 80 of anything, and their number.
const HEAD: usize = 84;
/// Bytes of a triangle: normal, three corners in single precision, and two more bytes.
const TRIANGLE: usize = 50;

/// The number of triangles that the head of a binary file tells.
pub(super) fn promised(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?))
}

/// Bytes of a binary file with so many triangles.
pub(super) fn length(triangles: u32) -> u64 {
    HEAD as u64 + TRIANGLE as u64 * u64::from(triangles)
}

pub(super) fn binary(bytes: &[u8]) -> Result<Surface, MeshError> {
    let Some(triangles) = promised(bytes) else {
        let (found, promised) =
            (format!("{} bytes", bytes.len()), format!("the {HEAD} of a binary STL's head"));
        return Err(MeshError::Truncated { found, promised });
    };
    let body = &bytes[HEAD..];
    if length(triangles) > bytes.len() as u64 {
        let (found, promised) = (format!("{}", body.len() / TRIANGLE), format!("{triangles} triangles"));
        return Err(MeshError::Truncated { found, promised });
    }
    let more = body.len() - TRIANGLE * triangles as usize;
    if more > 0 {
        return Err(MeshError::TooLong { triangles, more });
    }
    if triangles as usize > MAX_TRIANGLES {
        return Err(MeshError::TooMany);
    }
    let mut surface = Surface::default();
    for triangle in body.as_chunks::<TRIANGLE>().0 {
        let number = |at: usize| {
            let bytes = [triangle[at], triangle[at + 1], triangle[at + 2], triangle[at + 3]];
            f64::from(f32::from_le_bytes(bytes))
        };
        surface.push(std::array::from_fn(|k| std::array::from_fn(|axis| number(12 + 12 * k + 4 * axis))))?;
    }
    Ok(surface)
}

/// The text form: `facet normal`, `outer loop`, three times `vertex x y z`, `endloop`, `endfacet`, however broken into lines.
pub(super) fn text(bytes: &[u8]) -> Result<Surface, MeshError> {
    let mut surface = Surface::default();
    let mut corners: Vec<Point> = Vec::new();
    let (mut complete, mut last) = (true, 0);
    for (number, line) in lines(bytes) {
        let mut words = line?.split_whitespace();
        while let Some(word) = words.next() {
            last = number;
            match word.to_ascii_lowercase().as_str() {
                // The rest of the line is a name.
                "solid" => (complete, words) = (false, "".split_whitespace()),
                "endsolid" => (complete, words) = (true, "".split_whitespace()),
                "facet" => {
                    // The normal is not used, and some programs write none that are numbers.
                    (complete, _) = (false, words.by_ref().take(4).count());
                }
                "vertex" => corners.push(point(words.by_ref(), number)?),
                "outer" => corners.clear(),
                "loop" | "endfacet" => {}
                "endloop" => match *corners {
                    [a, b, c] => surface.push([a, b, c])?,
                    _ => {
                        let count = corners.len();
                        return Err(wrong(
                            number,
                            format!("a triangle has 3 corners, and this one has {count}"),
                        ));
                    }
                },
                _ => {
                    let problem = format!("`{}` is no word of an STL file", short(word));
                    return Err(wrong(number, problem));
                }
            }
            if corners.len() > 3 {
                return Err(wrong(number, "a triangle has 3 corners, and this one has more".to_string()));
            }
        }
    }
    if complete {
        return Ok(surface);
    }
    let found = format!("{} triangles up to line {last}, but not the last line,", surface.faces.len());
    Err(MeshError::Truncated { found, promised: "`endsolid`".to_string() })
}
