//! What a probe saw, sample by sample, as a comma-separated table.

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::directory::checked;
use crate::limited::{LONGEST_RESULT, read_text};
use crate::{OutputError, ResultDir};

/// A table `probes/NAME.csv` that grows by one row per sample.
///
/// The first line names the columns, `time [s],x [m],y [m]`; numbers have as many digits as it takes to
/// get the same `f64` back. Rows are buffered: [`flush`](ProbeTable::flush) with every frame, so that a
/// killed run loses little.
#[derive(Debug)]
pub struct ProbeTable {
    path: PathBuf,
    file: BufWriter<File>,
    columns: usize,
}

impl ProbeTable {
    /// Starts the table of the probe `name` with a `(name, unit)` for each column after the time.
    ///
    /// # Errors
    /// [`OutputError::AlreadyExists`] if a probe has this name already, [`OutputError::Name`],
    /// [`OutputError::Write`].
    pub fn create(results: &ResultDir, name: &str, columns: &[(&str, &str)]) -> Result<Self, OutputError> {
        let folder = results.path().join("probes");
        std::fs::create_dir_all(&folder).map_err(|cause| OutputError::write(&folder, cause))?;
        Self::new(folder.join(format!("{}.csv", checked(name)?)), columns)
    }

    /// The same for a table `NAME.csv` that stands beside the summary.
    ///
    /// # Errors
    /// As [`ProbeTable::create`].
    pub fn beside_summary(
        results: &ResultDir,
        name: &str,
        columns: &[(&str, &str)],
    ) -> Result<Self, OutputError> {
        Self::new(results.path().join(format!("{}.csv", checked(name)?)), columns)
    }

    fn new(path: PathBuf, columns: &[(&str, &str)]) -> Result<Self, OutputError> {
        let file = match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => file,
            Err(cause) if cause.kind() == io::ErrorKind::AlreadyExists => {
                return Err(OutputError::taken(&path));
            }
            Err(cause) => return Err(OutputError::write(&path, cause)),
        };
        Self::begin(path, file, columns)
    }

    fn begin(path: PathBuf, file: File, columns: &[(&str, &str)]) -> Result<Self, OutputError> {
        let mut table = Self { path, file: BufWriter::new(file), columns: columns.len() };
        let mut line = String::from("time [s]");
        for (name, unit) in columns {
            line += &format!(",{} [{}]", plain(name), plain(unit));
        }
        table.line(&line)?;
        Ok(table)
    }

    /// Appends a sample: the time, s, and one value per column.
    ///
    /// # Errors
    /// [`OutputError::Inconsistent`] if there are too many or too few values, [`OutputError::Write`].
    pub fn push(&mut self, time: f64, values: &[f64]) -> Result<(), OutputError> {
        if values.len() != self.columns {
            let problem = format!("{} values for {} columns", values.len(), self.columns);
            return Err(OutputError::inconsistent(self.path.display(), problem));
        }
        let mut line = format!("{time:?}");
        for value in values {
            line += &format!(",{value:?}");
        }
        self.line(&line)
    }

    /// Hands the buffered rows to the operating system.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.file.flush().map_err(|cause| OutputError::write(&self.path, cause))
    }

    fn line(&mut self, line: &str) -> Result<(), OutputError> {
        writeln!(self.file, "{line}").map_err(|cause| OutputError::write(&self.path, cause))
    }
}

/// `text` without the characters that structure the table.
fn plain(text: &str) -> String {
    text.chars().map(|c| if matches!(c, ',' | '"' | '[' | ']') || c.is_control() { ' ' } else { c }).collect()
}

/// One column of a [`Table`].
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What it is, such as `y`.
    pub name: String,
    /// SI unit, such as `m`.
    pub unit: String,
    /// One value per time.
    pub values: Vec<f64>,
}

/// A probe table in memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Times, s.
    pub times: Vec<f64>,
    /// The other columns.
    pub columns: Vec<Column>,
}

