//! Where title, particles, colour bar and scale bar stand in a picture, in pixels.

use crate::image::Font;

/// A rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    /// Top left corner.
    pub(crate) at: [usize; 2],
    /// Width and height.
    pub(crate) size: [usize; 2],
}

/// Air around everything.
pub(crate) const MARGIN: usize = 24;
/// Air between things that belong together.
pub(crate) const GAP: usize = 8;
/// Thickness of the colour bar.
const BAR: usize = 20;
/// Width of the column that holds an upright colour bar and its labels.
const COLUMN: usize = 252;
/// Particles get at least this height (wide pictures) or width (tall ones).
const LEAST: usize = 140;

/// The parts of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layout {
    /// Width and height of the image.
    pub(crate) image: [usize; 2],
    /// Where the particles are.
    pub(crate) plot: Rect,
    /// The colour bar, without its labels.
    pub(crate) bar: Rect,
    /// The line of the scale bar.
    pub(crate) ruler: Rect,
    /// Whether the colour bar stands upright beside the particles instead of lying below them.
    pub(crate) upright: bool,
}

impl Layout {
    /// For a window of this shape (width over height) in an image whose longest side is about `size`.
    pub(crate) fn new(aspect: f64, size: usize) -> Self {
        let size = size.clamp(400, 4000);
        let top = MARGIN + Font::Large.height() + Font::Small.height() + 2 * GAP;
        if aspect >= 1.2 { Self::wide(aspect, size, top) } else { Self::tall(aspect, size, top) }
    }

    fn wide(aspect: f64, size: usize, top: usize) -> Self {
        let width = size - 2 * MARGIN;
        let height = ((width as f64 / aspect) as usize).clamp(LEAST, size);
        let caption = top + height + GAP;
        let bar_width = width * 11 / 20;
        let bar_top = caption + Font::Small.height() + GAP / 2;
        let labels = bar_top + BAR + GAP / 2 + Font::Small.height();
        Self {
            image: [size, labels + MARGIN / 2],
            plot: Rect { at: [MARGIN, top], size: [width, height] },
            bar: Rect { at: [size - MARGIN - bar_width, bar_top], size: [bar_width, BAR] },
            ruler: Rect { at: [MARGIN, bar_top], size: [width / 4, BAR] },
            upright: false,
        }
    }

    fn tall(aspect: f64, size: usize, top: usize) -> Self {
        let height = size * 4 / 5;
        let width = ((height as f64 * aspect) as usize).clamp(LEAST, size);
        let bar_left = MARGIN + width + MARGIN;
        let bar_top = top + 3 * Font::Small.height();
        let ruler = Rect { at: [MARGIN, top + height + GAP], size: [width / 2, BAR] };
        Self {
            image: [bar_left + COLUMN, ruler.at[1] + BAR + MARGIN],
            plot: Rect { at: [MARGIN, top], size: [width, height] },
            bar: Rect { at: [bar_left, bar_top], size: [BAR, height * 3 / 5] },
            ruler,
            upright: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_inside_the_image() {
        for aspect in [0.0, 1e-9, 0.2, 1.0, 1.3, 20.0, 1e9, f64::INFINITY, f64::NAN] {
            for size in [0, 600, 1200, 1_000_000] {
                let layout = Layout::new(aspect, size);
                for part in [layout.plot, layout.bar, layout.ruler] {
                    for side in 0..2 {
                        assert!(part.size[side] > 0);
                        assert!(part.at[side] + part.size[side] <= layout.image[side], "{aspect}: {part:?}");
                    }
                }
            }
        }
    }
}
