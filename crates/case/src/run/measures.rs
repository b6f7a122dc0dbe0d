//! Named results.

use super::compare;
use super::curves::{Curve, Point};
use crate::study::spectrum::{Window, spectrum};
use crate::{Case, Extremum, Feature, Measure, MeasureKind};
use output::summary::Measured;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use taut::simulation::{Snapshot, Totals};

/// Samples of a probe.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Times, s.
    pub times: Vec<f64>,
    /// Values, by axis.
    pub values: [Vec<f64>; 3],
}

/// What named results are made from.
pub struct Evidence<'a> {
    /// Samples of every probe.
    pub series: &'a [Series],
    /// Totals at the start.
    pub start: Totals,
    /// Totals at the end.
    pub end: Totals,
    /// State at the end.
    pub snapshot: &'a Snapshot,
    /// Mass of every particle.
    pub mass: &'a [f64],
    /// When bodies first touched, s.
    pub contact: Option<f64>,
}

impl Evidence<'_> {
    /// All results that the case names.
    pub fn measured(&self, case: &Case) -> BTreeMap<String, Measured> {
        case.measures.iter().map(|m| (m.name.clone(), self.one(case, &m.kind))).collect()
    }

    fn one(&self, case: &Case, kind: &MeasureKind) -> Measured {
        match kind {
            MeasureKind::Probe { probe, axis, feature, over } => {
                let series = &self.series[*probe];
                let curve = Curve { times: &series.times, values: &series.values[axis.index()] };
                let measured = feature_of(&curve, feature, case.probes[*probe].quantity.unit());
                over.map_or(measured.clone(), |over| Measured {
                    value: measured.value.map(|value| value / over),
                    unit: "1".to_string(),
                    ..measured
                })
            }
            MeasureKind::Turns { probe, axis, feature } => {
                let Series { times, values } = &self.series[*probe];
                let (first, second) = ((axis.index() + 1) % 3, (axis.index() + 2) % 3);
                let turns = turns(&values[first], &values[second]);
                feature_of(&Curve { times, values: &turns }, feature, "1")
            }
            MeasureKind::Field(comparison) => compare::measured(comparison, self.snapshot, self.mass),
            MeasureKind::KineticRatio => Measured::value(self.end.kinetic / self.start.kinetic, "1"),
            MeasureKind::ContactStart => match self.contact {
                Some(time) => Measured::value(time, "s"),
                None => Measured::missing("s", "the bodies did not touch before the end of the run"),
            },
            MeasureKind::VolumeRatio { body } => Measured::value(self.volume_ratio(case, *body), "1"),
            MeasureKind::ReboundSpeed { body } => Measured::value(self.mean_speed(*body), "m/s"),
        }
    }

    /// Present volume over that at rest.
    fn volume_ratio(&self, case: &Case, body: usize) -> f64 {
        let rest = case.material_of(&case.bodies[body]).map_or(f64::NAN, |material| material.density);
        let mine = || (0..self.mass.len()).filter(|&i| self.snapshot.body[i] as usize == body);
        let volume: f64 = mine().map(|i| self.mass[i] / self.snapshot.density[i]).sum();
        volume / mine().map(|i| self.mass[i] / rest).sum::<f64>()
    }

    /// Speed of the centre of mass.
    fn mean_speed(&self, body: usize) -> f64 {
        let mine = || (0..self.mass.len()).filter(|&i| self.snapshot.body[i] as usize == body);
        let mass: f64 = mine().map(|i| self.mass[i]).sum();
        let momentum = mine().fold([0.0; 3], |p: [f64; 3], i| {
            std::array::from_fn(|k| p[k] + self.mass[i] * self.snapshot.velocity[i][k])
        });
        momentum.iter().map(|p| p * p).sum::<f64>().sqrt() / mass
    }
}

/// What the case measures of fields, of this state.
pub fn fields(case: &Case, snapshot: &Snapshot, mass: &[f64]) -> BTreeMap<String, Measured> {
    let one = |measure: &Measure| match &measure.kind {
        MeasureKind::Field(comparison) => {
            Some((measure.name.clone(), compare::measured(comparison, snapshot, mass)))
        }
        _ => None,
    };
    case.measures.iter().filter_map(one).collect()
}

/// Turns of (x, y) about the origin since the first sample; no step is taken for more than half a turn.
fn turns(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let angles: Vec<f64> = x.iter().zip(y).map(|(x, y)| y.atan2(*x) / TAU).collect();
    let step = |pair: &[f64]| {
        let step = pair[1] - pair[0];
        sum += step - step.round();
        sum
    };
    std::iter::once(0.0).chain(angles.windows(2).map(step)).take(angles.len()).collect()
}

fn feature_of(curve: &Curve<'_>, feature: &Feature, unit: &str) -> Measured {
    let end = curve.times.last().copied().unwrap_or(0.0);
    let short =
        |what: &str, unit: &str| Measured::missing(unit, &format!("the run ended at {end} s, before {what}"));
    let point = |p: Option<Point>, what: &str| {
        p.map_or_else(|| short(what, unit), |p| Measured::value(p.value, unit).at(p.time))
    };
    let crossing =
        |n, what: &str| curve.crossing(n).map_or_else(|| short(what, "s"), |t| Measured::value(t, "s"));
    match *feature {
        Feature::FirstCrossing => crossing(1, "the first zero crossing"),
        Feature::SecondCrossing => crossing(2, "the second zero crossing"),
        Feature::Maximum => point(curve.maximum(), "the first sample"),
        Feature::Minimum => point(curve.minimum(), "the first sample"),
        Feature::Frequency => {
            let found = spectrum(curve.times, curve.values, Window::Hann);
            let peak = found.and_then(|found| found.peaks().first().copied());
            peak.map_or_else(|| short("it vibrated", "Hz"), |peak| Measured::value(peak.frequency, "Hz"))
        }
        Feature::Duration => curve.duration().map_or_else(
            || short("half of the largest value was passed twice", "s"),
            |t| Measured::value(t, "s"),
        ),
        Feature::TurningPoint { extremum, prominence, index } => {
            let wanted = extremum == Extremum::Maximum;
            let all = curve.turning_points(prominence);
            let found = all.iter().filter(|p| p.1 == wanted).nth(index - 1).map(|p| p.0);
            point(found, &format!("turning point number {index}"))
        }
        Feature::ValueAt { time } => {
            let value = curve.at(time).map(|value| Point { time, value });
            point(value, &format!("t = {time} s"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_unwrapped_and_signed() {
        // Two turns and a quarter forward, then three back, in steps of a tenth of a turn and less.
        let angle =
            |i: i32| TAU * if i <= 30 { 0.075 * f64::from(i) } else { 2.25 - 0.1 * f64::from(i - 30) };
        let (x, y): (Vec<f64>, Vec<f64>) =
            (0..=60).map(|i| (2.0 * angle(i).cos(), 2.0 * angle(i).sin())).unzip();
        let turns = turns(&x, &y);
        let near = |i: usize, wanted: f64| assert!((turns[i] - wanted).abs() < 1e-12, "{i}: {}", turns[i]);
        [(0, 0.0), (30, 2.25), (60, -0.75)].iter().for_each(|&(i, wanted)| near(i, wanted));
        assert_eq!(turns.len(), 61);
        assert!(super::turns(&[], &[]).is_empty());
    }
}
