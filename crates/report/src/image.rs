//! An image in memory, text on it, and PNG files.

use std::path::Path;

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use crate::ReportError;
use crate::colours::Rgb;
use crate::palette::{MOST, Palette};

/// An image of 8-bit sRGB pixels, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Image {
    /// An image of these pixels.
    pub(crate) fn new(width: usize, height: usize, pixels: Vec<u8>) -> Self {
        debug_assert_eq!(pixels.len(), 3 * width * height);
        Self { width, height, pixels }
    }

    /// A white image.
    pub(crate) fn white(width: usize, height: usize) -> Self {
        Self::new(width, height, vec![255; 3 * width * height])
    }

    /// Pixels from left to right.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels from top to bottom.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green, blue of each pixel, row by row from the top left.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    pub(crate) fn get(&self, x: usize, y: usize) -> Rgb {
        let at = 3 * (y * self.width + x);
        [self.pixels[at], self.pixels[at + 1], self.pixels[at + 2]]
    }

    /// Sets a pixel; one outside the image is ignored.
    pub(crate) fn set(&mut self, x: usize, y: usize, colour: Rgb) {
        if x < self.width && y < self.height {
            let at = 3 * (y * self.width + x);
            self.pixels[at..at + 3].copy_from_slice(&colour);
        }
    }

    /// Fills `width` x `height` pixels from the top left corner `at`.
    pub(crate) fn fill(&mut self, at: [usize; 2], [width, height]: [usize; 2], colour: Rgb) {
        for y in at[1]..at[1] + height {
            for x in at[0]..at[0] + width {
                self.set(x, y, colour);
            }
        }
    }

    /// Copies `other` into this image, its top left corner at `at`.
    pub(crate) fn paste(&mut self, at: [usize; 2], other: &Self) {
        for y in 0..other.height {
            for x in 0..other.width {
                self.set(at[0] + x, at[1] + y, other.get(x, y));
            }
        }
    }

    /// Writes a line of text, its top left corner at `at`.
    pub(crate) fn text(&mut self, at: [usize; 2], text: &str, font: Font, colour: Rgb) {
        for (index, c) in text.chars().enumerate() {
            let Some(glyph) = font.glyph(c) else { continue };
            for (y, row) in glyph.rows().enumerate() {
                for (x, &ink) in row.iter().enumerate() {
                    self.blend(at[0] + index * font.width() + x, at[1] + y, colour, ink);
                }
            }
        }
    }

    /// Draws a line, two pixels wide, from one point to another (pixels, from the top left).
    pub(crate) fn line(&mut self, [from, to]: [[f64; 2]; 2], colour: Rgb) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-9);
        let bounds = |k: usize| {
            (from[k].min(to[k]) - 2.0).max(0.0) as usize..(from[k].max(to[k]) + 3.0).max(0.0) as usize
        };
        for (x, y) in bounds(1).flat_map(|y| bounds(0).map(move |x| (x, y))) {
            let [dx, dy] = [x as f64 + 0.5 - from[0], y as f64 + 0.5 - from[1]];
            let nearest = ((dx * along[0] + dy * along[1]) / square).clamp(0.0, 1.0);
            let far = (dx - nearest * along[0]).hypot(dy - nearest * along[1]);
            self.blend(x, y, colour, ((1.5 - far).clamp(0.0, 1.0) * 255.0) as u8);
        }
    }

    fn blend(&mut self, x: usize, y: usize, colour: Rgb, ink: u8) {
        if ink == 0 || x >= self.width || y >= self.height {
            return;
        }
        let (ink, below) = (u32::from(ink), self.get(x, y));
        let mix = |i: usize| (u32::from(colour[i]) * ink + u32::from(below[i]) * (255 - ink)) / 255;
        self.set(x, y, [0, 1, 2].map(|i| mix(i) as u8));
    }
}

/// Noto Sans Mono in two sizes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Font {
    /// 20 pixels high.
    Small,
    /// 24 pixels high.
    Large,
}

impl Font {
    fn raster(self) -> RasterHeight {
        match self {
            Self::Small => RasterHeight::Size20,
            Self::Large => RasterHeight::Size24,
        }
    }

    fn glyph(self, c: char) -> Option<noto_sans_mono_bitmap::RasterizedChar> {
        let known = |c| get_raster(c, FontWeight::Regular, self.raster());
        known(c).or_else(|| known('?'))
    }

    /// Width of a character, pixels.
    pub(crate) fn width(self) -> usize {
        get_raster_width(FontWeight::Regular, self.raster())
    }

    /// Height of a line, pixels.
    pub(crate) fn height(self) -> usize {
        self.raster().val()
    }

    /// Width of `text`, pixels.
    pub(crate) fn measure(self, text: &str) -> usize {
        text.chars().count() * self.width()
    }

    /// `text`, cut with an ellipsis if it is wider than `width` pixels.
    pub(crate) fn fit(self, text: &str, width: usize) -> String {
        if self.measure(text) <= width {
            return text.to_string();
        }
        let kept = (width / self.width()).saturating_sub(3);
        text.chars().take(kept).chain("...".chars()).collect()
    }
}

/// Writes `image` as a PNG file of at most 256 colours, in one step.
///
/// # Errors
/// [`ReportError::Write`] if the file cannot be written.
pub fn write_png(image: &Image, path: &Path) -> Result<(), ReportError> {
    let bytes = encoded(image)
        .map_err(|cause| ReportError::Draw { what: path.display().to_string(), cause: cause.to_string() })?;
    Ok(output::write_atomically(path, &bytes)?)
}

/// The bytes of the PNG file that [`write_png`] writes.
///
/// # Errors
/// What the encoder says, for an image without pixels.
pub fn encoded(image: &Image) -> Result<Vec<u8>, png::EncodingError> {
    let mut palette = Palette::new([image.pixels()], MOST);
    let indices = palette.indices(&image.pixels);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width as u32, image.height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.colours);
    encoder.set_compression(png::Compression::High);
    // Differences of palette numbers mean nothing.
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_file_comes_back() {
        let mut image = Image::white(40, 30);
        image.fill([5, 5], [10, 40], [10, 20, 200]);
        image.text([0, 0], "A", Font::Large, [0; 3]);
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a.png");
        write_png(&image, &path).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(std::fs::read(&path).unwrap()));
        reader.set_transformations(png::Transformations::EXPAND);
        let mut reader = reader.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (40, 30));
        let far = pixels.iter().zip(image.pixels()).map(|(a, b)| a.abs_diff(*b)).max();
        // Greys of the letter may share a colour within 6 bits: 4 of 256.
        assert!(far < Some(4), "{far:?}");
    }

    #[test]
    fn text_is_ink_and_stays_inside() {
        let mut image = Image::white(30, 30);
        image.text([0, 0], "\u{3bb}W", Font::Large, [0; 3]);
        image.text([1000, 1000], "outside", Font::Small, [0; 3]);
        assert!(image.pixels().iter().any(|&channel| channel < 50));
        assert_eq!(Font::Small.fit("a long line of text", Font::Small.width() * 8), "a lon...");
    }

    #[test]
    fn a_folder_that_is_missing_is_an_error_with_a_hint() {
        let error = write_png(&Image::white(1, 1), Path::new("/nowhere/a.png")).unwrap_err();
        assert!(error.to_string().contains("a.png") && !error.hint().is_empty());
    }
}
