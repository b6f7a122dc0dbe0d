//! The case as written: TOML values that know where they stand.

mod parse;
mod section;
mod write;

pub(crate) use parse::{parse_argument, parse_file};
pub(crate) use section::{Section, choice, list, named, optional, text};
pub(crate) use write::to_toml;

use crate::source::Place;

/// A value of the file (or of an override) and where it stands.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub value: Value,
    pub place: Place,
    /// For a text written without escapes: the byte of the source where its content begins.
    pub content: Option<usize>,
}

/// What a TOML value can be.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Number(f64),
    Bool(bool),
    Date(String),
    Array(Vec<Node>),
    Table(Table),
}

/// Keys and values in the order of the file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    pub entries: Vec<Entry>,
    /// Written in braces, not below a header.
    pub inline: bool,
}

/// One key with its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub key: String,
    pub place: Place,
    pub node: Node,
}

impl Table {
    pub(crate) fn get(&self, key: &str) -> Option<&Node> {
        self.entries.iter().find(|e| e.key == key).map(|e| &e.node)
    }

    pub(crate) fn get_mut(&mut self, key: &str) -> Option<&mut Node> {
        self.entries.iter_mut().find(|e| e.key == key).map(|e| &mut e.node)
    }

    /// Sets a key, in its old place or at the end; `place` is where a new key is named.
    pub(crate) fn set(&mut self, key: &str, place: Place, node: Node) {
        match self.get_mut(key) {
            Some(old) => *old = node,
            None => self.entries.push(Entry { key: key.to_string(), place, node }),
        }
    }

    /// Removes a key, if it is there.
    pub(crate) fn remove(&mut self, key: &str) {
        self.entries.retain(|e| e.key != key);
    }

    pub(crate) fn keys(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|e| e.key.as_str())
    }
}

impl Node {
    /// What stands here, for "found ...".
    pub(crate) fn found(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("the text \"{}\"", short(text)),
            Value::Integer(number) => format!("the number {number}"),
            Value::Number(number) => format!("the number {number}"),
            Value::Bool(value) => format!("`{value}`"),
            Value::Date(date) => format!("the date {date}"),
            Value::Array(items) => format!("a list of {}", items.len()),
            Value::Table(_) => "a table".to_string(),
        }
    }
}

/// The first forty characters.
fn short(text: &str) -> String {
    let mut cut: String = text.chars().take(40).collect();
    if cut.len() < text.len() {
        cut.push_str("...");
    }
    cut
}
