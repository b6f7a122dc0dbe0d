//! `[parameters]`: numbers by name, which may be expressions of one another.

use super::scope::{Scope, expression_diagnostic, read_quantity};
use crate::diagnostic::{Diagnostic, Problems};
use crate::expression::{Expression, Names, is_reserved};
use crate::units::Quantity;
use crate::written::{Entry, Section, Table, Value};

/// The scope with all parameters of the case (an empty one if a parameter is wrong).
pub(crate) fn read(root: &Table, dimension: usize, problems: &mut Problems) -> Scope {
    let mut scope = Scope { dimension, ..Scope::default() };
    let Some(node) = root.get("parameters") else { return scope };
    let Some(section) = problems.keep(Section::of(node, "[parameters]")) else { return scope };
    let entries = &section.table.entries;
    let names: Vec<&str> = section.table.keys().collect();
    let definitions: Vec<Option<Definition>> =
        entries.iter().map(|entry| problems.keep(Definition::read(entry, &names))).collect();
    let Some(definitions) = definitions.into_iter().collect::<Option<Vec<_>>>() else { return scope };
    if let Some(values) = problems.keep(evaluate(entries, &definitions)) {
        scope.parameters = names.iter().map(|name| name.to_string()).zip(values).collect();
        let units = definitions.into_iter().zip(&names);
        scope.units = units.filter_map(|(d, name)| Some((name.to_string(), d.quantity?))).collect();
    }
    scope
}

/// What one parameter is said to be.
struct Definition {
    /// Over the other parameters, in the order of the file.
    expression: Expression,
    quantity: Option<Quantity>,
}

impl Definition {
    fn read(entry: &Entry, names: &[&str]) -> Result<Self, Diagnostic> {
        check_name(entry)?;
        let node = &entry.node;
        let plain = |value| Ok(Self { expression: Expression::constant(value), quantity: None });
        let text = match &node.value {
            Value::Integer(number) => return plain(*number as f64),
            Value::Number(number) => return plain(*number),
            Value::Text(text) => text,
            _ => {
                let message = format!("parameter `{}` has to be a number, found {}", entry.key, node.found());
                return Err(Diagnostic::at(node.place, message)
                    .label("expected a number, a quantity or an expression"));
            }
        };
        if let Some(quantity) = read_quantity(node, text)? {
            let expression = Expression::constant(quantity.value);
            return Ok(Self { expression, quantity: Some(quantity) });
        }
        let expression = Expression::parse(text, &Names { variables: names, constants: &[] })
            .map_err(|error| expression_diagnostic(node, error))?;
        Ok(Self { expression, quantity: None })
    }
}

fn check_name(entry: &Entry) -> Result<(), Diagnostic> {
    let name = &entry.key;
    let first = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
    if !first || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Err(Diagnostic::at(entry.place, format!("`{name}` cannot be the name of a parameter"))
            .help("use letters, digits and `_`, so that expressions can name it"));
    }
    if is_reserved(name) {
        return Err(Diagnostic::at(entry.place, format!("`{name}` cannot be the name of a parameter"))
            .help("in expressions it is a function, a coordinate, the time or pi"));
    }
    Ok(())
}

/// The values, each after those it depends on (a walk in depth, with a path of its own instead of recursion).
fn evaluate(entries: &[Entry], definitions: &[Definition]) -> Result<Vec<f64>, Diagnostic> {
    let mut values = vec![f64::NAN; definitions.len()];
    let mut done = vec![false; definitions.len()];
    let mut waits = vec![false; definitions.len()];
    for first in 0..definitions.len() {
        let mut path = vec![first];
        while let Some(&now) = path.last() {
            let missing = definitions[now].expression.variables().find(|&v| !done[v]);
            waits[now] = true;
            match missing {
                _ if done[now] => drop(path.pop()),
                Some(next) if waits[next] => return Err(cycle(entries, &path, next)),
                Some(next) => path.push(next),
                None => {
                    values[now] = finite(&entries[now], definitions[now].expression.eval(&values))?;
                    done[now] = true;
                }
            }
        }
    }
    Ok(values)
}

fn finite(entry: &Entry, value: f64) -> Result<f64, Diagnostic> {
    if value.is_finite() {
        return Ok(value);
    }
    let message = format!("parameter `{}` is {value}, expected a finite number", entry.key);
    Err(Diagnostic::at(entry.node.place, message))
}

/// Names the circle that the path closes by coming back to `start`.
fn cycle(entries: &[Entry], path: &[usize], start: usize) -> Diagnostic {
    let from = path.iter().position(|&p| p == start).unwrap_or(0);
    let circle = path[from..].iter().chain([&start]);
    let names: Vec<String> = circle.map(|&p| format!("`{}`", entries[p].key)).collect();
    let shown =
        if names.len() > 8 { format!("{} -> ...", names[..8].join(" -> ")) } else { names.join(" -> ") };
    Diagnostic::at(entries[start].node.place, format!("parameters depend on each other in a circle: {shown}"))
        .help("give one of them a number")
}
