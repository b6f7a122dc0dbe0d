//! `taut modes` and `taut static`: what the matrix of small-strain bodies says.

use super::failed;
use crate::Failure;
use crate::arguments::{ModesOptions, StudyOptions};
use crate::builtin::read;
use crate::say;
use case::study::StudyError;
use case::study::vibration::{Shown, equilibrium, modes as lowest};
use output::{Frame, ResultDir, Series};
use report::{Picture, View, picture, write_png};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn unsolved(error: StudyError) -> Failure {
    match error {
        StudyError::Run(error) => failed(error),
        error @ StudyError::NotSmall(_) => Failure::Input(error.to_string()),
        other => Failure::Run(other.to_string()),
    }
}

fn unwritten(error: output::OutputError) -> Failure {
    Failure::Run(format!("{error}\nhint: {}", error.hint()))
}

/// Lists the lowest modes of every body and writes them: a frame each for ParaView, whose time is the number of the mode, and pictures.
pub fn modes(options: &ModesOptions) -> Result<(), Failure> {
    let case = read(&options.case)?;
    say::warnings(&case);
    let found = lowest(&case, options.count.into()).map_err(unsolved)?;
    let (results, out) = folder(options.out.as_ref(), &case.name, "modes")?;
    let mut series = Series::create(&results).map_err(unwritten)?;
    let mut table = String::from("number,body,frequency [Hz],omega^2 [1/s^2],zigzag,rigid\n");
    say!("  number  body            frequency        zigzag   rigid motion");
    for (k, Shown { body, mode, zigzag, frame }) in found.iter().enumerate() {
        let (number, frequency) = (k + 1, mode.frequency());
        say!("  {number:>6}  {body:<12} {frequency:>12.4} Hz   {zigzag:>7.4}   {:>7.4}", mode.rigid);
        let _ = writeln!(table, "{number},{body},{frequency},{},{zigzag},{}", mode.eigenvalue, mode.rigid);
        let frame = Frame { time: number as f64, step: number as u64, ..frame.clone() };
        series.write(&frame).map_err(unwritten)?;
        let note = format!("mode {number}: {body}, {frequency:.4} Hz, zigzag {zigzag:.3}");
        draw(&frame, (&case.title, note), &out.join(format!("mode-{number:02}.png")), case.dimension)?;
    }
    results.write("modes.csv", table.as_bytes()).map_err(unwritten)?;
    say!(
        "modes.csv, mode-NN.png, and particles/particles.pvd for ParaView (its time is the number), in {}",
        out.display()
    );
    Ok(())
}

/// Solves for the state of equilibrium, tells what the case measures of it, and draws it.
pub fn equilibrate(options: &StudyOptions) -> Result<(), Failure> {
    let case = read(&options.case)?;
    say::warnings(&case);
    let found = equilibrium(&case).map_err(unsolved)?;
    let (results, out) = folder(options.out.as_ref(), &case.name, "static")?;
    Series::create(&results).and_then(|mut series| series.write(&found.frame)).map_err(unwritten)?;
    say!("{}: {}", case.name, case.title);
    for (body, share) in &found.left_out {
        say!("  {body}: {share:.2e} of the load would move the body as a whole, and was left out");
    }
    let mut table = String::from("name,value,unit\n");
    for (name, measured) in &found.measured {
        if let Some(value) = measured.value {
            say!("  {name:<24} {value:.6e} {}", measured.unit);
            let _ = writeln!(table, "{name},{value},{}", measured.unit);
        }
    }
    results.write("measured.csv", table.as_bytes()).map_err(unwritten)?;
    draw(&found.frame, (&case.title, "equilibrium".to_string()), &out.join("static.png"), case.dimension)?;
    say!("measured.csv, static.png, and particles/particles.pvd for ParaView, in {}", out.display());
    Ok(())
}

fn folder(given: Option<&PathBuf>, case: &str, study: &str) -> Result<(ResultDir, PathBuf), Failure> {
    let out = given.cloned().unwrap_or_else(|| PathBuf::from("out").join(format!("{case}-{study}")));
    let results = ResultDir::create(&out).map_err(|error| Failure::Input(error.to_string()))?;
    Ok((results, out))
}

fn draw(frame: &Frame, (title, note): (&str, String), file: &Path, dimension: usize) -> Result<(), Failure> {
    let view = (dimension == 3).then(View::default);
    let options =
        Picture { title: title.to_string(), note, view, undeformed: true, size: 800, ..Picture::default() };
    write_png(&picture(frame, &options), file)
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))
}
