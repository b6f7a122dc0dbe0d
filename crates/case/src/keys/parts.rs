//! The tables that a case may have several of.

use super::{Key, Kind, Need, Range, Table, Words};
use crate::units::Dimension;

/// The shape key of parts that pick particles.
const fn region(need: Need) -> Key {
    Key::new(
        "region",
        Kind::Shape,
        need,
        "Particles whose reference position is in this shape (or in the region of this name).",
    )
}

const fn body_of(default: &'static str) -> Key {
    Key::new("body", Kind::NameOf("body"), Need::Default(default), "The body that is meant.")
}

/// `[[body]]`.
pub(crate) mod body {
    use super::*;
    use crate::checked::Formulation;

    pub(crate) const NAME: Key = Key::new("name", Kind::Name, Need::Required, "Its name.");
    pub(crate) const MATERIAL: Key =
        Key::new("material", Kind::NameOf("material"), Need::Required, "The name of its material.");
    pub(crate) const SHAPE: Key = Key::new("shape", Kind::Shape, Need::Required, "Where it is, undeformed.");
    pub(crate) const FILL: Key =
        Key::new("fill", Kind::Fill, Need::Default("lattice"), "How particles fill the shape.");
    pub(crate) const VELOCITY: Key = Key::new(
        "velocity",
        Kind::Place(Dimension::SPEED),
        Need::Default("at rest"),
        "Velocity at the start, by axis: a function of the reference position.",
    );
    pub(crate) const FORMULATION: Key = Key::new(
        "formulation",
        Kind::Choice(Formulation::choices),
        Need::Default("that of the case"),
        "How this body is solved.",
    );
    pub(crate) const SMOOTHING: Key = Key::new(
        "smoothing",
        Kind::Number(Dimension::NUMBER, Range::Smoothing),
        Need::Default("that of the case"),
        "Smoothing length over the spacing of the case, of this body.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[body]]",
        doc: "A deformable body. Bodies touch each other and tools; `[[contact]]` says how.",
        keys: &[NAME, MATERIAL, SHAPE, FILL, VELOCITY, FORMULATION, SMOOTHING],
        example: "[[body]]\nname = \"strip\"\nmaterial = \"rubber\"\nshape = { box = { min = [0, 0], max = [\"L\", \"H\"] } }\nvelocity = [0, \"0.1*sin(pi*x/L)\"]",
    };
}

/// `[[boundary]]`.
pub(crate) mod boundary {
    use super::*;

    pub(crate) const NAME: Key = Key::new(
        "name",
        Kind::Name,
        Need::Default("boundary-1, -2, ..."),
        "Its name, for probes of its reaction and in reactions.csv.",
    );
    pub(crate) const BODY: Key = body_of("all bodies");
    pub(crate) const REGION: Key = region(Need::Required);
    pub(crate) const EXCEPT: Key =
        Key::new("except", Kind::Shape, Need::Default("none"), "Particles of the region that stay free.");
    /// Of these exactly one is given.
    pub(crate) const CONSTRAINTS: [Key; 4] = [
        Key::new("fixed", Kind::True, Need::Optional, "Nothing moves."),
        Key::new("fix", Kind::Axes, Need::Optional, "Nothing moves along these axes."),
        Key::new(
            "velocity",
            Kind::FieldOrFree(Dimension::SPEED),
            Need::Optional,
            "Prescribed velocity by axis; \"free\" leaves an axis free.",
        ),
        Key::new(
            "displacement",
            Kind::FieldOrFree(Dimension::LENGTH),
            Need::Optional,
            "Prescribed displacement from the reference position by axis; \"free\" leaves an axis free.",
        ),
    ];
    pub(crate) const TABLE: Table = Table {
        header: "[[boundary]]",
        doc: "Particles whose motion is prescribed: exactly one of fixed, fix, velocity and displacement.",
        keys: &[NAME, BODY, REGION, EXCEPT, CONSTRAINTS[0], CONSTRAINTS[1], CONSTRAINTS[2], CONSTRAINTS[3]],
        example: "[[boundary]]\nregion = \"foot\"\nfixed = true",
    };
}

