//! Names that a case gives to its parts, and looking them up.

use crate::diagnostic::{Diagnostic, did_you_mean};
use crate::written::{Node, Section, text};

/// The name of a part: it becomes a column or a file, so letters, digits, `-` and `_` only.
pub(crate) fn part_name<'a>(section: &Section<'a>) -> Result<&'a str, Diagnostic> {
    let node = section.need("name")?;
    let name = text(node, "name")?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !name.is_empty() && name.len() <= 100 && name.chars().all(allowed) {
        return Ok(name);
    }
    Err(Diagnostic::at(node.place, format!("`{name}` cannot be a name"))
        .help("use letters, digits, `-` and `_`: names become columns and files"))
}

/// The names of a list of parts (those that have one), refusing one that comes twice.
pub(crate) fn part_names<'a>(sections: &[Section<'a>]) -> (Vec<Option<&'a str>>, Vec<Diagnostic>) {
    let mut names: Vec<Option<&str>> = Vec::with_capacity(sections.len());
    let mut twice = Vec::new();
    for section in sections {
        let node = section.get("name");
        let name = node.and_then(|node| text(node, "name").ok());
        if let (Some(node), Some(name)) = (node, name.filter(|_| names.contains(&name))) {
            twice.push(
                Diagnostic::at(node.place, format!("the name `{name}` is given twice"))
                    .label(format!("another {} has this name", section.title)),
            );
        }
        names.push(name);
    }
    (names, twice)
}

/// Which of the named parts a text names.
pub(crate) fn find(node: &Node, kind: &str, names: &[Option<&str>]) -> Result<usize, Diagnostic> {
    let name = text(node, kind)?;
    names.iter().position(|n| *n == Some(name)).ok_or_else(|| {
        Diagnostic::at(node.place, format!("unknown {kind} `{name}`"))
            .help(did_you_mean(name, names.iter().copied().flatten()))
    })
}
