//! Numbers, vectors and tensors: everything the physics is written in.

mod lanes;
mod principal;
mod real;
mod tensor;
mod vector;

#[cfg(target_arch = "aarch64")]
pub use lanes::neon;
pub use lanes::{Element, Lanes, MOST_LANES, plain, prefetch};
#[cfg(target_arch = "x86_64")]
pub use lanes::{avx2, avx512};
pub use real::Real;
pub use tensor::Tensor;
pub use vector::Vector;
