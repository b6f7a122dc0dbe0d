//! What is observed: values at material points, and disorder.

pub mod disorder;
mod material_point;

pub use material_point::MaterialPoint;
