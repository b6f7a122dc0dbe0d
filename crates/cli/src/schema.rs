//! `taut schema`.

use crate::Failure;
use case::keys;

/// Prints the JSON schema of case files, or the reference page of the manual.
pub fn schema(page: bool) -> Result<(), Failure> {
    use std::io::Write as _;
    let text = if page { keys::page() } else { keys::schema() };
    // A closed pipe is nobody's fault.
    let _ = write!(std::io::stdout(), "{text}");
    Ok(())
}
