//! What a run left behind, and the numbers in it.

use super::path::{Path, Sample};
use case::run::curves::{Curve, Point};
use output::summary::Status;
use output::{Summary, Table};
use serde_json::Value;
use std::path::PathBuf;

/// A run that is over.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// Its result directory.
    pub directory: PathBuf,
    /// Its summary.
    pub summary: Summary,
    /// Hash of its manifest.
    pub manifest: String,
    /// Whether a run that diverged has something to say.
    pub may_diverge: bool,
}

impl Evidence {
    /// The number at a path; the error is the reason why there is none.
    pub fn number(&self, path: &Path) -> Result<f64, String> {
        if self.summary.status != Status::Done && !self.may_diverge {
            let error = self.summary.error.as_ref().map_or("", |error| error.message.as_str());
            return Err(format!("the run did not reach its end: {error}"));
        }
        match path.sample {
            None => self.plain(path),
            Some(sample) => {
                let (times, values) = self.curve(path)?;
                take(&Curve { times: &times, values: &values }, sample)
            }
        }
    }

    fn plain(&self, path: &Path) -> Result<f64, String> {
        let json = serde_json::to_value(&self.summary).map_err(|error| error.to_string())?;
        let mut here = &json;
        for name in &path.names {
            here = here.get(name).ok_or_else(|| format!("summary.json has no {path}"))?;
        }
        let number =
            here.as_f64().or_else(|| ["value", "worst"].iter().find_map(|key| here.get(key)?.as_f64()));
        number.ok_or_else(|| match here.get("reason") {
            Some(Value::String(reason)) => reason.clone(),
            _ => format!("{path} is no number"),
        })
    }

    fn curve(&self, path: &Path) -> Result<(Vec<f64>, Vec<f64>), String> {
        let names: Vec<&str> = path.names.iter().map(String::as_str).collect();
        let energies =
            |column: usize| self.summary.energy.history.iter().map(|row| (row[0], row[column])).unzip();
        match names[..] {
            ["energy", "kinetic"] => Ok(energies(1)),
            ["energy", "strain"] => Ok(energies(2)),
            ["energy", "total"] => Ok(energies(3)),
            ["probe", name, axis] => self.probe(name, axis),
            ["disorder", name] => {
                let json = serde_json::to_value(&self.summary.disorder).map_err(|error| error.to_string())?;
                let history = json.get(name).and_then(|measure| measure.get("history"));
                let history = history.ok_or_else(|| format!("summary.json has no {path}"))?;
                let pairs: Vec<[Option<f64>; 2]> =
                    serde_json::from_value(history.clone()).map_err(|error| error.to_string())?;
                Ok(pairs
                    .into_iter()
                    .map(|pair| pair.map(|v| v.unwrap_or(f64::NAN)))
                    .map(|[t, v]| (t, v))
                    .unzip())
            }
            _ => Err(format!("{path} is no curve")),
        }
    }

    fn probe(&self, name: &str, axis: &str) -> Result<(Vec<f64>, Vec<f64>), String> {
        let file = self.directory.join("probes").join(format!("{name}.csv"));
        let table = Table::read(&file).map_err(|error| error.to_string())?;
        let column = table.columns.into_iter().find(|column| column.name == axis);
        let column = column.ok_or_else(|| format!("probe {name} has no {axis}"))?;
        Ok((table.times, column.values))
    }
}

fn take(curve: &Curve<'_>, sample: Sample) -> Result<f64, String> {
    let value = |point: Option<Point>| point.map(|p| p.value).ok_or_else(|| "the curve is empty".to_string());
    let peaks = || -> Result<Vec<f64>, String> {
        let range = value(curve.maximum())? - value(curve.minimum())?;
        let turning = curve.turning_points(0.25 * range);
        Ok(turning.iter().filter(|(_, high)| *high).map(|(point, _)| point.value).collect())
    };
    let peak = |found: Option<f64>| found.ok_or_else(|| "the curve has no peak".to_string());
    match sample {
        Sample::Min => value(curve.minimum()),
        Sample::Max => value(curve.maximum()),
        Sample::At(time) => nearest(curve, time),
        Sample::FirstPeak => peak(peaks()?.first().copied()),
        Sample::LastPeak => peak(peaks()?.last().copied()),
        Sample::HighestPeak => peak(peaks()?.into_iter().reduce(f64::max)),
        Sample::Peaks => Ok(peaks()?.len() as f64),
    }
}

