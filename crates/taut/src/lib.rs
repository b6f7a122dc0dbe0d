//! The numerics of Taut: no input or output, no file format, no clock.
//!
//! A line of code travels from [`math`] towards [`simulation`] and never back: numbers, fields, particles, kernels and
//! neighbours, passes and who runs them, materials, formulations, integrators, diagnostics, contact, simulation.

pub mod math;
#[macro_use]
pub mod field;
pub mod contact;
pub mod correction;
pub mod diagnostics;
pub mod formulation;
pub mod integrator;
pub mod kernel;
pub mod machine;
pub mod material;
pub mod neighbours;
pub mod particles;
pub mod pass;
pub mod run;
pub mod simulation;
