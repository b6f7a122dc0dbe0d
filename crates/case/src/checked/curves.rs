//! The reference curves of probes.

use std::path::Path;

use super::case::Case;
use super::probe::{Probe, Quantity};
use crate::diagnostic::{CaseError, Diagnostic};
use crate::source::Place;
use output::Reference;

/// A file with curves that a probe is compared with in its plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Its path, as the case says it: relative to the case file.
    pub file: String,
    /// Where it stands in the case file.
    pub place: Place,
    /// What is in it; `None` if it was not found.
    pub text: Option<String>,
}

/// Larger files are no curves, bytes.
const LARGEST: u64 = 64 << 20;

/// The text of a file that lies in `folder`.
pub(super) fn in_folder(folder: &Path, file: &str) -> Result<String, String> {
    let path = folder.join(file);
    let about = std::fs::metadata(&path).map_err(|cause| cause.to_string())?;
    if !about.is_file() || about.len() > LARGEST {
        return Err(format!("no ordinary file of at most {} MiB", LARGEST >> 20));
    }
    output::limited::read_text(&path, output::limited::LONGEST_TEXT).map_err(|cause| cause.to_string())
}

impl Case {
    /// Reads the reference curves of all probes; `find` has the text of a file, or why there is none. A file that is not found is
    /// a warning, so that a case can be run without; one that is no table of such curves is an error.
    ///
    /// # Errors
    /// Every file that is none.
    pub fn with_references(
        mut self,
        find: impl Fn(&str) -> Result<String, String>,
    ) -> Result<Self, CaseError> {
        let (mut wrong, mut doubts) = (Vec::new(), Vec::new());
        for probe in &mut self.probes {
            let Some(curves) = &mut probe.reference else { continue };
            match find(&curves.file) {
                Ok(text) => {
                    curves.text = Some(text);
                    wrong.extend(misfit(probe, self.dimension));
                }
                Err(reason) => doubts.push(
                    Diagnostic::at(curves.place, format!("cannot read the reference curves: {reason}"))
                        .help("its path is relative to the case file; the plot will be without them"),
                ),
            }
        }
        if !wrong.is_empty() {
            return Err(self.errors(wrong));
        }
        self.warnings.extend(doubts);
        Ok(self)
    }
}

/// What is wrong with the curves of a probe.
fn misfit(probe: &Probe, dimension: usize) -> Option<Diagnostic> {
    let curves = probe.reference.as_ref()?;
    let unit = if probe.quantity == Quantity::Velocity { "m/s" } else { "m" };
    let axes = &["x", "y", "z"][..dimension];
    let example = format!(
        "for example `time [s],{} [{unit}]`, after lines `# ...` that say where it comes from",
        axes[1]
    );
    let wrong = |message: String| Some(Diagnostic::at(curves.place, message).help(example.clone()));
    let reference = match Reference::parse(curves.text.as_deref()?) {
        Ok(reference) => reference,
        Err(problem) => return wrong(format!("{} is no table of curves: {problem}", curves.file)),
    };
    let mut found = axes.iter().flat_map(|axis| reference.curves(axis)).peekable();
    if found.peek().is_none() {
        let names: Vec<&str> = reference.table.columns.iter().map(|column| column.name.as_str()).collect();
        let (axes, names) = (axes.join(", "), names.join(", "));
        return wrong(format!("{} has no curve of {axes}; its columns are {names}", curves.file));
    }
    let odd = found.find(|column| column.unit != unit)?;
    wrong(format!("{}: the unit of {} is [{}] and not [{unit}]", curves.file, odd.name, odd.unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Overrides;

    const CASE: &str = r#"name = "a"
dimension = 2
spacing = 0.1
[material.rubber]
model = "neo-hookean"
density = 1100
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "block"
material = "rubber"
shape = { box = { min = [0, 0], max = [1, 1] } }
[time]
end = 1
[[probe]]
name = "tip"
at = [1, 1]
reference = "tip.csv"
"#;

    fn given(text: Result<&str, &str>) -> Result<Case, CaseError> {
        let case = Case::parse("a.toml", CASE, &Overrides::default()).unwrap();
        case.with_references(|file| {
            assert_eq!(file, "tip.csv");
            text.map(str::to_string).map_err(str::to_string)
        })
    }

    #[test]
    fn curves_are_taken_and_missing_ones_are_a_warning() {
        let case = given(Ok("# paper\ntime [s],y [m]\n0,1\n")).unwrap();
        assert!(case.probes[0].reference.as_ref().is_some_and(|curves| curves.text.is_some()));
        let before = case.warnings.len();
        let case = given(Err("no such file")).unwrap();
        assert_eq!(case.warnings.len(), before + 1);
        let told = case.render_warnings(false);
        assert!(told.contains("no such file") && told.contains("reference = \"tip.csv\""), "{told}");
    }

    #[test]
    fn files_that_are_no_curves_of_the_probe_are_refused() {
        for (text, words) in [
            ("", "line 1 names no time"),
            ("time [s],y [m]\n0,one\n", "line 2 holds something that is no number"),
            ("time [s],w [m]\n0,1\n", "has no curve of x, y; its columns are w"),
            ("time [s],y [m/s]\n0,1\n", "the unit of y is [m/s] and not [m]"),
        ] {
            let told = given(Ok(text)).unwrap_err().render(false);
            assert!(told.contains(words) && told.contains("a.toml:18"), "{told}");
        }
    }
}
