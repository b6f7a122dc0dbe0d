//! Particles as discs or balls, drawn sample by sample with a depth buffer.
//!
//! ```text
//!   particles --bands in parallel--> samples: which particle is in front, and how near
//!   samples ---average of 9 each---> pixels:  its colour in its light, its depth
//!   pixels  ---------------------->  veil:    darker where deep, paler where far (balls only)
//! ```

use rayon::prelude::*;

use crate::colours::{Rgb, shaded};
use crate::image::Image;
use crate::occlusion::{Depths, Veil};

/// Samples per pixel along each side: edges are averaged over 9 samples.
pub(crate) const SAMPLES: usize = 3;

/// How particles look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Finish {
    /// Discs of one colour with a thin darker rim.
    Flat,
    /// Balls in light from the upper left.
    Ball,
}

/// A particle in the picture, lengths in samples: `x` to the right, `y` down, `depth` towards the viewer.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Splat {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) depth: f64,
    pub(crate) radius: f64,
    pub(crate) colour: Rgb,
}

impl Splat {
    /// Whether it can be drawn: what is not a number is not.
    fn is_visible(&self) -> bool {
        [self.x, self.y, self.depth, self.radius].iter().all(|x| x.is_finite()) && self.radius > 0.0
    }

    /// No particle vanishes: its radius is at least that of one pixel.
    fn reach(&self) -> f64 {
        self.radius.max(0.5 * SAMPLES as f64)
    }
}

/// What is seen at a sample: how near, and the number of the particle.
#[derive(Debug, Clone, Copy)]
struct Sample {
    depth: f32,
    splat: u32,
}

const NOTHING: Sample = Sample { depth: f32::NEG_INFINITY, splat: u32::MAX };

/// Pixel rows that are drawn at a time.
const BAND: usize = 16;

/// A picture of particles, [`SAMPLES`] times finer than its pixels while it is made.
pub(crate) struct Canvas {
    /// Width and height, pixels.
    pub(crate) size: [usize; 2],
    pub(crate) finish: Finish,
}

impl Canvas {
    /// The picture of these particles. Where particles overlap, the surface nearer to the viewer shows; for discs in a plane this
    /// cuts both along a straight line.
    pub(crate) fn image(&self, splats: &[Splat]) -> Image {
        let [width, height] = self.size;
        let mut pixels = vec![255; 3 * width * height];
        let mut depth = vec![f32::NEG_INFINITY; width * height];
        let bands = self.bands(splats);
        let rows = pixels.par_chunks_mut(3 * width * BAND).zip(depth.par_chunks_mut(width * BAND)).zip(bands);
        rows.enumerate().for_each(|(band, ((pixels, depth), mine))| {
            let samples = self.samples(band, splats, &mine);
            self.resolve(band, splats, &samples, (pixels, depth));
        });
        if self.finish == Finish::Ball {
            let veils = Depths { width, height, depth }.veils();
            pixels.par_chunks_mut(3).zip(veils).for_each(|(pixel, veil)| veiled(pixel, veil));
        }
        Image::new(width, height, pixels)
    }

    /// The particles that reach into each band of rows.
    fn bands(&self, splats: &[Splat]) -> Vec<Vec<u32>> {
        let rows = (BAND * SAMPLES) as f64;
        let count = self.size[1].div_ceil(BAND);
        let mut bands = vec![Vec::new(); count];
        for (number, splat) in splats.iter().enumerate().filter(|(_, splat)| splat.is_visible()) {
            let [first, last] = [splat.y - splat.reach() - 1.0, splat.y + splat.reach() + 1.0]
                .map(|row| (row / rows).floor().clamp(-1.0, count as f64));
            for band in first.max(0.0) as usize..(last + 1.0).clamp(0.0, count as f64) as usize {
                bands[band].push(number as u32);
            }
        }
        bands
    }

    /// The samples of a band, with the particles `mine` drawn into it.
    fn samples(&self, band: usize, splats: &[Splat], mine: &[u32]) -> Vec<Sample> {
        let (width, top) = (self.size[0] * SAMPLES, band * BAND * SAMPLES);
        let height = (BAND * SAMPLES).min(self.size[1] * SAMPLES - top);
        let mut samples = vec![NOTHING; width * height];
        for &number in mine {
            let splat = &splats[number as usize];
            let (r, y) = (splat.reach(), splat.y - top as f64);
            for row in from(y, r, height)..to(y, r, height) {
                let dy = (row as f64 + 0.5 - y) / r;
                for column in from(splat.x, r, width)..to(splat.x, r, width) {
                    let dx = (column as f64 + 0.5 - splat.x) / r;
                    let inside = 1.0 - dx * dx - dy * dy;
                    let sample = &mut samples[row * width + column];
                    if inside >= 0.0 {
                        let depth = (splat.depth + r * inside.sqrt()) as f32;
                        if depth > sample.depth {
                            *sample = Sample { depth, splat: number };
                        }
                    }
                }
            }
        }
        samples
    }

