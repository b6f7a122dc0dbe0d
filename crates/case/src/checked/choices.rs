//! The choices that a case makes by name.

use crate::keys::Words;

/// The word for something.
pub(super) fn word<T: Words + PartialEq>(thing: T) -> &'static str {
    T::WORDS.iter().find(|(_, other, _)| *other == thing).map_or("", |(name, ..)| name)
}

/// How a body is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Formulation {
    /// Total Lagrangian, free of hourglass modes.
    TlHourglassFree,
    /// Total Lagrangian, stress from the deformation gradient (the plain nested form).
    TlNested,
    /// Total Lagrangian, the nested form with Ganzenmueller's hourglass control.
    TlGanzenmueller,
    /// Linear in the displacement, on the undeformed body.
    SmallStrain,
    /// Updated Lagrangian, essentially free of hourglass modes.
    UlNonHourglass,
    /// Updated Lagrangian, stress from the velocity gradient (the plain nested form).
    UlNested,
    /// Updated Lagrangian, the nested form with artificial stress.
    UlArtificialStress,
    /// Updated Lagrangian, `UlArtificialStress` with corrected gradients.
    UlArtificialStressCorrected,
    /// Updated Lagrangian, shear forces from the plain Laplacian of velocity.
    UlLaplacian,
    /// Updated Lagrangian, the nested form with an accumulated control of hourglass modes.
    UlGeneralised,
    /// Updated Lagrangian, `UlNonHourglass` with a limited Riemann solver.
    UlLowDissipation,
}

/// What the neighbours of a body refer to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Neighbours of the reference configuration, kept for ever.
    Total,
    /// Neighbours of the present configuration, renewed.
    Updated,
}

impl Words for Formulation {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        (
            "tl-hourglass-free",
            Self::TlHourglassFree,
            "total Lagrangian, free of hourglass modes; materials neo-hookean and neo-hookean-log",
        ),
        (
            "tl-nested",
            Self::TlNested,
            "total Lagrangian, the plain nested form, which hourglasses; materials neo-hookean, neo-hookean-log and saint-venant-kirchhoff",
        ),
        (
            "tl-ganzenmueller",
            Self::TlGanzenmueller,
            "total Lagrangian, the nested form with a penalty on zero-energy modes, of strength `alpha`; the same materials",
        ),
        (
            "small-strain",
            Self::SmallStrain,
            "linear in the displacement, with neighbours of the undeformed body: for vibrations and small strains without turns; material linear-elastic",
        ),
        (
            "ul-non-hourglass",
            Self::UlNonHourglass,
            "updated Lagrangian, essentially free of hourglass modes, for nearly incompressible solids; material linear-elastic",
        ),
        (
            "ul-nested",
            Self::UlNested,
            "updated Lagrangian, the plain nested form, which hourglasses; material linear-elastic",
        ),
        (
            "ul-generalised",
            Self::UlGeneralised,
            "updated Lagrangian, free of hourglass modes, objective, with exact moduli; dearer than ul-non-hourglass; materials linear-elastic and, for what is stretched far, neo-hookean",
        ),
        (
            "ul-artificial-stress",
            Self::UlArtificialStress,
            "updated Lagrangian, the nested form with artificial stress (Gray et al. 2001), which hourglasses too; material linear-elastic",
        ),
        (
            "ul-artificial-stress-corrected",
            Self::UlArtificialStressCorrected,
            "updated Lagrangian, ul-artificial-stress with the correction matrix in strain and force, so that thin parts are not too soft; for comparison only; material linear-elastic",
        ),
        (
            "ul-laplacian",
            Self::UlLaplacian,
            "updated Lagrangian, shear forces by the plain Laplacian of velocity, which resists rotation; for comparison only; material linear-elastic",
        ),
        (
            "ul-low-dissipation",
            Self::UlLowDissipation,
            "updated Lagrangian, ul-non-hourglass with the limited Riemann solver that its paper names, which makes plates soft; for comparison only; material linear-elastic",
        ),
    ];
}

