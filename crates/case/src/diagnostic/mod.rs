//! What is said about a wrong case: the place, what is wrong, and how to mend it.

mod nearest;

use std::fmt;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet, normalize_untrusted_str};

use crate::source::{Place, Sources};
pub(crate) use nearest::{did_you_mean, listed};

/// So many diagnostics are printed; the rest are counted only.
const PRINTED: usize = 20;

/// One thing that is wrong (or doubtful) in a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Where it stands; `None` when no text is to blame (a file that cannot be read).
    pub place: Option<Place>,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// A few words beside the caret; may be empty.
    pub label: String,
    /// How to mend it.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A diagnostic that points at `place`.
    pub fn at(place: Place, message: impl Into<String>) -> Self {
        Self { place: Some(place), message: message.into(), label: String::new(), help: None }
    }

    /// A diagnostic that no place in a text explains.
    pub fn nowhere(message: impl Into<String>) -> Self {
        Self { place: None, message: message.into(), label: String::new(), help: None }
    }

    /// The same, with a few words beside the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// The same, with a hint how to mend it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The diagnostic as a person reads it: title, file, line, caret, hint.
    fn render(&self, level: Level<'static>, sources: &Sources, renderer: &Renderer) -> String {
        let title = level.primary_title(normalize_untrusted_str(&self.message));
        let mut group = match self.place {
            Some(place) => title.element(snippet(place, sources, &self.label)),
            None => Group::with_title(title),
        };
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(normalize_untrusted_str(help)));
        }
        renderer.render(&[group])
    }
}

/// The lines around a place. An argument of the command line has neither file name nor line number.
fn snippet<'a>(
    place: Place,
    sources: &'a Sources,
    label: &str,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let mut annotation = AnnotationKind::Primary.span(sources.clamped(place));
    if !label.is_empty() {
        annotation = annotation.label(normalize_untrusted_str(label));
    }
    let snippet = Snippet::source(sources.content(place)).annotation(annotation);
    match sources.file_name(place) {
        Some(name) => snippet.path(name),
        None => snippet.line_numbering(false),
    }
}

/// The problems found so far, collected so that one look at the file finds several.
#[derive(Debug, Default)]
pub(crate) struct Problems(pub(crate) Vec<Diagnostic>);

impl Problems {
    /// The value, or its diagnostic noted.
    pub(crate) fn keep<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(diagnostic) => {
                self.0.push(diagnostic);
                None
            }
        }
    }
}

/// A case that cannot be run, with everything that is wrong about it (at least one diagnostic).
#[derive(Debug, Clone)]
pub struct CaseError {
    /// What is wrong, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    sources: Arc<Sources>,
}

impl CaseError {
    pub(crate) fn new(mut diagnostics: Vec<Diagnostic>, sources: Arc<Sources>) -> Self {
        diagnostics.sort_by_key(|d| d.place.map(|p| (p.text, p.start)));
        diagnostics.dedup();
        Self { diagnostics, sources }
    }

    /// The line of a diagnostic, counted from 1; `None` for one that points at an argument of the command line.
    pub fn line(&self, diagnostic: &Diagnostic) -> Option<usize> {
        diagnostic.place.and_then(|place| self.sources.line(place))
    }

    /// What the program prints: each diagnostic with file, line, caret and hint; in colour when asked.
    pub fn render(&self, colour: bool) -> String {
        render(&self.diagnostics, Level::ERROR, &self.sources, colour)
    }
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for CaseError {}

/// Warnings as a person reads them; the empty text when there are none.
pub(crate) fn render_warnings(diagnostics: &[Diagnostic], sources: &Sources, colour: bool) -> String {
    render(diagnostics, Level::WARNING, sources, colour)
}

fn render(diagnostics: &[Diagnostic], level: Level<'static>, sources: &Sources, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut blocks: Vec<String> =
        diagnostics.iter().take(PRINTED).map(|d| d.render(level.clone(), sources, &renderer)).collect();
    if diagnostics.len() > PRINTED {
        blocks.push(format!("... and {} more", diagnostics.len() - PRINTED));
    }
    blocks.join("\n\n")
}
