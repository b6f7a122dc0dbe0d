//! The frames that a result directory holds.

use std::path::{Path, PathBuf};

use crate::directory::checked;
use crate::limited::{LONGEST_RESULT, read_text};
use crate::{FrameFile, OutputError};

/// A frame of a list: its time and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed {
    /// Time, s.
    pub time: f64,
    /// Its file.
    pub path: PathBuf,
}

/// The frames of a run, finished or not, as far as they are there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Listing {
    /// In the order of time.
    pub frames: Vec<Listed>,
    /// What is missing or damaged, a sentence each.
    pub problems: Vec<String>,
}

/// More elements than a list has.
const MOST_NODES: u32 = 10_000_000;

impl Listing {
    /// Finds the frames of a result directory: those that `particles/particles.pvd` lists; where that is missing or damaged, all
    /// `particles/*.vtp`.
    ///
    /// # Errors
    /// [`OutputError::Read`] if the folder `particles` is not there or cannot be read.
    pub fn read(results: &Path) -> Result<Self, OutputError> {
        let folder = results.join("particles");
        let files = files(&folder)?;
        let mut listing = match listed(&folder) {
            Ok(frames) => Self::of_list(frames),
            Err(problem) => Self::of_files(files, problem.to_string()),
        };
        listing.frames.sort_by(|a, b| a.time.total_cmp(&b.time));
        Ok(listing)
    }

    fn of_list(frames: Vec<Listed>) -> Self {
        let (frames, gone): (Vec<_>, Vec<_>) = frames.into_iter().partition(|frame| frame.path.is_file());
        let problems = gone.iter().map(|frame| format!("{} is listed but missing", frame.path.display()));
        Self { problems: problems.collect(), frames }
    }

    fn of_files(files: Vec<PathBuf>, problem: String) -> Self {
        let mut listing = Self { problems: vec![problem], ..Self::default() };
        for path in files {
            match FrameFile::open(&path) {
                Ok(file) => listing.frames.push(Listed { time: file.time(), path }),
                Err(problem) => listing.problems.push(problem.to_string()),
            }
        }
        listing
    }
}

/// The `.vtp` files in a folder, by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let entries = std::fs::read_dir(folder).map_err(|cause| OutputError::read(folder, cause))?;
    let paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|e| e == "vtp")).collect();
    files.sort();
    Ok(files)
}

/// What `particles.pvd` lists, whether it is there or not.
fn listed(folder: &Path) -> Result<Vec<Listed>, OutputError> {
    let path = folder.join("particles.pvd");
    let text = read_text(&path, LONGEST_RESULT).map_err(|cause| OutputError::read(&path, cause))?;
    parse(folder, &text).map_err(|problem| OutputError::read(&path, problem))
}

fn parse(folder: &Path, text: &str) -> Result<Vec<Listed>, String> {
    let options = roxmltree::ParsingOptions { nodes_limit: MOST_NODES, ..Default::default() };
    let document =
        roxmltree::Document::parse_with_options(text, options).map_err(|cause| cause.to_string())?;
    let entries = document.descendants().filter(|node| node.has_tag_name("DataSet"));
    let frame = |node: roxmltree::Node| {
        let time: f64 = node.attribute("timestep")?.parse().ok()?;
        let name = checked(node.attribute("file")?).ok()?;
        time.is_finite().then(|| Listed { time, path: folder.join(name) })
    };
    entries.map(|node| frame(node).ok_or_else(|| "an entry has no usable time or file".to_string())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, ResultDir, Series};

    fn three_frames() -> tempfile::TempDir {
        let scratch = tempfile::tempdir().unwrap();
        let mut series = Series::create(&ResultDir::create(scratch.path()).unwrap()).unwrap();
        for time in [0.0, 0.1 + 0.2, 1e20] {
            series.write(&Frame { time, step: 0, points: vec![[0.0; 3]], arrays: vec![] }).unwrap();
        }
        scratch
    }

    fn times(listing: &Listing) -> Vec<f64> {
        listing.frames.iter().map(|frame| frame.time).collect()
    }

    #[test]
    fn what_is_there_is_listed_and_what_is_missing_is_named() {
        let scratch = three_frames();
        let listing = Listing::read(scratch.path()).unwrap();
        assert_eq!((times(&listing), listing.problems.len()), (vec![0.0, 0.1 + 0.2, 1e20], 0));
        std::fs::remove_file(scratch.path().join("particles/particles_000001.vtp")).unwrap();
        let listing = Listing::read(scratch.path()).unwrap();
        assert_eq!(times(&listing), [0.0, 1e20]);
        assert!(listing.problems[0].contains("particles_000001.vtp is listed but missing"));
    }

    #[test]
    fn without_a_list_the_files_speak_for_themselves() {
        let scratch = three_frames();
        let folder = scratch.path().join("particles");
        std::fs::write(folder.join("particles_000000.vtp"), "torn").unwrap();
        for list in [None, Some("<VTKFile>"), Some("<a><DataSet timestep='0' file='../../etc/passwd'/></a>")]
        {
            std::fs::remove_file(folder.join("particles.pvd")).ok();
            if let Some(list) = list {
                std::fs::write(folder.join("particles.pvd"), list).unwrap();
            }
            let listing = Listing::read(scratch.path()).unwrap();
            assert_eq!((times(&listing), listing.problems.len()), (vec![0.1 + 0.2, 1e20], 2));
        }
        assert!(Listing::read(&scratch.path().join("nowhere")).is_err());
    }
}
