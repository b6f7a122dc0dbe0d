//! `[[measure]]`: named results.

use super::choices::Axis;
use super::names::{find, part_name};
use super::probe::{Probe, Quantity};
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::units::Dimension;
use crate::written::{Section, Value, choice};

/// A named result of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Its name under `measured`.
    pub name: String,
    /// What it is.
    pub kind: MeasureKind,
}

/// What a measure is.
#[derive(Debug, Clone, PartialEq)]
pub enum MeasureKind {
    /// Something about one component of a probe over time.
    Probe {
        /// Number of the probe.
        probe: usize,
        /// The component.
        axis: Axis,
        /// What about it.
        feature: Feature,
    },
    /// Most turns that a probe goes around an axis through the origin, right-handed, counted from where it starts.
    MostTurns {
        /// Number of the probe, which records positions.
        probe: usize,
        /// The axis.
        axis: Axis,
    },
    /// Kinetic energy at the end over that at the start.
    KineticRatio,
    /// Time of the first contact of two bodies, s.
    ContactStart,
    /// Speed of the centre of mass of a body at the end, m/s.
    ReboundSpeed {
        /// Number of the body.
        body: usize,
    },
}

/// What is read off a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Feature {
    /// Time of the first zero crossing after the start, s.
    FirstCrossing,
    /// Time of the second zero crossing after the start, s: a period, for a curve that starts at zero.
    SecondCrossing,
    /// Largest value.
    Maximum,
    /// Smallest value.
    Minimum,
    /// A turning point.
    TurningPoint {
        /// Whether minima or maxima are counted.
        extremum: Extremum,
        /// The curve has to come back by so much (SI) on both sides.
        prominence: f64,
        /// Which of them, counted from 1.
        index: usize,
    },
    /// The value at a time, s.
    ValueAt {
        /// The time.
        time: f64,
    },
}

/// Which turning points are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Extremum {
    /// Lowest points.
    Minimum,
    /// Highest points.
    Maximum,
}

const KINDS: &[(&str, &[&str])] = &[
    ("second-crossing", CURVE),
    ("first-crossing", CURVE),
    ("maximum", CURVE),
    ("minimum", CURVE),
    ("turning-points", &["name", "kind", "probe", "component", "extremum", "prominence", "index"]),
    ("value-at", &["name", "kind", "probe", "component", "time"]),
    ("most-turns", &["name", "kind", "probe", "axis"]),
    ("kinetic-ratio", &["name", "kind"]),
    ("contact-start", &["name", "kind"]),
    ("rebound-speed", &["name", "kind", "body"]),
];

const CURVE: &[&str] = &["name", "kind", "probe", "component"];

/// What measures are read with.
pub(crate) struct MeasureReader<'a> {
    pub scope: &'a Scope,
    /// Names of all bodies and probes of the case, also of wrong ones.
    pub bodies: &'a [Option<&'a str>],
    pub probes: &'a [Option<&'a str>],
    /// The probes that are right; fewer than names when one is wrong (and the case is refused anyway).
    pub checked: &'a [Probe],
}

impl MeasureReader<'_> {
    /// One measure.
    pub(crate) fn read(&self, section: &Section<'_>, problems: &mut Problems) -> Option<Measure> {
        let name = problems.keep(part_name(section));
        let kinds: Vec<(&str, usize)> = KINDS.iter().enumerate().map(|(i, (name, _))| (*name, i)).collect();
        let kind = problems.keep(section.need("kind").and_then(|node| choice(node, "kind", &kinds)))?;
        let (kind_name, keys) = KINDS[kind];
        let titled = Section { title: format!("{} of kind `{kind_name}`", section.title), ..section.clone() };
        titled.only(keys, problems);
        let kind = problems.keep(self.kind(kind_name, &titled));
        Some(Measure { name: name?.to_string(), kind: kind? })
    }

    fn kind(&self, kind: &str, section: &Section<'_>) -> Result<MeasureKind, Diagnostic> {
        match kind {
            "kinetic-ratio" => Ok(MeasureKind::KineticRatio),
            "most-turns" => self.most_turns(section),
            "contact-start" => Ok(MeasureKind::ContactStart),
            "rebound-speed" => {
                Ok(MeasureKind::ReboundSpeed { body: find(section.need("body")?, "body", self.bodies)? })
            }
            _ => {
                let probe = find(section.need("probe")?, "probe", self.probes)?;
                let axes = &Axis::NAMES[..self.scope.dimension];
                let axis = choice(section.need("component")?, "component", axes)?;
                Ok(MeasureKind::Probe { probe, axis, feature: self.feature(kind, probe, section)? })
            }
        }
    }

    fn feature(&self, kind: &str, probe: usize, section: &Section<'_>) -> Result<Feature, Diagnostic> {
        Ok(match kind {
            "first-crossing" => Feature::FirstCrossing,
            "second-crossing" => Feature::SecondCrossing,
            "maximum" => Feature::Maximum,
            "minimum" => Feature::Minimum,
            "value-at" => Feature::ValueAt {
                time: self.scope.not_negative(section.need("time")?, "`time`", Dimension::TIME)?,
            },
            _ => self.turning_point(probe, section)?,
        })
    }

    fn most_turns(&self, section: &Section<'_>) -> Result<MeasureKind, Diagnostic> {
        let node = section.need("probe")?;
        let probe = find(node, "probe", self.probes)?;
        if self.checked.get(probe).is_some_and(|p| p.quantity != Quantity::Position) {
            let message = "turns are counted of a probe that records positions";
            return Err(Diagnostic::at(node.place, message).help("give the probe quantity = \"position\""));
        }
        // In the plane there is one axis to go around.
        let axes = &Axis::NAMES[if self.scope.dimension == 2 { 2 } else { 0 }..];
        Ok(MeasureKind::MostTurns { probe, axis: choice(section.need("axis")?, "axis", axes)? })
    }

    fn turning_point(&self, probe: usize, section: &Section<'_>) -> Result<Feature, Diagnostic> {
        let extrema = [("minimum", Extremum::Minimum), ("maximum", Extremum::Maximum)];
        let extremum = choice(section.need("extremum")?, "extremum", &extrema)?;
        let dimension = self.checked.get(probe).map_or(Dimension::LENGTH, |p| p.quantity.dimension());
        let prominence = self.scope.positive(section.need("prominence")?, "`prominence`", dimension)?;
        Ok(Feature::TurningPoint { extremum, prominence, index: index(section)? })
    }
}

/// Which turning point, counted from 1.
fn index(section: &Section<'_>) -> Result<usize, Diagnostic> {
    let node = section.need("index")?;
    let index = match node.value {
        Value::Integer(index) => usize::try_from(index).ok().filter(|index| *index >= 1),
        _ => None,
    };
    index.ok_or_else(|| {
        let message = format!("`index` has to be a whole number from 1 on, found {}", node.found());
        Diagnostic::at(node.place, message)
    })
}
