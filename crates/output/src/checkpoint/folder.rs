//! The folder `checkpoint` of a result directory: the last two are kept.

use super::{About, Draft};
use crate::directory::write_durably;
use crate::{OutputError, ResultDir};
use std::ffi::OsStr;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// How many are kept.
const KEPT: usize = 2;
const FOLDER: &str = "checkpoint";
const END: &str = ".taut";

/// Writes checkpoints and removes all but the last two.
#[derive(Debug)]
pub struct Keeper {
    folder: PathBuf,
}

impl Keeper {
    /// For this result directory; the folder is made with the first checkpoint.
    #[must_use]
    pub fn new(results: &ResultDir) -> Self {
        Self { folder: results.path().join(FOLDER) }
    }

    /// Writes a checkpoint for good: beside its place, stored by the disk, then moved there. Only then older ones go.
    ///
    /// # Errors
    /// [`OutputError::Write`]; those that were there stay.
    pub fn keep(
        &self,
        draft: &Draft,
        about: &About,
        notes: &serde_json::Value,
    ) -> Result<PathBuf, OutputError> {
        // Only this folder: a result directory that was deleted is not made again.
        match fs::create_dir(&self.folder) {
            Err(cause) if cause.kind() != ErrorKind::AlreadyExists => {
                return Err(OutputError::write(&self.folder, cause));
            }
            _ => {}
        }
        let path = self.folder.join(format!("step-{:09}{END}", about.step));
        write_durably(&path, |file| draft.write(about, notes, file))?;
        for old in listed(&self.folder).into_iter().skip(KEPT) {
            // What cannot be removed does no harm.
            let _ = fs::remove_file(old);
        }
        Ok(path)
    }
}

/// The checkpoints of the result directory `results`, the last one first.
#[must_use]
pub fn kept(results: &Path) -> Vec<PathBuf> {
    listed(&results.join(FOLDER))
}

/// Renames a checkpoint that cannot be used to `NAME.damaged`, so that it is no longer among those that are [`kept`].
///
/// # Errors
/// [`OutputError::Write`].
pub fn set_aside(path: &Path) -> Result<PathBuf, OutputError> {
    let mut name = path.as_os_str().to_os_string();
    name.push(".damaged");
    let aside = PathBuf::from(name);
    fs::rename(path, &aside).map_err(|cause| OutputError::write(&aside, cause))?;
    Ok(aside)
}

fn listed(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut found: Vec<(u64, PathBuf)> =
        entries.flatten().filter_map(|entry| Some((step(&entry.file_name())?, entry.path()))).collect();
    found.sort_unstable_by(|a, b| b.cmp(a));
    found.into_iter().map(|(_, path)| path).collect()
}

/// The step in the name of a checkpoint.
fn step(name: &OsStr) -> Option<u64> {
    name.to_str()?.strip_prefix("step-")?.strip_suffix(END)?.parse().ok()
}
