//! The files that a case refers to: where they lie, and which were read.

use std::cell::RefCell;
use std::path::PathBuf;

use output::limited::read_bytes;
use output::manifest::{KeptFile, hash};

/// Where the files of a case lie.
#[derive(Debug, Clone)]
pub(crate) enum Shelf {
    /// In this folder, under the names that the case gives them.
    Folder(PathBuf),
    /// In these results, as a run kept them.
    Kept(PathBuf, Vec<KeptFile>),
}

impl Default for Shelf {
    fn default() -> Self {
        Self::Folder(PathBuf::new())
    }
}

/// A file that a case refers to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UsedFile {
    /// Its path, as the case says it: relative to the case file.
    pub name: String,
    /// The hash of its bytes, as a manifest has it.
    pub hash: String,
    /// Where it lies.
    pub path: PathBuf,
}

/// Reads files, and remembers them.
#[derive(Debug, Default)]
pub(crate) struct Files {
    shelf: Shelf,
    used: RefCell<Vec<UsedFile>>,
}

impl Files {
    /// Those on a shelf.
    pub(crate) fn on(shelf: Shelf) -> Self {
        Self { shelf, used: RefCell::default() }
    }

    /// Where a file lies, for messages.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        match &self.shelf {
            Shelf::Folder(folder) => folder.join(name),
            Shelf::Kept(results, kept) => {
                results.join(kept.iter().find(|file| file.name == name).map_or(name, |file| &file.kept))
            }
        }
    }

    /// The bytes of a file of at most `most`.
    ///
    /// # Errors
    /// What the system says; and if it is not the file any more that a run began with.
    pub(crate) fn read(&self, name: &str, most: u64) -> Result<Vec<u8>, String> {
        let path = self.path(name);
        let about = std::fs::metadata(&path).map_err(|cause| cause.to_string())?;
        if !about.is_file() {
            return Err("it is no ordinary file".to_string());
        }
        let bytes = read_bytes(&path, most).map_err(|cause| cause.to_string())?;
        let hash = hash(&bytes);
        if let Shelf::Kept(_, kept) = &self.shelf
            && kept.iter().any(|file| file.name == name && file.hash != hash)
        {
            return Err("it is not what the run began with".to_string());
        }
        let file = UsedFile { name: name.to_string(), hash, path };
        let mut used = self.used.borrow_mut();
        if !used.contains(&file) {
            used.push(file);
        }
        Ok(bytes)
    }

    /// What was read, in the order of reading.
    pub(crate) fn used(&self) -> Vec<UsedFile> {
        self.used.borrow().clone()
    }
}
