//! `[[probe]]`.

use super::curves::Curves;
use super::defaults;
use super::names::{find, part_name};
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Words, probe as keys};
use crate::source::Place;
use crate::units::Dimension;
use crate::written::{Section, choice, text};

/// A material point whose motion is recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Its name.
    pub name: String,
    /// What it follows.
    pub spot: Spot,
    /// Number of the body that it belongs to.
    pub body: usize,
    /// What is recorded.
    pub quantity: Quantity,
    /// Time between two samples, s; 0 for every step.
    pub interval: f64,
    /// What it is compared with.
    pub reference: Option<Curves>,
    /// Where `at` or `region` stands in the case file.
    pub place: Place,
}

/// What a probe follows.
#[derive(Debug, Clone, PartialEq)]
pub enum Spot {
    /// A material point, by its reference position, m.
    Point([f64; 3]),
    /// The mean over the particles whose reference position is in here, weighted by volume.
    Region(ShapeSpec),
}

/// What a probe records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Present minus reference position, m.
    Displacement,
    /// Present position, m.
    Position,
    /// Velocity, m/s.
    Velocity,
}

impl Words for Quantity {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("displacement", Self::Displacement, "present minus reference position, m"),
        ("position", Self::Position, "present position, m"),
        ("velocity", Self::Velocity, "velocity, m/s"),
    ];
}

impl Quantity {
    /// What its numbers are: lengths or speeds.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Displacement | Self::Position => Dimension::LENGTH,
            Self::Velocity => Dimension::SPEED,
        }
    }
}

/// One probe; `bodies` are the names of all bodies of the case.
pub(crate) fn read(
    section: &Section<'_>,
    shapes: &mut ShapeReader<'_>,
    bodies: &[Option<&str>],
    problems: &mut Problems,
) -> Option<Probe> {
    let scope = shapes.scope;
    section.only(keys::TABLE.keys, problems);
    let name = problems.keep(part_name(section));
    let spot = problems.keep(spot(section, shapes));
    let body = problems.keep(body(section, bodies));
    let quantity =
        section.get(keys::QUANTITY.name).map(|node| choice(node, keys::QUANTITY.name, Quantity::WORDS));
    let quantity = problems.keep(quantity.transpose());
    let interval = problems.keep(scope.get(section, &keys::INTERVAL));
    let reference = problems.keep(reference(section));
    let (spot, place) = spot?;
    Some(Probe {
        name: name?.to_string(),
        spot,
        body: body?,
        quantity: quantity?.unwrap_or(Quantity::Displacement),
        interval: interval?.unwrap_or(defaults::PROBE_INTERVAL),
        reference: reference?,
        place,
    })
}

fn reference(section: &Section<'_>) -> Result<Option<Curves>, Diagnostic> {
    let Some(node) = section.get(keys::REFERENCE.name) else { return Ok(None) };
    let file = text(node, keys::REFERENCE.name)?.to_string();
    Ok(Some(Curves { file, place: node.place, text: None }))
}

fn spot(section: &Section<'_>, shapes: &mut ShapeReader<'_>) -> Result<(Spot, Place), Diagnostic> {
    match (section.get(keys::AT.name), section.get(keys::REGION.name)) {
        (Some(node), None) => Ok((Spot::Point(shapes.scope.vector(node, &keys::AT)?), node.place)),
        (None, Some(node)) => Ok((Spot::Region(shapes.shape(node)?), node.place)),
        (None, None) => Err(Diagnostic::at(section.place, "missing key `at`: the material point to follow")
            .help("for example at = [0.2, 0]; or region = \"NAME\" for the mean over the particles in it")),
        (Some(_), Some(node)) => {
            Err(Diagnostic::at(node.place, "a probe follows one thing, found both `at` and `region`"))
        }
    }
}

fn body(section: &Section<'_>, bodies: &[Option<&str>]) -> Result<usize, Diagnostic> {
    match section.get("body") {
        Some(node) => find(node, "body", bodies),
        None if bodies.len() <= 1 => Ok(0),
        None => {
            let names: Vec<&str> = bodies.iter().copied().flatten().collect();
            Err(Diagnostic::at(
                section.place,
                format!("{} has to say which `body` it belongs to", section.title),
            )
            .help(format!("the bodies are {}", names.join(", "))))
        }
    }
}
