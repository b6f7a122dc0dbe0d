//! What a clamp feels when something presses on what it holds.

use super::scene::{Kind, blocks, simulation};
use super::{ROUNDING, STEPS, between, length, scales};
use crate::common::Form;
use taut::math::Vector;

/// The second block is held in its lower two rows, on which the first one lands: nothing else comes from outside, so all momentum does.
fn clamp_takes_the_momentum<const D: usize>(friction: f64) {
    let mut bodies = blocks::<D>(0.1);
    let low = bodies[1].iter().map(|p| p.x[1]).fold(f64::INFINITY, f64::min);
    for point in &mut bodies[1] {
        point.v = Vector::zero();
        if point.x[1] < low + 1.5 * super::DP {
            point.free = Vector::zero();
        }
    }
    let nested = Kind::Of(Form::TotalNested);
    let mut simulation = simulation::<D>((nested, nested), &bodies, friction);
    let (scale, start) = (scales(&simulation).0, simulation.totals());
    for _ in 0..STEPS {
        simulation.step().expect("stable");
    }
    let change = between(simulation.totals().momentum, start.momentum);
    let [clamp] = simulation.audit().grips() else { panic!("one constraint") };
    let error = length(between(change, clamp.exerted().linear)) / scale;
    assert!(error < ROUNDING, "{D}D, friction {friction}: {error:e}");
    let pressed = length(between(clamp.exerted().linear, clamp.impulse().linear)) / scale;
    assert!(pressed > 0.4, "{D}D: it must land on what is held, {pressed}");
}

#[test]
fn a_clamp_feels_what_presses_on_what_it_holds() {
    clamp_takes_the_momentum::<2>(0.0);
    clamp_takes_the_momentum::<3>(0.3);
}
