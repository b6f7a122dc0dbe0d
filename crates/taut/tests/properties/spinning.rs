//! A free plate that spins: objectivity over many turns.

use crate::common::points::block;
use crate::common::{Clock, Setup};
use std::f64::consts::TAU;
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::integrator::Stepping;
use taut::math::Vector;
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;
const N: [usize; 2] = [16, 16];
const TURNS: usize = 10;

/// A square plate; its corners move at 0.05 c0.
fn plate(setup: &Setup) -> (Vec<Point<2>>, f64) {
    let mut points = block(N, DP);
    let middle = Vector([0.5 * N[0] as f64 * DP, 0.5 * N[1] as f64 * DP]);
    let omega = 0.05 * setup.moduli.sound_speed() / middle.norm_squared().sqrt();
    for p in &mut points {
        let r = p.x - middle;
        p.v = Vector([-omega * r[1], omega * r[0]]);
    }
    (points, omega)
}

/// What is seen of each turn: mean over it of the root mean square of the von Mises stress, and of the pressure, in units of rho0 (omega R)^2;
/// and spin (moment of momentum) over the first. `None` if it comes to pieces.
fn turns<F: Formulation<2> + Copy>(form: F, stepping: Stepping) -> Option<Vec<[f64; 3]>> {
    let setup = Setup { stepping, ..Setup::new(DP) };
    let (points, omega) = plate(&setup);
    let unit = setup.moduli.density * (0.05 * setup.moduli.sound_speed()).powi(2);
    let mut body = setup.updated(form, &points);
    let mut clock = Clock::start(&mut body).expect("finite");
    let spin = |body: &dyn Solver| {
        (0..body.len()).fold(0.0, |sum, i| {
            let (x, v) = (body.read(Quantity::Position, i), body.read(Quantity::Velocity, i));
            sum + body.scalar(Quantity::Mass, i) * (x[0] * v[1] - x[1] * v[0])
        })
    };
    let first = spin(&body);
    let mut seen = Vec::new();
    for turn in 1..=TURNS {
        let (mut sum, mut pressure, mut looks) = (0.0, 0.0, 0.0);
        while clock.time * omega < TAU * turn as f64 {
            for _ in 0..4 {
                clock.step(&mut body).ok()?;
            }
            let cauchy = |i| body.state(i).cauchy;
            let n = body.len() as f64;
            sum += ((0..body.len()).map(|i| cauchy(i).von_mises().powi(2)).sum::<f64>() / n).sqrt();
            pressure += (0..body.len()).map(|i| cauchy(i).trace() / -3.0).sum::<f64>() / n;
            looks += 1.0;
        }
        seen.push([sum / looks / unit, pressure / looks / unit, spin(&body) / first]);
    }
    Some(seen)
}

/// From the third turn, when the breathing that the sudden start set off has died away, to the tenth: stress, pressure and spin stay.
#[test]
fn a_plate_in_the_generalised_form_spins_without_drift() {
    stays(Setup::new(DP).generalised());
    stays(Setup::new(DP).generalised_rubber());
}

fn stays<F: Formulation<2> + Copy>(form: F) {
    for stepping in [Stepping::Dual, Stepping::Single] {
        let seen = turns(form, stepping).expect("it goes on");
        let (early, late) = (seen[2], seen[TURNS - 1]);
        assert!(early[0] > 0.05 && early[1] < -0.1, "there is a stress to drift: {seen:?}");
        for k in 0..3 {
            assert!((late[k] / early[k] - 1.0).abs() < 0.01, "{stepping:?} {k}: {seen:?}");
        }
    }
}

/// The non-hourglass form does not turn what it has accumulated: it comes to pieces, or to something else.
#[test]
fn a_plate_in_the_non_hourglass_form_does_not() {
    let seen = turns(Setup::new(DP).non_hourglass(2), Stepping::Dual);
    let drifted = |seen: &Vec<[f64; 3]>| (seen[TURNS - 1][0] / seen[2][0] - 1.0).abs() > 0.1;
    assert!(seen.as_ref().is_none_or(drifted), "{seen:?}");
}
