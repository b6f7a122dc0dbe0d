//! What stands around the particles: title, colour bar, scale bar.

use crate::colours::{ColourMap, Rgb};
use crate::image::{Font, Image};
use crate::layout::{GAP, Layout, MARGIN, Rect};
use crate::scale::{Scale, quantity};

pub(crate) const INK: Rgb = [25, 25, 25];
pub(crate) const GREY: Rgb = [110, 110, 110];

/// The title and a smaller line below it, `room` pixels wide at most.
pub(crate) fn header(image: &mut Image, [title, below]: [&str; 2], room: usize) {
    image.text([MARGIN, MARGIN / 2 + GAP], &Font::Large.fit(title, room), Font::Large, INK);
    let line = [MARGIN, MARGIN / 2 + GAP + Font::Large.height() + GAP / 2];
    image.text(line, &Font::Small.fit(below, room), Font::Small, GREY);
}

/// What the colours mean.
pub(crate) struct Colours<'a> {
    /// Name of the quantity.
    pub(crate) name: &'a str,
    /// Its SI unit.
    pub(crate) unit: &'a str,
    /// Values at the ends of the bar.
    pub(crate) range: [f64; 2],
    /// What the ends are, if not simply the least and the greatest value: words of one line or two.
    pub(crate) note: &'a [&'a str],
}

/// Steps between ticks of the colour bar, about.
const STEPS: f64 = 5.0;

impl Colours<'_> {
    /// Draws the bar with its caption and ticks.
    pub(crate) fn draw(&self, image: &mut Image, layout: &Layout, map: &ColourMap) {
        let [low, high] = self.range;
        let scale = Scale::new(low.abs().max(high.abs()), self.unit);
        self.gradient(image, layout, map);
        self.caption(image, layout, &scale);
        if high <= low {
            label(image, layout, 0.5, &scale.label(low, 0.0));
            return;
        }
        let step = round_step((high - low) / STEPS);
        for value in ticks(low, high, step) {
            label(image, layout, (value - low) / (high - low), &scale.label(value, step));
        }
    }

    fn gradient(&self, image: &mut Image, layout: &Layout, map: &ColourMap) {
        let Rect { at, size } = layout.bar;
        let length = if layout.upright { size[1] } else { size[0] };
        for i in 0..length {
            let colour = map.at((i as f64 + 0.5) / length as f64);
            if layout.upright {
                image.fill([at[0], at[1] + length - 1 - i], [size[0], 1], colour);
            } else {
                image.fill([at[0] + i, at[1]], [1, size[1]], colour);
            }
        }
    }

    fn caption(&self, image: &mut Image, layout: &Layout, scale: &Scale) {
        let Rect { at, size } = layout.bar;
        let line = Font::Small.height();
        if layout.upright {
            let width = image.width() - at[0] - GAP;
            for (above, text) in [(3, self.name), (2, scale.brackets().trim())] {
                image.text([at[0], at[1] - above * line], &Font::Small.fit(text, width), Font::Small, INK);
            }
            let below = at[1] + size[1] + line;
            for (index, part) in self.note.iter().enumerate() {
                image.text([at[0], below + index * line], part, Font::Small, GREY);
            }
            return;
        }
        let text = format!("{}{}", self.name, scale.brackets());
        let at = [at[0], at[1] - line - GAP / 2];
        image.text(at, &Font::Small.fit(&text, size[0]), Font::Small, INK);
        let note = self.note.join(" ");
        let width = Font::Small.measure(&note);
        if Font::Small.measure(&text) + width + 2 * GAP <= size[0] {
            image.text([at[0] + size[0] - width, at[1]], &note, Font::Small, GREY);
        }
    }
}

/// The multiples of `step` from `low` to `high`.
fn ticks(low: f64, high: f64, step: f64) -> Vec<f64> {
    // A hair of air, so that an end which is a multiple counts as one in spite of rounding.
    let [first, last] = [(low / step - 1e-6).ceil(), (high / step + 1e-6).floor()];
    let count =
        if first.is_finite() && last >= first { (last - first).min(4.0 * STEPS) as usize + 1 } else { 0 };
    (0..count).map(|k| ((first + k as f64) * step).clamp(low, high)).collect()
}

