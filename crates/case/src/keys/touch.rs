//! What touches: rigid tools, and how bodies meet.

use super::{Key, Kind, Need, Range, Table};
use crate::units::Dimension;

/// `[[tool]]`.
pub(crate) mod tool {
    use super::*;

    pub(crate) const NAME: Key = Key::new("name", Kind::Name, Need::Required, "Its name.");
    pub(crate) const SHAPE: Key = Key::new("shape", Kind::Shape, Need::Required, "Where it is at the start.");
    pub(crate) const FILL: Key =
        Key::new("fill", Kind::Fill, Need::Default("lattice"), "How particles fill the shape.");
    pub(crate) const DISPLACEMENT: Key = Key::new(
        "displacement",
        Kind::OfTime(Dimension::LENGTH),
        Need::Default("it stays"),
        "How far it has moved from where it was, by axis; either this or `velocity`.",
    );
    pub(crate) const VELOCITY: Key = Key::new(
        "velocity",
        Kind::OfTime(Dimension::SPEED),
        Need::Default("it stays"),
        "How fast it moves, by axis; either this or `displacement`.",
    );
    pub(crate) const ANGLE: Key = Key::new(
        "angle",
        Kind::AngleOfTime,
        Need::Default("it does not turn"),
        "How far it has turned about the axis, right-handed.",
    );
    pub(crate) const ABOUT: Key = Key::new(
        "about",
        Kind::Vector(Dimension::LENGTH),
        Need::Default("the origin"),
        "A point of the axis that it turns about, at the start; the axis moves with the tool.",
    );
    pub(crate) const AXIS: Key = Key::new(
        "axis",
        Kind::Vector(Dimension::NUMBER),
        Need::Default("z"),
        "The direction of that axis; in 2D there is no such key.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[tool]]",
        doc: "A rigid body that moves as it is told: no equation is solved for it. What touches it, it pushes.",
        keys: &[NAME, SHAPE, FILL, DISPLACEMENT, VELOCITY, ANGLE, ABOUT, AXIS],
        example: "[[tool]]\nname = \"punch\"\nshape = { box = { min = [0, \"H\"], max = [\"L\", \"H + 0.3 mm\"] } }\nvelocity = [0, \"-2 mm/s\"]",
    };
}

/// `[[contact]]`.
pub(crate) mod contact {
    use super::*;

    pub(crate) const BODIES: Key = Key::new(
        "bodies",
        Kind::NamesOf("body or tool"),
        Need::Required,
        "Two bodies or tools; or one body, which is then to touch itself.",
    );
    pub(crate) const FRICTION: Key = Key::new(
        "friction",
        Kind::Number(Dimension::NUMBER, Range::NotNegative),
        Need::Default("0"),
        "Coefficient of Coulomb friction.",
    );
    pub(crate) const IGNORE: Key =
        Key::new("ignore", Kind::True, Need::Optional, "They pass through each other.");
    pub(crate) const PENALTY: Key = Key::new(
        "penalty",
        Kind::Number(Dimension::MOMENT, Range::Positive),
        Need::Optional,
        "Instead of the general contact: every particle at the edge of one body pushes every one of the other by p (l^6 - l^4)/r at a distance r below `reach`, with l = reach/r. This p, N m (in 2D per metre of depth).",
    );
    pub(crate) const REACH: Key = Key::new(
        "reach",
        Kind::Number(Dimension::LENGTH, Range::Positive),
        Need::Optional,
        "The distance from which on they do; with `penalty`.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[contact]]",
        doc: "How two bodies meet. Without it all bodies and tools touch each other without friction, and no total Lagrangian body touches itself. How stiff contact is follows from the materials.",
        keys: &[BODIES, FRICTION, IGNORE, PENALTY, REACH],
        example: "[[contact]]\nbodies = [\"strip\", \"punch\"]\nfriction = 0.3",
    };
}
