//! The directory of one run, and writing a file into it in one step.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::limited::{LONGEST_RESULT, read_bytes};
use crate::vtp::Encoder;
use crate::{Frame, OutputError};

/// The directory that holds the results of one run, and of one run only.
///
/// Whatever lies directly in it goes through this type, so that two runs never mix: a directory that is
/// not empty is refused, and each folder in it is made once.
#[derive(Debug)]
pub struct ResultDir {
    path: PathBuf,
}

impl ResultDir {
    /// Claims `path` (and makes it, with its parents, where it is missing).
    ///
    /// # Errors
    /// [`OutputError::AlreadyExists`] if something but an empty directory is there,
    /// [`OutputError::Write`] if it cannot be made.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        if path.exists() && !is_empty_directory(path)? {
            return Err(OutputError::taken(path));
        }
        fs::create_dir_all(path).map_err(|cause| OutputError::write(path, cause))?;
        Ok(Self { path: path.to_path_buf() })
    }

    /// Where the results are.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the folder `name` in the result directory and returns its path.
    ///
    /// # Errors
    /// [`OutputError::AlreadyExists`] if it is there already (also when another run that claimed the
    /// same empty directory was faster), [`OutputError::Name`], [`OutputError::Write`].
    pub fn folder(&self, name: &str) -> Result<PathBuf, OutputError> {
        let path = self.path.join(checked(name)?);
        match fs::create_dir(&path) {
            Ok(()) => Ok(path),
            Err(cause) if cause.kind() == io::ErrorKind::AlreadyExists => Err(OutputError::taken(&path)),
            Err(cause) => Err(OutputError::write(&path, cause)),
        }
    }

    /// Writes `bytes` as the file `name`, in one step; a file of that name is replaced.
    ///
    /// # Errors
    /// [`OutputError::Name`], [`OutputError::Write`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, OutputError> {
        let path = self.path.join(checked(name)?);
        write_atomically(&path, bytes)?;
        Ok(path)
    }

    /// Writes a frame by itself as the file `name` for ParaView, such as `culprit.vtp`; a file of that name is replaced.
    ///
    /// # Errors
    /// [`OutputError::Inconsistent`] if an array does not fit the particles, [`OutputError::Name`], [`OutputError::Write`].
    pub fn write_frame(&self, name: &str, frame: &Frame) -> Result<PathBuf, OutputError> {
        frame.check()?;
        let bytes = Encoder::default().encode(frame);
        self.write(name, &bytes.map_err(|cause| OutputError::write(&self.path.join(name), cause))?)
    }

    /// Writes `value` as indented JSON; numbers that are not finite become `null`.
    pub(crate) fn write_json(&self, name: &str, value: &impl Serialize) -> Result<PathBuf, OutputError> {
        let mut text =
            serde_json::to_vec_pretty(value).map_err(|cause| OutputError::inconsistent(name, cause))?;
        text.push(b'\n');
        self.write(name, &text)
    }
}

fn is_empty_directory(path: &Path) -> Result<bool, OutputError> {
    if !path.is_dir() {
        return Ok(false);
    }
    let mut entries = fs::read_dir(path).map_err(|cause| OutputError::write(path, cause))?;
    Ok(entries.next().is_none())
}

/// `name` if it can be one file name on every system: nothing that climbs out of the directory.
pub(crate) fn checked(name: &str) -> Result<&str, OutputError> {
    let begins_well = name.starts_with(|c: char| c.is_ascii_alphanumeric());
    let allowed = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
    if begins_well && name.chars().all(allowed) {
        return Ok(name);
    }
    Err(OutputError::Name { name: name.to_string() })
}

/// Writes `bytes` to a temporary file beside `path`, then moves it there: a reader sees the old file or
/// the new one, never a part of one, and a run that is killed leaves no torn file.
///
/// # Errors
/// [`OutputError::Write`] with the name of the final file; the temporary one is removed.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let write = || -> io::Result<()> {
        let mut file = new_file_options().tempfile_in(parent)?;
        file.write_all(bytes)?;
        // Network file systems report a full disk only when asked to store the data for good.
        file.as_file().sync_all()?;
        file.persist(path).map_err(|refused| refused.error)?;
        Ok(())
    };
    write().map_err(|cause| OutputError::write(path, cause))
}

/// Reads what [`ResultDir::write_json`] wrote.
pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, OutputError> {
    let text = read_bytes(path, LONGEST_RESULT).map_err(|cause| OutputError::read(path, cause))?;
    serde_json::from_slice(&text).map_err(|cause| OutputError::read(path, cause))
}

/// Temporary files are private by default; results get the permissions that any new file gets.
fn new_file_options() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".unfinished-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_new_and_empty_directories_and_refuses_full_ones() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a/b");
        let results = ResultDir::create(&path).unwrap();
        ResultDir::create(&path).unwrap();
        results.write("note.txt", b"kept").unwrap();
        let refused = ResultDir::create(&path).unwrap_err();
        assert!(matches!(&refused, OutputError::AlreadyExists { path: p, .. } if *p == path));
        assert!(refused.hint().contains("--out"));
        let file = scratch.path().join("file");
        fs::write(&file, "x").unwrap();
        assert!(matches!(ResultDir::create(&file), Err(OutputError::AlreadyExists { .. })));
        assert_eq!(fs::read(path.join("note.txt")).unwrap(), b"kept");
    }

    #[test]
    fn a_folder_is_made_once() {
        let scratch = tempfile::tempdir().unwrap();
        let first = ResultDir::create(scratch.path()).unwrap();
        let second = ResultDir::create(scratch.path()).unwrap();
        first.folder("particles").unwrap();
        assert!(matches!(second.folder("particles"), Err(OutputError::AlreadyExists { .. })));
    }

    #[test]
    fn names_stay_inside_the_directory() {
        for bad in ["", "..", "../up", "a/b", "a\\b", ".hidden", "c:", "a\0"] {
            assert!(matches!(checked(bad), Err(OutputError::Name { .. })), "{bad:?}");
        }
        assert_eq!(checked("tip-2.csv").unwrap(), "tip-2.csv");
    }

    #[test]
    fn replacing_a_file_leaves_only_the_new_one() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("x.json");
        write_atomically(&path, b"old and longer").unwrap();
        write_atomically(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_parent_that_is_a_file_is_an_error_with_the_path() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("file");
        fs::write(&file, "x").unwrap();
        let error = write_atomically(&file.join("summary.json"), b"{}").unwrap_err();
        assert!(error.to_string().contains("summary.json"), "{error}");
        assert!(ResultDir::create(&file.join("out")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn results_are_readable_like_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let scratch = tempfile::tempdir().unwrap();
        fs::write(scratch.path().join("plain"), "x").unwrap();
        write_atomically(&scratch.path().join("ours"), b"x").unwrap();
        let mode = |name| fs::metadata(scratch.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("ours"), mode("plain"));
    }
}
