//! The quantities themselves.

use super::{AsScalar, AsTensor, AsVector, Field, Rank};

macro_rules! glossary {
    ($($(#[$doc:meta])* $name:ident: $shape:ident, $symbol:literal, $unit:literal;)+) => {
        /// Every quantity by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Quantity {
            $($(#[$doc])* $name,)+
        }

        impl Quantity {
            /// All quantities, in the order of the glossary.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// The name in files.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name)),+ }
            }

            /// The symbol in formulas.
            #[must_use]
            pub const fn symbol(self) -> &'static str {
                match self { $(Self::$name => $symbol),+ }
            }

            /// The SI unit (in 2D per metre of depth where that applies).
            #[must_use]
            pub const fn unit(self) -> &'static str {
                match self { $(Self::$name => $unit),+ }
            }

            /// Whether it stays in double precision when the rest is single: positions and displacements, whose increments are a
            /// millionth of them, and what sums up over a run. Velocities and deformation gradients are of the order of what
            /// is added to them often enough for single precision.
            #[must_use]
            pub const fn is_state(self) -> bool {
                matches!(
                    self,
                    Self::ReferencePosition
                        | Self::Displacement
                        | Self::Position
                        | Self::FollowedPosition
                        | Self::Density
                        | Self::DisplacementGradient
                        | Self::ShearAcceleration
                        | Self::ShearStress
                        | Self::AxialShearStress
                        | Self::Dissipated
                        | Self::ShearWork
                        | Self::ExternalWork
                )
            }

            /// Whether it is set before a run, or from outside, and not by the passes of a step: many particles then have the same.
            #[must_use]
            pub const fn is_given(self) -> bool {
                matches!(
                    self,
                    Self::Mass
                        | Self::Volume
                        | Self::Body
                        | Self::Shepard
                        | Self::Correction
                        | Self::BodyForce
                        | Self::Free
                        | Self::PrescribedVelocity
                        | Self::RestDensity
                        | Self::SoundSpeed
                        | Self::Impedance
                        | Self::ShearModulus
                )
            }

            /// The rank.
            #[must_use]
            pub const fn rank(self) -> Rank {
                match self { $(Self::$name => <$shape as super::Shape>::RANK),+ }
            }
        }

        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub struct $name;
            impl Field for $name {
                type Shape = $shape;
                const ID: Quantity = Quantity::$name;
            }
        )+
    };
}

