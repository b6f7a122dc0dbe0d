//! What is observed: values at material points, and disorder.

pub mod disorder;
mod material_point;
pub mod stability;

pub use material_point::MaterialPoint;
