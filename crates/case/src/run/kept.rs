//! Copies of the files that a case refers to, beside its results: with the manifest they are all that a run needs to be repeated, or to
//! go on.

use super::error::RunError;
use crate::checked::LARGEST_MESH;
use crate::{Case, UsedFile};
use output::limited::read_bytes;
use output::manifest::{KeptFile, hash};
use output::{OutputError, ResultDir};

/// Copies all of them into the folder `files`, each under a number and its name.
///
/// # Errors
/// A file that changed since the case was read, or cannot be copied.
pub fn keep(case: &Case, results: &ResultDir) -> Result<Vec<KeptFile>, RunError> {
    if case.files.is_empty() {
        return Ok(Vec::new());
    }
    let folder = results.folder("files")?;
    let copy = |(number, file): (usize, &UsedFile)| {
        let unread = |cause: String| OutputError::Read { path: file.path.clone(), cause };
        let bytes = read_bytes(&file.path, LARGEST_MESH).map_err(|cause| unread(cause.to_string()))?;
        if hash(&bytes) != file.hash {
            return Err(unread("it was changed while the run began".to_string()).into());
        }
        let last = file.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let kept = format!("{number}-{last}");
        output::write_atomically(&folder.join(&kept), &bytes)?;
        Ok(KeptFile { name: file.name.clone(), kept: format!("files/{kept}"), hash: file.hash.clone() })
    };
    case.files.iter().enumerate().map(copy).collect()
}
