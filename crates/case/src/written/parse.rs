//! From TOML text to the tree of values with places.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Entry, Node, Table, Value};
use crate::diagnostic::Diagnostic;
use crate::source::Place;

/// The tree of a case file (text number 0).
///
/// # Errors
/// The first place where the text is no TOML.
pub(crate) fn parse_file(text: &str) -> Result<Table, Diagnostic> {
    match DeTable::parse(text) {
        Ok(table) => Reading { source: text, text: 0, shift: 0 }.table(table.get_ref(), false),
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            let place = Place { text: 0, start: span.start, end: span.end };
            let message = format!("not valid TOML: {}", error.message());
            Err(Diagnostic::at(place, message).help("text stands in quotes, lists in [ ], and each key once"))
        }
    }
}

/// The value that byte `shift` and what follows of an argument of the command line say:
/// a TOML value, or else plain text.
pub(crate) fn parse_argument(argument: &str, text: usize, shift: usize) -> Node {
    let source = &argument[shift..];
    let reading = Reading { source, text, shift };
    match DeValue::parse(source) {
        Ok(value) if !matches!(value.get_ref(), DeValue::Datetime(_)) => reading.node(&value).ok(),
        _ => None,
    }
    .unwrap_or_else(|| Node {
        value: Value::Text(source.to_string()),
        place: Place { text, start: shift, end: argument.len() },
        content: Some(shift),
    })
}

/// What is being read: `source` begins at byte `shift` of text number `text`.
struct Reading<'a> {
    source: &'a str,
    text: usize,
    shift: usize,
}

impl Reading<'_> {
    fn place<T>(&self, spanned: &Spanned<T>) -> Place {
        let span = spanned.span();
        Place { text: self.text, start: self.shift + span.start, end: self.shift + span.end }
    }

    fn table(&self, table: &DeTable<'_>, inline: bool) -> Result<Table, Diagnostic> {
        let mut entries = Vec::with_capacity(table.len());
        for (key, value) in table {
            entries.push(Entry {
                key: key.get_ref().to_string(),
                place: self.place(key),
                node: self.node(value)?,
            });
        }
        entries.sort_by_key(|e| e.place.start);
        Ok(Table { entries, inline })
    }

    fn node(&self, spanned: &Spanned<DeValue<'_>>) -> Result<Node, Diagnostic> {
        let place = self.place(spanned);
        let raw = self.source.get(spanned.span()).unwrap_or("");
        let mut content = None;
        let value = match spanned.get_ref() {
            DeValue::String(text) => {
                content = content_start(raw, text).map(|quotes| place.start + quotes);
                Value::Text(text.to_string())
            }
            DeValue::Integer(number) => integer(number.as_str(), number.radix(), place)?,
            DeValue::Float(number) => Value::Number(
                number
                    .as_str()
                    .parse()
                    .map_err(|_| Diagnostic::at(place, format!("`{}` is not a number", number.as_str())))?,
            ),
            DeValue::Boolean(value) => Value::Bool(*value),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => {
                Value::Array(items.iter().map(|item| self.node(item)).collect::<Result<_, _>>()?)
            }
            DeValue::Table(table) => Value::Table(self.table(table, raw.starts_with('{'))?),
        };
        Ok(Node { value, place, content })
    }
}

/// Length of the opening quotes, when the content stands in the source letter by letter.
fn content_start(raw: &str, content: &str) -> Option<usize> {
    [3, 1].into_iter().find(|&quotes| {
        raw.len() == content.len() + 2 * quotes && raw.get(quotes..raw.len() - quotes) == Some(content)
    })
}

/// A whole number; one too large for 64 bits becomes a floating-point number.
fn integer(digits: &str, radix: u32, place: Place) -> Result<Value, Diagnostic> {
    if let Ok(number) = i64::from_str_radix(digits, radix) {
        return Ok(Value::Integer(number));
    }
    match digits.parse() {
        Ok(number) if radix == 10 => Ok(Value::Number(number)),
        _ => Err(Diagnostic::at(place, format!("the number `{digits}` is too large"))),
    }
}
