//! The spectrum of what a probe saw, and its peaks.

use realfft::RealFftPlanner;
use std::f64::consts::TAU;

/// Zeros behind the samples, as a multiple of them: so that a line is drawn by several points.
const PADDED: usize = 4;
/// A peak has at least this share of the highest.
const LOWEST: f64 = 0.02;

/// How samples are weighed before they are transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// Hann's: lines far from a peak are not covered by it, lines next to it are.
    Hann,
    /// None: the finest resolution, and side lobes of a fifth.
    None,
}

impl Window {
    fn at(self, share: f64) -> f64 {
        match self {
            Self::Hann => 0.5 - 0.5 * (TAU * share).cos(),
            Self::None => 1.0,
        }
    }

    /// Two lines are told apart from this many 1/T on.
    fn width(self) -> f64 {
        match self {
            Self::Hann => 2.0,
            Self::None => 1.0,
        }
    }
}

/// Amplitudes by frequency.
#[derive(Clone, Debug, Default)]
pub struct Spectrum {
    /// Hz, from 0 on.
    pub frequencies: Vec<f64>,
    /// Amplitude of a vibration of that frequency, in the unit of the samples.
    pub amplitudes: Vec<f64>,
    /// Two lines are told apart if they are so far from each other, Hz.
    pub resolution: f64,
    /// By so much may the frequency of a peak be wrong, Hz: half of 1/T, more than which a line between two others of the same height cannot be moved.
    pub uncertainty: f64,
}

/// A line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Hz.
    pub frequency: f64,
    /// In the unit of the samples.
    pub amplitude: f64,
}

/// The spectrum of samples at these times, s, which need not be equally far apart: their mean and trend are taken away, and they are
/// interpolated to equal steps. `None` if there are fewer than eight, or no time passes.
#[must_use]
pub fn spectrum(times: &[f64], values: &[f64], window: Window) -> Option<Spectrum> {
    let n = times.len().min(values.len());
    let span = times.get(n.checked_sub(1)?)? - times[0];
    if n < 8 || !(span > 0.0 && span.is_finite()) || values[..n].iter().any(|v| !v.is_finite()) {
        return None;
    }
    let even = level(&resampled(&times[..n], &values[..n]));
    let step = span / (n - 1) as f64;
    let length = (PADDED * n).next_power_of_two();
    let weight = |i: usize| window.at(i as f64 / (n - 1) as f64);
    let mut samples = vec![0.0; length];
    (0..n).for_each(|i| samples[i] = even[i] * weight(i));
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(length);
    let mut lines = transform.make_output_vec();
    transform.process(&mut samples, &mut lines).ok()?;
    let all: f64 = (0..n).map(weight).sum();
    Some(Spectrum {
        frequencies: (0..lines.len()).map(|k| k as f64 / (length as f64 * step)).collect(),
        amplitudes: lines.iter().map(|line| 2.0 * line.norm() / all).collect(),
        resolution: window.width() / span,
        uncertainty: 0.5 / span,
    })
}

impl Spectrum {
    /// The peaks, highest first: what is higher than everything within the resolution, at the top of the parabola through three points.
    #[must_use]
    pub fn peaks(&self) -> Vec<Peak> {
        let a = &self.amplitudes;
        let spacing = self.frequencies.get(1).copied().unwrap_or(1.0);
        let reach = ((self.resolution / spacing) as usize).max(1);
        let highest = a.iter().copied().fold(0.0, f64::max);
        let is_peak = |k: usize| {
            let near = &a[k.saturating_sub(reach)..(k + reach + 1).min(a.len())];
            a[k] > LOWEST * highest && near.iter().all(|other| *other <= a[k])
        };
        let top = |k: usize| {
            let (before, here, after) = (a[k - 1], a[k], a[k + 1]);
            let curve = before - 2.0 * here + after;
            let shift = if curve < 0.0 { 0.5 * (before - after) / curve } else { 0.0 };
            let amplitude = here - 0.25 * (before - after) * shift;
            Peak { frequency: self.frequencies[k] + shift * spacing, amplitude }
        };
        let mut peaks: Vec<Peak> = (1..a.len().saturating_sub(1)).filter(|&k| is_peak(k)).map(top).collect();
        peaks.sort_by(|one, other| other.amplitude.total_cmp(&one.amplitude));
        peaks
    }
}

