//! `[[probe]]`.

use super::defaults;
use super::names::{find, part_name};
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Words, probe as keys};
use crate::source::Place;
use crate::units::Dimension;
use crate::written::{Section, choice};

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
    /// What contact does to the body.
    Contact {
        /// Number of the body that does it; `None` for all.
        by: Option<usize>,
    },
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
    /// Contact force, N.
    ContactForce,
    /// Moment of the contact forces about the origin, N m.
    ContactMoment,
}

impl Words for Quantity {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("displacement", Self::Displacement, "present minus reference position, m"),
        ("position", Self::Position, "present position, m"),
        ("velocity", Self::Velocity, "velocity, m/s"),
        (
            "contact-force",
            Self::ContactForce,
            "the force of contact on a body or tool, N (in 2D per metre of depth)",
        ),
        ("contact-moment", Self::ContactMoment, "its moment about the origin, N m: x, y, z, in 2D too"),
    ];
}

impl Quantity {
    /// What its numbers are: lengths or speeds.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Displacement | Self::Position => Dimension::LENGTH,
            Self::Velocity => Dimension::SPEED,
            Self::ContactForce => Dimension::FORCE,
            Self::ContactMoment => Dimension::ENERGY,
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement | Self::Position => "m",
            Self::Velocity => "m/s",
            Self::ContactForce => "N",
            Self::ContactMoment => "N m",
        }
    }

    /// How many components it has in a dimension.
    pub fn components(self, dimension: usize) -> usize {
        if self == Self::ContactMoment { 3 } else { dimension }
    }

    fn is_contact(self) -> bool {
        matches!(self, Self::ContactForce | Self::ContactMoment)
    }
}

/// One probe, with the names of all bodies of the case, and of all bodies and then tools.
pub(crate) fn read(
    section: &Section<'_>,
    shapes: &mut ShapeReader<'_>,
    (bodies, touching): (&[Option<&str>], &[Option<&str>]),
    problems: &mut Problems,
) -> Option<Probe> {
    let scope = shapes.scope;
    section.only(keys::TABLE.keys, problems);
    let name = problems.keep(part_name(section));
    let quantity =
        section.get(keys::QUANTITY.name).map(|node| choice(node, keys::QUANTITY.name, Quantity::WORDS));
    let quantity = problems.keep(quantity.transpose())?.unwrap_or(Quantity::Displacement);
    let of_contact = quantity.is_contact();
    let spot = problems.keep(if of_contact { by(section, touching) } else { spot(section, shapes) });
    let body = problems.keep(body(section, if of_contact { touching } else { bodies }));
    let interval = problems.keep(scope.get(section, &keys::INTERVAL));
    let (spot, place) = spot?;
    Some(Probe {
        name: name?.to_string(),
        spot,
        body: body?,
        quantity,
        interval: interval?.unwrap_or(defaults::PROBE_INTERVAL),
        place,
    })
}

/// What a probe of contact looks at.
fn by(section: &Section<'_>, touching: &[Option<&str>]) -> Result<(Spot, Place), Diagnostic> {
    if let Some(node) = section.get(keys::AT.name).or(section.get(keys::REGION.name)) {
        return Err(Diagnostic::at(
            node.place,
            "a probe of contact is of a whole body: it has no `at` or `region`",
        ));
    }
    let by = section.get(keys::BY.name).map(|node| find(node, "body or tool", touching)).transpose()?;
    Ok((Spot::Contact { by }, section.place))
}

fn spot(section: &Section<'_>, shapes: &mut ShapeReader<'_>) -> Result<(Spot, Place), Diagnostic> {
    if let Some(node) = section.get(keys::BY.name) {
        return Err(Diagnostic::at(
            node.place,
            "`by` belongs to the quantities contact-force and contact-moment",
        ));
    }
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