glossary! {
    /// Position in the reference configuration.
    ReferencePosition: AsVector, "X", "m";
    /// Current position less reference position.
    Displacement: AsVector, "u", "m";
    /// Current position (updated Lagrangian bodies carry it; for the others it is X + u).
    Position: AsVector, "x", "m";
    /// Position at which a shear stress that only follows the motion was last integrated.
    FollowedPosition: AsVector, "x_s", "m";
    /// Displacement since then.
    Travel: AsVector, "u_s", "m";
    /// Velocity.
    Velocity: AsVector, "v", "m/s";
    /// Acceleration by all forces but those of constraints.
    Acceleration: AsVector, "a", "m/s^2";
    /// Body force per mass.
    BodyForce: AsVector, "b", "m/s^2";
    /// 1 for every component that moves freely, 0 for a prescribed one.
    Free: AsVector, "free", "1";
    /// Velocity of the prescribed components.
    PrescribedVelocity: AsVector, "v*", "m/s";
    /// Mass (per depth in 2D).
    Mass: AsScalar, "m", "kg";
    /// Volume; of the reference configuration in a total Lagrangian body, of the last list otherwise.
    Volume: AsScalar, "V", "m^3";
    /// Density.
    Density: AsScalar, "rho", "kg/m^3";
    /// Density of the undeformed material.
    RestDensity: AsScalar, "rho0", "kg/m^3";
    /// Rate of the density.
    DensityRate: AsScalar, "drho/dt", "kg/m^3/s";
    /// Pressure, positive in compression.
    Pressure: AsScalar, "p", "Pa";
    /// Bulk sound speed sqrt(K/rho0).
    SoundSpeed: AsScalar, "c0", "m/s";
    /// Acoustic impedance rho0 c0.
    Impedance: AsScalar, "Z", "Pa s/m";
    /// Shear modulus.
    ShearModulus: AsScalar, "G", "Pa";
    /// Index of the body, as a number.
    Body: AsScalar, "body", "1";
    /// Sum of the kernel over a neighbourhood, the particle itself included: 1 inside of a body.
    Shepard: AsScalar, "s", "1";
    /// Kernel gradient correction.
    Correction: AsTensor, "B", "1";
    /// Deformation gradient.
    DeformationGradient: AsTensor, "F", "1";
    /// Gradient of the displacement.
    DisplacementGradient: AsTensor, "H", "1";
    /// Rate of the deformation gradient, or of that of the displacement.
    DeformationRate: AsTensor, "dF/dt", "1/s";
    /// What a total Lagrangian particle hands to its neighbours as stress: P B (nested) or
    /// tau_r F^-T + zeta G J^(-2/d) 1 (hourglass-free).
    NominalStress: AsTensor, "Q", "Pa";
    /// zeta G J^(-2/d): stiffness of the hourglass-free pair force.
    PairStiffness: AsScalar, "zeta G J^(-2/d)", "Pa";
    /// Upper bound of the squared wave speed in the metric of the pair list.
    WaveSpeedSquared: AsScalar, "c^2", "m^2/s^2";
    /// Shear acceleration accumulated since the start (UL Eq. 20).
    ShearAcceleration: AsVector, "A", "m/s^2";
    /// Shear stress (in plane).
    ShearStress: AsTensor, "s", "Pa";
    /// Rate of the shear stress.
    ShearStressRate: AsTensor, "ds/dt", "Pa/s";
    /// Shear stress (in plane) that follows the motion, when it was last looked at.
    SeenShearStress: AsTensor, "s", "Pa";
    /// The same on the third axis.
    SeenAxialShearStress: AsScalar, "s_zz", "Pa";
    /// Shear stress on the third axis in plane strain.
    AxialShearStress: AsScalar, "s_zz", "Pa";
    /// Rate of the shear stress on the third axis.
    AxialShearStressRate: AsScalar, "ds_zz/dt", "Pa/s";
    /// Artificial stress times rho^2: -eps times the tensile part of the stress (Gray et al. 2001).
    ArtificialStress: AsTensor, "R", "Pa";
    /// Energy dissipated by viscosity so far.
    Dissipated: AsScalar, "W_d", "J";
    /// Work of the shear forces, or of an hourglass control, so far; positive when stored.
    ShearWork: AsScalar, "W_s", "J";
    /// Work done on the particle by body forces and prescribed motion so far.
    ExternalWork: AsScalar, "W_e", "J";
    /// Force per reference volume (a sum over neighbours, not stored).
    ForceDensity: AsVector, "f", "N/m^3";
    /// Sum of (v_b - v_a) (x) grad W V_b (a sum over neighbours, not stored).
    VelocityGradient: AsTensor, "L", "1/s";
    /// Force of an hourglass control per reference volume (a sum over neighbours, not stored).
    ControlForce: AsVector, "g", "N/m^3";
    /// Divergence of velocity times -1 (a sum over neighbours, not stored).
    Compression: AsScalar, "-div v", "1/s";
    /// Viscous power per volume (a sum over neighbours, not stored).
    DissipationRate: AsScalar, "phi", "W/m^3";
    /// Sum of X_ba (x) grad W V_b, whose inverse is B (not stored).
    MomentMatrix: AsTensor, "M", "1";
    /// Small strain (for output).
    Strain: AsTensor, "epsilon", "1";
    /// Cauchy stress (for output).
    CauchyStress: AsTensor, "sigma", "Pa";
    /// sqrt(3/2 s:s) of the three-dimensional deviator (for output).
    VonMisesStress: AsScalar, "sigma_vM", "Pa";
    /// Spacing that the particle was made with (for output).
    ParticleSpacing: AsScalar, "dp", "m";
}
