//! The JSON schema of case files, for editors that complete and explain (taplo: `#:schema taut-case.schema.json`).

use super::{Choice, Key, Kind, Need, Range, Table, all, fill, measure, shapes};
use crate::checked::Measured;
use crate::units::Dimension;
use serde_json::{Map, Value, json};

/// The schema as indented JSON.
#[must_use]
pub fn schema() -> String {
    let mut root = table(all());
    let head = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A case of Taut",
        "definitions": {
            "number": {
                "description": "A number in SI units, a text with a unit (\"17 MPa\"), or an expression of the parameters (\"2*L\").",
                "type": ["number", "string"],
            },
            "shape": shape(),
        },
    });
    if let (Some(root), Value::Object(head)) = (root.as_object_mut(), head) {
        root.extend(head);
    }
    // Cannot fail: there are no keys but texts.
    format!("{root:#}\n")
}

/// An object with the keys of a table and no others.
fn table(table: &Table) -> Value {
    let mut object = object(table.keys);
    object.insert("description".into(), table.doc.into());
    if table.header == measure::TABLE.header {
        object.insert("allOf".into(), kinds_of_measures());
    }
    Value::Object(object)
}

fn object(keys: &[Key]) -> Map<String, Value> {
    let properties: Map<String, Value> =
        keys.iter().map(|key| (key.name.to_string(), property(key))).collect();
    let required: Vec<&str> =
        keys.iter().filter(|key| matches!(key.need, Need::Required)).map(|key| key.name).collect();
    let mut object = Map::new();
    object.insert("type".into(), "object".into());
    object.insert("additionalProperties".into(), false.into());
    object.insert("properties".into(), Value::Object(properties));
    object.insert("required".into(), json!(required));
    object
}

fn property(key: &Key) -> Value {
    let mut value = kind(&key.kind);
    let mut doc = key.doc.to_string();
    if let Some(unit) = unit(&key.kind) {
        doc += &format!(" Unit: {unit}.");
    }
    if let Kind::Choice(choices) = key.kind {
        for choice in choices() {
            doc += &format!("\n- `{}`: {}", choice.name, choice.doc);
        }
    }
    if let Need::Default(default) = key.need {
        doc += &format!("\nDefault: {default}.");
    }
    if let Some(value) = value.as_object_mut() {
        value.insert("description".into(), doc.into());
    }
    value
}

/// The unit of a number and what is allowed, for people.
pub(super) fn unit(kind: &Kind) -> Option<String> {
    let (dimension, range) = match *kind {
        Kind::OfProbe => return Some("m, m/s, N, N m or Pa, as the probe records, > 0".to_string()),
        Kind::Number(dimension, range) => (dimension, range),
        other => (other.dimension()?, Range::Any),
    };
    let unit = if dimension == Dimension::NUMBER { "1" } else { dimension.unit() };
    let comma = if range == Range::Any { "" } else { ", " };
    Some(format!("{unit}{comma}{}", range.text()))
}

