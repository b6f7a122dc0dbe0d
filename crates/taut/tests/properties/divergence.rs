//! A run that cannot go on says which particle, which field, when and why.

use crate::common::points::{block, stir};
use crate::common::{FORMS, Form, Setup};
use taut::integrator::{Cause, Diverged};
use taut::math::Vector;
use taut::simulation::{Point, Simulation};

const DP: f64 = 0.002;

fn start(setup: &Setup, form: Form, points: &[Point<2>]) -> Result<Simulation, Diverged> {
    Simulation::start(vec![setup.body(form, points)], vec![])
}

/// Two bodies, moving.
fn points() -> Vec<Point<2>> {
    let mut points = block([12, 9], DP);
    stir(&mut points, 0.05 * Setup::new(DP).moduli.sound_speed(), 8.0 * DP);
    points.iter_mut().for_each(|p| p.body = u32::from(p.x[0] > 6.0 * DP));
    points
}

/// Everything a message is made of belongs to one particle that exists.
fn names_its_particle(diverged: &Diverged, points: &[Point<2>], what: &str) {
    let point = &points[diverged.particle as usize];
    assert_eq!(diverged.body, point.body as usize, "{what}");
    assert_eq!(diverged.position, [point.x[0], point.x[1], 0.0], "{what}");
    let text = diverged.to_string();
    for part in [
        format!("particle {} ", diverged.particle),
        diverged.field.to_owned(),
        format!("step {}", diverged.step),
    ] {
        assert!(text.contains(&part), "{what}: \"{part}\" is not in \"{text}\"");
    }
    assert!(text.contains(diverged.cause.hint()), "{what}: {text}");
}

/// Thirty times the stable step. A step may scatter the particles so far that nothing accelerates them any more: then it is the
/// density that tells.
#[test]
fn an_absurd_step_is_caught() {
    let (setup, points) = (Setup { cfl: 18.0, ..Setup::new(DP) }, points());
    for form in FORMS {
        let mut simulation = start(&setup, form, &points).expect("finite at the start");
        let (mut before, mut found) = (0.0, None);
        for _ in 0..200 {
            before = simulation.time() + simulation.dt();
            found = simulation.step().err();
            if found.is_some() {
                break;
            }
        }
        let diverged = found.unwrap_or_else(|| panic!("{form:?} goes on, with {:?}", simulation.totals()));
        names_its_particle(&diverged, &points, &format!("{form:?}"));
        assert_eq!((diverged.time, diverged.step), (before, simulation.steps() + 1), "{form:?}");
        let wrong = match diverged.cause {
            Cause::Inverted => {
                diverged.field == "det F" && (diverged.value <= 0.0 || diverged.value.is_nan())
            }
            Cause::NotFinite => !diverged.value.is_finite(),
            Cause::Density => !(100.0..1e4).contains(&diverged.value),
            Cause::Speed => diverged.value.abs() > setup.moduli.sound_speed(),
            Cause::Unlisted => false,
        };
        assert!(wrong, "{form:?}: {diverged}");
    }
}

/// The same particle, field and cause in every formulation.
#[test]
fn a_velocity_that_is_no_number_is_refused_at_the_start() {
    for form in FORMS {
        let mut points = points();
        points[17].v[1] = f64::NAN;
        let diverged = start(&Setup::new(DP), form, &points).err().expect("refused");
        names_its_particle(&diverged, &points, &format!("{form:?}"));
        assert_eq!((diverged.particle, diverged.field), (17, "Velocity"), "{form:?}: {diverged}");
        assert!(diverged.cause == Cause::NotFinite && diverged.value.is_nan(), "{form:?}: {diverged}");
    }
}

#[test]
fn a_position_that_is_no_number_is_refused_at_the_start() {
    for form in FORMS {
        let mut points = points();
        points[17].x[0] = f64::INFINITY;
        let diverged = start(&Setup::new(DP), form, &points).err().expect("refused");
        assert_eq!((diverged.particle, diverged.value), (17, f64::INFINITY), "{form:?}: {diverged}");
        assert!(["ReferencePosition", "Position"].contains(&diverged.field), "{form:?}: {diverged}");
        assert_eq!(diverged.cause, Cause::NotFinite);
    }
}

/// Compressed so fast that half a step turns every particle inside out: F_xx = 1 - rate dt / 2.
#[test]
fn an_inverted_particle_is_named() {
    let setup = Setup { cfl: 20.0, ..Setup::new(DP) };
    let rate = 0.8 * setup.moduli.sound_speed() / DP;
    for form in [Form::HourglassFree, Form::TotalNested, Form::Ganzenmueller] {
        let mut points = block([6, 5], DP);
        points.iter_mut().for_each(|p| p.v = Vector([-rate * p.x[0], 0.0]));
        let mut simulation = start(&setup, form, &points).expect("finite at the start");
        let expected = 1.0 - 0.5 * rate * simulation.dt();
        assert!(expected < 0.0, "the test must invert: {expected}");
        let diverged = simulation.step().expect_err("inverted");
        names_its_particle(&diverged, &points, &format!("{form:?}"));
        assert_eq!((diverged.cause, diverged.field, diverged.step), (Cause::Inverted, "det F", 1));
        assert!((diverged.value - expected).abs() < 1e-12, "{form:?}: {diverged} for {expected}");
    }
}

/// Squeezed beyond ten times its density, which an updated body notices when it falls.
#[test]
fn a_lost_density_is_named() {
    let setup = Setup { cfl: 18.0, ..Setup::new(DP) };
    let mut points = block([12, 9], DP);
    let rate = 0.2 * setup.moduli.sound_speed() / DP;
    points.iter_mut().for_each(|p| p.v = Vector([-rate * p.x[0], 0.0]));
    for form in [Form::NonHourglass, Form::UpdatedNested] {
        let mut simulation = start(&setup, form, &points).expect("finite at the start");
        let diverged = (0..50).find_map(|_| simulation.step().err()).expect("caught");
        assert_eq!((diverged.cause, diverged.field), (Cause::Density, "Density"), "{form:?}: {diverged}");
    }
}
