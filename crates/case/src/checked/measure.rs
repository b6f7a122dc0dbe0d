//! `[[measure]]`: named results.

use super::choices::{Axis, word};
use super::compare::Comparison;
use super::names::{find, part_name};
use super::probe::{Probe, Quantity};
use super::scope::Scope;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, Words, measure as keys};
use crate::units::Dimension;
use crate::written::{Section, Value, choice};

/// A named result of the run.
#[derive(Debug, Clone)]
pub struct Measure {
    /// Its name under `measured`.
    pub name: String,
    /// What it is.
    pub kind: MeasureKind,
}

/// What a measure is.
#[derive(Debug, Clone)]
pub enum MeasureKind {
    /// Something about one component of a probe over time.
    Probe {
        /// Number of the probe.
        probe: usize,
        /// The component.
        axis: Axis,
        /// What about it.
        feature: Feature,
        /// What it is divided by, SI; 1 with the unit of the probe if nothing is said.
        over: Option<f64>,
    },
    /// Something about the turns that a probe goes around an axis through the origin, right-handed, counted from where it starts.
    Turns {
        /// Number of the probe, which records positions.
        probe: usize,
        /// The axis.
        axis: Axis,
        /// What about them.
        feature: Feature,
    },
    /// A field at the end.
    Field(Box<Comparison>),
    /// Kinetic energy at the end over that at the start.
    KineticRatio,
    /// Time of the first contact of two bodies, s.
    ContactStart,
    /// Speed of the centre of mass of a body at the end, m/s.
    ReboundSpeed {
        /// Number of the body.
        body: usize,
    },
    /// Volume of a body at the end over that at rest.
    VolumeRatio {
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
    /// Frequency of the highest peak of its spectrum, Hz.
    Frequency,
    /// For how long it is larger than half of its largest value, s: of a blow.
    Duration,
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

impl Words for Extremum {
    const WORDS: &'static [(&'static str, Self, &'static str)] =
        &[("minimum", Self::Minimum, "lowest points"), ("maximum", Self::Maximum, "highest points")];
}

/// Kinds of measures, as a case names them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measured {
    SecondCrossing,
    FirstCrossing,
    Maximum,
    Minimum,
    TurningPoints,
    Duration,
    ValueAt,
    MostTurns,
    LeastTurns,
    TurnsAt,
    KineticRatio,
    ContactStart,
    ReboundSpeed,
    VolumeRatio,
    ErrorMax,
    ErrorRms,
    Ratio,
    Largest,
    Frequency,
}

impl Words for Measured {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        (
            "second-crossing",
            Self::SecondCrossing,
            "time of the second zero crossing after the start: a period, for a curve that starts at zero",
        ),
        ("first-crossing", Self::FirstCrossing, "time of the first zero crossing after the start"),
        ("maximum", Self::Maximum, "largest value, and when"),
        ("minimum", Self::Minimum, "smallest value, and when"),
        ("turning-points", Self::TurningPoints, "a minimum or maximum by its number"),
        ("duration", Self::Duration, "for how long it is larger than half of its largest value: of a blow"),
        ("value-at", Self::ValueAt, "the value at a time"),
        (
            "most-turns",
            Self::MostTurns,
            "most turns of a probe around an axis through the origin, counted from where it starts",
        ),
        (
            "least-turns",
            Self::LeastTurns,
            "fewest turns: how far the probe goes the other way, as a negative number",
        ),
        ("turns-at", Self::TurnsAt, "the turns at a time"),
        ("kinetic-ratio", Self::KineticRatio, "kinetic energy at the end over that at the start"),
        ("contact-start", Self::ContactStart, "time of the first contact of two bodies"),
        ("rebound-speed", Self::ReboundSpeed, "speed of the centre of mass of a body at the end"),
        ("volume-ratio", Self::VolumeRatio, "volume of a body (in 2D its area) at the end over that at rest"),
        (
            "error-max",
            Self::ErrorMax,
            "largest difference of a field, at the end, from what it should be, over the largest that it should be",
        ),
        ("error-rms", Self::ErrorRms, "root mean square of that difference, over the same"),
        ("ratio", Self::Ratio, "mean of a field at the end over what it should be"),
        ("largest", Self::Largest, "largest value of a field at the end"),
        (
            "frequency",
            Self::Frequency,
            "frequency of the highest peak of its spectrum (Hann's window over the whole run): right to half of 1/T",
        ),
    ];
}

