//! Shapes and fillings.

/// Shapes: a table with one key, the kind of the shape.
pub(crate) mod shape {
    use super::super::{Key, Kind, Need, Range, Words};
    use crate::checked::MeshUnit;
    use crate::units::Dimension;

    const LENGTH: Kind = Kind::Number(Dimension::LENGTH, Range::Positive);
    const POINT: Kind = Kind::Vector(Dimension::LENGTH);

    const fn required(name: &'static str, kind: Kind, doc: &'static str) -> Key {
        Key::new(name, kind, Need::Required, doc)
    }

    pub(crate) const MIN: Key = required("min", POINT, "Corner of the smallest coordinates.");
    pub(crate) const MAX: Key = required("max", POINT, "Corner of the largest coordinates.");
    pub(crate) const CENTER: Key = required("center", POINT, "Centre.");
    pub(crate) const RADIUS: Key = required("radius", LENGTH, "Radius.");
    pub(crate) const INNER: Key =
        required("inner", Kind::Number(Dimension::LENGTH, Range::NotNegative), "Inner radius, may be 0.");
    pub(crate) const OUTER: Key = required("outer", LENGTH, "Outer radius.");
    pub(crate) const FROM: Key = required("from", POINT, "Centre of one end.");
    pub(crate) const TO: Key = required("to", POINT, "Centre of the other end.");
    pub(crate) const POINTS: Key =
        required("points", Kind::Pairs(Dimension::LENGTH), "Corners, the last joined to the first.");
    pub(crate) const HEIGHT: Key = Key::new(
        "height",
        Kind::Pair(Dimension::LENGTH),
        Need::Optional,
        "Lowest and highest z of the prism: required in 3D, refused in 2D.",
    );
    pub(crate) const STENT_LENGTH: Key = required("length", LENGTH, "Length along x, from x = 0.");
    pub(crate) const DIAMETER: Key = required("diameter", LENGTH, "Outer diameter.");
    pub(crate) const THICKNESS: Key = required("thickness", LENGTH, "Thickness of the wall.");
    const CELLS: Kind = Kind::Number(Dimension::NUMBER, Range::Positive);
    pub(crate) const AROUND: Key = required("around", CELLS, "Cells around the axis, 2 to 1000.");
    pub(crate) const ALONG: Key = required("along", CELLS, "Cells along the axis, 1 to 1000.");
    pub(crate) const STRUT: Key = required("strut", LENGTH, "Width of struts and bridges.");
    pub(crate) const BRIDGE: Key = required(
        "bridge",
        LENGTH,
        "Length of the bridges along the axis, which join struts of neighbouring rows.",
    );
    pub(crate) const FILE: Key = required(
        "file",
        Kind::Text,
        "The file, STL or OBJ; its path is relative to the case file. `taut mesh FILE` tells what is in it.",
    );
    pub(crate) const UNIT: Key = required(
        "unit",
        Kind::Choice(<MeshUnit as Words>::choices),
        "The unit of its coordinates, which files do not say.",
    );
    pub(crate) const BY: Key = required("by", POINT, "How far.");
    pub(crate) const ANGLE: Key = required(
        "angle",
        Kind::Number(Dimension::NUMBER, Range::Any),
        "By how much, in radians (or \"30 deg\"), right-handed.",
    );
    pub(crate) const AXIS: Key = Key::new(
        "axis",
        Kind::Vector(Dimension::NUMBER),
        Need::Optional,
        "Direction of the axis: required in 3D, refused in 2D.",
    );
    pub(crate) const ABOUT: Key =
        Key::new("about", POINT, Need::Default("the origin"), "The point that stays.");
    pub(crate) const FACTOR: Key =
        required("factor", Kind::Number(Dimension::NUMBER, Range::Positive), "By how much.");
    pub(crate) const SHAPE: Key = required("shape", Kind::Shape, "What.");

    /// Kind, meaning, keys; those without keys are lists of shapes.
    pub(crate) const KINDS: &[(&str, &str, &[Key])] = &[
        ("box", "All points between two corners (in 2D a rectangle).", &[MIN, MAX]),
        ("ball", "All points within a distance (in 2D a disc).", &[CENTER, RADIUS]),
        ("ring", "All points between two circles (in 3D between two spheres).", &[CENTER, INNER, OUTER]),
        ("hollow-ball", "The same in 3D, by its own name.", &[CENTER, INNER, OUTER]),
        ("cylinder", "3D: a straight cylinder with flat ends.", &[FROM, TO, RADIUS]),
        ("polygon", "A closed polygon in x and y; in 3D the prism above it.", &[POINTS, HEIGHT]),
        (
            "stent",
            "3D: a tube around the x axis with six-sided cells cut into it, in staggered rows; struts lead in zigzag from row to row. With an even number of cells along and around, a bridge of the middle row is where y is largest, and one where it is smallest.",
            &[STENT_LENGTH, DIAMETER, THICKNESS, AROUND, ALONG, STRUT, BRIDGE],
        ),
        ("mesh", "3D: what the triangles of a file enclose.", &[FILE, UNIT]),
        ("union", "Points in any of the shapes of a list.", &[]),
        ("intersection", "Points in all of the shapes of a list.", &[]),
        ("difference", "Points in the first shape of a list and in none of the others.", &[]),
        ("translate", "A shape, moved.", &[BY, SHAPE]),
        ("rotate", "A shape, turned.", &[ANGLE, AXIS, ABOUT, SHAPE]),
        ("scale", "A shape, made larger or smaller.", &[FACTOR, ABOUT, SHAPE]),
    ];

    /// The keys of a kind.
    pub(crate) fn keys(kind: &str) -> &'static [Key] {
        KINDS.iter().find(|(name, ..)| *name == kind).map_or(&[], |(_, _, keys)| keys)
    }
}

/// Fillings.
pub(crate) mod fill {
    use super::super::{Choice, Key, Kind, Need, Range};
    use crate::units::Dimension;

    pub(crate) const ORIGIN: Key = Key::new(
        "origin",
        Kind::Vector(Dimension::LENGTH),
        Need::Required,
        "A corner of one cell; particles stand in the middle of cells.",
    );
    pub(crate) const AROUND: Key = Key::new(
        "around",
        Kind::Number(Dimension::NUMBER, Range::Positive),
        Need::Required,
        "Particles of each ring, a whole number from 3 on.",
    );
    pub(crate) const RINGS: Key = Key::new(
        "rings",
        Kind::Number(Dimension::NUMBER, Range::Positive),
        Need::Default("the wall over the spacing, rounded"),
        "How many rings, a whole number.",
    );
    pub(crate) const POLAR: &str = "polar";
    pub(crate) const LATTICE: &str = "lattice";
    pub(crate) const CONCENTRIC: &str = "concentric";
    pub(crate) const FITTED: &str = "fitted";
    pub(crate) const PARTICLES: &str = "particles";

    /// The words.
    pub(crate) const CHOICES: &[Choice] = &[
        Choice {
            name: LATTICE,
            doc: "A square lattice through the origin; { lattice = { origin = [..] } } moves it.",
        },
        Choice { name: CONCENTRIC, doc: "Layers around the centre of a ring or ball." },
        Choice {
            name: FITTED,
            doc: "Particles that settle until they are evenly spread, those at the surface half a spacing inside; `{ particles = \"FILE.vtp\" }` takes those of a file that `taut particles` wrote, as far as they lie in the shape.",
        },
    ];
}
