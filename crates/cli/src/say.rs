//! What the program says. A closed pipe (`taut list | head -1`) is nobody's fault: what nobody reads is not said, and a
//! run goes on.

use crate::builtin::colour;
use case::Case;

/// A line on standard output.
macro_rules! say {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stdout(), $($text)*);
    }};
}

/// A line on standard error.
macro_rules! complain {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}

/// The warnings of a case, on standard error.
pub fn warnings(case: &Case) {
    if !case.warnings.is_empty() {
        complain!("{}\n", case.render_warnings(colour()));
    }
}