/// `[[initial]]`.
pub(crate) mod initial {
    use super::*;

    pub(crate) const REGION: Key = region(Need::Required);
    pub(crate) const BODY: Key = body_of("all bodies");
    pub(crate) const VELOCITY: Key = Key::new(
        "velocity",
        Kind::Place(Dimension::SPEED),
        Need::Required,
        "Velocity at the start, by axis: a function of the reference position.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[initial]]",
        doc: "A velocity at the start in a region; it replaces that of the body.",
        keys: &[REGION, BODY, VELOCITY],
        example: "[[initial]]\nregion = \"foot\"\nvelocity = [0, \"-1 m/s\"]",
    };
}

/// `[[gravity]]`.
pub(crate) mod gravity {
    use super::*;

    pub(crate) const ACCELERATION: Key = Key::new(
        "acceleration",
        Kind::Field(Dimension::ACCELERATION),
        Need::Required,
        "Force per mass, by axis: a function of reference position and time.",
    );
    pub(crate) const BODY: Key = body_of("all bodies");
    pub(crate) const REGION: Key = region(Need::Default("everywhere"));
    pub(crate) const TABLE: Table = Table {
        header: "[[gravity]]",
        doc: "A body force; several add up.",
        keys: &[ACCELERATION, BODY, REGION],
        example: "[[gravity]]\nacceleration = [0, \"-9.81 m/s^2\"]",
    };
}

/// `[[probe]]`.
pub(crate) mod probe {
    use super::*;
    use crate::checked::Quantity;

    pub(crate) const NAME: Key =
        Key::new("name", Kind::Name, Need::Required, "Its name; becomes probes/NAME.csv and NAME.svg.");
    pub(crate) const AT: Key = Key::new(
        "at",
        Kind::Vector(Dimension::LENGTH),
        Need::Optional,
        "The material point to follow, by its reference position; either this or `region` or `of` (none for what contact does, and for gaps).",
    );
    pub(crate) const REGION: Key = Key::new(
        "region",
        Kind::Shape,
        Need::Optional,
        "Follow the mean over the particles whose reference position is in this shape; either this or `at` or `of`.",
    );
    pub(crate) const OF: Key = Key::new(
        "of",
        Kind::NameOf("boundary"),
        Need::Optional,
        "The boundary whose reaction is recorded: what it has to exert, the mean since the sample before; for the quantities `reaction` and `moment`.",
    );
    pub(crate) const BODY: Key = Key::new(
        "body",
        Kind::NameOf("body"),
        Need::Default("the only one"),
        "The body that is meant; for what contact does, and for gaps, a body or tool.",
    );
    pub(crate) const BY: Key = Key::new(
        "by",
        Kind::NameOf("body or tool"),
        Need::Default("all"),
        "Whose force it is, or to whom the gap; for `contact-force`, `contact-moment` and `gap`.",
    );
    pub(crate) const QUANTITY: Key = Key::new(
        "quantity",
        Kind::Choice(Quantity::choices),
        Need::Default("displacement; reaction with `of`"),
        "What is recorded.",
    );
    pub(crate) const INTERVAL: Key = Key::new(
        "interval",
        Kind::Number(Dimension::TIME, Range::NotNegative),
        Need::Default("0"),
        "Time between two samples; 0 is every step.",
    );
    pub(crate) const REFERENCE: Key = Key::new(
        "reference",
        Kind::Text,
        Need::Optional,
        "A table of curves to compare with, drawn dashed into the plot: a CSV file beside the case file, with a first line such as `time [s],y [m]`, and lines `# ...` before it that say where the curves come from.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[probe]]",
        doc: "A material point (or a region) whose motion is recorded, a boundary whose reaction is, or a body or tool that is pushed.",
        keys: &[NAME, AT, REGION, OF, BODY, BY, QUANTITY, INTERVAL, REFERENCE],
        example: "[[probe]]\nname = \"tip\"\nat = [\"L\", \"H/2\"]",
    };
}

