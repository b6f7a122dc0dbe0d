//! A run that was interrupted, found in its result directory.

use super::{Books, Notes};
use crate::run::audit::Audit;
use crate::run::writer::untouched;
use crate::{Case, CaseError};
use output::checkpoint::{Checkpoint, kept, set_aside};
use output::summary::Status;
use output::{Manifest, OutputError, ResultDir, Series, Summary, Table};
use std::fs;
use std::path::{Path, PathBuf};
use taut::run::InstructionSet;
use taut::simulation::Numbers;

/// A run that can go on.
#[derive(Debug)]
pub struct Interrupted {
    /// Its case, as it was run.
    pub case: Case,
    /// What it computes with.
    pub numbers: Numbers,
    /// What the user should know: checkpoints that cannot be used, and why.
    pub notices: Vec<String>,
    pub(crate) results: ResultDir,
    pub(crate) manifest: Manifest,
    pub(crate) found: Found,
}

/// The checkpoint that a run goes on from, with what it holds beside the state.
#[derive(Debug)]
pub struct Found {
    pub path: PathBuf,
    pub checkpoint: Checkpoint,
    pub books: Books,
    pub notes: Notes,
    /// Later checkpoints, which cannot be used.
    refused: Vec<PathBuf>,
}

/// Why a run cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The directory is not that of a run, or a run is writing there.
    #[error("{cause}\nhint: {}", cause.hint())]
    Directory {
        /// What happened.
        #[from]
        cause: OutputError,
    },
    /// The case in the manifest is not one any more.
    #[error("{0}")]
    Case(#[from] CaseError),
    /// There is nothing to be done.
    #[error("the run in {} has come to its end: there is nothing left to do", .0.display())]
    Done(PathBuf),
    /// No checkpoint was written.
    #[error(
        "there is no checkpoint in {}: the run was stopped before it wrote one\nhint: run the case again, with another --out or \
         after removing this directory", .0.display()
    )]
    None(PathBuf),
    /// No checkpoint can be used.
    #[error("cannot go on with the run in {}{}\nhint: {hint}", results.display(), told(refused))]
    Refused {
        /// The result directory.
        results: PathBuf,
        /// Checkpoints, and why each cannot be used.
        refused: Vec<(PathBuf, String)>,
        /// What to do.
        hint: String,
    },
}

fn told(refused: &[(PathBuf, String)]) -> String {
    refused.iter().map(|(path, reason)| format!("\n  {}: {reason}", path.display())).collect()
}

/// A checkpoint that fits what is on disk.
type Usable = (Checkpoint, Books, Notes);

impl Interrupted {
    /// Looks at a result directory, or at one checkpoint in it. Of a directory the last checkpoint is taken that can be used; what is
    /// wrong with later ones is told in `notices`.
    ///
    /// # Errors
    /// No run there, a run that is still writing, one that has ended, no checkpoint that can be used.
    pub fn find(place: &Path) -> Result<Self, ResumeError> {
        let single = place.is_file();
        let directory = if single { place.parent().and_then(Path::parent) } else { Some(place) };
        let directory = directory.filter(|path| !path.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let results = ResultDir::reopen(directory)?;
        let manifest = Manifest::read(directory)?;
        if Summary::read(directory).is_ok_and(|summary| summary.status == Status::Done) {
            return Err(ResumeError::Done(directory.to_path_buf()));
        }
        let name = format!("the case in {}", directory.join("manifest.json").display());
        let case = Case::again(&name, &manifest, directory)?;
        let candidates = if single { vec![place.to_path_buf()] } else { kept(directory) };
        if candidates.is_empty() {
            return Err(ResumeError::None(directory.to_path_buf()));
        }
        let mut refused = Vec::new();
        for path in candidates {
            match usable(&path, directory, (&case, &manifest)) {
                Ok((checkpoint, books, notes)) => {
                    let notices = notices(&refused, &checkpoint);
                    let numbers =
                        if manifest.precision == "single" { Numbers::Single } else { Numbers::Double };
                    let refused = refused.into_iter().map(|(path, _)| path).collect();
                    let found = Found { path, checkpoint, books, notes, refused };
                    return Ok(Self { case, numbers, notices, results, manifest, found });
                }
                Err(reason) => refused.push((path, reason)),
            }
        }
        let hint = offer(directory, &refused, (&case, &manifest));
        Err(ResumeError::Refused { results: directory.to_path_buf(), refused, hint })
    }

    /// Where the results are.
    #[must_use]
    pub fn results(&self) -> &Path {
        self.results.path()
    }

    /// The checkpoint that the run goes on from.
    #[must_use]
    pub fn checkpoint(&self) -> &Path {
        &self.found.path
    }

    /// Time of the checkpoint, s, and steps taken.
    #[must_use]
    pub fn stands_at(&self) -> (f64, u64) {
        let about = &self.found.checkpoint.about;
        (about.time, about.step)
    }
}

impl Found {
    /// What to do if the state does not fit after all: a line about another checkpoint, if there is one that can be used.
    pub fn other(&self, results: &Path, run: (&Case, &Manifest)) -> String {
        let tried: Vec<_> =
            self.refused.iter().chain([&self.path]).map(|p| (p.clone(), String::new())).collect();
        format!("\nhint: {}", offer(results, &tried, run))
    }

