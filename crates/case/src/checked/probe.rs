//! `[[probe]]`.

use super::choices::word;
use super::curves::Curves;
use super::defaults;
use super::names::{find, part_name};
use super::shape::ShapeSpec;
use super::shape_reader::ShapeReader;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Words, probe as keys};
use crate::source::Place;
use crate::units::Dimension;
use crate::written::{Node, Section, Value, choice, text};
use std::ops::Range;

/// A material point whose motion is recorded, or a boundary whose reaction is.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Its name.
    pub name: String,
    /// What it follows.
    pub spot: Spot,
    /// Number of the body that it belongs to; no meaning for a boundary.
    pub body: usize,
    /// What is recorded.
    pub quantity: Quantity,
    /// Time between two samples, s; 0 for every step.
    pub interval: f64,
    /// What it is compared with.
    pub reference: Option<Curves>,
    /// Where `at`, `region` or `of` stands in the case file.
    pub place: Place,
}

/// What a probe follows.
#[derive(Debug, Clone, PartialEq)]
pub enum Spot {
    /// A material point, by its reference position, m.
    Point([f64; 3]),
    /// The mean over the particles whose reference position is in here, weighted by volume.
    Region(ShapeSpec),
    /// A boundary, by its number.
    Boundary(usize),
    /// What other bodies do to the body, or how near they are.
    Contact {
        /// Number of the other body; `None` for all.
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
    /// Force that a boundary exerts on what it holds, N.
    Reaction,
    /// Moment of that force about the origin, N m.
    Moment,
    /// Contact force, N.
    ContactForce,
    /// Moment of the contact forces about the origin, N m.
    ContactMoment,
    /// Largest von Mises stress of the particles, Pa.
    VonMises,
    /// Smallest distance to the particles of another body, m.
    Gap,
}

impl Words for Quantity {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("displacement", Self::Displacement, "present minus reference position, m"),
        ("position", Self::Position, "present position, m"),
        ("velocity", Self::Velocity, "velocity, m/s"),
        (
            "reaction",
            Self::Reaction,
            "force that a boundary exerts on what it holds, N (in 2D per metre of depth)",
        ),
        ("moment", Self::Moment, "moment of that force about the origin, N m; in 2D z only"),
        (
            "contact-force",
            Self::ContactForce,
            "the force of contact on a body or tool, N (in 2D per metre of depth)",
        ),
        ("contact-moment", Self::ContactMoment, "its moment about the origin, N m; in 2D z only"),
        (
            "von-mises",
            Self::VonMises,
            "the largest von Mises stress of the particles that are followed, Pa; one number",
        ),
        (
            "gap",
            Self::Gap,
            "the smallest distance from a particle of a body or tool to one of another, m; one number",
        ),
    ];
}

impl Quantity {
    /// What its numbers are: lengths, speeds, forces, moments or stresses.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Displacement | Self::Position | Self::Gap => Dimension::LENGTH,
            Self::Velocity => Dimension::SPEED,
            Self::Reaction | Self::ContactForce => Dimension::FORCE,
            Self::Moment | Self::ContactMoment => Dimension::MOMENT,
            Self::VonMises => Dimension::PRESSURE,
        }
    }

    /// Unit of its numbers.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement | Self::Position | Self::Gap => "m",
            Self::Velocity => "m/s",
            Self::Reaction | Self::ContactForce => "N",
            Self::Moment | Self::ContactMoment => "N m",
            Self::VonMises => "Pa",
        }
    }

    /// The axes that it has components along; the first if it is one number.
    pub fn axes(self, dimension: usize) -> Range<usize> {
        match self {
            Self::Moment | Self::ContactMoment if dimension == 2 => 2..3,
            Self::VonMises | Self::Gap => 0..1,
            _ => 0..dimension,
        }
    }

    /// What its components are called.
    pub fn components(self, dimension: usize) -> &'static [&'static str] {
        match self {
            Self::VonMises => &["von-mises"],
            Self::Gap => &["gap"],
            _ => &["x", "y", "z"][self.axes(dimension)],
        }
    }

    /// Whether it is one number, without components.
    pub fn is_scalar(self) -> bool {
        matches!(self, Self::VonMises | Self::Gap)
    }

    /// Whether it is recorded of a boundary.
    pub fn is_of_boundary(self) -> bool {
        matches!(self, Self::Reaction | Self::Moment)
    }

    /// Whether it is between a body and others.
    pub fn is_of_contact(self) -> bool {
        matches!(self, Self::ContactForce | Self::ContactMoment | Self::Gap)
    }
}

