//! How updated Lagrangian bodies are stepped.

use crate::kernel::Kernel;

/// When the configuration (neighbours, kernel, volumes) is made anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepping {
    /// Every advection step, CFL_ad h / |v|max (UL Eq. 21); many acoustic steps share one configuration.
    Dual,
    /// Every acoustic step.
    Single,
}

/// Settings of the integrator.
#[derive(Clone, Copy, Debug)]
pub struct UpdatedOptions {
    /// The kernel.
    pub kernel: Kernel,
    /// Acoustic Courant number; 0.4 in the paper.
    pub cfl: f64,
    /// Advection Courant number; 0.2 in the paper.
    pub advection_cfl: f64,
    /// When the configuration is made anew.
    pub stepping: Stepping,
    /// How far ahead of the present a configuration of dual stepping is made, as a share of the time that it lasts: 0 in the paper. 1/2 puts it into
    /// the middle, so that what directions lag behind in its second half they are ahead in its first.
    pub ahead: f64,
    /// Least speed of the advection criterion, m/s: Eq. (21) has no limit for a body at rest.
    pub reference_speed: f64,
    /// Largest sqrt(K/rho0) of the materials, m/s.
    pub bulk_speed: f64,
    /// Largest c_M = sqrt((K + 3 zeta G / (d + 2)) / rho0) of the materials, m/s: the speed that the shear Laplacian of
    /// the non-hourglass form makes of the longitudinal wave. 0 where it does not apply.
    pub shear_speed: f64,
}
