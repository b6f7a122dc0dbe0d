//! Every key of the tables, mutated: misspelt, of a wrong type, in a wrong unit, out of range. Each is refused at the right line;
//! nothing panics.

mod samples;

use case::keys::{self, Key, Kind, Range, Table};
use samples::parse;

/// A case that is right and uses every table.
const BASE: &str = r#"name = "all"
dimension = 2
spacing = 0.1

[parameters]
p = 1

[material.rubber]
model = "neo-hookean"
density = 1000
youngs_modulus = 1e7
poisson_ratio = 0.45

[region.some]
shape = { box = { min = [0, 0], max = [1, 1] } }

[[body]]
name = "one"
material = "rubber"
shape = "some"

[[tool]]
name = "punch"
shape = "some"
angle = "t"

[[contact]]
bodies = ["one", "punch"]

[[boundary]]
region = "some"
fixed = true

[[initial]]
region = "some"
velocity = [0, 0]

[[gravity]]
acceleration = [0, 0]

[[load]]
region = "some"
force = [0, 0]

[time]
end = 1

[damping]
probability = 0.5

[monitor]
zigzag = 0.1

[[probe]]
name = "tip"
at = [1, 1]

[[measure]]
name = "most"
kind = "maximum"
probe = "tip"
component = "y"
"#;

/// The base with increments of load, which know no contact: without what touches.
fn still() -> String {
    let tables: Vec<&str> =
        BASE.split("\n\n").filter(|t| !t.starts_with("[[tool]]") && !t.starts_with("[[contact]]")).collect();
    tables.join("\n\n") + "\n[quasi_static]\nincrements = 2\n"
}

/// The tables with the header that they have in the base; the top level has none.
fn tables() -> Vec<(&'static Table, &'static str)> {
    let mut tables = vec![(keys::all(), "")];
    for key in keys::all().keys {
        match key.kind {
            Kind::Table(table) | Kind::List(table) => tables.push((table, table.header)),
            Kind::Named(table) if key.name == "material" => tables.push((table, "[material.rubber]")),
            Kind::Named(table) => tables.push((table, "[region.some]")),
            _ => {}
        }
    }
    tables
}

/// The base with a line of a table replaced or added, and the number of that line.
fn with(header: &str, key: &str, line: &str) -> (String, usize) {
    let base = if header == "[quasi_static]" { still() } else { BASE.to_string() };
    let mut lines: Vec<String> = base.lines().map(str::to_string).collect();
    let start = if header.is_empty() { 0 } else { 1 + lines.iter().position(|l| l == header).expect(header) };
    let end = (start..lines.len()).find(|&i| lines[i].is_empty()).unwrap_or(lines.len());
    let old = (start..end).find(|&i| lines[i].split(" = ").next() == Some(key));
    let at = match old {
        Some(at) => {
            lines[at] = line.to_string();
            at
        }
        None => {
            lines.insert(start, line.to_string());
            start
        }
    };
    (lines.join("\n") + "\n", at + 1)
}

/// Refused, with a diagnostic that points at the line.
#[track_caller]
fn refused(text: &str, line: usize, why: &str) {
    let error = match parse(text) {
        Ok(_) => panic!("accepted: {why}\n{text}"),
        Err(error) => error,
    };
    let rendered = error.render(false);
    let lines: Vec<Option<usize>> = error.diagnostics.iter().map(|d| error.line(d)).collect();
    assert!(lines.contains(&Some(line)), "{why}: not at line {line}\n{rendered}");
}

