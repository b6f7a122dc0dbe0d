//! Studies of a case that are no runs of it: how long its steps may be, how it vibrates, where it comes to rest.

mod error;
mod operator;
pub mod spectrum;
pub mod stability;
pub mod vibration;

pub use error::StudyError;
pub use operator::{Mode, Operator};
