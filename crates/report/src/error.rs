//! What can go wrong while pictures are made.

use output::OutputError;

/// A picture or plot that could not be made or written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] OutputError),
    /// The picture could not be turned into the bytes of a file.
    #[error("cannot draw {what}: {cause}")]
    Draw {
        /// The file that should have been made.
        what: String,
        /// What the drawing library said.
        cause: String,
    },
}

impl ReportError {
    /// What the user can do about it, one sentence.
    pub fn hint(&self) -> &str {
        match self {
            Self::Write(error) => error.hint(),
            Self::Draw { .. } => {
                "the numbers of the run are not affected; please report it with the result directory"
            }
        }
    }
}
