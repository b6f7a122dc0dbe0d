//! One frame as a picture.

use output::Frame;
use rayon::prelude::*;

use crate::colours::{ColourMap, Rgb};
use crate::field::{Shown, shown};
use crate::image::{Font, Image};
use crate::layout::{Layout, MARGIN};
use crate::legend::{self, Colours, TRIPOD};
use crate::range::Range;
use crate::scale::quantity;
use crate::splat::{Canvas, Finish, SAMPLES, Splat};
use crate::view::{View, Window, project};

/// What a picture shows and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Stands above the picture.
    pub title: String,
    /// Stands below the title instead of the time; the empty text is the time.
    pub note: String,
    /// The quantity that gives the colours: `Pressure`; `Velocity` is its magnitude, `Velocity.x` or `CauchyStress.xy` a component.
    pub field: String,
    /// From where; `None` is the plane view with flat discs, for two dimensions.
    pub view: Option<View>,
    /// Which part of the world; `None` is all particles of this frame. Give all pictures of a run the same.
    pub window: Option<Window>,
    /// Values at the ends of the colours; `None` is [`typical_range`] of this frame.
    pub range: Option<Range>,
    /// Length of the longer side, pixels; 400 to 4000.
    pub size: usize,
    /// Whether to show where the particles came from, in light grey behind them; in the plane view, if the frame has a
    /// `Displacement`.
    pub undeformed: bool,
}

impl Default for Picture {
    /// The von Mises stress in the plane view, 1200 pixels.
    fn default() -> Self {
        Self {
            title: String::new(),
            note: String::new(),
            field: "VonMisesStress".to_string(),
            view: None,
            window: None,
            range: None,
            size: 1200,
            undeformed: false,
        }
    }
}

/// The range of a quantity in a frame without its outermost 0.5 % at either end; `None` if the frame does not have it.
pub fn typical_range(frame: &Frame, field: &str) -> Option<Range> {
    shown(frame, field).ok().map(|shown| Range::typical(&shown.values))
}

/// Draws the particles of `frame`: discs of half a `ParticleSpacing` in the plane view, else shaded balls,
/// coloured by a quantity, with title, time, colour bar, scale bar and axes.
///
/// Anything can be drawn: particles whose position is not a number are left out, values that are not are
/// grey, and without particles the picture says so.
pub fn picture(frame: &Frame, options: &Picture) -> Image {
    let window = options.window.unwrap_or_else(|| Window::around(frame, options.view)).usable();
    let layout = Layout::new(window.size()[0] / window.size()[1], options.size);
    let mut image = Image::white(layout.image[0], layout.image[1]);
    let room = layout.image[0] - 2 * MARGIN - if options.view.is_some() { TRIPOD } else { 0 };
    let time = format!("t = {}", quantity(frame.time, "s"));
    let below = if options.note.is_empty() { &time } else { &options.note };
    legend::header(&mut image, [&options.title, below], room);
    let sheet = Sheet::new(window, options.view, &layout);
    let shown = shown(frame, &options.field);
    let values: &[f64] = shown.as_ref().map_or(&[], |shown| &shown.values);
    let range = options.range.unwrap_or_else(|| Range::typical(values)).rounded();
    let map = ColourMap::of_range(range.ends);
    let colour = |i: usize| map.at(place(values.get(i).copied(), range.ends));
    let start = if options.undeformed && options.view.is_none() { start(frame) } else { Vec::new() };
    image.paste(layout.plot.at, &sheet.particles(frame, &start, colour));
    legend::ruler(&mut image, &layout, sheet.per_pixel);
    if options.view.is_some() {
        legend::tripod(&mut image, &sheet.axes);
    }
    match &shown {
        Ok(Shown { name, unit, .. }) => {
            let note: &[&str] = if range.cut { &["0.5 to 99.5", "percentile"] } else { &[] };
            Colours { name, unit, range: range.ends, note }.draw(&mut image, &layout, &map);
        }
        Err(problem) => remark(&mut image, &layout, problem),
    }
    if frame.points.is_empty() {
        remark(&mut image, &layout, "no particles");
    }
    image
}