/// Values of a wrong type for a kind.
fn wrong_types(kind: &Kind) -> Vec<&'static str> {
    let mut wrong = vec!["2026-01-01"];
    match kind {
        Kind::Text | Kind::Name | Kind::NameOf(_) | Kind::Choice(_) => {
            wrong.extend(["1", "true", "[1]", "{ a = 1 }", "\"\u{1f600} no such thing\""]);
            if matches!(kind, Kind::Text) {
                wrong.pop();
            }
        }
        Kind::NamesOf(_) => wrong.extend(["1", "[]", "[1]", "{}", "\"one\"", "[\"nobody\"]"]),
        Kind::Flag => wrong.extend(["1", "\"true\"", "[]", "{}"]),
        Kind::True => wrong.extend(["false", "1", "\"true\"", "[]", "{}"]),
        Kind::OneOf(_) | Kind::Count => wrong.extend(["0", "-1", "1.5", "\"2\"", "[2]", "true", "{}"]),
        Kind::Number(..) | Kind::OfProbe | Kind::Scalar(_) | Kind::AngleOfTime => {
            wrong.extend(["true", "[1]", "{}", "nan", "inf", "\"\"", "\"2 +\""])
        }
        Kind::OfTime(_) => wrong.extend(["1", "[1]", "[\"x\", 0]", "[0, \"1/t\"]", "[true, 1]", "{}"]),
        Kind::Vector(_) | Kind::Pair(_) | Kind::Place(_) | Kind::Field(_) | Kind::FieldOrFree(_) => {
            wrong.extend([
                "1",
                "true",
                "[1]",
                "[1, 2, 3]",
                "[1, true]",
                "[nan, 1]",
                "[\"q\", 1]",
                "\"1\"",
                "{}",
            ]);
        }
        Kind::Pairs(_) => wrong.extend(["1", "[]", "[[0, 0], [1, 1]]", "[[0], [1], [2]]"]),
        Kind::History => wrong.extend([
            "1",
            "[]",
            "[1]",
            "[[1]]",
            "[[0, 0], [0, 1]]",
            "[[1, 0], [0, 1]]",
            "[[\"1 m\", 0]]",
            "\"no such.csv\"",
            "{}",
        ]),
        Kind::Axes => wrong.extend(["1", "\"x\"", "[]", "[\"q\"]", "[1]", "[\"z\"]"]),
        Kind::Shape => wrong.extend(["1", "[]", "{}", "\"nowhere\"", "{ blob = {} }", "{ box = 1 }"]),
        Kind::Shapes => wrong.extend(["1", "[]", "{}"]),
        Kind::Fill => wrong.extend(["1", "[]", "{}", "\"full\"", "{ lattice = {} }", "{ lattice = 1 }"]),
        Kind::Parameters | Kind::Table(_) | Kind::Named(_) | Kind::List(_) => {
            wrong.extend(["1", "\"text\"", "true", "[1]"]);
        }
    }
    wrong
}

/// Values of a wrong unit for a kind; angles and shares have no unit to be wrong in, but a mass is wrong everywhere.
fn wrong_units(kind: &Kind) -> Vec<&'static str> {
    match kind {
        Kind::Number(..) | Kind::OfProbe | Kind::Scalar(_) => vec!["\"3 kg\"", "\"3 W\"", "\"3 lightyears\""],
        Kind::AngleOfTime => vec!["\"3 kg\"", "\"3 m\""],
        Kind::Vector(_)
        | Kind::Pair(_)
        | Kind::Place(_)
        | Kind::Field(_)
        | Kind::FieldOrFree(_)
        | Kind::OfTime(_) => {
            vec!["[\"3 kg\", 1]", "[1, \"3 W\"]", "[\"3 lightyears\", 1]"]
        }
        _ => Vec::new(),
    }
}

/// Values out of range for a kind.
fn out_of_range(kind: &Kind) -> Vec<&'static str> {
    match kind {
        Kind::Number(_, Range::Positive) | Kind::OfProbe => vec!["0", "-1", "\"-p\"", "\"0*p\""],
        Kind::Number(_, Range::NotNegative) => vec!["-1", "\"-1e-300\""],
        Kind::Number(_, Range::Share) => vec!["0", "-1", "1.0001", "\"2*p\""],
        Kind::Number(_, Range::Poisson) => vec!["0.5", "-1", "7", "\"p/2\""],
        Kind::Number(_, Range::Smoothing) => vec!["0", "-1", "0.1", "100"],
        _ => Vec::new(),
    }
}

/// What else a table needs so that this key is read at all.
fn ready(key: &Key, text: String) -> String {
    match key.name {
        // One thing at a time: these stand beside another that they exclude.
        "fix" | "displacement" => text.replacen("fixed = true\n", "", 1),
        "velocity" => {
            text.replacen("fixed = true\n", "", usize::from(text.contains("\n[[boundary]]\nvelocity")))
        }
        "extremum" | "prominence" | "index" => {
            let rest = [("extremum", "\"maximum\""), ("prominence", "1"), ("index", "1")];
            let rest = rest.iter().filter(|(name, _)| *name != key.name);
            let more: String = rest.map(|(name, value)| format!("{name} = {value}\n")).collect();
            text.replacen("kind = \"maximum\"", "kind = \"turning-points\"", 1) + &more
        }
        "axis" => text
            .replacen("kind = \"maximum\"", "kind = \"most-turns\"", 1)
            .replacen("component = \"y\"\n", "", 1)
            .replacen("at = [1, 1]\n", "at = [1, 1]\nquantity = \"position\"\n", 1),
        "time" => text.replacen("kind = \"maximum\"", "kind = \"value-at\"", 1),
        _ => text,
    }
}

