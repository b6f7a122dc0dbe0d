//! Pictures and plots of a run.

use crate::Failure;
use case::Case;
use output::{Frame, OutputError, Reference, Table};
use report::{Picture, View, Window, picture, plot_audit, plot_probe, write_png};
use std::path::{Path, PathBuf};

/// What was made, and what could not be.
#[derive(Default)]
pub struct Drawn {
    /// Files.
    pub files: Vec<PathBuf>,
    /// Why something is missing, a sentence each.
    pub problems: Vec<String>,
}

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
        let plain = Picture { title: case.title.clone(), view, window, ..Picture::default() };
        let options = match case.shear_stress {
            true => plain,
            false => Picture { field: "Pressure".to_string(), ..plain },
        };
        let file = results.join(format!("{name}.png"));
        write_png(&picture(frame, &options), &file)
            .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    }
    let mut drawn = Drawn::default();
    plots(&case.title, results, results, &mut drawn);
    match drawn.problems.is_empty() {
        true => Ok(()),
        false => Err(Failure::Run(drawn.problems.join("\n"))),
    }
}

/// Plots the audit and every table in the folder `probes` of the results into `out`, these with their reference curves.
pub fn plots(title: &str, results: &Path, out: &Path, drawn: &mut Drawn) {
    let mut note = |made: Result<(), String>, path: PathBuf| match made {
        Ok(()) => drawn.files.push(path),
        Err(problem) => drawn.problems.push(problem),
    };
    let audit = out.join("audit.svg");
    note(books(title, &results.join("audit.csv"), &audit), audit);
    let mut names: Vec<String> = Vec::new();
    // Without probes there is no such folder.
    for entry in std::fs::read_dir(results.join("probes")).into_iter().flatten().flatten() {
        let file = entry.file_name().to_string_lossy().into_owned();
        names.extend(file.strip_suffix(".csv").map(str::to_string));
    }
    names.sort();
    for name in names {
        let reference = results.join("reference").join(format!("{name}.csv"));
        let path = out.join(format!("{name}.svg"));
        let table = results.join("probes").join(format!("{name}.csv"));
        note(plot(&format!("{title}: {name}"), &table, &reference, &path), path);
    }
}

fn told(error: OutputError) -> String {
    format!("{error}\nhint: {}", error.hint())
}

fn books(title: &str, table: &Path, path: &Path) -> Result<(), String> {
    let table = Table::read(table).map_err(told)?;
    plot_audit(title, &table, path).map_err(|error| format!("{error}\nhint: {}", error.hint()))
}

fn plot(title: &str, table: &Path, reference: &Path, path: &Path) -> Result<(), String> {
    let table = Table::read(table).map_err(told)?;
    let reference = reference.is_file().then(|| Reference::read(reference).map_err(told)).transpose()?;
    plot_probe(title, &table, reference.as_ref(), path)
        .map_err(|error| format!("{error}\nhint: {}", error.hint()))
}