/// The sample nearest to a time; none if the curve has no sample within its own widest gap of it.
fn nearest(curve: &Curve<'_>, time: f64) -> Result<f64, String> {
    let gap = curve.times.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    let samples = curve.times.iter().zip(curve.values).map(|(t, value)| ((t - time).abs(), *value));
    let nearest = samples.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|(distance, _)| *distance <= gap)
        .map(|(_, value)| value)
        .ok_or_else(|| format!("there is no sample near {time} s"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use output::summary::{Failure, Measured, Worst};

    fn evidence() -> Evidence {
        let mut summary = Summary { status: Status::Done, ..Summary::default() };
        summary.energy.residual = -0.5;
        summary.energy.history = vec![[0.0, 3.0, 1.0, 4.0], [1.0, 1.0, 4.0, 5.0], [2.0, 2.0, 1.0, 3.0]];
        summary.disorder.zigzag_rms =
            Worst { worst: 0.3, time: 1.0, history: vec![[0.0, 0.1], [1.1, 0.3], [2.0, 0.2]] };
        summary.measured.insert("period".to_string(), Measured::value(0.25, "s").at(0.75));
        summary.measured.insert("tip".to_string(), Measured::missing("m", "too short"));
        Evidence { directory: PathBuf::new(), summary, manifest: String::new(), may_diverge: false }
    }

    fn number(evidence: &Evidence, path: &str) -> Result<f64, String> {
        evidence.number(&Path::try_from(path.to_string())?)
    }

    #[test]
    fn every_kind_of_place() {
        let run = evidence();
        for (path, wanted) in [
            ("energy.residual", -0.5),
            ("measured.period", 0.25),
            ("measured.period.time", 0.75),
            ("disorder.zigzag_rms", 0.3),
            ("disorder.zigzag_rms@0.9", 0.3),
            ("disorder.zigzag_rms@0.4", 0.1),
            ("energy.total@max", 5.0),
            ("energy.kinetic@min", 1.0),
            ("energy.strain@2", 1.0),
        ] {
            assert_eq!(number(&run, path), Ok(wanted), "{path}");
        }
    }

    #[test]
    fn what_is_not_there_has_a_reason() {
        let run = evidence();
        assert_eq!(number(&run, "measured.tip").unwrap_err(), "too short");
        assert!(number(&run, "measured.top").unwrap_err().contains("no measured.top"));
        assert!(number(&run, "disorder.zigzag_rms@7").unwrap_err().contains("near 7 s"));
        assert!(number(&run, "case").is_err() && number(&run, "measured.period@max").is_err());
    }

    #[test]
    fn a_run_that_diverged_holds_nothing_unless_it_may() {
        let mut run = evidence();
        run.summary.status = Status::Diverged;
        run.summary.error = Some(Failure { message: "det F < 0".to_string(), ..Failure::default() });
        assert!(number(&run, "measured.period").unwrap_err().contains("det F < 0"));
        run.may_diverge = true;
        assert_eq!(number(&run, "measured.period"), Ok(0.25));
    }

    #[test]
    fn peaks_of_a_decaying_swing() {
        let times: Vec<f64> = (0..2000).map(|i| f64::from(i) * 0.01).collect();
        let values: Vec<f64> = times.iter().map(|t| (-0.01 * t).exp() * t.sin()).collect();
        let curve = Curve { times: &times, values: &values };
        // Maxima of the sine at pi/2, 5 pi/2, 9 pi/2; sampling at 0.01 and the decay cost less than 1e-4.
        let decay = |n: f64| (-0.01 * (0.5 + 2.0 * n) * std::f64::consts::PI).exp();
        assert_eq!(take(&curve, Sample::Peaks), Ok(3.0));
        assert!((take(&curve, Sample::FirstPeak).unwrap() - decay(0.0)).abs() < 1e-4);
        assert!((take(&curve, Sample::LastPeak).unwrap() - decay(2.0)).abs() < 1e-4);
        assert_eq!(take(&curve, Sample::HighestPeak), take(&curve, Sample::FirstPeak));
    }
}
