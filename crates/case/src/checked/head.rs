//! The head of a case: name, title, dimension, plane, kernel.

use super::choices::{Kernel, Plane};
use super::defaults;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Words, case as keys};
use crate::written::{Node, Section, Value, choice, text};

/// What the case says before any number.
pub(super) struct Head {
    pub name: String,
    pub title: String,
    /// 2 or 3.
    pub dimension: usize,
    /// What 2D means; `None` in 3D.
    pub plane: Option<Plane>,
    pub kernel: Kernel,
}

/// The head; what is wrong is noted. `None` without a dimension: nothing else can be read then.
pub(super) fn head(top: &Section<'_>, problems: &mut Problems) -> Option<Head> {
    let name = problems.keep(top.need(keys::NAME.name).and_then(case_name)).unwrap_or_default();
    let title = top.get(keys::TITLE.name).map(|node| text(node, "title")).transpose();
    let title = problems.keep(title).flatten().unwrap_or(name);
    let kernel =
        top.get(keys::KERNEL.name).map(|node| choice(node, keys::KERNEL.name, Kernel::WORDS)).transpose();
    let kernel = problems.keep(kernel).flatten().unwrap_or(defaults::KERNEL);
    let dimension = problems.keep(top.need(keys::DIMENSION.name).and_then(dimension))?;
    let plane = problems.keep(plane(top.get(keys::PLANE.name), dimension)).flatten();
    Some(Head { name: name.to_string(), title: title.to_string(), dimension, plane, kernel })
}

fn case_name(node: &Node) -> Result<&str, Diagnostic> {
    let name = text(node, "name")?;
    let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 100 && name.chars().all(allowed) {
        return Ok(name);
    }
    Err(Diagnostic::at(node.place, format!("`{name}` cannot be the name of a case"))
        .help("use small letters, digits and `-`: it becomes the name of the output folder"))
}

fn dimension(node: &Node) -> Result<usize, Diagnostic> {
    match node.value {
        Value::Integer(2) => Ok(2),
        Value::Integer(3) => Ok(3),
        _ => Err(Diagnostic::at(node.place, format!("`dimension` has to be 2 or 3, found {}", node.found()))),
    }
}

fn plane(node: Option<&Node>, dimension: usize) -> Result<Option<Plane>, Diagnostic> {
    let Some(node) = node else { return Ok((dimension == 2).then_some(defaults::PLANE)) };
    if dimension == 3 {
        return Err(Diagnostic::at(node.place, "`plane` says what 2D means, and the case has dimension = 3")
            .help("remove it"));
    }
    choice(node, keys::PLANE.name, Plane::WORDS).map(Some)
}