    /// Clears away what comes after the checkpoint: later checkpoints (those that are damaged are renamed), and what was begun.
    pub fn clear(&self, results: &ResultDir) -> Result<(), OutputError> {
        results.sweep();
        for path in &self.refused {
            set_aside(path)?;
        }
        // The last first; a later one than this was passed over because the user named this one.
        for later in kept(results.path()).iter().take_while(|path| !is_same(path, &self.path)) {
            fs::remove_file(later).map_err(|cause| OutputError::Write { path: later.clone(), cause })?;
        }
        Ok(())
    }
}

fn is_same(a: &Path, b: &Path) -> bool {
    a.file_name() == b.file_name()
}

/// A checkpoint that belongs to the run, and whose tables and frames are still there.
fn usable(path: &Path, results: &Path, (case, manifest): (&Case, &Manifest)) -> Result<Usable, String> {
    let checkpoint = Checkpoint::read(path).map_err(|damage| damage.to_string())?;
    if let Some(reason) = checkpoint.about.foreign(manifest) {
        return Err(reason);
    }
    let nonsense = |reason| format!("its contents make no sense: {reason}");
    let books = Books::of(&checkpoint, untouched(case)).map_err(nonsense)?;
    let notes = Notes::of(&checkpoint).map_err(nonsense)?;
    if notes.tables.len() != case.probes.len() {
        return Err(nonsense("it has another number of probes".to_string()));
    }
    let tables = case.probes.iter().map(|probe| output::table_path(results, &probe.name)).zip(&notes.tables);
    for (path, mark) in tables.chain(Audit::files(results, 2).zip(&notes.audit)) {
        Table::read_until(&path, mark).map_err(|error| error.to_string())?;
    }
    Series::check(results, books.frames.len()).map_err(|error| error.to_string())?;
    Ok((checkpoint, books, notes))
}

/// What a user should know about the checkpoint that was found.
fn notices(refused: &[(PathBuf, String)], found: &Checkpoint) -> Vec<String> {
    let about = &found.about;
    let refused = refused.iter().map(|(path, reason)| {
        let step = about.step;
        format!("{} cannot be used: {reason}; going on from the one before it, step {step}", path.display())
    });
    let here = InstructionSet::best().name();
    let other = (about.instruction_set != here).then(|| {
        let there = &about.instruction_set;
        format!("the run was begun with {there} and goes on with {here}: sums are rounded in another way from here on")
    });
    refused.chain(other).collect()
}

/// What can be done if what was asked for cannot be used.
fn offer(results: &Path, refused: &[(PathBuf, String)], run: (&Case, &Manifest)) -> String {
    let tried = |path: &Path| refused.iter().any(|(other, _)| is_same(other, path));
    let other = kept(results).into_iter().find(|path| !tried(path) && usable(path, results, run).is_ok());
    match other {
        Some(path) => format!("another checkpoint can be used: taut run --resume {}", path.display()),
        None => "no other checkpoint can be used: run the case again, with another --out or after removing this directory".to_string(),
    }
}