    /// Averages the samples of each pixel of a band.
    fn resolve(&self, band: usize, splats: &[Splat], samples: &[Sample], out: (&mut [u8], &mut [f32])) {
        let (width, top) = (self.size[0], (band * BAND * SAMPLES) as f64);
        for (place, (pixel, nearest)) in out.0.chunks_exact_mut(3).zip(out.1.iter_mut()).enumerate() {
            let (x, y) = (place % width * SAMPLES, place / width * SAMPLES);
            let mut sum = [0usize; 3];
            for (row, column) in (0..SAMPLES * SAMPLES).map(|k| (y + k / SAMPLES, x + k % SAMPLES)) {
                let sample = samples[row * width * SAMPLES + column];
                *nearest = nearest.max(sample.depth / SAMPLES as f32);
                let at = [column as f64 + 0.5, row as f64 + 0.5 + top];
                let colour =
                    splats.get(sample.splat as usize).map_or([255; 3], |splat| self.finish.colour(splat, at));
                sum.iter_mut().zip(colour).for_each(|(sum, channel)| *sum += usize::from(channel));
            }
            let count = SAMPLES * SAMPLES;
            pixel.copy_from_slice(&sum.map(|total| ((total + count / 2) / count) as u8));
        }
    }
}

/// The first sample of a row or column that a particle at `at` reaches.
fn from(at: f64, r: f64, end: usize) -> usize {
    (at - r - 0.5).ceil().clamp(0.0, end as f64) as usize
}

/// The one after the last.
fn to(at: f64, r: f64, end: usize) -> usize {
    (at + r + 0.5).floor().clamp(0.0, end as f64) as usize
}

fn veiled(pixel: &mut [u8], veil: Veil) {
    for channel in pixel {
        let lit = f64::from(*channel) * veil.light;
        *channel = (lit + (255.0 - lit) * veil.haze).round() as u8;
    }
}

impl Finish {
    /// The colour of a particle at a sample.
    fn colour(self, splat: &Splat, at: [f64; 2]) -> Rgb {
        let r = splat.reach();
        let [dx, dy] = [(at[0] - splat.x) / r, (at[1] - splat.y) / r];
        let from_centre = dx * dx + dy * dy;
        match self {
            Self::Flat => {
                // A rim of one pixel at most; none on particles too small to show it.
                let rim = (SAMPLES as f64).min(0.22 * r);
                let outside = from_centre > (1.0 - rim / r).powi(2);
                if outside && r > 3.0 * SAMPLES as f64 { shaded(splat.colour, 0.62) } else { splat.colour }
            }
            Self::Ball => {
                const LIGHT: [f64; 3] = [-0.37, -0.56, 0.74];
                let towards = (1.0 - from_centre).max(0.0).sqrt();
                let facing = dx * LIGHT[0] + dy * LIGHT[1] + towards * LIGHT[2];
                shaded(splat.colour, 0.55 + 0.52 * facing.max(0.0))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = [200, 0, 0];
    const BLUE: Rgb = [0, 0, 200];
    const FLAT: Canvas = Canvas { size: [20, 40], finish: Finish::Flat };

    fn splat(x: f64, depth: f64, colour: Rgb) -> Splat {
        Splat { x, y: 30.0, depth, radius: 15.0, colour }
    }

    #[test]
    fn a_disc_has_its_area_and_its_colour() {
        let splats = [Splat { y: 48.0, ..splat(30.0, 0.0, RED) }];
        // It reaches into two bands.
        let bands = FLAT.bands(&splats);
        assert_eq!(bands, [vec![0], vec![0], vec![]]);
        let samples: Vec<Sample> =
            (0..3).flat_map(|band| FLAT.samples(band, &splats, &bands[band])).collect();
        let painted = samples.iter().filter(|sample| sample.depth.is_finite()).count();
        let area = std::f64::consts::PI * 15.0 * 15.0;
        // Counting samples errs by about one sample in ten along the edge (94 samples long).
        assert!((painted as f64 - area).abs() < 10.0, "{painted} of {area}");
        let image = FLAT.image(&splats);
        assert_eq!((image.get(10, 16), image.get(0, 0)), (RED, [255; 3]));
    }

    #[test]
    fn the_nearer_particle_shows_whatever_the_order() {
        for order in [[0, 1], [1, 0]] {
            let splats = [splat(30.0, 0.0, RED), splat(33.0, 40.0, BLUE)];
            assert_eq!(FLAT.image(&order.map(|i| splats[i])).get(10, 10), BLUE);
        }
    }

    #[test]
    fn particles_beside_the_canvas_or_without_numbers_change_nothing() {
        let mut splats: Vec<Splat> =
            [-100.0, 1e300, -1e300, f64::NAN, f64::INFINITY].map(|x| splat(x, 0.0, RED)).to_vec();
        splats.extend([-100.0, 1e300, -1e300, f64::NAN].map(|y| Splat { y, ..splat(30.0, 0.0, RED) }));
        splats.push(splat(30.0, f64::NAN, RED));
        splats.push(Splat { radius: -1.0, ..splat(30.0, 0.0, RED) });
        for finish in [Finish::Flat, Finish::Ball] {
            assert_eq!(Canvas { finish, ..FLAT }.image(&splats), Image::white(20, 40));
        }
    }
}