impl Table {
    /// Reads a table that [`ProbeTable`] wrote. A last line that a killed run left unfinished is ignored.
    ///
    /// # Errors
    /// [`OutputError::Read`] with the line, if it is no such table.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = read_text(path, LONGEST_RESULT).map_err(|cause| OutputError::read(path, cause))?;
        Self::parse(&text, 0).map_err(|problem| OutputError::read(path, problem))
    }

    /// Reads the text of a table that begins after so many lines of its file.
    pub(crate) fn parse(text: &str, before: usize) -> Result<Self, String> {
        let complete = text.rfind('\n').map_or("", |end| &text[..end]);
        let mut lines = complete.lines();
        let head = lines.next().filter(|line| line.starts_with("time [s]"));
        let head = head.ok_or_else(|| format!("line {} names no time", before + 1))?;
        let mut table = Self { times: Vec::new(), columns: head.split(',').skip(1).map(column).collect() };
        for (index, line) in lines.enumerate() {
            let row: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
            let row =
                row.map_err(|_| format!("line {} holds something that is no number", before + index + 2))?;
            if row.len() != table.columns.len() + 1 {
                let expected = table.columns.len() + 1;
                return Err(format!(
                    "line {} has {} values instead of {expected}",
                    before + index + 2,
                    row.len()
                ));
            }
            table.times.push(row[0]);
            for (column, &value) in table.columns.iter_mut().zip(&row[1..]) {
                column.values.push(value);
            }
        }
        Ok(table)
    }
}

/// `name [unit]`, still without values.
fn column(label: &str) -> Column {
    let (name, unit) = label.trim_end_matches(']').rsplit_once(" [").unwrap_or((label, ""));
    Column { name: name.to_string(), unit: unit.to_string(), values: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_f64_comes_back_bit_for_bit() {
        let scratch = tempfile::tempdir().unwrap();
        let results = ResultDir::create(scratch.path()).unwrap();
        let mut table = ProbeTable::create(&results, "tip", &[("x", "m"), ("v, fast", "m/s")]).unwrap();
        let samples = [(0.0, [0.1 + 0.2, -0.0]), (1e-300, [f64::MAX, f64::MIN_POSITIVE / 3.0])];
        for (time, values) in samples {
            table.push(time, &values).unwrap();
        }
        table.push(1.0, &[f64::NAN, f64::NEG_INFINITY]).unwrap();
        table.flush().unwrap();
        let path = scratch.path().join("probes/tip.csv");
        assert!(std::fs::read_to_string(&path).unwrap().starts_with("time [s],x [m],v  fast [m/s]\n"));
        let read = Table::read(&path).unwrap();
        assert_eq!(read.columns[1].unit, "m/s");
        for (row, (time, values)) in samples.iter().enumerate() {
            assert_eq!(read.times[row].to_bits(), time.to_bits());
            for (column, value) in values.iter().enumerate() {
                assert_eq!(read.columns[column].values[row].to_bits(), value.to_bits());
            }
        }
        assert!(read.columns[0].values[2].is_nan());
        assert_eq!(read.columns[1].values[2], f64::NEG_INFINITY);
    }

    #[test]
    fn names_are_unique_and_rows_complete() {
        let scratch = tempfile::tempdir().unwrap();
        let results = ResultDir::create(scratch.path()).unwrap();
        let mut table = ProbeTable::create(&results, "tip", &[("x", "m")]).unwrap();
        assert!(matches!(ProbeTable::create(&results, "tip", &[]), Err(OutputError::AlreadyExists { .. })));
        assert!(matches!(ProbeTable::create(&results, "../tip", &[]), Err(OutputError::Name { .. })));
        assert!(matches!(table.push(0.0, &[1.0, 2.0]), Err(OutputError::Inconsistent { .. })));
    }

    #[test]
    fn a_torn_last_line_is_ignored_and_nonsense_is_named() {
        let torn = Table::parse("time [s],x [m]\n0.0,1.0\n0.5,1.", 0).unwrap();
        assert_eq!((torn.times, &torn.columns[0].values), (vec![0.0], &vec![1.0]));
        assert!(Table::parse("time [s],x [m]\n0.0,1.0\n0.5,one\n", 0).unwrap_err().contains("line 3"));
        assert!(Table::parse("", 0).is_err());
        assert!(Table::read(Path::new("/nowhere/tip.csv")).unwrap_err().to_string().contains("tip.csv"));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_an_error_with_the_file_and_a_hint() {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut table = ProbeTable::begin(PathBuf::from("tip.csv"), full, &[("x", "m")]).unwrap();
        let error = table.flush().unwrap_err();
        assert!(error.to_string().contains("tip.csv"), "{error}");
        assert!(error.hint().contains("free some space"), "{}", error.hint());
    }
}
