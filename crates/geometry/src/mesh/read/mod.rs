//! Mesh files: STL, binary and text, and OBJ. Nothing in a file is trusted: lengths are compared with the bytes that are there
//! before memory is taken.

mod obj;
mod stl;
mod text;

use super::MeshError;
use super::surface::Surface;
use crate::point::Point;

/// The kinds of files that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// STL of bytes.
    StlBinary,
    /// STL of words.
    StlText,
    /// Wavefront OBJ.
    Obj,
}

impl MeshFormat {
    /// What a person calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::StlBinary => "binary STL",
            Self::StlText => "text STL",
            Self::Obj => "OBJ",
        }
    }
}

/// The triangles of a file; `name` is its name, of which only the ending counts.
pub(crate) fn surface(bytes: &[u8], name: &str) -> Result<(Surface, MeshFormat), MeshError> {
    let format = format(bytes, name)?;
    let surface = match format {
        MeshFormat::StlBinary => stl::binary(bytes)?,
        MeshFormat::StlText => stl::text(bytes)?,
        MeshFormat::Obj => obj::read(bytes)?,
    };
    Ok((surface, format))
}

/// Many binary STL files begin with `solid` too: the length decides, then whether what follows are words.
fn format(bytes: &[u8], name: &str) -> Result<MeshFormat, MeshError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(MeshError::Empty);
    }
    let ends = |end: &str| name.to_ascii_lowercase().ends_with(end);
    if ends(".obj") {
        return Ok(MeshFormat::Obj);
    }
    let words = bytes.trim_ascii_start();
    let solid = words.get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    let readable =
        |head: &[u8]| head.iter().all(|b| b.is_ascii_graphic() || b.is_ascii_whitespace() || *b >= 128);
    let fits = stl::promised(bytes).is_some_and(|n| bytes.len() as u64 == stl::length(n));
    if fits {
        return Ok(MeshFormat::StlBinary);
    }
    if solid && readable(&words[..words.len().min(512)]) {
        return Ok(MeshFormat::StlText);
    }
    if ends(".stl") {
        return Ok(MeshFormat::StlBinary);
    }
    let first = text::lines(words).next().and_then(|(_, line)| line.ok()).unwrap_or_default();
    match first.split_whitespace().next() {
        Some("v" | "#" | "o" | "g" | "mtllib") => Ok(MeshFormat::Obj),
        _ => Err(MeshError::Unknown(begins(words))),
    }
}

/// The first bytes of a file, as a person can read them.
fn begins(bytes: &[u8]) -> String {
    format!("\"{}\"", bytes[..bytes.len().min(16)].escape_ascii())
}
