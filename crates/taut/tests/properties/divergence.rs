//! A run that cannot go on says which particle, which field, when and why.

use crate::common::points::{block, stir};
use crate::common::{FINITE, Form, Setup};
use taut::field::Quantity;
use taut::integrator::{Cause, Diverged};
use taut::math::Vector;
use taut::pass::Now;
use taut::simulation::{Drive, Point, Simulation, Solver};

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
    for form in FINITE {
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
        // A wrong number stops a step in its middle; energies are looked at when it is done.
        let done = diverged.step == simulation.steps();
        assert!(done || diverged.step == simulation.steps() + 1, "{form:?}: {diverged}");
        assert_eq!(diverged.time, if done { simulation.time() } else { before }, "{form:?}");
        let wrong = match diverged.cause {
            Cause::Inverted => {
                diverged.field == "det F" && (diverged.value <= 0.0 || diverged.value.is_nan())
            }
            Cause::NotFinite => !diverged.value.is_finite(),
            Cause::Density => !(100.0..1e4).contains(&diverged.value),
            Cause::Speed => diverged.value.abs() > diverged.bound,
            Cause::Gained => diverged.value > diverged.bound,
            Cause::Lost | Cause::Collapsed => diverged.value < diverged.bound,
            Cause::Unlisted | Cause::Disordered => false,
        };
        assert!(wrong, "{form:?}: {diverged}");
    }
}

/// The same particle, field and cause in every formulation.
#[test]
fn a_velocity_that_is_no_number_is_refused_at_the_start() {
    for form in FINITE {
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
    for form in FINITE {
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

/// Ids go on from one solver to the next, as they do in files.
#[test]
fn a_particle_of_a_later_solver_has_its_id_in_the_files() {
    let (mut first, mut second) = (block([4, 4], DP), block([5, 3], DP));
    second[7].v[0] = f64::NAN;
    second.iter_mut().for_each(|p| p.body = 1);
    first.iter_mut().for_each(|p| p.x[0] -= 1.0);
    let setup = Setup::new(DP);
    let solvers = [&first, &second].map(|points| setup.body(Form::TotalNested, points));
    let diverged = Simulation::start(solvers.into(), vec![]).err().expect("refused");
    assert_eq!((diverged.particle, diverged.body), (16 + 7, 1), "{diverged}");
}

/// Every particle is led outward, in proportion to where it is: slow enough for everything else, until the density is gone.
#[test]
fn a_total_body_blown_up_beyond_ten_times_its_volume_is_stopped() {
    for form in [Form::HourglassFree, Form::TotalNested] {
        let mut points = block([12, 9], DP);
        points.iter_mut().for_each(|p| p.free = Vector::zero());
        let drive = Box::new(Blow { rate: 0.05 * Setup::new(DP).moduli.sound_speed() / DP });
        let mut simulation =
            Simulation::start(vec![Setup::new(DP).body(form, &points)], vec![drive]).expect("finite");
        let diverged = (0..20_000).find_map(|_| simulation.step().err()).expect("caught");
        assert_eq!((diverged.cause, diverged.field), (Cause::Density, "Density"), "{form:?}: {diverged}");
        // All have the same density: the first is named. Seen at the latest 256 steps after it happened.
        assert!(
            diverged.particle == 0 && (diverged.bound / 100.0 - 1.0).abs() < 1e-12,
            "{form:?}: {diverged}"
        );
        assert!(diverged.value < 100.0 && diverged.value > 10.0, "{form:?}: {diverged}");
        assert_eq!(diverged.step, simulation.steps());
    }
}

/// Leads all particles outward from the origin.
struct Blow {
    rate: f64,
}

impl Drive for Blow {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], _: Now<f64>) {
        for solver in solvers {
            for place in 0..solver.len() {
                let x = solver.read(Quantity::ReferencePosition, place);
                solver.write(Quantity::PrescribedVelocity, place, x.map(|x| self.rate * x));
            }
        }
    }
}

/// The corner of a block is shot off: it has no neighbours left when the list is made anew.
#[test]
fn a_particle_that_loses_its_neighbours_is_named() {
    for form in [Form::NonHourglass, Form::UpdatedNested] {
        let mut points = block([8, 6], DP);
        let last = points.len() - 1;
        points[last].v = Vector([1.25, 1.25]).times(Setup::new(DP).moduli.sound_speed());
        let mut simulation = start(&Setup::new(DP), form, &points).expect("finite");
        let diverged = (0..500).find_map(|_| simulation.step().err()).expect("caught");
        names_its_particle(&diverged, &points, &format!("{form:?}"));
        assert_eq!((diverged.cause, diverged.particle), (Cause::Lost, last as u32), "{form:?}: {diverged}");
        assert!(diverged.value < diverged.bound && diverged.bound == 2.0, "{form:?}: {diverged}");
    }
}

/// A particle that never had neighbours has lost none.
#[test]
fn a_lonely_particle_is_nobodys_loss() {
    let setup = Setup::new(DP);
    let mut simulation = start(&setup, Form::UpdatedNested, &block([1, 1], DP)).expect("finite");
    (0..50).for_each(|_| simulation.step().expect("goes on"));
}

/// The history names the criterion, the step and the particle, and keeps the last 64.
#[test]
fn the_last_steps_are_remembered() {
    for form in FINITE {
        let mut simulation = start(&Setup::new(DP), form, &points()).expect("finite");
        for _ in 0..100 {
            simulation.step().expect("stable");
        }
        let steps: Vec<_> = simulation.history().steps().copied().collect();
        assert_eq!(steps.len(), 64, "{form:?}");
        let numbers: Vec<u64> = steps.iter().map(|s| s.number).collect();
        assert_eq!(numbers, (38..=101).collect::<Vec<u64>>(), "{form:?}: the next one is known already");
        let last = steps[63];
        assert_eq!((last.dt, last.time), (simulation.dt(), simulation.time()), "{form:?}");
        assert!(steps.windows(2).all(|w| (w[0].time + w[0].dt - w[1].time).abs() < 1e-12 * w[1].time));
        assert!(last.particle.is_some_and(|id| (id as usize) < points().len()), "{form:?}: {last:?}");
        let speed = crate::common::largest(simulation.solvers()[0].as_ref(), Quantity::Velocity);
        assert!((last.bounding.speed / speed - 1.0).abs() < 1e-12, "{form:?}: {last:?} {speed}");
    }
}
