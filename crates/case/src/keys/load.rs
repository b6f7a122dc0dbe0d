//! `[[load]]`.

use super::{Key, Kind, Need, Table};
use crate::units::Dimension;

pub(crate) const BODY: Key =
    Key::new("body", Kind::NameOf("body"), Need::Default("all bodies"), "The body that is meant.");
pub(crate) const REGION: Key = Key::new(
    "region",
    Kind::Shape,
    Need::Optional,
    "Where it acts: for `force` on the particles whose reference position is in this shape, for `traction` and `pressure` on the outer faces of particles whose middle is in it (half a spacing outside of the particles: a box a quarter of a spacing to both sides of a side has the faces of that side alone).",
);
pub(crate) const AT: Key = Key::new(
    "at",
    Kind::Vector(Dimension::LENGTH),
    Need::Optional,
    "For `force` instead of `region`: a point of the undeformed body; the force is spread over the particles that the kernel reaches from there, by its weight.",
);
/// Of these exactly one is given.
pub(crate) const KINDS: [Key; 3] = [
    Key::new(
        "force",
        Kind::Field(Dimension::FORCE),
        Need::Optional,
        "Total force by axis, N (in 2D per metre of depth), a function of reference position and time; it keeps its direction.",
    ),
    Key::new(
        "traction",
        Kind::Field(Dimension::PRESSURE),
        Need::Optional,
        "Force per area of the undeformed surface, by axis; it keeps its direction (a dead load).",
    ),
    Key::new(
        "pressure",
        Kind::Scalar(Dimension::PRESSURE),
        Need::Optional,
        "Pressure on the deformed surface; it follows the surface as it turns and stretches. Positive presses. For total Lagrangian bodies.",
    ),
];
pub(crate) const HISTORY: Key = Key::new(
    "history",
    Kind::History,
    Need::Default("1 at all times"),
    "Factor over time: a list of [time, factor], or the name of a CSV file of such rows (beside the case file). Between its times it is interpolated, before and after them it stays as it is.",
);

pub(crate) const TABLE: Table = Table {
    header: "[[load]]",
    doc: "A force on particles or on a part of the surface: exactly one of force, traction and pressure; several add up. Surfaces are the outer faces of particles on a lattice, each of area dp^2 (in 2D dp).",
    keys: &[BODY, REGION, AT, KINDS[0], KINDS[1], KINDS[2], HISTORY],
    example: "[[load]]\nregion = { box = { min = [\"L - dp/4\", 0], max = [\"L + dp/4\", \"H\"] } }\ntraction = [0, \"-2 kPa\"]\nhistory = [[0, 0], [\"10 ms\", 1]]",
};
