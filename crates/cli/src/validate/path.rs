//! Where a number stands in what a run left behind.

use serde::Deserialize;

/// A place in `summary.json`, or on one of its curves.
///
/// Written as dotted names, with an optional `@` and what to take of a curve:
/// `measured.period`, `measured.s_z_min_1.time`, `momentum.linear.drift`, `disorder.zigzag_rms` (the worst),
/// `disorder.zigzag_rms@0.005` (the sample nearest to that time), `energy.total@max`, `probe.tip.y@last-peak`.
/// The curves are `disorder.*`, `energy.kinetic`, `energy.strain`, `energy.total`, and the columns of the probes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Path {
    /// The names between the dots.
    pub names: Vec<String>,
    /// What to take of the curve; `None` if the place holds a number.
    pub sample: Option<Sample>,
}

/// What to take of a curve. Peaks are maxima that stand out by a quarter of the range of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sample {
    /// The sample nearest to a time, s.
    At(f64),
    /// The smallest value.
    Min,
    /// The largest value.
    Max,
    /// The first peak.
    FirstPeak,
    /// The last peak.
    LastPeak,
    /// The highest of the peaks.
    HighestPeak,
    /// How many peaks there are.
    Peaks,
}

impl TryFrom<String> for Path {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let (names, sample) = match text.split_once('@') {
            Some((names, sample)) => (names, Some(parse_sample(sample)?)),
            None => (text.as_str(), None),
        };
        let names: Vec<String> = names.split('.').map(str::to_string).collect();
        if names.iter().any(String::is_empty) {
            return Err(format!("`{text}` is no path: expected names with dots between them"));
        }
        Ok(Self { names, sample })
    }
}

fn parse_sample(text: &str) -> Result<Sample, String> {
    Ok(match text {
        "min" => Sample::Min,
        "max" => Sample::Max,
        "first-peak" => Sample::FirstPeak,
        "last-peak" => Sample::LastPeak,
        "highest-peak" => Sample::HighestPeak,
        "peaks" => Sample::Peaks,
        time => match time.parse::<f64>() {
            Ok(time) if time.is_finite() => Sample::At(time),
            _ => {
                return Err(format!(
                    "`@{text}`: expected a time, min, max, first-peak, last-peak, highest-peak or peaks"
                ));
            }
        },
    })
}

impl std::fmt::Display for Path {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.names.join("."))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str) -> Result<Path, String> {
        Path::try_from(text.to_string())
    }

    #[test]
    fn names_and_samples() {
        let plain = path("measured.s_z_min_1.time").unwrap();
        assert_eq!((plain.names.len(), plain.sample), (3, None));
        let at = path("disorder.zigzag_rms@0.005").unwrap();
        assert_eq!((at.to_string().as_str(), at.sample), ("disorder.zigzag_rms", Some(Sample::At(0.005))));
        assert_eq!(path("probe.tip.y@last-peak").unwrap().sample, Some(Sample::LastPeak));
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "a..b", "energy.total@", "energy.total@later", "energy.total@NaN"] {
            assert!(path(text).is_err(), "{text}");
        }
    }
}
