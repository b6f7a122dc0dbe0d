//! The top level of a case file, and the tables that stand there once.

/// The top level.
pub(crate) mod case {
    use super::super::{
        Key, Kind, Need, Range, Table, Words, body, boundary, contact, damping, gravity, initial, load,
        measure, probe, quasi_static, tool,
    };
    use super::{material, monitor, region, time};
    use crate::checked::{Calibration, Formulation, Kernel, Normalisation, Plane, Stepping};
    use crate::units::Dimension;

    pub(crate) const NAME: Key = Key::new(
        "name",
        Kind::Name,
        Need::Required,
        "Short name, of small letters, digits and `-`; also the name of the output folder.",
    );
    pub(crate) const TITLE: Key =
        Key::new("title", Kind::Text, Need::Default("the name"), "One line about the case, for people.");
    pub(crate) const DIMENSION: Key = Key::new(
        "dimension",
        Kind::OneOf(&[2, 3]),
        Need::Required,
        "2 or 3. In two dimensions a body is a prism of unit depth.",
    );
    pub(crate) const PLANE: Key = Key::new(
        "plane",
        Kind::Choice(Plane::choices),
        Need::Default("strain, in 2D"),
        "What two dimensions mean; in 3D there is no such key.",
    );
    pub(crate) const FORMULATION: Key = Key::new(
        "formulation",
        Kind::Choice(Formulation::choices),
        Need::Default("tl-hourglass-free"),
        "How bodies are solved that do not name their own formulation.",
    );
    pub(crate) const STEPPING: Key = Key::new(
        "stepping",
        Kind::Choice(Stepping::choices),
        Need::Default("dual; single for ul-nested, ul-artificial-stress and ul-artificial-stress-corrected"),
        "How updated Lagrangian bodies renew their neighbours; total Lagrangian ones never do.",
    );
    pub(crate) const SPACING: Key = Key::new(
        "spacing",
        Kind::Number(Dimension::LENGTH, Range::Positive),
        Need::Required,
        "Distance of particles, and so the resolution. At least 4 particles belong into the thinnest part.",
    );
    pub(crate) const KERNEL: Key = Key::new(
        "kernel",
        Kind::Choice(Kernel::choices),
        Need::Default("wendland-c2"),
        "The smoothing kernel.",
    );
    pub(crate) const SMOOTHING: Key = Key::new(
        "smoothing",
        Kind::Number(Dimension::NUMBER, Range::Smoothing),
        Need::Default("1.15 total Lagrangian, 1.3 updated Lagrangian"),
        "Smoothing length over spacing, h/dp: how far a particle looks.",
    );
    pub(crate) const REFERENCE_SPEED: Key = Key::new(
        "reference_speed",
        Kind::Number(Dimension::SPEED, Range::NotNegative),
        Need::Default("0"),
        "Least speed of the advection step of updated Lagrangian bodies: they renew their neighbours at least as often as if something moved at this speed. For bodies that come to rest.",
    );
    pub(crate) const ALPHA: Key = Key::new(
        "alpha",
        Kind::Number(Dimension::NUMBER, Range::NotNegative),
        Need::Default("10"),
        "Strength of the hourglass control of `tl-ganzenmueller`: a number to be tuned. Too little lets zigzag grow, too much makes bodies too stiff.",
    );
    pub(crate) const ARTIFICIAL_STRESS: Key = Key::new(
        "artificial_stress",
        Kind::Number(Dimension::NUMBER, Range::NotNegative),
        Need::Default("0.3"),
        "Strength of the artificial stress of `ul-artificial-stress` and `ul-artificial-stress-corrected`, eps of Gray et al. (2001), who have 0.3.",
    );
    pub(crate) const KELVIN_VOIGT: Key = Key::new(
        "kelvin_voigt",
        Kind::Number(Dimension::NUMBER, Range::NotNegative),
        Need::Default("1"),
        "Factor of the Kelvin-Voigt damping of total Lagrangian bodies, rho0 c h / 2 (TL Eq. 23); 1 as in the paper, 0 for none. `tl-hourglass-free` is not stable without it.",
    );
    pub(crate) const CALIBRATION: Key = Key::new(
        "calibration",
        Kind::Choice(Calibration::choices),
        Need::Default("paper"),
        "The factors of the force of `tl-hourglass-free`.",
    );
    pub(crate) const SHEAR_STRESS: Key = Key::new(
        "shear_stress",
        Kind::Flag,
        Need::Default("true"),
        "Whether `ul-non-hourglass`, whose motion needs no shear stress, integrates one to be looked at. Without it files and pictures have the pressure alone, and the run is faster.",
    );
    pub(crate) const NORMALISATION: Key = Key::new(
        "normalisation",
        Kind::Choice(Normalisation::choices),
        Need::Default("adjoint"),
        "What `small-strain` does about the part of the kernel that is missing at the edge of a body.",
    );
    const PARAMETERS: Key = Key::new(
        "parameters",
        Kind::Parameters,
        Need::Optional,
        "Numbers by name, for expressions and for `--set parameters.NAME=VALUE`. A parameter may be an expression of others.",
    );

