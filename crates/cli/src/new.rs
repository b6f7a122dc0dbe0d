//! `taut new`.

use crate::Failure;
use case::{Case, Overrides};
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::PathBuf;

/// The starter case; its name is put in.
const STARTER: &str = include_str!("starter.toml");

/// The name that stands in the starter case.
const NAME: &str = "my-case";

/// Writes a commented starter case, `NAME.toml`.
pub fn new(name: &str) -> Result<(), Failure> {
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let text = STARTER.replacen(NAME, name, 1);
    if Case::parse("starter", &text, &Overrides::default()).is_err() {
        return Err(Failure::Input(format!(
            "`{name}` cannot be the name of a case: use small letters, digits and `-`."
        )));
    }
    let file = PathBuf::from(format!("{name}.toml"));
    let opened = OpenOptions::new().write(true).create_new(true).open(&file);
    let written = opened.and_then(|mut opened| opened.write_all(text.as_bytes()));
    match written {
        Ok(()) => {
            say!("wrote {0}; try `taut explain {0}`, `taut check {0}` and `taut run {0}`", file.display());
            Ok(())
        }
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(Failure::Input(format!(
            "{} already exists; nothing was written. Give the new case another name.",
            file.display()
        ))),
        Err(error) => Err(Failure::Run(format!("cannot write {}: {error}", file.display()))),
    }
}