/// Positions before any displacement; none if the frame does not say.
fn start(frame: &Frame) -> Vec<[f64; 3]> {
    let Some(moved) = frame.array("Displacement").filter(|array| array.components == 3) else {
        return Vec::new();
    };
    let moved = moved.values.to_f64();
    let back = |(point, moved): (&[f64; 3], &[f64; 3])| std::array::from_fn(|k| point[k] - moved[k]);
    frame.points.iter().zip(moved.as_chunks::<3>().0).map(back).collect()
}

/// A line of text in the place of the colour bar's caption.
fn remark(image: &mut Image, layout: &Layout, text: &str) {
    let at = [layout.plot.at[0], layout.plot.at[1]];
    image.text(at, &Font::Small.fit(text, layout.plot.size[0]), Font::Small, legend::GREY);
}

/// Where in the colour map a value stands: 0 to 1, or not a number.
fn place(value: Option<f64>, [low, high]: [f64; 2]) -> f64 {
    let value = value.unwrap_or(f64::NAN);
    if value.is_nan() || high > low { (value - low) / (high - low) } else { 0.5 }
}

/// The colour of particles where they were at the start.
const PALE: Rgb = [226, 226, 226];
/// How far behind the others these are drawn, samples.
const BEHIND: f64 = 1e4;

/// The sheet of paper that particles are drawn on: how world lengths become pixels.
struct Sheet {
    axes: [[f64; 3]; 3],
    finish: Finish,
    window: Window,
    size: [usize; 2],
    /// Length of a pixel, m.
    per_pixel: f64,
}

impl Sheet {
    fn new(window: Window, view: Option<View>, layout: &Layout) -> Self {
        let size = layout.plot.size;
        let per_pixel = (window.size()[0] / size[0] as f64).max(window.size()[1] / size[1] as f64);
        let finish = if view.is_some() { Finish::Ball } else { Finish::Flat };
        Self { axes: view.unwrap_or(View::PLANE).axes(), finish, window, size, per_pixel }
    }

    /// The particles, with the colour of particle `i` from `colour(i)`, before those at the places of the start.
    fn particles(&self, frame: &Frame, start: &[[f64; 3]], colour: impl Fn(usize) -> Rgb + Sync) -> Image {
        let scale = SAMPLES as f64 / self.per_pixel;
        let (centre, half) = (self.window.centre(), self.size.map(|side| 0.5 * (side * SAMPLES) as f64));
        let spacings = frame.array("ParticleSpacing").map(|array| array.magnitudes()).unwrap_or_default();
        let largest = self.largest_radius(frame.points.len());
        // Depths are counted from some particle, since the buffer holds 7 digits only.
        let first = frame.points.iter().map(|&p| project(&self.axes, p)[2]).find(|z| z.is_finite());
        let at = |(i, &point): (usize, &[f64; 3])| {
            let p = project(&self.axes, point);
            let spacing = spacings.get(i).copied().filter(|s| s.is_finite() && *s > 0.0);
            Splat {
                x: half[0] + (p[0] - centre[0]) * scale,
                y: half[1] - (p[1] - centre[1]) * scale,
                depth: (p[2] - first.unwrap_or(0.0)) * scale,
                radius: closed(0.5 * spacing.unwrap_or(largest).min(largest) * scale),
                colour: PALE,
            }
        };
        // Behind everything, far enough for the buffer to tell and near enough for it to tell them from each other.
        let behind = |splat: Splat| Splat { depth: splat.depth - BEHIND, ..splat };
        let mut splats: Vec<Splat> = start.par_iter().enumerate().map(|p| behind(at(p))).collect();
        let coloured = frame.points.par_iter().enumerate().map(|p| Splat { colour: colour(p.0), ..at(p) });
        splats.par_extend(coloured);
        Canvas { size: self.size, finish: self.finish }.image(&splats)
    }

    /// An upper bound for a radius, m: `n` particles that fill a cube as large as the window are half as
    /// large. Keeps the work bounded when spacings are nonsense, and stands in where there are none.
    fn largest_radius(&self, n: usize) -> f64 {
        let longest = self.window.size()[0].max(self.window.size()[1]);
        longest / (n.max(1) as f64).cbrt()
    }
}

