//! Increments of load that come by contact.

use super::scene::{DP, Kind, blocks, simulation};
use super::{between, length};
use crate::common::Form;
use taut::math::Vector;
use taut::simulation::{Increments, QuasiStatic};

const TOLERANCE: f64 = 1e-4;

/// A block stands in a clamp, and a rigid one comes down on it by a spacing in three increments of one second, on the clock of the load. Whenever that stands still,
/// the clamp carries what the tool presses: unbalanced forces of all particles add up to less than the tolerance times the mean stress over the section,
/// which is at most twice the mean pressure.
fn tool_and_clamp_balance<const D: usize>(form: Form) {
    let mut bodies = blocks::<D>(0.0);
    let low = bodies[0].iter().map(|p| p.x[1]).fold(f64::INFINITY, f64::min);
    for point in &mut bodies[0] {
        point.v = Vector::zero();
        if point.x[1] < low + 1.5 * DP {
            point.free = Vector::zero();
        }
    }
    for point in &mut bodies[1] {
        point.v = Vector::zero();
        point.v[1] = -1.3 * DP;
    }
    let mut simulation = simulation::<D>((Kind::Of(form), Kind::Rigid), &bodies, 0.0);
    let increments = Increments { end: 1.0, count: 3, tolerance: TOLERANCE, most: 20_000 };
    let mut statics = QuasiStatic::new(&mut simulation, increments, true);
    let mut pressed = Vec::new();
    while !statics.is_done() {
        let Some(increment) = statics.step(&mut simulation).expect("stable") else { continue };
        assert!(increment.converged, "{form:?} in {D}D: {increment:?}");
        let met = simulation.contact().expect("contact").met(0, None).force;
        let [clamp] = simulation.audit().grips() else { panic!("one constraint") };
        let held = clamp.force().expect("quasi-static").linear;
        let error = length(between(held, met.map(|f| -f))) / length(met).max(f64::MIN_POSITIVE);
        assert!(error < 2.0 * TOLERANCE, "{form:?} in {D}D: {held:?} against {met:?}, {error:e}");
        pressed.push(-met[1]);
    }
    assert!(pressed.is_sorted() && pressed[0] > 0.0 && pressed[2] > 2.0 * pressed[0], "{pressed:?}");
}

#[test]
fn what_a_tool_presses_a_clamp_carries() {
    tool_and_clamp_balance::<2>(Form::HourglassFree);
    tool_and_clamp_balance::<2>(Form::TotalNested);
    tool_and_clamp_balance::<3>(Form::HourglassFree);
}