fn mutate(table: &Table, header: &str, key: &Key) {
    let is_table = matches!(key.kind, Kind::Parameters | Kind::Table(_) | Kind::Named(_) | Kind::List(_));
    for letters in [1, key.name.len() / 2 + 1] {
        let misspelt = format!("{}q{}", &key.name[..letters], &key.name[letters..]);
        let (text, line) = with(header, "", &format!("{misspelt} = 1"));
        refused(&text, line, &format!("{misspelt} in {}", table.header));
    }
    if is_table {
        // A table cannot be replaced by a line; a second key of its name is a mistake of TOML.
        let (text, line) = with("", "", &format!("{} = 1", key.name));
        let alone = text.split("\n[").next().expect("the top").to_string() + "\n";
        refused(&alone, line, key.name);
        return;
    }
    let values = [wrong_types(&key.kind), wrong_units(&key.kind), out_of_range(&key.kind)].concat();
    for value in values {
        let (text, line) = with(header, key.name, &format!("{} = {value}", key.name));
        // Whatever it says, it says it without a panic ...
        let _ = parse(&text).map_err(|error| error.render(true));
        let text = ready(key, text);
        if alone(header, key.name) {
            // ... and, where it is read, in the right line.
            refused(
                &text,
                line_of(&text, key.name, value).unwrap_or(line),
                &format!("{} = {value}", key.name),
            );
        }
    }
}

/// Where `key = value` stands now.
fn line_of(text: &str, key: &str, value: &str) -> Option<usize> {
    text.lines().position(|line| line == format!("{key} = {value}")).map(|at| at + 1)
}

/// Whether the base reads this key; a few belong to what the base does not have.
fn alone(header: &str, key: &str) -> bool {
    // Two elastic constants are given, a third is one too many; a region and a point exclude each other; a step rule is total
    // Lagrangian; a body of a measure belongs to another kind: all refused, some at the other line.
    !matches!(
        (header, key),
        ("[material.rubber]", "bulk_modulus" | "shear_modulus")
            | ("[[probe]]", "region")
            | ("[[measure]]", "body")
    )
}

#[test]
fn the_base_is_right_and_every_key_is_mutated() {
    parse(BASE).expect("the base is right");
    parse(&still()).expect("and so it is with increments");
    let mut keys = 0;
    for (table, header) in tables() {
        for key in table.keys {
            mutate(table, header, key);
            keys += 1;
        }
    }
    assert!(keys > 55, "{keys} keys");
}

#[test]
fn every_key_of_every_shape_is_mutated() {
    let around = |kind: &str, inside: &str| {
        BASE.replacen(
            "{ box = { min = [0, 0], max = [1, 1] } }",
            &format!("{{ {kind} = {{ {inside} }} }}"),
            1,
        )
    };
    let right = |key: &Key| match key.name {
        "min" | "from" | "center" | "about" | "by" => "[0, 0]",
        "max" | "to" => "[1, 1]",
        "points" => "[[0, 0], [1, 0], [0, 1]]",
        "shape" => "{ box = { min = [0, 0], max = [1, 1] } }",
        "inner" => "0.5",
        _ => "1",
    };
    let line = BASE.lines().position(|l| l.starts_with("shape = { box")).expect("the shape") + 1;
    for &(kind, _, keys) in keys::shapes() {
        let planar = |key: &&Key| key.name != "height" && key.name != "axis";
        let all = |but: &str, value: &str| -> String {
            let one =
                |key: &Key| format!("{} = {}", key.name, if key.name == but { value } else { right(key) });
            keys.iter().filter(planar).map(one).collect::<Vec<_>>().join(", ")
        };
        for key in keys.iter().filter(planar) {
            let values = [wrong_types(&key.kind), wrong_units(&key.kind), out_of_range(&key.kind)].concat();
            for value in values {
                refused(
                    &around(kind, &all(key.name, value)),
                    line,
                    &format!("{kind}: {} = {value}", key.name),
                );
            }
            refused(&around(kind, &all("", "").replacen(key.name, "qqq", 1)), line, kind);
        }
        for wrong in ["1", "[]", "{}", "true"] {
            if !(wrong == "{}" && keys.is_empty()) {
                let text = BASE.replacen(
                    "{ box = { min = [0, 0], max = [1, 1] } }",
                    &format!("{{ {kind} = {wrong} }}"),
                    1,
                );
                refused(&text, line, kind);
            }
        }
    }
}