/// The number of the form 1, 2, 2.5, 5 times a power of ten that is next to `step`.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let lead = step / power;
    let nearest =
        [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().min_by(|a, b| (a - lead).abs().total_cmp(&(b - lead).abs()));
    nearest.unwrap_or(1.0) * power
}

/// A tick and its number at `along` (0 to 1) of the bar.
fn label(image: &mut Image, layout: &Layout, along: f64, text: &str) {
    let Rect { at, size } = layout.bar;
    let font = Font::Small;
    if layout.upright {
        let y = at[1] + ((1.0 - along) * (size[1] - 1) as f64) as usize;
        image.fill([at[0] + size[0], y], [GAP, 1], INK);
        image.text([at[0] + size[0] + 2 * GAP, y.saturating_sub(font.height() / 2)], text, font, INK);
        return;
    }
    let x = at[0] + (along * (size[0] - 1) as f64) as usize;
    image.fill([x, at[1] + size[1]], [1, GAP / 2], INK);
    let half = font.measure(text) / 2;
    let last = (image.width() - GAP).saturating_sub(2 * half);
    image.text([x.saturating_sub(half).min(last), at[1] + size[1] + GAP / 2 + 1], text, font, INK);
}

/// Width of the corner that the tripod takes from the header, pixels.
pub(crate) const TRIPOD: usize = 120;

/// The axes of the world, as they are seen, in the upper right corner.
pub(crate) fn tripod(image: &mut Image, axes: &[[f64; 3]; 3]) {
    const LENGTH: f64 = 28.0;
    let foot = [(image.width() - MARGIN) as f64 - 50.0, 54.0];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let seen = [axes[0][axis] * LENGTH, -axes[1][axis] * LENGTH];
        image.line([foot, [foot[0] + seen[0], foot[1] + seen[1]]], GREY);
        let label = [0, 1].map(|k| foot[k] + 1.3 * seen[k]);
        let corner =
            [label[0] - 0.5 * Font::Small.width() as f64, label[1] - 0.5 * Font::Small.height() as f64];
        image.text(corner.map(|x| x.max(0.0) as usize), name, Font::Small, GREY);
    }
}

/// A line of a round length and that length beside it. `per_pixel` is the length of a pixel, m.
pub(crate) fn ruler(image: &mut Image, layout: &Layout, per_pixel: f64) {
    let Rect { at, size } = layout.ruler;
    let length = round_below(per_pixel * size[0] as f64);
    let pixels = (length / per_pixel).round();
    if !(pixels >= 1.0 && pixels <= size[0] as f64) {
        return;
    }
    let (width, middle) = (pixels as usize, at[1] + size[1] / 2);
    image.fill([at[0], middle - 1], [width, 2], INK);
    for end in [at[0], at[0] + width - 2] {
        image.fill([end, middle - 6], [2, 12], INK);
    }
    image.text([at[0] + width + GAP, at[1]], &quantity(length, "m"), Font::Small, INK);
}

/// The largest of 1, 2, 5 times a power of ten that is at most `length`.
fn round_below(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    // A hair above, so that 5 counts as 5 in spite of rounding.
    let lead = length / power * (1.0 + 1e-9);
    let lead = if lead >= 5.0 {
        5.0
    } else if lead >= 2.0 {
        2.0
    } else {
        1.0
    };
    lead * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.02, 1.47, round_step(1.45 / STEPS)), [0.25, 0.5, 0.75, 1.0, 1.25]);
        assert_eq!(ticks(-3.0, 3.0, round_step(6.0 / STEPS)), [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0]);
        for (low, high) in [(0.0, f64::MAX), (-f64::MAX, f64::MAX), (1.0, 1.0 + f64::EPSILON), (0.0, 5e-324)]
        {
            assert!(ticks(low, high, round_step((high - low) / STEPS)).len() < 30);
        }
    }

    #[test]
    fn rulers_are_round() {
        for (length, expected) in [(0.013, 0.01), (0.5, 0.5), (49.0, 20.0), (1000.0, 1000.0)] {
            // Powers of ten round.
            assert!((round_below(length) / expected - 1.0).abs() < 1e-12, "{length}");
        }
    }

    #[test]
    fn rulers_of_impossible_scales_are_left_out() {
        let layout = Layout::new(2.0, 600);
        for per_pixel in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut image = Image::white(600, 500);
            ruler(&mut image, &layout, per_pixel);
            assert_eq!(image, Image::white(600, 500));
        }
    }
}