/// The samples at equal steps, by linear interpolation.
fn resampled(times: &[f64], values: &[f64]) -> Vec<f64> {
    let n = times.len();
    let (first, last) = (times[0], times[n - 1]);
    let mut k = 0;
    let at = |i: usize| first + (last - first) * i as f64 / (n - 1) as f64;
    let mut value = |t: f64| {
        while k + 2 < n && times[k + 1] < t {
            k += 1;
        }
        let share = (t - times[k]) / (times[k + 1] - times[k]);
        if share.is_finite() { values[k] + share * (values[k + 1] - values[k]) } else { values[k] }
    };
    (0..n).map(|i| value(at(i))).collect()
}

/// The samples without their mean and trend.
fn level(values: &[f64]) -> Vec<f64> {
    let n = values.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = values.iter().sum::<f64>() / n;
    let tilt: f64 = values.iter().enumerate().map(|(i, v)| (i as f64 - middle) * v).sum();
    let spread = n * (n * n - 1.0) / 12.0;
    values.iter().enumerate().map(|(i, v)| v - mean - tilt / spread * (i as f64 - middle)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two vibrations on a drift, at steps that vary by a tenth.
    fn sampled() -> (Vec<f64>, Vec<f64>) {
        let mut t = 0.0;
        let times: Vec<f64> = (0..4000_u32)
            .map(|i| {
                t += 1e-5 * (1.0 + 0.1 * f64::from(i).sin());
                t
            })
            .collect();
        let value = |t: f64| 3.0 + 20.0 * t + 1.5 * (TAU * 453.0 * t).sin() + 0.4 * (TAU * 1210.0 * t).cos();
        let values = times.iter().map(|t| value(*t)).collect();
        (times, values)
    }

    #[test]
    fn lines_are_found_where_they_are() {
        let (times, values) = sampled();
        let found = spectrum(&times, &values, Window::Hann).expect("enough samples");
        let peaks = found.peaks();
        for (peak, [frequency, amplitude]) in peaks.iter().zip([[453.0, 1.5], [1210.0, 0.4]]) {
            // Steps of 8 samples a period lose sinc^2(1/80); what the window leaves of the other line is less.
            assert!((peak.frequency - frequency).abs() < 0.1 * found.uncertainty, "{peak:?}");
            assert!((peak.amplitude / amplitude - 1.0).abs() < 0.01, "{peak:?}");
        }
        assert!(
            (found.resolution * 0.04 - 2.0).abs() < 1e-2 && (found.uncertainty * 0.04 - 0.5).abs() < 1e-2
        );
    }

    #[test]
    fn without_a_window_lines_are_narrower() {
        let (times, values) = sampled();
        let width = |window| {
            let found = spectrum(&times, &values, window).expect("enough samples");
            let top = found.peaks()[0].amplitude;
            found.amplitudes.iter().filter(|a| **a > 0.5 * top).count()
        };
        assert!(width(Window::None) < width(Window::Hann));
    }

    #[test]
    fn too_little_is_nothing() {
        assert!(spectrum(&[], &[], Window::Hann).is_none());
        assert!(spectrum(&[0.0; 9], &[1.0; 9], Window::Hann).is_none());
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        assert!(spectrum(&times, &[f64::NAN; 9], Window::None).is_none());
        let flat = spectrum(&times, &[2.0; 9], Window::None).expect("nine samples");
        assert!(flat.peaks().is_empty(), "a constant has no lines: {:?}", flat.peaks());
    }
}
