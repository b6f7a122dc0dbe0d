//! Pictures and plots of a finished run.

use crate::Failure;
use case::Case;
use output::{Frame, Table};
use report::{Picture, View, Window, picture, plot_audit, plot_probe, write_png};
use std::path::Path;

/// Draws the particles at start, middle and end, and every probe.
pub fn draw(case: &Case, frames: &[Frame], results: &Path) -> Result<(), Failure> {
    let view = (case.dimension == 3).then(View::default);
    let windows = frames.iter().map(|frame| Window::around(frame, view));
    let window = windows.reduce(Window::union);
    let names: &[&str] = match frames.len() {
        0 => &[],
        1 => &["start"],
        2 => &["start", "end"],
        _ => &["start", "middle", "end"],
    };
    for (frame, name) in frames.iter().zip(names) {
        let options = Picture { title: case.title.clone(), view, window, ..Picture::default() };
        let file = results.join(format!("{name}.png"));
        write_png(&picture(frame, &options), &file).map_err(failed)?;
    }
    let read = |path: &Path| {
        Table::read(path).map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))
    };
    plot_audit(&case.title, &read(&results.join("audit.csv"))?, &results.join("audit.svg"))
        .map_err(failed)?;
    for probe in &case.probes {
        let table = read(&results.join("probes").join(format!("{}.csv", probe.name)))?;
        let title = format!("{}: {}", case.title, probe.name);
        plot_probe(&title, &table, &results.join(format!("{}.svg", probe.name))).map_err(failed)?;
    }
    Ok(())
}

fn failed(error: report::ReportError) -> Failure {
    Failure::Run(format!("{error}\nhint: {}", error.hint()))
}