/// What probes are read with.
pub(crate) struct ProbeReader<'a, 'b> {
    pub shapes: &'b mut ShapeReader<'a>,
    /// Names of all bodies and boundaries of the case, also of wrong ones.
    pub bodies: &'b [Option<&'a str>],
    pub boundaries: &'b [Option<&'a str>],
    /// Names of all bodies, and then tools.
    pub touching: &'b [Option<&'a str>],
}

impl ProbeReader<'_, '_> {
    /// One probe.
    pub(crate) fn read(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Probe> {
        section.only(keys::TABLE.keys, problems);
        let name = problems.keep(part_name(section));
        let of_contact = Quantity::WORDS.iter().any(|(word, quantity, _)| {
            let said = section.get(keys::QUANTITY.name).map(|node| &node.value);
            quantity.is_of_contact() && matches!(said, Some(Value::Text(text)) if text == word)
        });
        let spot = problems.keep(if of_contact { self.by(section) } else { self.spot(section) });
        let body = match spot {
            Some((Spot::Boundary(_), _)) => problems.keep(bodiless(section)),
            Some((Spot::Contact { .. }, _)) => problems.keep(body(section, self.touching)),
            _ => problems.keep(body(section, self.bodies)),
        };
        let quantity = problems.keep(quantity(section, spot.as_ref().map(|(spot, _)| spot)));
        if let (Some((Spot::Contact { by }, _)), Some(body), Some(Quantity::Gap)) = (&spot, body, quantity) {
            problems.keep(self.two(section, body, *by));
        }
        let interval = problems.keep(self.shapes.scope.get(section, &keys::INTERVAL));
        let reference = problems.keep(reference(section));
        let (spot, place) = spot?;
        Some(Probe {
            name: name?.to_string(),
            spot,
            body: body?,
            quantity: quantity?,
            interval: interval?.unwrap_or(defaults::PROBE_INTERVAL),
            reference: reference?,
            place,
        })
    }

    /// The other body of a probe of contact or of a gap.
    fn by(&self, section: &Section<'_>) -> Result<(Spot, Place), Diagnostic> {
        let others = [keys::AT.name, keys::REGION.name, keys::OF.name];
        if let Some(node) = others.iter().find_map(|key| section.get(key)) {
            let message =
                "a probe of contact, or of a gap, is of a whole body: it has no `at`, `region` or `of`";
            return Err(Diagnostic::at(node.place, message));
        }
        let by =
            section.get(keys::BY.name).map(|node| find(node, "body or tool", self.touching)).transpose()?;
        Ok((Spot::Contact { by }, section.place))
    }

    /// A gap is between two.
    fn two(&self, section: &Section<'_>, body: usize, by: Option<usize>) -> Result<(), Diagnostic> {
        if by == Some(body) || self.touching.len() < 2 {
            let message = "a gap is that between two bodies, or a body and a tool";
            let place = section.get(keys::BY.name).map_or(section.place, |node| node.place);
            return Err(Diagnostic::at(place, message).help("name one as `body` and the other as `by`"));
        }
        Ok(())
    }

    fn spot(&mut self, section: &Section<'_>) -> Result<(Spot, Place), Diagnostic> {
        let given: Vec<(&str, &Node)> = [keys::AT.name, keys::REGION.name, keys::OF.name]
            .into_iter()
            .filter_map(|key| Some((key, section.get(key)?)))
            .collect();
        if let Some(node) = section.get(keys::BY.name) {
            let message = "`by` belongs to the quantities contact-force, contact-moment and gap";
            return Err(Diagnostic::at(node.place, message));
        }
        match given.as_slice() {
            [] => Err(Diagnostic::at(section.place, "missing key `at`: the material point to follow").help(
                "for example at = [0.2, 0]; or region = \"NAME\" for the mean over the particles in it; or of = \"NAME\" for the reaction of a boundary",
            )),
            [("at", node)] => Ok((Spot::Point(self.shapes.scope.vector(node, &keys::AT)?), node.place)),
            [("region", node)] => Ok((Spot::Region(self.shapes.shape(node)?), node.place)),
            [(_, node)] => Ok((Spot::Boundary(self.boundary(node)?), node.place)),
            [.., (_, node)] => {
                let names: Vec<String> = given.iter().map(|(name, _)| format!("`{name}`")).collect();
                let message = format!("a probe follows one thing, found {}", names.join(" and "));
                Err(Diagnostic::at(node.place, message))
            }
        }
    }

    fn boundary(&self, node: &Node) -> Result<usize, Diagnostic> {
        if self.boundaries.iter().all(Option::is_none) && !self.boundaries.is_empty() {
            let message = "`of` names a boundary, and none of this case has a name";
            return Err(Diagnostic::at(node.place, message).help("give the [[boundary]] a name = \"...\""));
        }
        find(node, "boundary", self.boundaries)
    }
}

/// Which of these a probe belongs to.
fn body(section: &Section<'_>, bodies: &[Option<&str>]) -> Result<usize, Diagnostic> {
    match section.get("body") {
        Some(node) => find(node, "body", bodies),
        None if bodies.len() <= 1 => Ok(0),
        None => {
            let names: Vec<&str> = bodies.iter().copied().flatten().collect();
            let message = format!("{} has to say which `body` it belongs to", section.title);
            Err(Diagnostic::at(section.place, message).help(format!("the bodies are {}", names.join(", "))))
        }
    }
}

fn reference(section: &Section<'_>) -> Result<Option<Curves>, Diagnostic> {
    let Some(node) = section.get(keys::REFERENCE.name) else { return Ok(None) };
    let file = text(node, keys::REFERENCE.name)?.to_string();
    Ok(Some(Curves { file, place: node.place, text: None }))
}

/// A probe of a boundary belongs to no body.
fn bodiless(section: &Section<'_>) -> Result<usize, Diagnostic> {
    match section.get("body") {
        Some(node) => Err(Diagnostic::at(node.place, "a probe of a boundary belongs to no `body`")
            .help("remove this line: the reaction is that to all that the boundary holds")),
        None => Ok(0),
    }
}

/// What is recorded: of a boundary its reaction, of anything else its motion.
fn quantity(section: &Section<'_>, spot: Option<&Spot>) -> Result<Quantity, Diagnostic> {
    let of_boundary = matches!(spot, Some(Spot::Boundary(_)));
    let Some(node) = section.get(keys::QUANTITY.name) else {
        return Ok(if of_boundary { Quantity::Reaction } else { Quantity::Displacement });
    };
    let quantity = choice(node, keys::QUANTITY.name, Quantity::WORDS)?;
    match (of_boundary, quantity.is_of_boundary()) {
        (false, true) if spot.is_some() => {
            Err(Diagnostic::at(node.place, format!("a {} is that of a boundary", word(quantity)))
                .help("name the boundary with of = \"NAME\" instead of `at` or `region`"))
        }
        (true, false) => Err(Diagnostic::at(node.place, format!("a boundary has no {}", word(quantity)))
            .help("`of` goes with quantity = \"reaction\" or \"moment\"; the motion is that of a point `at` or a `region`")),
        _ => Ok(quantity),
    }
}