fn kind(kind: &Kind) -> Value {
    let number = json!({ "$ref": "#/definitions/number" });
    match *kind {
        Kind::Text => json!({ "type": "string" }),
        Kind::Name | Kind::NameOf(_) => json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]+$" }),
        Kind::NamesOf(_) => {
            let name = json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]+$" });
            json!({ "type": "array", "items": name, "minItems": 1, "maxItems": 2 })
        }
        Kind::True => json!({ "const": true }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::OneOf(numbers) => json!({ "enum": numbers }),
        Kind::Count => json!({ "type": "integer", "minimum": 1 }),
        Kind::Number(_, range) => bounded(range),
        Kind::Scalar(_) => bounded(Range::Any),
        Kind::History => {
            let pair = json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 });
            json!({ "anyOf": [{ "type": "string" }, { "type": "array", "items": pair, "minItems": 1 }] })
        }
        Kind::OfProbe => bounded(Range::Positive),
        Kind::AngleOfTime => number,
        Kind::Vector(_) | Kind::Place(_) | Kind::Field(_) | Kind::FieldOrFree(_) | Kind::OfTime(_) => {
            json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 3 })
        }
        Kind::Pair(_) => json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 }),
        Kind::Pairs(d) => json!({ "type": "array", "items": self::kind(&Kind::Pair(d)), "minItems": 3 }),
        Kind::Choice(choices) => json!({ "enum": words(&choices()) }),
        Kind::Axes => json!({ "type": "array", "items": { "enum": ["x", "y", "z"] }, "minItems": 1 }),
        Kind::Shape => json!({ "$ref": "#/definitions/shape" }),
        Kind::Shapes => json!({ "type": "array", "items": { "$ref": "#/definitions/shape" }, "minItems": 1 }),
        Kind::Fill => filling(),
        Kind::Parameters => json!({ "type": "object", "additionalProperties": number }),
        Kind::Table(of) => table(of),
        Kind::Named(of) => json!({ "type": "object", "additionalProperties": table(of) }),
        Kind::List(of) => json!({ "type": "array", "items": table(of) }),
    }
}

/// A number; plain ones within their range (texts are looked into only by the program).
fn bounded(range: Range) -> Value {
    let mut value = json!({ "type": ["number", "string"] });
    let bounds: &[(&str, f64)] = match range {
        Range::Any => &[],
        Range::Positive => &[("exclusiveMinimum", 0.0)],
        Range::NotNegative => &[("minimum", 0.0)],
        Range::Share => &[("exclusiveMinimum", 0.0), ("maximum", 1.0)],
        Range::Smoothing => &[("minimum", 0.6), ("maximum", 4.0)],
        Range::Poisson => &[("exclusiveMinimum", -1.0), ("exclusiveMaximum", 0.5)],
    };
    for (name, bound) in bounds {
        value[*name] = json!(bound);
    }
    value
}

fn words(choices: &[Choice]) -> Vec<&'static str> {
    choices.iter().map(|choice| choice.name).collect()
}

fn filling() -> Value {
    let one = |name: &str, value: Value| {
        json!({
            "type": "object",
            "additionalProperties": false,
            "properties": { name: value },
            "required": [name],
        })
    };
    let moved = one(fill::LATTICE, Value::Object(object(&[fill::ORIGIN])));
    let polar = one(fill::POLAR, Value::Object(object(&[fill::AROUND, fill::RINGS])));
    let saved = one(fill::PARTICLES, json!({ "type": "string" }));
    json!({ "anyOf": [{ "enum": words(fill::CHOICES) }, moved, polar, saved] })
}

fn shape() -> Value {
    let mut properties = Map::new();
    for &(name, doc, keys) in shapes() {
        let mut value = if keys.is_empty() { kind(&Kind::Shapes) } else { Value::Object(object(keys)) };
        value["description"] = doc.into();
        properties.insert(name.into(), value);
    }
    let described = json!({
        "type": "object",
        "additionalProperties": false,
        "properties": properties,
        "minProperties": 1,
        "maxProperties": 1,
    });
    json!({ "description": "A shape, or the name of a region.", "anyOf": [{ "type": "string" }, described] })
}

/// Which keys go with which kind of measure.
fn kinds_of_measures() -> Value {
    let rule = |&(name, measured, _): &(&str, Measured, &str)| {
        let mut required = vec!["name", "kind"];
        required.extend(measured.keys().iter().map(|key| key.name));
        let allowed: Vec<&str> =
            required.iter().copied().chain(measured.more().iter().map(|key| key.name)).collect();
        json!({
            "if": { "properties": { "kind": { "const": name } } },
            "then": { "required": required, "propertyNames": { "enum": allowed } },
        })
    };
    <Measured as super::Words>::WORDS.iter().map(rule).collect()
}
