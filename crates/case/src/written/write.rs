//! From the tree back to TOML text.

use super::{Node, Table, Value};

/// The table as a TOML document, keys in their order (plain values first, then tables).
pub(crate) fn to_toml(root: &Table) -> String {
    let mut out = String::new();
    write_table(&mut out, "", root);
    out
}

fn write_table(out: &mut String, path: &str, table: &Table) {
    let (headed, plain): (Vec<_>, Vec<_>) = table.entries.iter().partition(|e| is_headed(&e.node));
    for entry in plain {
        out.push_str(&format!("{} = {}\n", key(&entry.key), inline(&entry.node)));
    }
    for entry in headed {
        let path = if path.is_empty() { key(&entry.key) } else { format!("{path}.{}", key(&entry.key)) };
        match &entry.node.value {
            Value::Table(table) => {
                if table.entries.is_empty() || !table.entries.iter().all(|e| is_headed(&e.node)) {
                    out.push_str(&format!("\n[{path}]\n"));
                }
                write_table(out, &path, table);
            }
            Value::Array(items) => {
                for item in items {
                    if let Value::Table(table) = &item.value {
                        out.push_str(&format!("\n[[{path}]]\n"));
                        write_table(out, &path, table);
                    }
                }
            }
            _ => {}
        }
    }
}

/// Whether a value was written below a header of its own.
fn is_headed(node: &Node) -> bool {
    let below_header = |node: &Node| matches!(&node.value, Value::Table(t) if !t.inline);
    match &node.value {
        Value::Array(items) => !items.is_empty() && items.iter().all(below_header),
        _ => below_header(node),
    }
}

fn inline(node: &Node) -> String {
    match &node.value {
        Value::Text(text) => quoted(text),
        Value::Integer(number) => number.to_string(),
        Value::Number(number) => format!("{number:?}").replace("NaN", "nan"),
        Value::Bool(value) => value.to_string(),
        Value::Date(date) => date.clone(),
        Value::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let entries = table.entries.iter().map(|e| format!("{} = {}", key(&e.key), inline(&e.node)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(bare) { name.to_string() } else { quoted(name) }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_string()).to_string()
}
