//! Arguments that override the case file: `--set a.b=value` and `--formulation NAME`.

use crate::diagnostic::{Diagnostic, did_you_mean};
use crate::source::{Place, Sources};
use crate::written::{Entry, Node, Table, Value, parse_argument};

/// What the command line changes about a case.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Overrides {
    /// Each as typed after `--set`: `a.b=value`. Parts of the path are keys, numbers count the
    /// entries of a list from 0, and a named entry of a list may be called by its name
    /// (`body.left.velocity=...`). The value is a TOML value, or else text.
    pub set: Vec<String>,
    /// The formulation of every body, whatever the file says.
    pub formulation: Option<String>,
}

impl Overrides {
    /// Overrides by `--set` only.
    pub fn set<S: Into<String>>(set: impl IntoIterator<Item = S>) -> Self {
        Self { set: set.into_iter().map(Into::into).collect(), formulation: None }
    }
}

const PREFIX: &str = "--set ";

/// Puts one `--set` into the tree.
///
/// # Errors
/// No `=`, or a path that leads nowhere. (Whether the key and the value are right is checked later,
/// as for the file.)
pub(crate) fn apply(root: &mut Table, argument: &str, sources: &mut Sources) -> Result<(), Diagnostic> {
    let typed = format!("{PREFIX}{argument}");
    let text = sources.add_argument(typed.clone());
    let whole = Place { text, start: PREFIX.len(), end: typed.len() };
    let Some(equals) = argument.find('=') else {
        return Err(Diagnostic::at(whole, "`--set` needs a path, `=` and a value")
            .help("for example --set time.end=0.01"));
    };
    let parts = path_parts(&argument[..equals], text);
    if let Some(empty) = parts.iter().find(|part| part.name.is_empty()) {
        return Err(Diagnostic::at(empty.place, "empty name in the path of `--set`"));
    }
    let value = parse_argument(&typed, text, PREFIX.len() + equals + 1);
    put(root, &parts, value)
}

/// One name of a path, and where it stands in the argument.
struct Part<'a> {
    name: &'a str,
    place: Place,
}

fn path_parts(path: &str, text: usize) -> Vec<Part<'_>> {
    let mut start = PREFIX.len();
    path.split('.')
        .map(|raw| {
            let place = Place { text, start, end: start + raw.len() };
            start = place.end + 1;
            Part { name: raw.trim(), place }
        })
        .collect()
}

/// Walks down the path, making tables that are not there yet, and puts the value at its end.
fn put(root: &mut Table, parts: &[Part<'_>], value: Node) -> Result<(), Diagnostic> {
    let Some((last, way)) = parts.split_last() else { return Ok(()) };
    refuse_new_name(root, parts)?;
    if way.is_empty() {
        root.set(last.name, last.place, value);
        return Ok(());
    }
    let mut node = child(root, &way[0]);
    for (depth, part) in way.iter().enumerate().skip(1) {
        node = down(node, part, parts[depth - 1].name)?;
    }
    let parent = parts[parts.len() - 2].name;
    match &mut node.value {
        Value::Table(table) => table.set(last.name, last.place, value),
        Value::Array(_) => *down(node, last, parent)? = value,
        _ => return Err(no_way(node, last, parent)),
    }
    Ok(())
}

/// A new parameter, material or region would be used by nothing: surely a slip.
fn refuse_new_name(root: &Table, parts: &[Part<'_>]) -> Result<(), Diagnostic> {
    let [first, second, ..] = parts else { return Ok(()) };
    if !["parameters", "material", "region"].contains(&first.name) {
        return Ok(());
    }
    let names: Vec<&str> = match root.get(first.name).map(|node| &node.value) {
        Some(Value::Table(table)) => table.keys().collect(),
        _ => Vec::new(),
    };
    if names.contains(&second.name) {
        return Ok(());
    }
    let kind = first.name.trim_end_matches('s');
    Err(Diagnostic::at(second.place, format!("the case has no {kind} `{}`", second.name))
        .help(did_you_mean(second.name, names)))
}

/// The value of a key of a table; a key that is not there becomes an empty table.
fn child<'a>(table: &'a mut Table, part: &Part<'_>) -> &'a mut Node {
    let at = table.entries.iter().position(|e| e.key == part.name).unwrap_or_else(|| {
        let node = Node { value: Value::Table(Table::default()), place: part.place, content: None };
        table.entries.push(Entry { key: part.name.to_string(), place: part.place, node });
        table.entries.len() - 1
    });
    &mut table.entries[at].node
}

/// One step down the path.
fn down<'a>(node: &'a mut Node, part: &Part<'_>, parent: &str) -> Result<&'a mut Node, Diagnostic> {
    let refusal = no_way(node, part, parent);
    match &mut node.value {
        Value::Table(table) => Ok(child(table, part)),
        Value::Array(items) => {
            let at = index(items, part, parent)?;
            Ok(&mut items[at])
        }
        _ => Err(refusal),
    }
}

/// Which entry of a list a part of a path means: its number from 0, or its name.
fn index(items: &[Node], part: &Part<'_>, parent: &str) -> Result<usize, Diagnostic> {
    let named: Vec<Option<&str>> = items.iter().map(name_of).collect();
    let at = part.name.parse().ok().or_else(|| named.iter().position(|n| *n == Some(part.name)));
    match at {
        Some(at) if at < items.len() => Ok(at),
        Some(at) => Err(Diagnostic::at(
            part.place,
            format!("`{parent}` has {} entries, counted from 0: there is no {at}", items.len()),
        )),
        None => Err(Diagnostic::at(part.place, format!("no `{parent}` is called `{}`", part.name))
            .help(did_you_mean(part.name, named.into_iter().flatten()))),
    }
}

fn name_of(node: &Node) -> Option<&str> {
    match &node.value {
        Value::Table(table) => match &table.get("name")?.value {
            Value::Text(name) => Some(name),
            _ => None,
        },
        _ => None,
    }
}

fn no_way(node: &Node, part: &Part<'_>, parent: &str) -> Diagnostic {
    Diagnostic::at(part.place, format!("`{parent}` is {}: there is no `{}` in it", node.found(), part.name))
}