/// A radius in samples; small particles grow, up to the circle around their square, so that a body of
/// many looks closed rather than like a sieve.
fn closed(radius: f64) -> f64 {
    let pixels = radius / SAMPLES as f64;
    radius * (1.0 + 0.42 * ((6.0 - pixels) / 3.0).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use output::{Array, Values};

    fn frame(points: Vec<[f64; 3]>, stress: Vec<f64>, spacing: f64) -> Frame {
        let n = points.len();
        let arrays = vec![
            Array::scalar("VonMisesStress", "Pa", Values::F64(stress)),
            Array::scalar("ParticleSpacing", "m", Values::F64(vec![spacing; n])),
        ];
        Frame { time: 0.5, step: 0, points, arrays }
    }

    fn drawn(frame: &Frame, view: Option<View>) -> Image {
        picture(frame, &Picture { view, size: 400, ..Picture::default() })
    }

    /// Whether any pixel has exactly this colour.
    fn shows(image: &Image, colour: [u8; 3]) -> bool {
        image.pixels().chunks(3).any(|pixel| pixel == colour)
    }

    /// How many pixels have this colour: edges that are averaged may have any here and there.
    fn count(image: &Image, colour: [u8; 3]) -> usize {
        image.pixels().chunks(3).filter(|pixel| *pixel == colour).count()
    }

    #[test]
    fn broken_frames_are_drawn_without_a_panic() {
        let huge = f64::MAX;
        for view in [None, Some(View::default())] {
            for spacing in [0.1, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e300, 1e-300] {
                drawn(&frame(vec![], vec![], spacing), view);
                drawn(&frame(vec![[0.0; 3]], vec![3.0], spacing), view);
                drawn(&frame(vec![[f64::NAN; 3], [1.0; 3]], vec![f64::NAN, 2.0], spacing), view);
                drawn(&frame(vec![[huge; 3], [-huge; 3]], vec![huge, -huge], spacing), view);
                drawn(&frame(vec![[1e9; 3], [1e9 + 1e-6; 3]], vec![f64::INFINITY; 2], spacing), view);
            }
        }
    }

    #[test]
    fn any_window_range_time_and_array_will_do() {
        let frame = Frame { time: f64::NAN, ..frame(vec![[0.0; 3], [1.0; 3]], vec![1.0, 2.0], 0.5) };
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            let window = Some(Window { min: [0.0; 2], max: [bad; 2] });
            picture(
                &frame,
                &Picture {
                    window,
                    range: Some(Range { ends: [1.0, bad], cut: false }),
                    size: 400,
                    ..Picture::default()
                },
            );
        }
        picture(&frame, &Picture { field: "Nothing".to_string(), size: 0, ..Picture::default() });
    }

    #[test]
    fn colours_follow_the_values_and_grey_means_no_number() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        let image = drawn(&frame(points.clone(), vec![1.0, f64::NAN, 3.0], 1.0), None);
        let map = ColourMap::amounts();
        for colour in [map.at(0.0), map.at(1.0), crate::colours::NO_NUMBER] {
            assert!(shows(&image, colour), "{colour:?}");
        }
        let constant = drawn(&frame(points.clone(), vec![5.0; 3], 1.0), None);
        assert!(shows(&constant, map.at(0.5)));
        let signed = drawn(&frame(points, vec![-2.0, 0.0, 1.0], 1.0), None);
        assert!(shows(&signed, ColourMap::signed().at(0.5)), "zero is in the middle");
    }

    #[test]
    fn the_start_is_pale_and_behind() {
        let mut frame = frame(vec![[0.0; 3], [3.0, 0.0, 0.0]], vec![1.0, 2.0], 1.0);
        frame.arrays.push(Array::vector("Displacement", "m", vec![[-1.5, 0.0, 0.0], [0.0; 3]]));
        let options = Picture { undeformed: true, size: 400, ..Picture::default() };
        let image = picture(&frame, &options);
        assert!(count(&image, PALE) > 500 && shows(&image, ColourMap::amounts().at(1.0)));
        assert!(count(&picture(&frame, &Picture { undeformed: false, ..options }), PALE) < 50);
    }

    #[test]
    fn pictures_of_one_window_have_one_size() {
        let (small, large) =
            (frame(vec![[0.0; 3]], vec![1.0], 0.1), frame(vec![[3.0, 1.0, 0.0]], vec![2.0], 0.1));
        let window = Some(Window::around(&small, None).union(Window::around(&large, None)));
        let options = Picture { window, size: 400, ..Picture::default() };
        let (a, b) = (picture(&small, &options), picture(&large, &options));
        assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        assert_ne!(a, b);
    }
}
