//! Numbers, vectors and tensors: everything the physics is written in.

mod lanes;
mod real;
mod tensor;
mod vector;

#[cfg(target_arch = "x86_64")]
pub use lanes::avx2::{F64x4, available as avx2_available};
pub use lanes::{Lanes, plain::Plain4};
pub use real::Real;
pub use tensor::Tensor;
pub use vector::Vector;
