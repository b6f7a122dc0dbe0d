//! How disordered the particles are: measures that see every zero-energy mode with the same weight.
//!
//! All of them compare the current positions with a reference arrangement and know nothing of the formulation
//! that moved the particles; F below is their own, not the solver's.
//!
//! - **zigzag** of particle i = | mean over its nearest reference neighbours j of
//!   (x_ji - 1/2 (F_i + F_j) X_ji) | / (2 dp_i). A displacement that alternates with amplitude a along n of the
//!   D axes of a lattice gives a n / (D dp). Linear fields give zero to rounding; so do quadratic ones wherever
//!   F is exact for them, that is where i and its nearest neighbours see a symmetric neighbourhood.
//! - **broken** = share of reference bonds (R < 1.2 dp, same body) with |x_ij| > 1.5 |1/2 (F_i + F_j) X_ij|: a
//!   real uniform stretch is not broken. **pieces** = components that unbroken bonds connect.
//! - **bond_min**, **spacing_min** = smallest |x_ij| / dp over reference bonds, over all particles.
//!
//! Here x_ji = x_j - x_i, X and R are the same in the reference arrangement, and dp of a pair is the mean of its
//! two particles' spacings.

mod bonds;
mod error;
mod gradient;
mod pieces;
mod reference;
mod shell;
mod spacing;
mod symmetric;
mod zigzag;

#[cfg(test)]
mod tests;

pub use error::DisorderError;
pub use reference::Reference;

/// Particles (or bonds) handed to a thread at a time.
const CHUNK: usize = 256;

/// The disorder of one state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disorder {
    /// Root mean square of the zigzag over all particles with a full nearest shell; not a number if none has.
    pub zigzag_rms: f64,
    /// 99th percentile of the same: the smallest value that at least 99 % of those particles do not exceed.
    pub zigzag_99: f64,
    /// Largest of the same.
    pub zigzag_max: f64,
    /// Smallest |x_ij| / dp over reference bonds; infinite if there are none.
    pub bond_min: f64,
    /// Smallest |x_ij| / dp over all pairs of particles, whatever their bodies; infinite for a single particle.
    pub spacing_min: f64,
    /// Share of reference bonds that are broken, 0 to 1; 0 if there are no bonds.
    pub broken: f64,
    /// Number of components connected by unbroken bonds; a particle without any is one of its own.
    pub pieces: usize,
}
