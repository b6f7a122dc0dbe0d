//! A shear stress that follows the motion, against one that is integrated step by step.

use crate::common::points::{block, stir};
use crate::common::{Clock, Setup, size, tensor};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::formulation::updated::CorrectedArtificialStress;
use taut::integrator::{Stepping, Updated};
use taut::math::{Tensor, Vector};
use taut::run::{Cpu, Run};
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;
const STEPS: usize = 60;

type Body<F> = Updated<2, F, Cpu<2>>;

/// A body all of whose particles are led, each with its own velocity, after some steps: whatever the forces, it moves as told.
fn led<F: Formulation<2>>(setup: &Setup, form: F) -> Body<F> {
    let mut points: Vec<Point<2>> = block([13, 12], DP);
    stir(&mut points, 0.02 * setup.moduli.sound_speed(), 10.0 * DP);
    let led: Vec<_> = points.iter().map(|p| p.v).collect();
    points.iter_mut().for_each(|p| p.free = Vector::zero());
    let mut body = setup.updated(form, &points);
    for (id, &v) in led.iter().enumerate() {
        let place = body.stored(id);
        body.write(Quantity::PrescribedVelocity, place, [v[0], v[1], 0.0]);
        body.write(Quantity::Velocity, place, [v[0], v[1], 0.0]);
    }
    Clock::start(&mut body).expect("finite").steps(&mut body, STEPS);
    body
}

/// The shear stress that is seen of a body at a place.
fn seen<F: Formulation<2>>(body: &Body<F>, i: usize) -> Tensor<f64, 3> {
    let state = body.state(i);
    let rest = body.scalar(Quantity::RestDensity, i);
    let pressure = body.scalar(Quantity::SoundSpeed, i).powi(2) * (state.density - rest);
    state.cauchy.plus_diagonal(pressure)
}

/// Largest difference from the stress that is integrated with the corrected gradient at every step, over the largest of those; those as strain; and
/// the lists.
fn difference(stepping: Stepping) -> (f64, f64, u64) {
    let setup = Setup { stepping, ..Setup::new(DP) };
    let integrated: Body<CorrectedArtificialStress> = led(&setup, setup.corrected_artificial_stress(2));
    let mut followed = led(&setup, setup.non_hourglass(2));
    assert_eq!(followed.lists(), integrated.lists());
    followed.look();
    let (mut most, mut apart) = (0.0f64, 0.0f64);
    for id in 0..followed.len() {
        let (one, other) = (seen(&followed, followed.stored(id)), seen(&integrated, integrated.stored(id)));
        most = most.max(size(other));
        apart = apart.max(size(one - other));
    }
    (apart / most, most / (2.0 * setup.moduli.shear), followed.lists())
}

/// Who integrates step by step takes the mean of two rates, each with the weights of its own time; who follows takes those of the list for what was
/// travelled. In all they differ by half a step of what the gradient L has changed by, which is L L t, spin and strain together twice the strain:
/// relative to the stress, by the strain over the number of steps. (That a list mixes strain and spin at one go is the square of an angle of
/// 0.03, over three: a tenth of that.)
#[test]
fn it_is_the_same() {
    for (stepping, fewest) in [(Stepping::Dual, 3), (Stepping::Single, STEPS as u64)] {
        let (apart, strain, lists) = difference(stepping);
        assert!((fewest..STEPS as u64 + 10).contains(&lists), "{lists}");
        assert!(apart < strain / STEPS as f64, "{apart:e} {strain}");
    }
}

/// Looking after every step changes nothing of what is seen at the end.
#[test]
fn looking_changes_nothing() {
    let setup = Setup::new(DP);
    let mut points = block([9, 8], DP);
    stir(&mut points, 0.02 * setup.moduli.sound_speed(), 10.0 * DP);
    let run = |often: bool| {
        let mut body = setup.updated(setup.non_hourglass(2), &points);
        let mut clock = Clock::start(&mut body).expect("finite");
        for _ in 0..STEPS {
            clock.step(&mut body).expect("stable");
            if often {
                body.look();
            }
        }
        body.look();
        (0..body.len()).map(|i| seen(&body, i)).collect::<Vec<_>>()
    };
    let (often, once) = (run(true), run(false));
    assert!(size(once[0]) > 0.0 && often == once);
}

#[test]
fn nobody_pays_for_a_stress_that_nobody_asks_for() {
    let setup = Setup::new(DP);
    let points = block([9, 8], DP);
    let watched = setup.updated(setup.non_hourglass(2), &points);
    let mut unwatched = setup.updated(setup.unwatched(2), &points);
    unwatched.start().expect("finite");
    unwatched.look();
    for field in [Quantity::ShearStress, Quantity::FollowedPosition, Quantity::Travel] {
        assert!(watched.run().particles().has(field) && !unwatched.run().particles().has(field));
    }
    assert_eq!(size(unwatched.state(0).cauchy), 0.0);
    assert_eq!(tensor::<2>(watched.run().particles(), Quantity::ShearStress, 0), Tensor::zero());
}
