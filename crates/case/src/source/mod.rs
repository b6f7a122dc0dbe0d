//! The texts a case comes from (the file, and the arguments that override it) and places in them.

mod files;
mod overrides;

use std::ops::Range;

pub use files::UsedFile;
pub(crate) use files::{Files, Shelf};
pub use overrides::Overrides;
pub(crate) use overrides::apply;

/// Where something stands: which text, and which bytes of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Place {
    /// Number of the text: 0 is the file, the others are arguments of the command line.
    pub text: usize,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Place {
    /// The beginning of the file.
    pub(crate) const START: Self = Self { text: 0, start: 0, end: 0 };

    /// The same text, from `span.start` to `span.end` counted from byte `from` of it.
    pub(crate) fn part(self, from: usize, span: &Range<usize>) -> Self {
        Self { text: self.text, start: from + span.start, end: from + span.end }
    }
}

/// All texts of one case.
#[derive(Debug, Clone)]
pub struct Sources {
    file: String,
    texts: Vec<String>,
    shelf: Shelf,
}

impl Sources {
    /// The texts of a case whose file is called `file` and reads `content`.
    pub(crate) fn new(file: &str, content: &str) -> Self {
        let content = content.strip_prefix('\u{feff}').unwrap_or(content);
        let shelf =
            Shelf::Folder(std::path::Path::new(file).parent().map_or_else(Default::default, Into::into));
        Self { file: file.to_string(), texts: vec![content.to_string()], shelf }
    }

    /// Adds an argument of the command line, as typed; its number.
    pub(crate) fn add_argument(&mut self, text: String) -> usize {
        self.texts.push(text);
        self.texts.len() - 1
    }

    /// The same with the files that the case refers to on another shelf than the folder of the case.
    pub(crate) fn with(self, shelf: Shelf) -> Self {
        Self { shelf, ..self }
    }

    /// The files that the case refers to.
    pub(crate) fn files(&self) -> Files {
        Files::on(self.shelf.clone())
    }

    /// The text of the file.
    pub(crate) fn file_content(&self) -> &str {
        &self.texts[0]
    }

    /// The text that a place stands in.
    pub(crate) fn content(&self, place: Place) -> &str {
        self.texts.get(place.text).map_or("", String::as_str)
    }

    /// The name of the file, if the place stands in it.
    pub(crate) fn file_name(&self, place: Place) -> Option<&str> {
        (place.text == 0).then_some(self.file.as_str())
    }

    /// The line of a place, counted from 1, if it stands in the file.
    pub(crate) fn line(&self, place: Place) -> Option<usize> {
        let start = self.clamped(place).start;
        (place.text == 0)
            .then(|| 1 + self.texts[0].as_bytes()[..start].iter().filter(|&&b| b == b'\n').count())
    }

    /// The bytes of a place, moved to the nearest character boundaries inside its text.
    pub(crate) fn clamped(&self, place: Place) -> Range<usize> {
        let content = self.content(place);
        let mut start = place.start.min(content.len());
        while !content.is_char_boundary(start) {
            start -= 1;
        }
        let mut end = place.end.clamp(start, content.len());
        while !content.is_char_boundary(end) {
            end += 1;
        }
        start..end
    }
}
