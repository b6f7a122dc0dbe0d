//! The colour maps: from dark blue over green to light yellow for amounts, from blue over light grey to orange for what has a sign;
//! both even to the eye.
//!
//! They are paths through the OKLCh colour space (Ottosson 2020, <https://bottosson.github.io/posts/oklab/>):
//! lightness changes evenly with the value (with its size, where it has a sign), so equal differences of the value look equally different, also
//! in grey and to most colour-blind readers.

/// Red, green and blue, 0 to 255, sRGB.
pub(crate) type Rgb = [u8; 3];

/// The colour of a value that is no number.
pub(crate) const NO_NUMBER: Rgb = [190, 190, 190];

/// Colours for 0 to 1 in equal steps.
pub(crate) struct ColourMap {
    table: Vec<Rgb>,
}

impl ColourMap {
    /// The map for amounts, in 256 steps.
    pub(crate) fn amounts() -> Self {
        Self::along(amount)
    }

    /// The map for what has a sign: zero is in the middle.
    pub(crate) fn signed() -> Self {
        Self::along(sign)
    }

    /// The map that fits values between these ends.
    pub(crate) fn of_range([low, high]: [f64; 2]) -> Self {
        if low == -high && high > 0.0 { Self::signed() } else { Self::amounts() }
    }

    fn along(path: fn(f64) -> [f64; 3]) -> Self {
        Self { table: (0..256).map(|i| to_srgb(to_linear(path(f64::from(i) / 255.0)))).collect() }
    }

    /// The colour at `t`; outside 0 to 1 that of the nearer end.
    pub(crate) fn at(&self, t: f64) -> Rgb {
        if t.is_nan() {
            return NO_NUMBER;
        }
        self.table[(t.clamp(0.0, 1.0) * 255.0).round() as usize]
    }
}

/// The point of the path of blue and orange at `t`, in OKLab: two hues that all readers tell apart.
fn sign(t: f64) -> [f64; 3] {
    let size = (2.0 * t - 1.0).abs();
    let hue = if t < 0.5 { 255f64 } else { 50.0 }.to_radians();
    // As colourful as sRGB allows in either hue, so that both sides weigh the same.
    let chroma = (0.35 * size).min(0.19 - 0.09 * size);
    [0.88 - 0.48 * size, chroma * hue.cos(), chroma * hue.sin()]
}

/// The point of the path of amounts at `t`, in OKLab.
fn amount(t: f64) -> [f64; 3] {
    let lightness = 0.34 + 0.58 * t;
    let hue = (285.0 - 182.0 * t).to_radians();
    // About as colourful as sRGB allows along this path; the blue-green middle allows least.
    let chroma = 0.13 - 0.19 * t + 0.24 * t * t;
    [lightness, chroma * hue.cos(), chroma * hue.sin()]
}

/// Linear light to 8-bit sRGB; colours outside are cut off.
fn to_srgb(linear: [f64; 3]) -> Rgb {
    linear.map(|linear| (encode(linear.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

/// OKLab to the linear light of the sRGB primaries.
fn to_linear([l, a, b]: [f64; 3]) -> [f64; 3] {
    let cones = [
        (l + 0.3963377774 * a + 0.2158037573 * b).powi(3),
        (l - 0.1055613458 * a - 0.0638541728 * b).powi(3),
        (l - 0.0894841775 * a - 1.2914855480 * b).powi(3),
    ];
    let mix = |m: [f64; 3]| m[0] * cones[0] + m[1] * cones[1] + m[2] * cones[2];
    [
        mix([4.0767416621, -3.3077115913, 0.2309699292]),
        mix([-1.2684380046, 2.6097574011, -0.3413193965]),
        mix([-0.0041960863, -0.7034186147, 1.7076147010]),
    ]
}

/// Linear light to sRGB (IEC 61966-2-1).
fn encode(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// `colour` times `factor`, for light and shade.
pub(crate) fn shaded(colour: Rgb, factor: f64) -> Rgb {
    colour.map(|channel| (f64::from(channel) * factor).round().clamp(0.0, 255.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of an sRGB colour.
    fn luminance(colour: Rgb) -> f64 {
        let linear = colour.map(|channel| {
            let c = f64::from(channel) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    #[test]
    fn white_grey_and_black_are_what_they_are() {
        assert_eq!(to_srgb(to_linear([1.0, 0.0, 0.0])), [255; 3]);
        assert_eq!(to_srgb(to_linear([0.0, 0.0, 0.0])), [0; 3]);
    }

    #[test]
    fn no_colour_of_the_maps_is_cut_off() {
        for (path, i) in [amount, sign].into_iter().flat_map(|path| (0..256).map(move |i| (path, i))) {
            let linear = to_linear(path(f64::from(i) / 255.0));
            assert!(linear.iter().all(|x| (0.0..=1.0).contains(x)), "{i}: {linear:?}");
        }
    }

    #[test]
    fn both_signs_are_equally_dark() {
        // 8-bit colours round by up to 0.4 of CIE lightness; OKLab and CIE disagree between hues by about 5.
        let map = ColourMap::signed();
        for i in 0..=8 {
            let size = f64::from(i) / 16.0;
            let [low, high] = [0.5 - size, 0.5 + size].map(|t| 116.0 * luminance(map.at(t)).cbrt() - 16.0);
            assert!((low - high).abs() < 6.0, "{size}: {low} and {high}");
        }
        assert!(ColourMap::of_range([-2.0, 2.0]).at(0.0) == map.at(0.0));
        assert!(ColourMap::of_range([0.0, 2.0]).at(0.0) == ColourMap::amounts().at(0.0));
    }

    #[test]
    fn lightness_rises_evenly() {
        // CIE lightness, a measure that the map was not built with; it agrees with OKLab's only roughly,
        // and 8-bit colours round by up to 0.4 each, so sixteen steps are compared within 35 %.
        let map = ColourMap::amounts();
        let lightness = |i: i32| 116.0 * luminance(map.at(f64::from(i) / 16.0)).cbrt() - 16.0;
        let mean = (lightness(16) - lightness(0)) / 16.0;
        for i in 0..16 {
            let step = lightness(i + 1) - lightness(i);
            assert!((step / mean - 1.0).abs() < 0.35, "step {i}: {step} of {mean}");
        }
    }

    #[test]
    fn every_input_has_a_colour() {
        let map = ColourMap::amounts();
        assert_eq!(map.at(f64::NAN), NO_NUMBER);
        assert_eq!(map.at(-5.0), map.at(0.0));
        assert_eq!(map.at(f64::INFINITY), map.at(1.0));
        assert_ne!(map.at(0.0), map.at(1.0));
    }
}
