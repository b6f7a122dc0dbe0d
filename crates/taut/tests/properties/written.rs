//! The nested form with B in the stress is the one that has it in every pair.

use crate::common::as_written::AsWritten;
use crate::common::points::{block, disordered, stir};
use crate::common::{Clock, Setup, vectors};
use taut::field::Quantity;
use taut::simulation::{InSpace, Point, Solver};

const DP: f64 = 0.002;
const STEPS: usize = 20;

/// Largest difference of the velocities after some steps, over the largest velocity.
fn difference<const D: usize>(mut points: Vec<Point<D>>) -> f64
where
    Point<D>: InSpace,
{
    let setup = Setup::new(DP);
    stir(&mut points, 0.05 * setup.moduli.sound_speed(), 10.0 * DP);
    let velocities = |mut body: Box<dyn Solver>| {
        Clock::start(body.as_mut()).expect("finite").steps(body.as_mut(), STEPS);
        vectors(body.as_ref(), Quantity::Velocity)
    };
    let fast = velocities(Box::new(setup.total(setup.total_nested(D), &points)));
    let written = velocities(Box::new(setup.total(AsWritten(setup.total_nested(D)), &points)));
    let size = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let apart = fast.iter().zip(&written).map(|(a, b)| size(std::array::from_fn(|i| a[i] - b[i])));
    apart.fold(0.0, f64::max) / fast.into_iter().map(size).fold(0.0, f64::max)
}

/// Each step rounds the product with B once more, three terms of eps/2 in the stress and in each of some 60 pairs, and a force changes a velocity
/// by less than its own size in a step; nothing grows in 20 steps.
#[test]
fn b_in_the_stress_is_b_in_every_pair() {
    let bound = STEPS as f64 * 3.0 * 64.0 * 1.1e-16;
    for off in [
        difference(block([12, 8], DP)),
        difference(block([7, 6, 5], DP)),
        difference(disordered([6, 6, 5], DP, 0.2)),
    ] {
        assert!(off < bound, "{off:e}");
    }
}