impl Formulation {
    /// The name in case files and on the command line.
    pub fn name(self) -> &'static str {
        word(self)
    }

    /// Total or updated Lagrangian.
    pub fn family(self) -> Family {
        match self {
            Self::TlHourglassFree | Self::TlNested | Self::TlGanzenmueller | Self::SmallStrain => {
                Family::Total
            }
            Self::UlNonHourglass
            | Self::UlNested
            | Self::UlArtificialStress
            | Self::UlArtificialStressCorrected
            | Self::UlLaplacian
            | Self::UlGeneralised
            | Self::UlLowDissipation => Family::Updated,
        }
    }

    /// Whether it has artificial stress, which must not be frozen.
    pub fn has_artificial_stress(self) -> bool {
        matches!(self, Self::UlArtificialStress | Self::UlArtificialStressCorrected)
    }

    /// Updated Lagrangian with a nested stress and nothing against the modes that it is blind to.
    pub fn is_updated_nested(self) -> bool {
        self == Self::UlNested || self.has_artificial_stress()
    }
}

/// What two dimensions mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Plane {
    /// Plane strain: no stretch along the third axis, three-dimensional stress.
    Strain,
    /// Plane stress: no stress along the third axis.
    Stress,
    /// As the papers' two-dimensional benchmarks: the deviator is formed with 1/2, the bulk modulus is the
    /// three-dimensional one. Up to 4 per cent softer than plane strain.
    Papers,
}

impl Words for Plane {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("strain", Self::Strain, "plane strain: no stretch along the third axis"),
        ("stress", Self::Stress, "plane stress: no stress along the third axis; for `small-strain`"),
        (
            "papers",
            Self::Papers,
            "as the papers' two-dimensional benchmarks: the deviator is formed with 1/2; up to 4 % softer",
        ),
    ];
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

impl Words for Kernel {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("wendland-c2", Self::WendlandC2, "Wendland's C2 kernel, support 2 h"),
        ("cubic-spline", Self::CubicSpline, "cubic B-spline, support 2 h"),
        ("gaussian", Self::Gaussian, "Gaussian, cut at 3 h"),
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

impl Words for Stepping {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("dual", Self::Dual, "several acoustic steps for each renewal"),
        ("single", Self::Single, "a renewal with each step"),
    ];
}

/// How a total Lagrangian run bounds its time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StepRule {
    /// By the wave speed in the stretched material, measured in the reference configuration.
    Stretch,
    /// By the wave speed at rest (total Lagrangian paper, Eq. 33).
    Paper,
}

impl Words for StepRule {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("stretch", Self::Stretch, "by the wave speed in the stretched material; safe at any stretch"),
        ("paper", Self::Paper, "by sqrt(K/rho) at rest, as in the total Lagrangian paper (Eq. 33)"),
    ];
}

/// What a small-strain body does about the part of the kernel that is missing at its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Normalisation {
    /// Gradients and stresses are divided by the sum of the kernel of their own particle.
    Adjoint,
    /// Both sums of a particle are divided by its sum of the kernel.
    Literal,
    /// Nothing.
    None,
}

impl Words for Normalisation {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        (
            "adjoint",
            Self::Adjoint,
            "gradient and stress of a particle over its Shepard sum: momentum and energy are conserved",
        ),
        (
            "literal",
            Self::Literal,
            "gradient and force of a particle over its Shepard sum, as the paper says: momentum is not conserved, and stresses are up to 20 % low",
        ),
        ("none", Self::None, "no normalisation: half of a gradient is missing at the edge"),
    ];
}

/// The factors of the hourglass-free force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Calibration {
    /// zeta = 1.07, as in the total Lagrangian paper.
    Paper,
    /// Such that the moduli are exact inside of a lattice.
    Lattice,
}

impl Words for Calibration {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        (
            "paper",
            Self::Paper,
            "zeta = 1.07, as in the total Lagrangian paper: inside of a lattice the shear modulus is 3.6 % (2D) or 6.4 % (3D) too large, the bulk modulus 3.2 % or 0.6 % too small",
        ),
        (
            "lattice",
            Self::Lattice,
            "zeta = 1 and the force over its lattice sum: the moduli are exact inside of a lattice",
        ),
    ];
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

impl Words for Axis {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("x", Self::X, "the first axis"),
        ("y", Self::Y, "the second axis"),
        ("z", Self::Z, "the third axis; in 2D it points out of the plane"),
    ];
}

impl Axis {
    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }
}
