//! `taut list`.

use crate::Failure;
use crate::builtin::CASES;
use case::{Case, Overrides};

/// Prints the built-in cases, a line each.
pub fn list() -> Result<(), Failure> {
    for (name, text) in CASES {
        let case = Case::parse(name, text, &Overrides::default())
            .map_err(|error| Failure::Input(error.render(false)))?;
        say!("{name:<20} {}", case.title);
    }
    Ok(())
}
