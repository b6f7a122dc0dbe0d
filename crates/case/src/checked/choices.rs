//! The choices that a case makes by name.

/// How a body is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Formulation {
    /// Total Lagrangian, free of hourglass modes.
    TlHourglassFree,
    /// Total Lagrangian, stress from the deformation gradient (the plain nested form).
    TlNested,
    /// Updated Lagrangian, essentially free of hourglass modes.
    UlNonHourglass,
    /// Updated Lagrangian, stress from the velocity gradient (the plain nested form).
    UlNested,
}

/// What the neighbours of a body refer to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Neighbours of the reference configuration, kept for ever.
    Total,
    /// Neighbours of the present configuration, renewed.
    Updated,
}

impl Formulation {
    /// Names that a case may use.
    pub(crate) const NAMES: &'static [(&'static str, Self)] = &[
        ("tl-hourglass-free", Self::TlHourglassFree),
        ("tl-nested", Self::TlNested),
        ("ul-non-hourglass", Self::UlNonHourglass),
        ("ul-nested", Self::UlNested),
    ];

    /// Names that are reserved for what is not there yet.
    pub(crate) const LATER: &'static [&'static str] =
        &["tl-ganzenmueller", "ul-artificial-stress", "small-strain", "ul-generalised"];

    /// The name in case files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::TlHourglassFree => "tl-hourglass-free",
            Self::TlNested => "tl-nested",
            Self::UlNonHourglass => "ul-non-hourglass",
            Self::UlNested => "ul-nested",
        }
    }

    /// Total or updated Lagrangian.
    pub fn family(self) -> Family {
        match self {
            Self::TlHourglassFree | Self::TlNested => Family::Total,
            Self::UlNonHourglass | Self::UlNested => Family::Updated,
        }
    }
}

/// What two dimensions mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Plane {
    /// Plane strain: no stretch along the third axis, three-dimensional stress.
    Strain,
    /// As the papers' two-dimensional benchmarks: the deviator is formed with 1/2, the bulk modulus is the
    /// three-dimensional one. Up to 4 per cent softer than plane strain.
    Papers,
}

impl Plane {
    /// Names that a case may use.
    pub(crate) const NAMES: &'static [(&'static str, Self)] =
        &[("strain", Self::Strain), ("papers", Self::Papers)];
}

/// The smoothing kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// Wendland's C2 kernel, support 2h.
    WendlandC2,
    /// Cubic B-spline, support 2h.
    CubicSpline,
    /// Gaussian, cut at 3h.
    Gaussian,
}

impl Kernel {
    /// Names that a case may use.
    pub(crate) const NAMES: &'static [(&'static str, Self)] = &[
        ("wendland-c2", Self::WendlandC2),
        ("cubic-spline", Self::CubicSpline),
        ("gaussian", Self::Gaussian),
    ];
}

/// How an updated Lagrangian run renews its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stepping {
    /// Several acoustic steps for each renewal (an advection step).
    Dual,
    /// A renewal with each step.
    Single,
}

impl Stepping {
    /// Names that a case may use.
    pub(crate) const NAMES: &'static [(&'static str, Self)] =
        &[("dual", Self::Dual), ("single", Self::Single)];
}

/// How a total Lagrangian run bounds its time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StepRule {
    /// By the wave speed in the stretched material, measured in the reference configuration.
    Stretch,
    /// By the wave speed at rest (total Lagrangian paper, Eq. 33).
    Paper,
}

impl StepRule {
    /// Names that a case may use.
    pub(crate) const NAMES: &'static [(&'static str, Self)] =
        &[("stretch", Self::Stretch), ("paper", Self::Paper)];
}

/// An axis of space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third, in 3D only.
    Z,
}

impl Axis {
    /// Names that a case may use, in their order.
    pub(crate) const NAMES: &'static [(&'static str, Self)] =
        &[("x", Self::X), ("y", Self::Y), ("z", Self::Z)];

    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }
}