    const fn table(name: &'static str, kind: Kind, need: Need, table: &'static Table) -> Key {
        Key::new(name, kind, need, table.doc)
    }

    /// The table.
    pub(crate) const TABLE: Table = Table {
        header: "the case",
        doc: "The top level of the file, before the first header.",
        keys: &[
            NAME,
            TITLE,
            DIMENSION,
            PLANE,
            FORMULATION,
            STEPPING,
            SPACING,
            KERNEL,
            SMOOTHING,
            REFERENCE_SPEED,
            ALPHA,
            ARTIFICIAL_STRESS,
            KELVIN_VOIGT,
            CALIBRATION,
            SHEAR_STRESS,
            NORMALISATION,
            PARAMETERS,
            table("material", Kind::Named(&material::TABLE), Need::Required, &material::TABLE),
            table("region", Kind::Named(&region::TABLE), Need::Optional, &region::TABLE),
            table("body", Kind::List(&body::TABLE), Need::Required, &body::TABLE),
            table("tool", Kind::List(&tool::TABLE), Need::Optional, &tool::TABLE),
            table("contact", Kind::List(&contact::TABLE), Need::Optional, &contact::TABLE),
            table("boundary", Kind::List(&boundary::TABLE), Need::Optional, &boundary::TABLE),
            table("initial", Kind::List(&initial::TABLE), Need::Optional, &initial::TABLE),
            table("gravity", Kind::List(&gravity::TABLE), Need::Optional, &gravity::TABLE),
            table("load", Kind::List(&load::TABLE), Need::Optional, &load::TABLE),
            table("time", Kind::Table(&time::TABLE), Need::Required, &time::TABLE),
            table("damping", Kind::Table(&damping::TABLE), Need::Optional, &damping::TABLE),
            table("quasi_static", Kind::Table(&quasi_static::TABLE), Need::Optional, &quasi_static::TABLE),
            table("monitor", Kind::Table(&monitor::TABLE), Need::Optional, &monitor::TABLE),
            table("probe", Kind::List(&probe::TABLE), Need::Optional, &probe::TABLE),
            table("measure", Kind::List(&measure::TABLE), Need::Optional, &measure::TABLE),
        ],
        example: "name = \"strip\"\ntitle = \"A strip swings\"\ndimension = 2\nspacing = \"dp\"\n\n[parameters]\nH = \"2 cm\"\ndp = \"H/10\"",
    };
}

/// `[material.NAME]`.
pub(crate) mod material {
    use super::super::{Key, Kind, Need, Range, Table, Words};
    use crate::checked::Model;
    use crate::units::Dimension;

    const fn modulus(name: &'static str, doc: &'static str) -> Key {
        Key::new(name, Kind::Number(Dimension::PRESSURE, Range::Positive), Need::Optional, doc)
    }

    pub(crate) const MODEL: Key =
        Key::new("model", Kind::Choice(Model::choices), Need::Required, "The law of stress.");
    pub(crate) const DENSITY: Key = Key::new(
        "density",
        Kind::Number(Dimension::DENSITY, Range::Positive),
        Need::Required,
        "Density at rest.",
    );
    /// The four constants, of which two are given.
    pub(crate) const ELASTIC: [Key; 4] = [
        modulus("youngs_modulus", "Young's modulus E; give two of the four elastic constants."),
        Key::new(
            "poisson_ratio",
            Kind::Number(Dimension::NUMBER, Range::Poisson),
            Need::Optional,
            "Poisson's ratio nu; give two of the four elastic constants.",
        ),
        modulus(
            "bulk_modulus",
            "Bulk modulus K, of three dimensions; give two of the four elastic constants.",
        ),
        modulus("shear_modulus", "Shear modulus G; give two of the four elastic constants."),
    ];
    pub(crate) const TABLE: Table = Table {
        header: "[material.NAME]",
        doc: "What bodies are made of: a law, a density, and two of the four elastic constants.",
        keys: &[MODEL, DENSITY, ELASTIC[0], ELASTIC[1], ELASTIC[2], ELASTIC[3]],
        example: "[material.rubber]\nmodel = \"neo-hookean\"\ndensity = \"1.1 g/cm^3\"\nyoungs_modulus = \"17 MPa\"\npoisson_ratio = 0.45",
    };
}

