//! Looking things up in a table, with an answer that points at the place when they are not there.

use super::{Node, Table, Value};
use crate::diagnostic::{Diagnostic, Problems, did_you_mean, listed};
use crate::keys::{Key, names};
use crate::source::Place;

/// A table under the name that messages give it.
#[derive(Debug, Clone)]
pub(crate) struct Section<'a> {
    pub table: &'a Table,
    /// Its header (or its braces).
    pub place: Place,
    /// `[time]`, `[[body]]`, "the shape `ring`".
    pub title: String,
}

impl<'a> Section<'a> {
    /// The table in a node, under a title.
    pub(crate) fn of(node: &'a Node, title: impl Into<String>) -> Result<Self, Diagnostic> {
        let title = title.into();
        match &node.value {
            Value::Table(table) => Ok(Self { table, place: node.place, title }),
            _ => {
                Err(Diagnostic::at(node.place, format!("{title} has to be a table, found {}", node.found()))
                    .label("expected a table"))
            }
        }
    }

    /// The value of an optional key.
    pub(crate) fn get(&self, key: &str) -> Option<&'a Node> {
        self.table.get(key)
    }

    /// The value of a key that has to be there.
    pub(crate) fn need(&self, key: &str) -> Result<&'a Node, Diagnostic> {
        self.get(key).ok_or_else(|| {
            Diagnostic::at(self.place, format!("missing key `{key}` in {}", self.title))
                .label(format!("`{key}` is required here"))
        })
    }

    /// Refuses every key that is not among `allowed`, each with the nearest right name.
    pub(crate) fn only(&self, allowed: &[Key], problems: &mut Problems) {
        problems.0.extend(self.unknown(&names(allowed)));
    }

    /// Refuses the first key that is not among `allowed`.
    pub(crate) fn only_first(&self, allowed: &[&str]) -> Result<(), Diagnostic> {
        self.unknown(allowed).next().map_or(Ok(()), Err)
    }

    /// Refuses the first key that is not among these.
    pub(crate) fn only_of(&self, allowed: &[Key]) -> Result<(), Diagnostic> {
        self.only_first(&names(allowed))
    }

    fn unknown(&self, allowed: &[&str]) -> impl Iterator<Item = Diagnostic> {
        let wrong = self.table.entries.iter().filter(|e| !allowed.contains(&e.key.as_str()));
        wrong.map(|entry| {
            let near = did_you_mean(&entry.key, allowed.iter().copied());
            let known = listed(allowed);
            let help = if near.starts_with("did") { format!("{near} (known here: {known})") } else { near };
            Diagnostic::at(entry.place, format!("unknown key `{}` in {}", entry.key, self.title))
                .label("not a key of this table")
                .help(help)
        })
    }
}

/// The sections of a list of tables, `[[key]]`; none if the key is not there.
pub(crate) fn list<'a>(root: &'a Table, key: &str, problems: &mut Problems) -> Vec<Section<'a>> {
    let Some(node) = root.get(key) else { return Vec::new() };
    let Value::Array(items) = &node.value else {
        let message = format!("`{key}` has to be a list of tables, found {}", node.found());
        problems.0.push(Diagnostic::at(node.place, message).help(format!("write the header as [[{key}]]")));
        return Vec::new();
    };
    items.iter().filter_map(|item| problems.keep(Section::of(item, list_title(item, key)))).collect()
}

/// `[[body]] `left``, or without the name when there is none.
fn list_title(item: &Node, key: &str) -> String {
    match &item.value {
        Value::Table(table) => match table.get("name").map(|node| &node.value) {
            Some(Value::Text(name)) => format!("[[{key}]] `{name}`"),
            _ => format!("[[{key}]]"),
        },
        _ => format!("each [[{key}]]"),
    }
}

/// A table of named tables, `[key.name]`; none if the key is not there.
pub(crate) fn named<'a>(root: &'a Table, key: &str, problems: &mut Problems) -> Vec<(&'a str, Section<'a>)> {
    let Some(node) = root.get(key) else { return Vec::new() };
    let Some(section) = problems.keep(Section::of(node, format!("[{key}]"))) else { return Vec::new() };
    let sections = section.table.entries.iter().filter_map(|entry| {
        let title = format!("[{key}.{}]", entry.key);
        Some((entry.key.as_str(), problems.keep(Section::of(&entry.node, title))?))
    });
    sections.collect()
}

/// What is read from an optional node, with its place; a wrong one is noted and left out.
pub(crate) fn optional<T>(
    node: Option<&Node>,
    problems: &mut Problems,
    read: impl FnOnce(&Node) -> Result<T, Diagnostic>,
) -> Option<(T, Place)> {
    let node = node?;
    Some((problems.keep(read(node))?, node.place))
}

/// The text in a node.
pub(crate) fn text<'a>(node: &'a Node, what: &str) -> Result<&'a str, Diagnostic> {
    match &node.value {
        Value::Text(text) => Ok(text),
        _ => Err(Diagnostic::at(node.place, format!("{what} has to be a text, found {}", node.found()))
            .label("expected a text in quotes")),
    }
}

/// The choice that a text names.
pub(crate) fn choice<T: Copy>(node: &Node, what: &str, choices: &[(&str, T, &str)]) -> Result<T, Diagnostic> {
    let name = text(node, what)?;
    choices.iter().find(|(n, ..)| *n == name).map(|(_, value, _)| *value).ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|(n, ..)| *n).collect();
        Diagnostic::at(node.place, format!("unknown {what} `{name}`, expected one of {}", listed(&names)))
            .help(did_you_mean(name, names))
    })
}
