//! Bodies that push each other by pairs of particles (SS Eq. 12).

use crate::common::points::{Noise, block};
use crate::common::{Form, Setup};
use taut::contact::{Contact, PairPenalty};
use taut::math::Vector;
use taut::simulation::{Point, Simulation};

/// The force on one is minus that on the other, bit by bit: every operation on x only changes sign with it.
#[test]
fn forces_of_a_pair_are_opposite_to_the_last_digit() {
    let penalty = PairPenalty { bodies: [0, 1], strength: 5e-8, reach: 8.5e-5 };
    let (mut noise, mut pushed) = (Noise(11), 0);
    for _ in 0..1000 {
        let x = noise.vector::<3>().times(1e-4);
        let (force, other) = (penalty.force(x), penalty.force(-x));
        pushed += u32::from(force.norm_squared() > 0.0);
        assert_eq!(force.0, (-other).0, "{x:?}");
        assert_eq!(penalty.energy(x).to_bits(), penalty.energy(-x).to_bits());
    }
    assert!((100..1000).contains(&pushed), "some are near enough, some are not: {pushed}");
}

/// What one body gets from another is what that gets from it: many pairs, added up in either order, so to the rounding of the sum.
#[test]
fn bodies_push_each_other_alike() {
    const DP: f64 = 0.002;
    let mut points = block::<2>([6, 6], DP);
    let mut noise = Noise(4);
    let mut above: Vec<Point<2>> = block([7, 5], DP);
    for p in &mut above {
        p.x = p.x + Vector([0.31 * DP, 6.4 * DP]).plus(0.1 * DP, noise.vector());
        p.body = 1;
    }
    points.iter_mut().for_each(|p| p.body = 0);
    let setup = Setup::new(DP);
    let solvers = vec![setup.body(Form::TotalNested, &points), setup.body(Form::TotalNested, &above)];
    let penalty = PairPenalty { bodies: [0, 1], strength: 1.0, reach: 2.0 * DP };
    let contact = Contact::new(&[], DP, 2).with_penalties(&[penalty], DP);
    let mut simulation = Simulation::new(solvers, vec![]).touching(Some(contact));
    simulation.begin().expect("finite");
    let contact = simulation.contact().expect("contact");
    let (one, other) = (contact.met(0, Some(1)), contact.met(1, Some(0)));
    let size = one.force.iter().map(|f| f * f).sum::<f64>().sqrt();
    assert!(size > 0.0 && one.force[1] < 0.0, "the upper one presses the lower one down: {:?}", one.force);
    for k in 0..2 {
        // Forces of dozens of pairs, most of which push the same way.
        let apart = (one.force[k] + other.force[k]).abs();
        assert!(apart < 1e-13 * size, "{:?} {:?}", one.force, other.force);
    }
}
