//! Particles as discs or balls, drawn sample by sample with a depth buffer.

use crate::colours::{Rgb, shaded};
use crate::image::Image;

/// Samples per pixel along each side: edges are averaged over 9 samples.
pub(crate) const SAMPLES: usize = 3;

/// How a particle looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Finish {
    /// A disc of one colour with a thin darker rim.
    Flat,
    /// A ball in light from the upper left.
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
    fn is_finite(&self) -> bool {
        [self.x, self.y, self.depth, self.radius].iter().all(|x| x.is_finite())
    }
}

/// A picture in the making, [`SAMPLES`] times finer than the image.
pub(crate) struct Canvas {
    width: usize,
    height: usize,
    depth: Vec<f32>,
    colour: Vec<Rgb>,
}

impl Canvas {
    /// A white canvas for an image of `width` x `height` pixels.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let (width, height) = (width * SAMPLES, height * SAMPLES);
        let n = width * height;
        Self { width, height, depth: vec![f32::NEG_INFINITY; n], colour: vec![[255; 3]; n] }
    }

    /// Draws a particle. Where particles overlap, the surface nearer to the viewer shows; for discs in a
    /// plane this cuts both along a straight line. What is not a number is not drawn.
    pub(crate) fn draw(&mut self, splat: &Splat, finish: Finish) {
        if !splat.is_finite() || splat.radius <= 0.0 {
            return;
        }
        // No particle vanishes: its radius is at least that of one pixel.
        let r = splat.radius.max(0.5 * SAMPLES as f64);
        let from = |at: f64, end: usize| (at - r - 0.5).ceil().clamp(0.0, end as f64) as usize;
        let to = |at: f64, end: usize| (at + r + 0.5).floor().clamp(0.0, end as f64) as usize;
        for row in from(splat.y, self.height)..to(splat.y, self.height) {
            let dy = (row as f64 + 0.5 - splat.y) / r;
            for column in from(splat.x, self.width)..to(splat.x, self.width) {
                let dx = (column as f64 + 0.5 - splat.x) / r;
                let inside = 1.0 - dx * dx - dy * dy;
                if inside < 0.0 {
                    continue;
                }
                let height = inside.sqrt();
                let depth = (splat.depth + r * height) as f32;
                let at = row * self.width + column;
                if depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.colour[at] = finish.colour(splat.colour, [dx, dy, height], r);
                }
            }
        }
    }

    /// Averages the samples of each pixel.
    pub(crate) fn image(&self) -> Image {
        let mut image = Image::white(self.width / SAMPLES, self.height / SAMPLES);
        for y in 0..image.height() {
            for x in 0..image.width() {
                image.set(x, y, self.average(x, y));
            }
        }
        image
    }

    fn average(&self, x: usize, y: usize) -> Rgb {
        let mut sum = [0usize; 3];
        for row in y * SAMPLES..(y + 1) * SAMPLES {
            let start = row * self.width + x * SAMPLES;
            for sample in &self.colour[start..start + SAMPLES] {
                for (total, &channel) in sum.iter_mut().zip(sample) {
                    *total += usize::from(channel);
                }
            }
        }
        let count = SAMPLES * SAMPLES;
        sum.map(|total| ((total + count / 2) / count) as u8)
    }
}

impl Finish {
    /// The colour at `normal` (right, down, towards the viewer; length 1) of a particle of radius `r`.
    fn colour(self, colour: Rgb, normal: [f64; 3], r: f64) -> Rgb {
        match self {
            Self::Flat => {
                // A rim of one pixel at most; none on particles too small to show it.
                let rim = (SAMPLES as f64).min(0.22 * r);
                let edge = (1.0 - rim / r).powi(2);
                let outside = 1.0 - normal[2] * normal[2] > edge;
                if outside && r > 3.0 * SAMPLES as f64 { shaded(colour, 0.62) } else { colour }
            }
            Self::Ball => {
                const LIGHT: [f64; 3] = [-0.37, -0.56, 0.74];
                let facing = normal[0] * LIGHT[0] + normal[1] * LIGHT[1] + normal[2] * LIGHT[2];
                shaded(colour, 0.48 + 0.57 * facing.max(0.0))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = [200, 0, 0];
    const BLUE: Rgb = [0, 0, 200];

    fn splat(x: f64, depth: f64, colour: Rgb) -> Splat {
        Splat { x, y: 30.0, depth, radius: 15.0, colour }
    }

    fn painted(canvas: &Canvas) -> usize {
        canvas.depth.iter().filter(|depth| depth.is_finite()).count()
    }

    #[test]
    fn a_disc_has_its_area_and_its_colour() {
        let mut canvas = Canvas::new(20, 20);
        canvas.draw(&splat(30.0, 0.0, RED), Finish::Flat);
        let area = std::f64::consts::PI * 15.0 * 15.0;
        // Counting samples errs by about one sample in ten along the edge (94 samples long).
        assert!((painted(&canvas) as f64 - area).abs() < 10.0, "{} of {area}", painted(&canvas));
        assert_eq!(canvas.image().get(10, 10), RED);
        assert_eq!(canvas.image().get(0, 0), [255; 3]);
    }

    #[test]
    fn the_nearer_particle_shows_whatever_the_order() {
        for order in [[0, 1], [1, 0]] {
            let splats = [splat(30.0, 0.0, RED), splat(33.0, 40.0, BLUE)];
            let mut canvas = Canvas::new(20, 20);
            for i in order {
                canvas.draw(&splats[i], Finish::Flat);
            }
            assert_eq!(canvas.image().get(10, 10), BLUE);
        }
    }

    #[test]
    fn particles_beside_the_canvas_or_without_numbers_change_nothing() {
        let mut canvas = Canvas::new(20, 20);
        for x in [-100.0, 1e300, -1e300, f64::NAN, f64::INFINITY] {
            canvas.draw(&splat(x, 0.0, RED), Finish::Ball);
        }
        canvas.draw(&splat(30.0, f64::NAN, RED), Finish::Ball);
        canvas.draw(&Splat { radius: -1.0, ..splat(30.0, 0.0, RED) }, Finish::Flat);
        assert_eq!(painted(&canvas), 0);
    }
}
