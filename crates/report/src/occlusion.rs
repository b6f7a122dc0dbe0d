//! Depth made visible: what lies behind its surroundings is darker, as far as daylight is kept from it.
//!
//! Each pixel is compared with the mean depth around it (Luft, Colditz, Deussen 2006, "Image enhancement by unsharp masking the
//! depth buffer"): creases, and what is just behind the rim of something in front, get less light. A little haze tells the far side
//! from the near one.

/// Darkening where a pixel lies deeper than its surroundings by their radius.
const SHADE: f64 = 0.55;
/// Largest darkening.
const MOST: f64 = 0.4;
/// Share of white in what is furthest away.
const HAZE: f64 = 0.16;

/// Depths of the pixels of a picture, in pixels towards the viewer; `NEG_INFINITY` where there is nothing.
pub(crate) struct Depths {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) depth: Vec<f32>,
}

/// What depth does to the light of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Veil {
    /// Factor of the colour, at most 1.
    pub(crate) light: f64,
    /// Share of white.
    pub(crate) haze: f64,
}

impl Depths {
    /// The veil of every pixel.
    pub(crate) fn veils(&self) -> Vec<Veil> {
        let radius = (self.width.max(self.height) / 80).max(2);
        let mean = self.blurred(radius);
        let finite = || self.depth.iter().copied().filter(|depth| depth.is_finite());
        let (near, far) =
            (finite().fold(f32::NEG_INFINITY, f32::max), finite().fold(f32::INFINITY, f32::min));
        let extent = f64::from(near - far).max(1.0);
        let veil = |(&depth, &mean): (&f32, &f32)| {
            if !depth.is_finite() {
                return Veil { light: 1.0, haze: 0.0 };
            }
            let behind = f64::from(mean - depth).max(0.0) / radius as f64;
            let haze = HAZE * f64::from(near - depth) / extent;
            Veil { light: 1.0 - (SHADE * behind).min(MOST), haze: if haze.is_finite() { haze } else { 0.0 } }
        };
        self.depth.iter().zip(&mean).map(veil).collect()
    }

    /// Mean depth within `radius` pixels along both axes, of what there is.
    fn blurred(&self, radius: usize) -> Vec<f32> {
        let known = |depth: &f32| if depth.is_finite() { [*depth, 1.0] } else { [0.0, 0.0] };
        let mut sums: Vec<[f32; 2]> = self.depth.iter().map(known).collect();
        for row in sums.chunks_mut(self.width.max(1)) {
            let line: Vec<[f32; 2]> = row.to_vec();
            slide(&line, radius, |i, sum| row[i] = sum);
        }
        let mut line = vec![[0.0; 2]; self.height];
        for column in 0..self.width {
            for (row, value) in line.iter_mut().enumerate() {
                *value = sums[row * self.width + column];
            }
            slide(&line, radius, |row, sum| sums[row * self.width + column] = sum);
        }
        sums.iter().map(|[sum, count]| sum / count).collect()
    }
}

/// Sums over the `radius` values to either side of each.
fn slide(line: &[[f32; 2]], radius: usize, mut put: impl FnMut(usize, [f32; 2])) {
    let mut sum = [0f64; 2];
    let add = |sum: &mut [f64; 2], i: usize, sign: f64| {
        (0..2).for_each(|k| sum[k] += sign * f64::from(line[i][k]));
    };
    (0..radius.min(line.len())).for_each(|i| add(&mut sum, i, 1.0));
    for i in 0..line.len() {
        if i + radius < line.len() {
            add(&mut sum, i + radius, 1.0);
        }
        if i > radius {
            add(&mut sum, i - radius - 1, -1.0);
        }
        put(i, sum.map(|s| s as f32));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_keeps_its_light_and_a_pit_loses_some() {
        let (width, height) = (80, 60);
        let slope = |i: usize| (i % width) as f32;
        let mut depths = Depths { width, height, depth: (0..width * height).map(slope).collect() };
        let middle = 30 * width + 40;
        assert!((depths.veils()[middle].light - 1.0).abs() < 1e-6);
        depths.depth[middle] -= 10.0;
        let veils = depths.veils();
        assert!(veils[middle].light < 0.7);
        // Nearer (to the right): less haze.
        assert!(veils[60].haze < veils[20].haze && veils[0].haze <= HAZE);
    }

    #[test]
    fn nothing_and_wreckage_have_no_veil_that_is_no_number() {
        for value in [f32::NEG_INFINITY, f32::NAN, 1e38, -1e38] {
            let mut depth = vec![f32::NEG_INFINITY; 12];
            depth[5] = value;
            depth[6] = 1.0;
            for veil in (Depths { width: 4, height: 3, depth }).veils() {
                assert!(veil.light.is_finite() && veil.haze.is_finite());
            }
        }
    }
}
