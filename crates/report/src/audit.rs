//! The books of energy and momentum as charts.

use std::path::Path;

use output::{Column, Table};
use plotters::prelude::*;

use crate::ReportError;
use crate::plot::{Drawn, chart_of};

const SIZE: (u32, u32) = (1360, 960);

/// Draws `audit.csv` into the SVG file `path`: the energies; what is missing of the energy, and of momentum and angular momentum
/// against the impulses, each in a chart of its own, since it is small.
///
/// # Errors
/// [`ReportError::Write`] if the file cannot be written.
pub fn plot_audit(title: &str, table: &Table, path: &Path) -> Result<(), ReportError> {
    let mut svg = String::new();
    let drawn = charts(title, table, &mut svg).map_err(|cause| cause.to_string());
    drawn.map_err(|cause| ReportError::Draw { what: path.display().to_string(), cause })?;
    Ok(output::write_atomically(path, svg.as_bytes())?)
}

fn charts(title: &str, table: &Table, svg: &mut String) -> Drawn {
    let area = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let [energies, rest, linear, angular] = tables(table);
    let heads = [
        format!("{title}: energies"),
        "initial + external work - dissipated - kinetic - strain - contact".to_string(),
        "momentum - initial - impulse".to_string(),
        "angular momentum - initial - angular impulse".to_string(),
    ];
    let charts = [energies, rest, linear, angular];
    for ((part, head), table) in area.split_evenly((2, 2)).iter().zip(&heads).zip(&charts) {
        chart_of(head, table, part)?;
    }
    area.present()?;
    Ok(())
}

/// Energies, the residual, and what is missing of the two momenta.
fn tables(table: &Table) -> [Table; 4] {
    let only = |wanted: &dyn Fn(&str) -> bool| Table {
        times: table.times.clone(),
        columns: table.columns.iter().filter(|column| wanted(&column.name)).cloned().collect(),
    };
    let missing = |of: &str, given: &str| Table {
        times: table.times.clone(),
        columns: table.columns.iter().filter_map(|column| unaccounted(table, column, (of, given))).collect(),
    };
    // A line of zeros says nothing.
    let touched = table.columns.iter().any(|c| c.name == "contact" && c.values.iter().any(|v| *v != 0.0));
    [
        only(&|name| {
            ["kinetic", "strain", "dissipated", "external work"].contains(&name)
                || (name == "contact" && touched)
        }),
        only(&|name| name == "residual"),
        missing("momentum ", "impulse "),
        missing("angular momentum ", "angular impulse "),
    ]
}

/// A component less its first value and less the impulse along the same axis.
fn unaccounted(table: &Table, column: &Column, (of, given): (&str, &str)) -> Option<Column> {
    let axis = column.name.strip_prefix(of)?;
    let impulse = table.columns.iter().find(|other| other.name == format!("{given}{axis}"))?;
    let first = column.values.first().copied().unwrap_or(0.0);
    let rest = column.values.iter().zip(&impulse.values).map(|(now, given)| now - first - given);
    Some(Column { name: axis.to_string(), unit: column.unit.clone(), values: rest.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, unit: &str, values: [f64; 2]) -> Column {
        Column { name: name.to_string(), unit: unit.to_string(), values: values.to_vec() }
    }

    #[test]
    fn what_is_missing_is_what_no_impulse_explains() {
        let table = Table {
            times: vec![0.0, 1.0],
            columns: vec![
                column("kinetic", "J", [1.0, 2.0]),
                column("residual", "J", [0.0, 0.5]),
                column("momentum x", "kg m/s", [3.0, 10.0]),
                column("impulse x", "kg m/s", [0.0, 6.0]),
                column("angular momentum z", "kg m^2/s", [1.0, 1.0]),
                column("angular impulse z", "kg m^2/s", [0.0, -2.0]),
            ],
        };
        let [energies, rest, linear, angular] = tables(&table);
        assert_eq!((energies.columns.len(), rest.columns.len()), (1, 1));
        assert_eq!(linear.columns, [column("x", "kg m/s", [0.0, 1.0])]);
        assert_eq!(angular.columns, [column("z", "kg m^2/s", [0.0, 2.0])]);
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("audit.svg");
        plot_audit("swing", &table, &path).unwrap();
        let svg = std::fs::read_to_string(&path).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("swing: energies") && svg.contains("impulse"));
        plot_audit("nothing", &Table::default(), &path).unwrap();
    }
}