/// `[region.NAME]`.
pub(crate) mod region {
    use super::super::{Key, Kind, Need, Table};

    pub(crate) const SHAPE: Key = Key::new("shape", Kind::Shape, Need::Required, "The shape.");
    pub(crate) const TABLE: Table = Table {
        header: "[region.NAME]",
        doc: "A shape with a name, to be used wherever a shape is expected.",
        keys: &[SHAPE],
        example: "[region.foot]\nshape = { box = { min = [-1, -1], max = [0, 1] } }",
    };
}

/// `[time]`.
pub(crate) mod time {
    use super::super::{Key, Kind, Need, Range, Table, Words};
    use crate::checked::StepRule;
    use crate::units::Dimension;

    pub(crate) const END: Key = Key::new(
        "end",
        Kind::Number(Dimension::TIME, Range::Positive),
        Need::Required,
        "When the run ends; it begins at 0.",
    );
    pub(crate) const OUTPUT: Key = Key::new(
        "output",
        Kind::Number(Dimension::TIME, Range::Positive),
        Need::Default("end/50, but 500 steps or end/5 apart"),
        "Time between two frames for ParaView.",
    );
    pub(crate) const CFL: Key = Key::new(
        "cfl",
        Kind::Number(Dimension::NUMBER, Range::Share),
        Need::Default(
            "0.6 total Lagrangian, 0.4 updated Lagrangian and tl-ganzenmueller; 0.8 for small-strain",
        ),
        "Fraction of the stable time step that is taken.",
    );
    pub(crate) const STEP: Key = Key::new(
        "step",
        Kind::Choice(StepRule::choices),
        Need::Default("stretch"),
        "How total Lagrangian bodies bound their time step.",
    );
    pub(crate) const DT: Key = Key::new(
        "dt",
        Kind::Number(Dimension::TIME, Range::Positive),
        Need::Default("cfl times the limit of stability"),
        "A time step for `small-strain`, whose limit of stability does not change in a run; longer than that limit it blows up.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[time]",
        doc: "How long the run is, and how often something is written.",
        keys: &[END, OUTPUT, CFL, STEP, DT],
        example: "[time]\nend = \"0.5 s\"\noutput = \"10 ms\"",
    };
}

/// `[monitor]`.
pub(crate) mod monitor {
    use super::super::{Key, Kind, Need, Range, Table};
    use crate::units::Dimension;

    pub(crate) const ZIGZAG: Key = Key::new(
        "zigzag",
        Kind::Number(Dimension::NUMBER, Range::Positive),
        Need::Default("0.06"),
        "The run warns, once, when the root mean square of the zigzag over the spacing is larger: zero-energy modes grow.",
    );
    pub(crate) const BOND_MIN: Key = Key::new(
        "bond_min",
        Kind::Number(Dimension::NUMBER, Range::Positive),
        Need::Default("0.3"),
        "The run warns, once, when two particles that were neighbours come closer than this many spacings.",
    );
    pub(crate) const BROKEN: Key = Key::new(
        "broken",
        Kind::Number(Dimension::NUMBER, Range::Positive),
        Need::Default("0.01"),
        "The run warns, once, when a larger share of the bonds between neighbours is broken: one and a half times as long as the strain around them makes them.",
    );
    pub(crate) const STOP: Key = Key::new(
        "stop",
        Kind::Flag,
        Need::Default("false"),
        "Whether the run ends, with a diagnosis, where it would warn.",
    );
    pub(crate) const INTERVAL: Key = Key::new(
        "interval",
        Kind::Number(Dimension::TIME, Range::Positive),
        Need::Default("as [time] output; disorder 1000 steps apart"),
        "Time between two measurements of energies and disorder.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[monitor]",
        doc: "The watch over the disorder of the particles.",
        keys: &[ZIGZAG, BOND_MIN, BROKEN, STOP, INTERVAL],
        example: "[monitor]\nzigzag = \"1 %\"\nstop = true",
    };
}