impl Measured {
    /// The keys of this kind, besides name and kind.
    pub(crate) fn keys(self) -> &'static [Key] {
        const CURVE: &[Key] = &[keys::PROBE, keys::COMPONENT];
        const TURNING: &[Key] =
            &[keys::PROBE, keys::COMPONENT, keys::EXTREMUM, keys::PROMINENCE, keys::INDEX];
        match self {
            Self::SecondCrossing
            | Self::FirstCrossing
            | Self::Maximum
            | Self::Minimum
            | Self::Frequency
            | Self::Duration => CURVE,
            Self::TurningPoints => TURNING,
            Self::ValueAt => const { &[keys::PROBE, keys::COMPONENT, keys::TIME] },
            Self::MostTurns | Self::LeastTurns => const { &[keys::PROBE, keys::AXIS] },
            Self::TurnsAt => const { &[keys::PROBE, keys::AXIS, keys::TIME] },
            Self::KineticRatio | Self::ContactStart => &[],
            Self::ReboundSpeed | Self::VolumeRatio => const { &[keys::BODY] },
            Self::ErrorMax | Self::ErrorRms | Self::Ratio => &[],
            Self::Largest => const { &[keys::FIELD] },
        }
    }

    /// Keys that it may have besides.
    pub(crate) fn more(self) -> &'static [Key] {
        match self {
            Self::Maximum | Self::Minimum | Self::TurningPoints | Self::ValueAt => const { &[keys::OVER] },
            Self::ErrorMax | Self::ErrorRms | Self::Ratio => {
                const { &[keys::DISPLACEMENT, keys::VON_MISES, keys::BODY, keys::REGION, keys::ALIGNED] }
            }
            Self::Largest => const { &[keys::BODY, keys::REGION] },
            _ => &[],
        }
    }
}

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
    pub(crate) fn read(
        &self,
        section: &Section<'_>,
        (shapes, problems): (&mut ShapeReader<'_>, &mut Problems),
    ) -> Option<Measure> {
        let name = problems.keep(part_name(section));
        let kind = section.need(keys::KIND.name);
        let kind = problems.keep(kind.and_then(|node| choice(node, keys::KIND.name, Measured::WORDS)))?;
        let title = format!("{} of kind `{}`", section.title, word(kind));
        let titled = Section { title, ..section.clone() };
        let allowed: Vec<Key> = [&[keys::NAME, keys::KIND], kind.keys(), kind.more()].concat();
        titled.only(&allowed, problems);
        let kind = match kind {
            Measured::ErrorMax | Measured::ErrorRms | Measured::Ratio | Measured::Largest => problems.keep(
                self.comparison(kind, &titled, shapes).map(|field| MeasureKind::Field(Box::new(field))),
            ),
            _ => problems.keep(self.kind(kind, &titled)),
        };
        Some(Measure { name: name?.to_string(), kind: kind? })
    }

    fn kind(&self, kind: Measured, section: &Section<'_>) -> Result<MeasureKind, Diagnostic> {
        match kind {
            Measured::MostTurns => self.turns(section, Feature::Maximum),
            Measured::LeastTurns => self.turns(section, Feature::Minimum),
            Measured::TurnsAt => {
                self.turns(section, Feature::ValueAt { time: self.scope.need(section, &keys::TIME)? })
            }
            Measured::KineticRatio => Ok(MeasureKind::KineticRatio),
            Measured::ContactStart => Ok(MeasureKind::ContactStart),
            Measured::ReboundSpeed => Ok(MeasureKind::ReboundSpeed { body: self.body(section)? }),
            Measured::VolumeRatio => Ok(MeasureKind::VolumeRatio { body: self.body(section)? }),
            _ => {
                let probe = find(section.need(keys::PROBE.name)?, keys::PROBE.name, self.probes)?;
                // Where a probe is wrong the others have moved up: then every axis may be right.
                let whole = self.checked.len() == self.probes.len();
                let quantity = self.checked.get(probe).filter(|_| whole).map(|p| p.quantity);
                let axis = self.component(quantity, section)?;
                let feature = self.feature(kind, probe, section)?;
                Ok(MeasureKind::Probe { probe, axis, feature, over: self.over(probe, section)? })
            }
        }
    }

    /// Which number of a probe is read: of several one has to be chosen, of one there is no choice.
    fn component(&self, quantity: Option<Quantity>, section: &Section<'_>) -> Result<Axis, Diagnostic> {
        if let Some(scalar) = quantity.filter(|quantity| quantity.is_scalar()) {
            return match section.get(keys::COMPONENT.name) {
                None => Ok(Axis::X),
                Some(node) => {
                    let message =
                        format!("a probe of {} records one number: it has no components", word(scalar));
                    Err(Diagnostic::at(node.place, message).help("remove this line"))
                }
            };
        }
        let axes = &Axis::WORDS[quantity.map_or(0..3, |q| q.axes(self.scope.dimension))];
        choice(section.need(keys::COMPONENT.name)?, keys::COMPONENT.name, axes)
    }

    fn body(&self, section: &Section<'_>) -> Result<usize, Diagnostic> {
        find(section.need(keys::BODY.name)?, keys::BODY.name, self.bodies)
    }

    /// The unit of what a probe records.
    fn unit_of(&self, probe: usize) -> Dimension {
        self.checked.get(probe).map_or(Dimension::LENGTH, |p| p.quantity.dimension())
    }

    fn over(&self, probe: usize, section: &Section<'_>) -> Result<Option<f64>, Diagnostic> {
        let node = section.get(keys::OVER.name);
        node.map(|node| self.scope.positive(node, "`over`", self.unit_of(probe))).transpose()
    }

    fn feature(&self, kind: Measured, probe: usize, section: &Section<'_>) -> Result<Feature, Diagnostic> {
        Ok(match kind {
            Measured::FirstCrossing => Feature::FirstCrossing,
            Measured::SecondCrossing => Feature::SecondCrossing,
            Measured::Maximum => Feature::Maximum,
            Measured::Minimum => Feature::Minimum,
            Measured::Frequency => Feature::Frequency,
            Measured::Duration => Feature::Duration,
            Measured::ValueAt => Feature::ValueAt { time: self.scope.need(section, &keys::TIME)? },
            _ => self.turning_point(probe, section)?,
        })
    }

    fn turns(&self, section: &Section<'_>, feature: Feature) -> Result<MeasureKind, Diagnostic> {
        let node = section.need(keys::PROBE.name)?;
        let probe = find(node, keys::PROBE.name, self.probes)?;
        if self.checked.get(probe).is_some_and(|p| p.quantity != Quantity::Position) {
            let message = "turns are counted of a probe that records positions";
            return Err(Diagnostic::at(node.place, message).help("give the probe quantity = \"position\""));
        }
        // In the plane there is one axis to go around.
        let axes = &Axis::WORDS[if self.scope.dimension == 2 { 2 } else { 0 }..];
        let axis = choice(section.need(keys::AXIS.name)?, keys::AXIS.name, axes)?;
        Ok(MeasureKind::Turns { probe, axis, feature })
    }

    fn turning_point(&self, probe: usize, section: &Section<'_>) -> Result<Feature, Diagnostic> {
        let extremum = choice(section.need(keys::EXTREMUM.name)?, keys::EXTREMUM.name, Extremum::WORDS)?;
        let dimension = self.unit_of(probe);
        let prominence =
            self.scope.positive(section.need(keys::PROMINENCE.name)?, "`prominence`", dimension)?;
        Ok(Feature::TurningPoint { extremum, prominence, index: index(section)? })
    }
}

/// Which turning point, counted from 1.
fn index(section: &Section<'_>) -> Result<usize, Diagnostic> {
    let node = section.need(keys::INDEX.name)?;
    let index = match node.value {
        Value::Integer(index) => usize::try_from(index).ok().filter(|index| *index >= 1),
        _ => None,
    };
    index.ok_or_else(|| {
        let message = format!("`index` has to be a whole number from 1 on, found {}", node.found());
        Diagnostic::at(node.place, message)
    })
}
