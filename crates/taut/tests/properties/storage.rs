//! Particles are stored in an order that may change during a run; what is known of them by id does not.

use crate::common::points::block;
use crate::common::{Clock, Form, Setup};
use taut::field::Quantity;
use taut::integrator::Stepping;
use taut::math::Vector;
use taut::simulation::Point;

const DP: f64 = 0.002;

/// Two blocks fly past each other, far apart and free of stress, for more than a hundred lists.
#[test]
fn bodies_that_pass_each_other_are_stored_anew() {
    let setup = Setup { stepping: Stepping::Single, ..Setup::new(DP) };
    let speed = 0.3 * setup.moduli.sound_speed();
    let velocity = |body: u32| if body == 0 { speed } else { -speed };
    let mut points: Vec<Point<2>> = block([12, 9], DP);
    let other = points.iter().map(|p| Point { x: p.x + Vector([30.0 * DP, 20.0 * DP]), body: 1, ..*p });
    points.extend(other.collect::<Vec<_>>());
    points.iter_mut().for_each(|p| p.v = Vector([velocity(p.body), 0.0]));

    let mut body = setup.body(Form::NonHourglass, &points);
    let mut clock = Clock::start(body.as_mut()).expect("finite");
    let before = body.ids().to_vec();
    clock.steps(body.as_mut(), 130);
    assert_ne!(before, body.ids(), "places have changed");
    for (id, point) in points.iter().enumerate() {
        let place = body.stored(id);
        assert_eq!(body.ids()[place] as usize, id);
        // A block that flies as a whole has no forces; a position is rounded once in each step.
        let expected = point.v[0] * clock.time;
        let flown = body.read(Quantity::Displacement, place)[0];
        assert!(
            (flown - expected).abs() < 300.0 * f64::EPSILON * (30.0 * DP + expected.abs()),
            "{id}: {flown}"
        );
        assert_eq!(body.scalar(Quantity::Body, place), f64::from(point.body));
    }
}
