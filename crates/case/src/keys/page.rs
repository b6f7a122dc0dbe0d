//! The reference page of the manual.

use super::schema::unit;
use super::{Choice, Key, Kind, Need, Table, all, fill, shapes};
use crate::expression::function_names;
use std::fmt::Write as _;

const HEAD: &str = "\
# Case files: every key

This page is written by the program (`taut schema --page`), from the tables that its reader works with.

A case is one TOML file. A *number* is written plainly, in SI units (`0.02`); as a text with a unit (`\"20 mm\"`, `\"1.1 g/cm^3\"`); or
as an expression of the parameters (`\"2*L\"`). Where a value may differ from place to place the expression may also use the
reference position `x`, `y`, `z` (m), and where it may change, the time `t` (s). Editors that read JSON schemas complete and
explain all keys: save what `taut schema` prints as `taut-case.schema.json` and begin the case with
`#:schema taut-case.schema.json`.
";

/// The page, in Markdown.
#[must_use]
pub fn page() -> String {
    let mut page = HEAD.to_string();
    section(&mut page, all());
    for key in all().keys {
        if let Kind::Table(of) | Kind::Named(of) | Kind::List(of) = key.kind {
            section(&mut page, of);
        }
    }
    shapes_and_fillings(&mut page);
    expressions(&mut page);
    page
}

fn section(page: &mut String, table: &Table) {
    let title =
        if table.header.starts_with('[') { format!("`{}`", table.header) } else { "Top level".into() };
    let _ = write!(page, "\n## {title}\n\n{}\n\n```toml\n{}\n```\n\n", table.doc, table.example);
    rows(page, table.keys);
    choices(page, table.keys);
}

/// The words of keys that have some.
fn choices(page: &mut String, keys: &[Key]) {
    for key in keys {
        if let Kind::Choice(choices) = key.kind {
            let _ = write!(page, "\n`{}` is one of\n\n", key.name);
            words(page, &choices());
        }
    }
}

fn rows(page: &mut String, keys: &[Key]) {
    page.push_str("| key | value | default | |\n|---|---|---|---|\n");
    for key in keys {
        let default = match key.need {
            Need::Required => "**required**",
            Need::Default(default) => default,
            Need::Optional => "",
        };
        let _ = writeln!(page, "| `{}` | {} | {default} | {} |", key.name, value(&key.kind), key.doc);
    }
}

fn words(page: &mut String, choices: &[Choice]) {
    for choice in choices {
        let _ = writeln!(page, "- `\"{}\"`: {}", choice.name, choice.doc);
    }
}

fn value(kind: &Kind) -> String {
    let of = unit(kind).map_or(String::new(), |unit| format!(" ({unit})"));
    let what = match *kind {
        Kind::Text => "text",
        Kind::Name => "name",
        Kind::NameOf(part) => return format!("name of a {part}"),
        Kind::NamesOf(part) => return format!("list of one or two names of a {part}"),
        Kind::True => "`true`",
        Kind::Flag => "`true` or `false`",
        Kind::OneOf(numbers) => {
            return numbers.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(" or ");
        }
        Kind::Count => "whole number from 1 on",
        Kind::Number(..) | Kind::OfProbe => "number",
        Kind::Vector(_) => "number per axis",
        Kind::Pair(_) => "two numbers",
        Kind::Pairs(_) => "list of points",
        Kind::Place(_) => "expression of x, y, z per axis",
        Kind::Scalar(_) => "expression of x, y, z, t",
        Kind::History => "list of [time, factor], or name of a CSV file",
        Kind::Field(_) => "expression of x, y, z, t per axis",
        Kind::OfTime(_) => "expression of t per axis",
        Kind::AngleOfTime => "expression of t",
        Kind::FieldOrFree(_) => "expression of x, y, z, t or `\"free\"` per axis",
        Kind::Choice(_) => "word",
        Kind::Axes => "list of axes",
        Kind::Shape => "shape",
        Kind::Shapes => "list of shapes",
        Kind::Fill => "filling",
        Kind::Parameters | Kind::Table(_) => "table",
        Kind::Named(_) => "tables by name",
        Kind::List(_) => "list of tables",
    };
    format!("{what}{of}")
}

fn shapes_and_fillings(page: &mut String) {
    page.push_str(
        "\n## Shapes\n\nA shape is a table with one key, its kind, or the name of a region in quotes:\n`shape = { difference = [\"plate\", { ball = { center = [0, 0], radius = \"5 mm\" } }] }`.\n",
    );
    for &(name, doc, keys) in shapes() {
        let _ = write!(page, "\n### `{name}`\n\n{doc}\n");
        if !keys.is_empty() {
            page.push('\n');
            rows(page, keys);
            choices(page, keys);
        }
    }
    page.push_str("\n## Fillings\n\n");
    words(page, fill::CHOICES);
    page.push_str("- `{ polar = { around = 36 } }`: layers around the centre of a ring in 2D with as many particles each, one behind the other, each with its sector.\n");
}

fn expressions(page: &mut String) {
    let names: Vec<String> = function_names().map(|name| format!("`{name}`")).collect();
    let _ = write!(
        page,
        "\n## Expressions\n\nNumbers, parameters, `pi`, `+ - * / ^`, comparisons, parentheses and the functions {}.\n`-2^2` is -4, `2^3^2` is 512; `if(condition, then, else)` chooses. Angles are radians. A unit may not stand inside an\nexpression: give the quantity a name in `[parameters]`.\n",
        names.join(", ")
    );
}
