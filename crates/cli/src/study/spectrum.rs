//! `taut spectrum`: at which frequencies a probe moves.

use super::column;
use crate::Failure;
use crate::arguments::SpectrumOptions;
use case::study::spectrum::{Peak, Spectrum, spectrum};
use output::{Column, Table, table_path, write_atomically};
use report::plot_over;
use std::fmt::Write as _;

/// Peaks that are told of each component.
const TOLD: usize = 8;

/// Prints the peaks of every component; writes and draws the spectra.
pub fn of_probe(options: &SpectrumOptions) -> Result<(), Failure> {
    let path = table_path(&options.dir, &options.probe);
    let table = Table::read(&path).map_err(|error| Failure::Input(format!("{error}{}", known(options))))?;
    let spectra: Vec<(String, Spectrum)> = table
        .columns
        .iter()
        .filter_map(|of| Some((of.name.clone(), analysed(&table, of, options)?)))
        .collect();
    let Some((_, first)) = spectra.first() else {
        return Err(Failure::Input(format!(
            "{} has fewer than eight samples in this time\nhint: a longer run, or a wider --from and --to",
            path.display()
        )));
    };
    say!(
        "{}: resolution {:.4} Hz, a peak is right to {:.4} Hz",
        options.probe,
        first.resolution,
        first.uncertainty
    );
    let unit = &table.columns[0].unit;
    for (name, found) in &spectra {
        for Peak { frequency, amplitude } in found.peaks().iter().take(TOLD) {
            say!("  {name}  {frequency:>12.4} Hz +- {:.4}   {amplitude:.4e} {unit}", found.uncertainty);
        }
    }
    write(options, &spectra, unit)
}

/// The spectrum of a column, in the time that is asked for.
fn analysed(table: &Table, column: &Column, options: &SpectrumOptions) -> Option<Spectrum> {
    let (from, to) = (options.from.unwrap_or(f64::NEG_INFINITY), options.to.unwrap_or(f64::INFINITY));
    let within = table.times.iter().zip(&column.values).filter(|(t, _)| (from..=to).contains(*t));
    let (times, values): (Vec<f64>, Vec<f64>) = within.unzip();
    spectrum(&times, &values, options.window.into())
}

/// Table, peaks and plot, beside the run.
fn write(options: &SpectrumOptions, spectra: &[(String, Spectrum)], unit: &str) -> Result<(), Failure> {
    let highest = options.highest.unwrap_or_else(|| shown(spectra));
    let frequencies = &spectra[0].1.frequencies;
    let count = frequencies.iter().take_while(|f| **f <= highest).count();
    let columns = spectra.iter().map(|(name, s)| column(name, unit, s.amplitudes[..count].to_vec()));
    let table = Table { times: frequencies[..count].to_vec(), columns: columns.collect() };
    let mut text = String::from("frequency [Hz]");
    for (name, _) in spectra {
        let _ = write!(text, ",{name} [{unit}]");
    }
    for (row, frequency) in table.times.iter().enumerate() {
        let _ = write!(text, "\n{frequency}");
        for column in &table.columns {
            let _ = write!(text, ",{}", column.values[row]);
        }
    }
    text.push('\n');
    let mut peaks = String::from("component,frequency [Hz],uncertainty [Hz],amplitude\n");
    for (name, found) in spectra {
        for peak in found.peaks() {
            let _ = writeln!(peaks, "{name},{},{},{}", peak.frequency, found.uncertainty, peak.amplitude);
        }
    }
    let file = |end: &str| options.dir.join(format!("spectrum-{}{end}", options.probe));
    let unwritten = |error: output::OutputError| Failure::Run(error.to_string());
    write_atomically(&file(".csv"), text.as_bytes()).map_err(unwritten)?;
    write_atomically(&file("-peaks.csv"), peaks.as_bytes()).map_err(unwritten)?;
    let title = format!("spectrum of {}", options.probe);
    plot_over(&title, ("frequency", "Hz"), &table, &file(".svg"))
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    say!("written: {}, .svg and -peaks.csv", file(".csv").display());
    Ok(())
}

/// The highest frequency that is drawn if nothing is said: a half more than the highest peak that is told, Hz.
fn shown(spectra: &[(String, Spectrum)]) -> f64 {
    let peaks = spectra.iter().flat_map(|(_, found)| found.peaks().into_iter().take(TOLD));
    let most = peaks.map(|peak| peak.frequency).fold(0.0, f64::max);
    if most > 0.0 { 1.5 * most } else { f64::INFINITY }
}

/// The probes that there are.
fn known(options: &SpectrumOptions) -> String {
    let files = std::fs::read_dir(options.dir.join("probes")).into_iter().flatten().flatten();
    let mut names: Vec<String> = files
        .filter_map(|file| file.file_name().to_string_lossy().strip_suffix(".csv").map(str::to_string))
        .collect();
    names.sort();
    if names.is_empty() { String::new() } else { format!("\nprobes of this run: {}", names.join(", ")) }
}
