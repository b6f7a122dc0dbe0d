//! Studies of a case, and of what a run left.

pub mod spectrum;
pub mod stability;
pub mod vibration;

use crate::Failure;
use crate::builtin::colour;
use case::run::RunError;
use output::{Column, ResultDir, Table};
use report::plot_over;
use std::fmt::Write as _;

/// A failure of a study as the program tells it.
pub fn failed(error: RunError) -> Failure {
    match error {
        RunError::Case(error) => Failure::Input(error.render(colour())),
        error if error.is_input() => Failure::Input(error.to_string()),
        other => Failure::Run(other.to_string()),
    }
}

/// A column of numbers.
pub fn column(name: &str, unit: &str, values: Vec<f64>) -> Column {
    Column { name: name.to_string(), unit: unit.to_string(), values }
}

/// Writes a table as NAME.csv and draws it as NAME.svg; `over` is the first column, with its unit.
pub fn tell(
    results: &ResultDir,
    name: &str,
    (title, over): (&str, (&str, &str)),
    table: &Table,
) -> Result<(), Failure> {
    let mut text = format!("{} [{}]", over.0, over.1);
    for column in &table.columns {
        let _ = write!(text, ",{} [{}]", column.name, column.unit);
    }
    text.push('\n');
    for (row, x) in table.times.iter().enumerate() {
        let _ = write!(text, "{x}");
        for column in &table.columns {
            let _ = write!(text, ",{}", column.values[row]);
        }
        text.push('\n');
    }
    let unwritten = |error: output::OutputError| Failure::Run(error.to_string());
    results.write(&format!("{name}.csv"), text.as_bytes()).map_err(unwritten)?;
    plot_over(title, over, table, &results.path().join(format!("{name}.svg")))
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))
}
