//! Particles that are held or led, and the work that this takes.

use crate::common::points::{block, stir};
use crate::common::{FORMS, Form, Setup, length};
use taut::field::Quantity;
use taut::math::Vector;
use taut::pass::Now;
use taut::simulation::{Drive, Point, Simulation, Solver, Totals};

const DP: f64 = 0.002;

/// Leads the prescribed components of all particles: the velocity at the end of the step.
struct Lead(fn(f64) -> [f64; 3]);

impl Drive for Lead {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        for solver in solvers {
            for place in 0..solver.len() {
                solver.write(Quantity::PrescribedVelocity, place, (self.0)(now.t + now.dt));
            }
        }
    }
}

/// Rising evenly, so that the trapezoidal rule of position Verlet is exact.
fn ramp(t: f64) -> [f64; 3] {
    [4000.0 * t, -2000.0 * t, 0.0]
}

fn simulate(form: Form, points: &[Point<2>], drives: Vec<Box<dyn Drive>>) -> Simulation {
    Simulation::start(vec![Setup::new(DP).body(form, points)], drives).expect("finite")
}

/// Vectors of the only solver, by id.
fn field(simulation: &Simulation, field: Quantity) -> Vec<[f64; 3]> {
    crate::common::vectors(simulation.solvers()[0].as_ref(), field)
}

fn stirred(n: [usize; 2]) -> Vec<Point<2>> {
    let mut points = block(n, DP);
    stir(&mut points, 0.02 * Setup::new(DP).moduli.sound_speed(), 10.0 * DP);
    points
}

/// Held: not by much, not at all. Their initial velocity is taken away, too.
#[test]
fn held_particles_do_not_move() {
    for form in FORMS {
        let mut points = stirred([14, 6]);
        for p in points.iter_mut().filter(|p| p.x[0] < 3.0 * DP) {
            p.free = Vector::zero();
        }
        let mut simulation = simulate(form, &points, vec![]);
        (0..100).for_each(|_| simulation.step().expect("stable"));
        let u = field(&simulation, Quantity::Displacement);
        for (i, p) in points.iter().enumerate() {
            assert_eq!(length(u[i]) == 0.0, p.free[0] == 0.0, "{form:?}: particle {i} by {:?}", u[i]);
        }
    }
}

#[test]
fn one_component_can_be_held() {
    for form in FORMS {
        let mut points = stirred([14, 6]);
        for p in points.iter_mut().filter(|p| p.x[0] < 3.0 * DP) {
            p.free = Vector([1.0, 0.0]);
        }
        let mut simulation = simulate(form, &points, vec![]);
        (0..100).for_each(|_| simulation.step().expect("stable"));
        let u = field(&simulation, Quantity::Displacement);
        for (i, p) in points.iter().enumerate() {
            assert_eq!(u[i][1] == 0.0, p.free[1] == 0.0, "{form:?}: particle {i} by {:?}", u[i]);
            assert!(u[i][0] != 0.0, "{form:?}: the other component is free");
        }
    }
}

/// v = ramp(t) and u = ramp(t) t / 2 at every step, whatever the rest of the body does. 200 sums of eps each.
#[test]
fn led_particles_follow() {
    for form in FORMS {
        let mut points = block([14, 6], DP);
        for p in points.iter_mut().filter(|p| p.x[0] < 3.0 * DP) {
            p.free = Vector::zero();
        }
        let mut simulation = simulate(form, &points, vec![Box::new(Lead(ramp))]);
        for _ in 0..100 {
            simulation.step().expect("stable");
            let t = simulation.time();
            let (u, v) = (field(&simulation, Quantity::Displacement), field(&simulation, Quantity::Velocity));
            for i in (0..points.len()).filter(|&i| points[i].free[0] == 0.0) {
                let error = |x: [f64; 3], y: [f64; 3]| length([x[0] - y[0], x[1] - y[1], x[2] - y[2]]);
                let half = ramp(t).map(|c| 0.5 * c * t);
                assert!(error(v[i], ramp(t)) < 1e-13 * length(ramp(t)), "{form:?}");
                // Updated positions are rounded at the size of the position, 0.03 m, in every step.
                assert!(error(u[i], half) < 1e-13 * length(half) + 100.0 * 1.1e-16 * 0.03, "{form:?}");
            }
        }
    }
}

/// Free fall: v = g t, u = g t^2 / 2, and the work of gravity is the kinetic energy m g^2 t^2 / 2. No stress.
#[test]
fn gravity_in_free_fall() {
    for form in FORMS {
        let mut points = block([8, 7], DP);
        points.iter_mut().for_each(|p| p.force = Vector([3.0, -9.81]));
        let mut simulation = simulate(form, &points, vec![]);
        (0..100).for_each(|_| simulation.step().expect("stable"));
        let (t, totals) = (simulation.time(), simulation.totals());
        let mass = 1000.0 * 56.0 * DP * DP;
        let energy = 0.5 * mass * (9.0 + 9.81 * 9.81) * t * t;
        // Hundreds of additions of eps.
        assert!((totals.kinetic / energy - 1.0).abs() < 1e-13, "{form:?}: {totals:?}");
        assert!((totals.external_work / energy - 1.0).abs() < 1e-13, "{form:?}: {totals:?}");
        assert!((totals.momentum[1] / (-9.81 * mass * t) - 1.0).abs() < 1e-13, "{form:?}");
        // Equal accelerations differ by nothing; positions differ by their rounding.
        assert!(totals.strain.abs() < 1e-20 * energy.max(1.0), "{form:?}: {totals:?}");
    }
}

/// A grip that leads all of a body gives it its kinetic energy and nothing else.
#[test]
fn a_grip_on_everything_gives_kinetic_energy() {
    for form in FORMS {
        let mut points = block([8, 7], DP);
        points.iter_mut().for_each(|p| p.free = Vector::zero());
        let mut simulation = simulate(form, &points, vec![Box::new(Lead(ramp))]);
        (0..100).for_each(|_| simulation.step().expect("stable"));
        let totals = simulation.totals();
        let v = length(ramp(simulation.time()));
        let energy = 0.5 * 1000.0 * 56.0 * DP * DP * v * v;
        assert!((totals.external_work / energy - 1.0).abs() < 1e-13, "{form:?}: {totals:?}");
    }
}

/// What a grip at one end puts in is found again: (kinetic + strain + dissipated) / work - 1.
fn residual(form: Form) -> (f64, Totals) {
    let mut points = block([24, 6], DP);
    for p in points.iter_mut().filter(|p| p.x[0] < 3.0 * DP) {
        p.free = Vector::zero();
    }
    let mut simulation = simulate(form, &points, vec![Box::new(Lead(ramp))]);
    (0..400).for_each(|_| simulation.step().expect("stable"));
    let t = simulation.totals();
    ((t.kinetic + t.strain + t.dissipated) / t.external_work - 1.0, t)
}

/// Work in, energy out: what is missing is the error of the time integral of a pull that starts at once, and between
/// lists of the updated forms the frozen volumes (measured 3e-5 to 1e-3). The hourglass-free form is not adjoint at surfaces
/// and may lose a little (measured 0.011).
#[test]
fn a_grip_at_one_end_pays_for_all() {
    for form in FORMS {
        let (residual, totals) = residual(form);
        let tolerance = if form == Form::HourglassFree { 0.02 } else { 2e-3 };
        assert!(totals.external_work > 0.0 && totals.strain > 0.0, "{form:?}: {totals:?}");
        assert!(residual.abs() < tolerance, "{form:?}: {residual:e} {totals:?}");
    }
}
