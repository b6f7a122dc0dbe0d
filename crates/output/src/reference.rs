//! Curves from elsewhere, to compare probes with.

use std::path::Path;

use crate::limited::{LONGEST_TEXT, read_text};
use crate::{OutputError, Table};

/// Curves over time with their source: a comma-separated table as probes have them (`time [s],y [m]`), whose first lines may say
/// where it comes from (`# paper, Fig. 12`).
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The lines with `#`, in one; empty if there are none.
    pub source: String,
    /// The curves. `y` and `y coarse` both go with what a probe calls `y`.
    pub table: Table,
}

impl Reference {
    /// Reads a file.
    ///
    /// # Errors
    /// [`OutputError::Read`] with the line, if it is no such table.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = read_text(path, LONGEST_TEXT).map_err(|cause| OutputError::read(path, cause))?;
        Self::parse(&text).map_err(|problem| OutputError::read(path, problem))
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// What is wrong with it, with the line.
    pub fn parse(text: &str) -> Result<Self, String> {
        let comments = text.lines().take_while(|line| line.starts_with('#'));
        let source: Vec<&str> = comments.map(|line| line.trim_start_matches('#').trim()).collect();
        let table: Vec<&str> = text.lines().skip(source.len()).collect();
        let table = Table::parse(&(table.join("\n") + "\n"), source.len())?;
        Ok(Self { source: source.join(" "), table })
    }

    /// The curves that go with the column `name` of a probe.
    pub fn curves(&self, name: &str) -> impl Iterator<Item = &crate::Column> {
        let goes = move |column: &&crate::Column| column.name.split(' ').next() == Some(name);
        self.table.columns.iter().filter(goes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn source_and_curves() {
        let text = "# paper, Fig. 12\n# digitised\ntime [s],y [m],y coarse [m],z [m]\n0,1,2,3\n0.5,1,2,3";
        let reference = Reference::parse(text).unwrap();
        assert_eq!(reference.source, "paper, Fig. 12 digitised");
        assert_eq!(reference.table.times, [0.0, 0.5]);
        assert_eq!(reference.curves("y").map(|c| c.name.as_str()).collect::<Vec<_>>(), ["y", "y coarse"]);
        assert_eq!(reference.curves("x").count(), 0);
    }

    #[test]
    fn mistakes_are_told_with_their_line() {
        for (text, words) in [
            ("", "line 1 names no time"),
            ("# a\nt,y\n", "line 2 names no time"),
            ("# a\ntime [s],y [m]\n0,1\n0.5,one\n", "line 4"),
            ("time [s],y [m]\n0,1,2\n", "line 2 has 3 values instead of 2"),
        ] {
            let error = Reference::parse(text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
