//! What can go wrong while results are written or read back.

use std::io;
use std::path::{Path, PathBuf};

/// A result that could not be written or read. The message names the file and the cause;
/// [`hint`](OutputError::hint) says what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The directory (or file) of the results is there already: nothing in it was touched.
    #[error("{} already exists and is not empty", path.display())]
    AlreadyExists {
        /// The place that is taken.
        path: PathBuf,
        /// What to do.
        hint: String,
    },
    /// The operating system refused a write.
    #[error("cannot write {}: {cause}", path.display())]
    Write {
        /// The file or directory concerned.
        path: PathBuf,
        /// What the operating system said.
        cause: io::Error,
    },
    /// Another run is writing into the directory.
    #[error("a run is writing into {}", path.display())]
    Busy {
        /// The directory.
        path: PathBuf,
    },
    /// A result file could not be opened, or is not what it should be.
    #[error("cannot read {}: {cause}", path.display())]
    Read {
        /// The file concerned.
        path: PathBuf,
        /// What is wrong with it.
        cause: String,
    },
    /// A name that cannot be the name of a file in the result directory.
    #[error("\"{name}\" cannot be the name of a result file")]
    Name {
        /// The name asked for.
        name: String,
    },
    /// Data whose parts do not fit together (lengths, names, times).
    #[error("{what} cannot be written: {problem}")]
    Inconsistent {
        /// The file or the frame concerned.
        what: String,
        /// Which parts do not fit.
        problem: String,
    },
}

impl OutputError {
    /// What the user can do about it, one sentence.
    pub fn hint(&self) -> &str {
        match self {
            Self::AlreadyExists { hint, .. } => hint,
            Self::Write { cause, .. } => hint_for(cause.kind()),
            Self::Busy { .. } => "wait until it has ended, or stop it first",
            Self::Read { .. } => "check the path, and whether the run that should have written it finished",
            Self::Name { .. } => "use letters, digits, '-', '_' and '.', and begin with a letter or a digit",
            Self::Inconsistent { .. } => {
                "this is a mistake in the program, not in your input: please report it"
            }
        }
    }

    pub(crate) fn write(path: &Path, cause: io::Error) -> Self {
        Self::Write { path: path.to_path_buf(), cause }
    }

    pub(crate) fn read(path: &Path, cause: impl ToString) -> Self {
        Self::Read { path: path.to_path_buf(), cause: cause.to_string() }
    }

    pub(crate) fn inconsistent(what: impl ToString, problem: impl ToString) -> Self {
        Self::Inconsistent { what: what.to_string(), problem: problem.to_string() }
    }

    pub(crate) fn taken(path: &Path) -> Self {
        let hint = "results are never overwritten or mixed: choose another directory with --out, \
                    or move or delete this one";
        Self::AlreadyExists { path: path.to_path_buf(), hint: hint.to_string() }
    }
}

fn hint_for(kind: io::ErrorKind) -> &'static str {
    use io::ErrorKind as Kind;
    match kind {
        Kind::StorageFull | Kind::QuotaExceeded => {
            "free some space or choose a directory on another disk with --out; \
             fewer frames ([time] output) need less"
        }
        Kind::FileTooLarge => "the file system or a limit (ulimit -f) refuses files of this size",
        Kind::PermissionDenied | Kind::ReadOnlyFilesystem => {
            "choose a directory that you may write to with --out"
        }
        Kind::NotADirectory => "a part of this path is a file: choose another directory with --out",
        Kind::AlreadyExists => "another run may be writing here: choose another directory with --out",
        Kind::NotFound => "the directory vanished during the run: leave it in place until the run has ended",
        _ => "check that the disk is there and writable, or choose another directory with --out",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn message_names_file_and_cause_and_hint_fits_the_cause() {
        let full = OutputError::write(Path::new("out/plate/summary.json"), io::ErrorKind::StorageFull.into());
        assert!(full.to_string().contains("out/plate/summary.json"), "{full}");
        assert!(full.hint().contains("free some space"));
        let denied = OutputError::write(Path::new("out"), io::ErrorKind::PermissionDenied.into());
        assert!(denied.hint().contains("may write to"));
    }
}