/// `[[measure]]`.
pub(crate) mod measure {
    use super::*;
    use crate::checked::{Axis, Extremum, Measured, Seen};

    pub(crate) const NAME: Key =
        Key::new("name", Kind::Name, Need::Required, "Its name under `measured` in summary.json.");
    pub(crate) const KIND: Key =
        Key::new("kind", Kind::Choice(Measured::choices), Need::Required, "What it is.");
    pub(crate) const PROBE: Key = Key::new(
        "probe",
        Kind::NameOf("probe"),
        Need::Optional,
        "The probe whose curve is read; for kinds that read a curve, and for turns.",
    );
    pub(crate) const COMPONENT: Key = Key::new(
        "component",
        Kind::Choice(Axis::choices),
        Need::Optional,
        "The component of the probe, unless it records one number; for kinds that read a curve.",
    );
    pub(crate) const EXTREMUM: Key = Key::new(
        "extremum",
        Kind::Choice(Extremum::choices),
        Need::Optional,
        "Whether minima or maxima are counted; for `turning-points`.",
    );
    pub(crate) const PROMINENCE: Key = Key::new(
        "prominence",
        Kind::OfProbe,
        Need::Optional,
        "The curve has to come back by so much on both sides of a turning point; for `turning-points`.",
    );
    pub(crate) const INDEX: Key = Key::new(
        "index",
        Kind::Count,
        Need::Optional,
        "Which turning point, counted from 1; for `turning-points`.",
    );
    pub(crate) const TIME: Key = Key::new(
        "time",
        Kind::Number(Dimension::TIME, Range::NotNegative),
        Need::Optional,
        "When; for `value-at` and `turns-at`.",
    );
    pub(crate) const AXIS: Key = Key::new(
        "axis",
        Kind::Choice(Axis::choices),
        Need::Optional,
        "The axis that the probe goes around, right-handed, through the origin; in 2D z; for turns.",
    );
    pub(crate) const BODY: Key = Key::new(
        "body",
        Kind::NameOf("body"),
        Need::Optional,
        "The body; for `rebound-speed` and `volume-ratio`, and where fields are not to be those of all bodies.",
    );
    pub(crate) const FIELD: Key =
        Key::new("field", Kind::Choice(Seen::choices), Need::Optional, "Which field; for `largest`.");
    pub(crate) const DISPLACEMENT: Key = Key::new(
        "displacement",
        Kind::Field(Dimension::LENGTH),
        Need::Optional,
        "What the displacement should be, by axis: a function of reference position and time. For `error-max`, `error-rms` and `ratio`.",
    );
    pub(crate) const VON_MISES: Key = Key::new(
        "von_mises",
        Kind::Scalar(Dimension::PRESSURE),
        Need::Optional,
        "What the von Mises stress should be: a function of reference position and time. For `error-max`, `error-rms` and `ratio`.",
    );
    pub(crate) const REGION: Key = region(Need::Optional);
    pub(crate) const ALIGNED: Key = Key::new(
        "aligned",
        Kind::Flag,
        Need::Default("false"),
        "Whether the translation and small turn of all particles that fit best are taken out of the displacements: for bodies that nothing holds.",
    );
    pub(crate) const OVER: Key = Key::new(
        "over",
        Kind::OfProbe,
        Need::Optional,
        "Divide by this: the result is a ratio. For `maximum`, `minimum`, `turning-points` and `value-at`.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[[measure]]",
        doc: "A named result: a number that summary.json has under `measured`.",
        keys: &[
            NAME,
            KIND,
            PROBE,
            COMPONENT,
            EXTREMUM,
            PROMINENCE,
            INDEX,
            TIME,
            AXIS,
            BODY,
            OVER,
            FIELD,
            DISPLACEMENT,
            VON_MISES,
            REGION,
            ALIGNED,
        ],
        example: "[[measure]]\nname = \"period\"\nkind = \"second-crossing\"\nprobe = \"tip\"\ncomponent = \"y\"",
    };
}
