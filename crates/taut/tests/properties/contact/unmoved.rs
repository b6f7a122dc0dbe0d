//! What contact must not depend on, and where it must be nothing.

use super::scene::{DP, Kind, SPEED, blocks, simulation, solver};
use crate::common::points::block;
use crate::common::{Form, Setup};
use taut::contact::{Contact, Meeting};
use taut::math::{Tensor, Vector};
use taut::simulation::{Point, Simulation};

const KIND: Kind = Kind::Of(Form::HourglassFree);

/// A rotation of the plane, or in space about an axis that is no axis of the lattice.
fn rotation<const D: usize>() -> Tensor<f64, D> {
    let (s, c) = 0.7_f64.sin_cos();
    let about = |i: usize, j: usize| {
        Tensor::<f64, D>::from_fn(|k, l| match (k, l) {
            _ if (k, l) == (i, i) || (k, l) == (j, j) => c,
            _ if (k, l) == (i, j) => -s,
            _ if (k, l) == (j, i) => s,
            _ => f64::from(u8::from(k == l)),
        })
    };
    if D == 2 { about(0, 1) } else { about(0, 1).mul(about(1, D - 1)) }
}

/// Two blocks pressed into each other.
fn pressed<const D: usize>(turn: impl Fn(Vector<f64, D>) -> Vector<f64, D>) -> Simulation {
    let mut bodies = blocks::<D>(0.1);
    for point in bodies.iter_mut().flatten() {
        if point.body == 1 {
            point.x[1] -= 0.6 * DP;
        }
        (point.x, point.v) = (turn(point.x), Vector::zero());
    }
    simulation((KIND, KIND), &bodies, 0.0)
}

fn turned<const D: usize>() {
    let r = rotation::<D>();
    let aside = Vector::<f64, D>::from_fn(|k| 0.3 + 0.1 * k as f64);
    let (here, there) = (pressed::<D>(|x| x), pressed::<D>(|x| r.mul_vector(x) + aside));
    let force = |s: &Simulation| Vector(s.contact().map(|c| c.met(0, Some(1)).force).unwrap_or_default());
    let (before, after) = (force(&here), force(&there));
    let rotated = r.mul_vector(Vector::from_fn(|k| before[k]));
    let size = before.norm_squared().sqrt();
    // Positions of the order of 1 are rounded by 1.1e-16, distances are of the order of DP: relative errors of 1e-13 in each of some
    // hundred pair forces, whose derivative by the distance is some ten times the force over DP.
    let off = (0..D).map(|k| (rotated[k] - after[k]).abs()).fold(0.0, f64::max);
    assert!(size > 0.0 && off < 1e-11 * size, "{D}D: {off:e} of {size:e}");
    let energy = |s: &Simulation| s.totals().contact;
    assert!((energy(&here) / energy(&there) - 1.0).abs() < 1e-11, "{D}D");
    assert!(energy(&here) > 0.0);
}

#[test]
fn forces_turn_with_the_bodies() {
    turned::<2>();
    turned::<3>();
}

/// A lattice that is cut in two is in contact with itself as it was before: without a force.
#[test]
fn lattices_that_continue_each_other_just_touch() {
    let whole = block::<2>([8, 10], DP);
    let halves = [0, 1].map(|body: u32| -> Vec<Point<2>> {
        let mine = whole.iter().filter(|p| u32::from(p.x[1] > 5.0 * DP) == body);
        mine.map(|p| Point { body, ..*p }).collect()
    });
    let simulation = simulation((KIND, KIND), &halves, 0.0);
    let met = simulation.contact().map(|contact| contact.met(0, None)).unwrap_or_default();
    // sigma - sigma_0 is a rounding of sigma, 0.2, and so p below 1e-15 K; over six spacings.
    let k = Setup::new(DP).moduli.bulk;
    assert!(met.force[1].abs() < 1e-14 * k * 8.0 * DP, "{met:?}");
}

/// The undeformed body does not touch itself, nor does it when it is turned, or stretched and squeezed by a quarter.
#[test]
fn a_body_at_rest_does_not_touch_itself() {
    let meeting = Meeting { bodies: [0, 0], stiffness: Setup::new(DP).moduli.bulk, friction: 0.0 };
    let still = |points: &[Point<2>]| {
        let contact = Contact::new(&[meeting], DP, 2);
        let mut simulation = Simulation::new(vec![solver(KIND, points)], vec![]).touching(Some(contact));
        simulation.begin().expect("finite");
        simulation
    };
    let mut points = block::<2>([14, 12], DP);
    assert_eq!(still(&points).totals().contact, 0.0);
    // A strain rate of 0.2 c over the height: the second axis is squeezed by a fifth until the wave is through.
    let c = Setup::new(DP).moduli.sound_speed();
    points.iter_mut().for_each(|p| p.v = Vector([0.0, -4.0 * SPEED * c * p.x[1] / (12.0 * DP)]));
    let mut squeezed = still(&points);
    for _ in 0..80 {
        squeezed.step().expect("stable");
        assert_eq!(squeezed.totals().contact, 0.0, "at {} s", squeezed.time());
    }
}
