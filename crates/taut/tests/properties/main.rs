//! What the physics must hold, one file for each family of properties, for every formulation and dimension.
//!
//! `cargo test -p taut --test properties`, or with the name of a family behind it.

mod common;

mod constraints;
mod contact;
mod damping;
mod divergence;
mod energy;
mod followed;
mod impulses;
mod lanes;
mod moduli;
mod momentum;
mod patch;
mod plane;
mod rest;
mod rigid;
mod saved;
mod small_strain;
mod spinning;
mod storage;
mod threads;
mod time_step;
mod written;
mod zigzag;
