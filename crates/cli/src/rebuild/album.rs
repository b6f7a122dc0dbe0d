//! The pictures that are wanted of a run, and drawing them.

use super::About;
use crate::Failure;
use crate::arguments::{Animation, ReportOptions};
use crate::pictures::Drawn;
use output::{Frame, FrameFile, Listed};
use report::{
    Image, Picture, Range, ReportError, View, Window, components, picture, split_field, typical_range,
};
use report::{write_gif, write_png};
use std::path::Path;

/// Pictures of one run.
pub struct Album<'a> {
    options: &'a ReportOptions,
    title: &'a str,
    /// Name and file of every frame that is drawn.
    frames: Vec<(String, Listed)>,
    view: Option<View>,
    window: Option<Window>,
    /// For every field its range over all frames; `None` if no frame has it.
    ranges: Vec<Option<Range>>,
}

impl<'a> Album<'a> {
    /// Looks through the frames that are wanted: what is damaged is left out and named. `None` if none is left.
    pub fn new(
        about: &'a About,
        options: &'a ReportOptions,
        list: Vec<Listed>,
        problems: &mut Vec<String>,
    ) -> Option<Self> {
        let mut album = Self {
            options,
            title: &about.title,
            frames: vec![],
            view: options.view,
            window: None,
            ranges: vec![],
        };
        album.ranges = vec![None; options.fields.len()];
        let mut flat = true;
        let wanted: Vec<_> =
            options.choice().into_iter().map(|frames| (frames, frames.of(&list, about.end))).collect();
        problems.extend(
            wanted
                .iter()
                .filter(|(_, found)| found.is_empty())
                .filter_map(|(frames, _)| frames.missing(&list)),
        );
        for (name, number) in wanted.into_iter().flat_map(|(_, found)| found) {
            match album.read(&list[number], None) {
                Ok(frame) => {
                    flat &= frame.points.iter().all(|point| point[2] == 0.0);
                    album.frames.push((name, list[number].clone()));
                    album.measure(&frame, about.dimension.map_or(flat, |d| d == 2));
                }
                Err(problem) => problems.push(problem),
            }
        }
        for (field, _) in options.fields.iter().zip(&album.ranges).filter(|(_, range)| range.is_none()) {
            problems.extend(album.frames.first().and_then(|(_, first)| unknown(field, first)));
        }
        (!album.frames.is_empty()).then_some(album)
    }

    /// Widens the window and the ranges to what is in a frame.
    fn measure(&mut self, frame: &Frame, flat: bool) {
        if self.options.view.is_none() {
            self.view = (!flat).then(View::default);
        }
        let window = Window::around(frame, self.view);
        self.window = Some(self.window.map_or(window, |all| all.union(window)));
        for (range, field) in self.ranges.iter_mut().zip(&self.options.fields) {
            let here = typical_range(frame, field);
            *range = range.map(|all| here.map_or(all, |here| all.union(here))).or(here);
        }
    }

    /// Reads a frame with what one field, or any of them, needs.
    fn read(&self, file: &Listed, field: Option<&str>) -> Result<Frame, String> {
        let wanted = |name: &str| {
            let is = |field: &str| split_field(field).0 == name;
            name == "ParticleSpacing"
                || (name == "Displacement" && self.options.undeformed)
                || field.map_or_else(|| self.options.fields.iter().any(|field| is(field)), is)
        };
        let read = FrameFile::open(&file.path).and_then(|file| file.frame(wanted));
        read.map_err(|error| error.to_string())
    }

    /// Draws everything that is wanted into `out`.
    ///
    /// # Errors
    /// If a picture cannot be written.
    pub fn draw(&self, out: &Path, drawn: &mut Drawn) -> Result<(), Failure> {
        for (field, range) in
            self.options.fields.iter().zip(&self.ranges).filter(|(_, range)| range.is_some())
        {
            let behind = if field == "VonMisesStress" { String::new() } else { format!("-{field}") };
            match self.options.animation {
                None => {
                    for (name, file) in &self.frames {
                        self.still((file, field, None), &out.join(format!("{name}{behind}.png")), drawn)?;
                    }
                }
                Some(Animation::Frames) => {
                    let folder = out.join(format!("animation{behind}"));
                    std::fs::create_dir_all(&folder).map_err(|cause| {
                        Failure::Run(format!("cannot make {}: {cause}", folder.display()))
                    })?;
                    for (number, (_, file)) in self.frames.iter().enumerate() {
                        self.still((file, field, *range), &folder.join(format!("{number:06}.png")), drawn)?;
                    }
                }
                Some(Animation::Gif) => {
                    let path = out.join(format!("animation{behind}.gif"));
                    let one = |number: usize| {
                        self.image(&self.frames[number].1, field, *range).map_err(Problem::Frame)
                    };
                    match write_gif(self.frames.len(), one, &path) {
                        Ok(()) => drawn.files.push(path),
                        Err(Problem::Frame(problem)) => drawn.problems.push(problem),
                        Err(Problem::Write(error)) => {
                            return Err(Failure::Run(format!("{error}\nhint: {}", error.hint())));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn still(
        &self,
        (file, field, range): (&Listed, &str, Option<Range>),
        path: &Path,
        drawn: &mut Drawn,
    ) -> Result<(), Failure> {
        match self.image(file, field, range) {
            Ok(image) => {
                write_png(&image, path)
                    .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
                drawn.files.push(path.to_path_buf());
            }
            Err(problem) => drawn.problems.push(problem),
        }
        Ok(())
    }

    fn image(&self, file: &Listed, field: &str, range: Option<Range>) -> Result<Image, String> {
        let frame = self.read(file, Some(field))?;
        let own = self.options.range.map(|ends| Range { ends, cut: false });
        let options = Picture {
            note: String::new(),
            title: self.title.to_string(),
            field: field.to_string(),
            view: self.view,
            window: self.window,
            range: own.or(range),
            size: self
                .options
                .size
                .map_or(if self.options.animation.is_some() { 800 } else { 1200 }, usize::from),
            undeformed: self.options.undeformed,
        };
        Ok(picture(&frame, &options))
    }
}

/// Why an animation could not be made.
enum Problem {
    Frame(String),
    Write(ReportError),
}

impl From<ReportError> for Problem {
    fn from(error: ReportError) -> Self {
        Self::Write(error)
    }
}

/// Says that a frame has no such quantity, and what it has.
fn unknown(field: &str, file: &Listed) -> Option<String> {
    let file = FrameFile::open(&file.path).ok()?;
    let (name, component) = split_field(field);
    let known = file.arrays().find(|(known, _)| *known == name);
    Some(match (known, component) {
        (Some((_, count)), Some(component)) => {
            format!("{name} has no component `{component}`: {}", components(count))
        }
        _ => {
            let names: Vec<&str> = file.arrays().map(|(name, _)| name).collect();
            format!("the frames have no `{name}`; they have {}", names.join(", "))
        }
    })
}
