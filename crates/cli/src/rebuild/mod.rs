//! `taut report`: pictures and plots of a run, finished or not, made again from its files.

mod album;
mod choice;

pub use choice::{Frames, range, view};

use crate::Failure;
use crate::arguments::{Animation, ReportOptions};
use crate::pictures::{self, Drawn};
use album::Album;
use case::{Case, Overrides};
use output::{Listing, Manifest};
use std::path::Path;

/// Makes what can be made, and says what cannot.
pub fn report(options: &ReportOptions) -> Result<(), Failure> {
    let results = options.dir.as_path();
    let mut problems = Vec::new();
    let about = About::of(results, &mut problems)?;
    let out = options.out.as_deref().unwrap_or(results);
    std::fs::create_dir_all(out)
        .map_err(|cause| Failure::Run(format!("cannot make {}: {cause}", out.display())))?;
    let mut drawn = Drawn { files: Vec::new(), problems };
    match Listing::read(results) {
        Ok(listing) => {
            drawn.problems.extend(listing.problems);
            match Album::new(&about, options, listing.frames, &mut drawn.problems) {
                Some(album) => album.draw(out, &mut drawn)?,
                None => drawn.problems.push("there is no frame to draw".to_string()),
            }
        }
        Err(error) => drawn.problems.push(error.to_string()),
    }
    pictures::plots(&about.title, results, out, &mut drawn);
    tell(options, out, &drawn)
}

fn tell(options: &ReportOptions, out: &Path, drawn: &Drawn) -> Result<(), Failure> {
    // Told even if little is wanted: it is why the command fails.
    for problem in &drawn.problems {
        complain!("warning: {problem}");
    }
    if !options.quiet {
        for file in &drawn.files {
            say!("{}", file.display());
        }
    }
    match (drawn.files.is_empty(), drawn.problems.is_empty()) {
        (true, _) => Err(Failure::Run(format!(
            "nothing could be made from {}{}",
            options.dir.display(),
            drawn.problems.first().map_or(String::new(), |problem| format!(": {problem}"))
        ))),
        (false, true) => Ok(()),
        (false, false) => Err(Failure::Run(format!(
            "not everything could be made; what could is in {} ({} files)",
            out.display(),
            drawn.files.len()
        ))),
    }
}

/// What the manifest says about a run.
pub struct About {
    /// Its title.
    pub title: String,
    /// Two or three; `None` if the manifest does not say.
    pub dimension: Option<usize>,
    /// Time at which it should end, s; infinite if the manifest does not say.
    pub end: f64,
}

impl About {
    /// Reads the manifest. Where it is damaged, the name of the directory has to do.
    fn of(results: &Path, problems: &mut Vec<String>) -> Result<Self, Failure> {
        if !results.is_dir() {
            return Err(Failure::Input(format!("there is no directory {}", results.display())));
        }
        let known = ["manifest.json", "summary.json", "particles", "probes"];
        if !known.iter().any(|name| results.join(name).exists()) {
            return Err(Failure::Input(format!(
                "{} is no result of a run: it has no manifest.json, no particles, no probes\nhint: `taut run` leaves its results in out/NAME",
                results.display()
            )));
        }
        match case_of(results) {
            Ok(case) => Ok(Self { dimension: Some(case.dimension), end: case.time.end, title: case.title }),
            Err(problem) => {
                problems.push(problem);
                let name = results.file_name().map_or("results".into(), |name| name.to_string_lossy());
                Ok(Self { title: name.into_owned(), dimension: None, end: f64::INFINITY })
            }
        }
    }
}

fn case_of(results: &Path) -> Result<Case, String> {
    let manifest = Manifest::read(results).map_err(|error| error.to_string())?;
    Case::parse("manifest.json", &manifest.case, &Overrides::default()).map_err(|_| {
        format!("the case in {} is not one of this version", results.join("manifest.json").display())
    })
}

impl ReportOptions {
    /// The frames that are wanted: by default all for an animation, else three.
    fn choice(&self) -> Vec<Frames> {
        match (&self.frames[..], self.animation) {
            ([], None) => vec![Frames::Start, Frames::Middle, Frames::End],
            ([], Some(Animation::Gif | Animation::Frames)) => vec![Frames::All],
            (chosen, _) => chosen.to_vec(),
        }
    }
}
