//! What brings bodies to rest: the exchange of velocities pair by pair, and increments held until forces are in balance.

use crate::common::points::{block, disordered, stir};
use crate::common::{Clock, Form, Setup, length, vectors};
use std::f64::consts::PI;
use taut::field::Quantity;
use taut::math::Vector;
use taut::pass::Now;
use taut::run::{Cpu, Serial};
use taut::simulation::{
    Damping, Drive, Increment, Increments, Point, QuasiStatic, Simulation, Solver, Splitting,
};

const DP: f64 = 0.002;

fn started<const D: usize>(points: &[Point<D>]) -> Box<dyn Solver> {
    let mut body = Setup::new(DP).body(Form::HourglassFree, points);
    Clock::start(body.as_mut()).expect("finite");
    body
}

fn stirred() -> Vec<Point<3>> {
    let mut points = disordered([7, 6, 6], DP, 0.25);
    stir(&mut points, 0.1 * Setup::new(DP).moduli.sound_speed(), 12.0 * DP);
    points
}

/// Momentum, kinetic energy, what was dissipated and what constraints did.
fn books(body: &dyn Solver) -> ([f64; 3], f64, f64, f64) {
    let (mut momentum, mut kinetic, mut lost, mut work) = ([0.0; 3], 0.0, 0.0, 0.0);
    for place in 0..body.len() {
        let (m, v) = (body.scalar(Quantity::Mass, place), body.read(Quantity::Velocity, place));
        (0..3).for_each(|i| momentum[i] += m * v[i]);
        kinetic += 0.5 * m * v.iter().map(|c| c * c).sum::<f64>();
        lost += body.scalar(Quantity::Dissipated, place);
        work += body.scalar(Quantity::ExternalWork, place);
    }
    (momentum, kinetic, lost, work)
}

/// However large the viscosity, even after thousands of time steps of it: the exchange keeps the momentum of a free body, and what the
/// motion lost is what was dissipated. About 50 pairs of each particle, four times, each rounded.
#[test]
fn an_exchange_keeps_momentum_and_books() {
    for strength in [0.01, 1.0, 1e4] {
        let mut body = started(&stirred());
        let before = books(body.as_ref());
        let m = Setup::new(DP).moduli;
        // k/m = strength: eta dt W'/r V / rho of the nearest neighbours is about 0.4 eta dt / (rho dp^2).
        let gave = body.relax().expect("total").exchange(strength * m.density * DP * DP / 0.4, 1.0);
        let after = books(body.as_ref());
        let scale = (2.0 * before.1 * m.density * 252.0 * DP.powi(3)).sqrt();
        for i in 0..3 {
            assert!((after.0[i] - before.0[i]).abs() < 200.0 * f64::EPSILON * scale, "{strength}: {after:?}");
            assert!(gave.linear[i].abs() < 200.0 * f64::EPSILON * scale, "{strength}: {gave:?}");
        }
        let residual = before.1 - after.1 - (after.2 - before.2);
        assert!(residual.abs() < 200.0 * f64::EPSILON * before.1, "{strength}: {residual:e}");
        assert!(after.1 < before.1 && after.2 > before.2);
    }
}

/// Held and led particles keep their velocity, and what they give is work.
#[test]
fn an_exchange_respects_constraints() {
    let mut points = stirred();
    for p in points.iter_mut().filter(|p| p.x[0] < 2.0 * DP) {
        p.free = Vector([0.0, 1.0, 0.0]);
    }
    let mut body = started(&points);
    for place in 0..body.len() {
        if body.read(Quantity::Free, place)[0] == 0.0 {
            body.set_word(Quantity::Velocity, 0, (place, 3.0));
        }
    }
    let before = books(body.as_ref());
    body.relax().expect("total").exchange(10.0, 1e-3);
    let after = books(body.as_ref());
    for place in 0..body.len() {
        let (free, v) = (body.read(Quantity::Free, place), body.read(Quantity::Velocity, place));
        if free[0] == 0.0 {
            assert_eq!((v[0], v[2]), (3.0, 0.0));
            assert!(v[1] != 0.0);
        }
    }
    let residual = before.1 + (after.3 - before.3) - (after.2 - before.2) - after.1;
    assert!(residual.abs() < 200.0 * f64::EPSILON * before.1, "{residual:e}");
    assert!(after.3 != before.3, "the grip works");
}

/// v_y = cos(pi x / L) loses kinetic energy at the rate 2 eta M k^2 / rho, M the moment of the lattice (0.968), for weak damping: free
/// ends have no flux. The rows at the two sides lack the pairs across, which are 38 per cent of their exchange along the row, half of
/// them: 2/40 of 19 per cent of the whole.
#[test]
fn a_weak_exchange_is_a_viscosity() {
    let n = [30, 40];
    let wave = PI / (n[0] as f64 * DP);
    let mut points = block(n, DP);
    points.iter_mut().for_each(|p| p.v = Vector([0.0, (wave * p.x[0]).cos()]));
    let mut body = started(&points);
    let before = books(body.as_ref()).1;
    let eta_dt = 1e-4 * 1000.0 / (wave * wave);
    body.relax().expect("total").exchange(eta_dt, 1.0);
    let lost = 1.0 - books(body.as_ref()).1 / before;
    let expected = 2.0 * eta_dt * 0.968 * wave * wave / 1000.0;
    assert!((lost / expected - 1.0).abs() < 0.02, "{lost:e} for {expected:e}");
}

fn swept(threads: usize) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let mut points = block([21, 19, 18], DP);
        stir(&mut points, 0.1 * Setup::new(DP).moduli.sound_speed(), 12.0 * DP);
        let mut body = started(&points);
        for _ in 0..3 {
            body.relax().expect("total").exchange(50.0, 1e-4);
        }
        vectors(body.as_ref(), Quantity::Velocity).concat().into_iter().map(f64::to_bits).collect()
    })
}

/// Every bit of every velocity, on 1, 2 and 3 threads.
#[test]
fn the_number_of_threads_does_not_show() {
    let one = swept(1);
    assert!(one == swept(2) && one == swept(3));
}

/// The order of pairs does not depend on how a run walks its list: the oracle gives the same bits.
#[test]
fn any_run_sweeps_alike() {
    let points = stirred();
    let exchanged = |mut body: Box<dyn Solver>| {
        body.start().expect("finite");
        body.relax().expect("total").exchange(50.0, 1e-4);
        vectors(body.as_ref(), Quantity::Velocity)
    };
    let setup = Setup::new(DP);
    let serial = exchanged(setup.body_on(Form::TotalNested, &points, Serial::new));
    assert_eq!(serial, exchanged(setup.body_on(Form::TotalNested, &points, Cpu::new)));
}

/// The same seed repeats a run bit by bit, another one does not.
#[test]
fn a_seed_repeats_a_run() {
    let run = |seed| {
        let splitting: Box<dyn Damping> =
            Box::new(Splitting { viscosity: vec![5.0], probability: 0.2, seed });
        let body = Setup::new(DP).body(Form::HourglassFree, &stirred());
        let mut simulation = Simulation::new(vec![body], vec![]).damped(Some(splitting));
        simulation.begin().expect("finite");
        (0..40).for_each(|_| simulation.step().expect("stable"));
        vectors(simulation.solvers()[0].as_ref(), Quantity::Velocity)
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

/// A body force that grows with time.
struct Weight;

impl Drive for Weight {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        for place in 0..solvers[0].len() {
            solvers[0].write(Quantity::BodyForce, place, [0.0, -2e4 * (now.t + 0.5 * now.dt), 0.0]);
        }
    }
}

/// A block that hangs from its top and is pulled down in three increments.
fn hanging(form: Form, own: bool) -> (Simulation, Vec<Increment>) {
    let n = [8, 14];
    let mut points = block(n, DP);
    for p in points.iter_mut().filter(|p| p.x[1] > 12.0 * DP) {
        p.free = Vector::zero();
    }
    let body = Setup::new(DP).body(form, &points);
    let splitting = Splitting { viscosity: vec![200.0], probability: 0.2, seed: 1 };
    let damping: Option<Box<dyn Damping>> = if own { None } else { Some(Box::new(splitting)) };
    let mut simulation = Simulation::new(vec![body], vec![Box::new(Weight)]).damped(damping);
    simulation.begin().expect("finite");
    let increments = Increments { end: 1.0, count: 3, tolerance: 1e-4, most: 20_000 };
    let mut statics = QuasiStatic::new(&mut simulation, increments, own);
    let mut settled = Vec::new();
    while !statics.is_done() {
        settled.extend(statics.step(&mut simulation).expect("stable"));
    }
    (simulation, settled)
}

/// Every increment converges, says so, and both dampings find the same equilibrium: stresses are right to 1e-4 on both sides, and where the block is
/// stretched by a third, displacements are off by twice as much.
#[test]
fn increments_end_in_equilibrium() {
    for form in [Form::HourglassFree, Form::TotalNested, Form::Ganzenmueller] {
        let both = [true, false].map(|own| hanging(form, own));
        for (simulation, settled) in &both {
            assert_eq!(settled.len(), 3, "{form:?}");
            for (i, increment) in settled.iter().enumerate() {
                assert!(increment.converged && increment.balance.force <= 1e-4, "{form:?}: {increment:?}");
                assert!((increment.time - (i + 1) as f64 / 3.0).abs() < 1e-12);
            }
            assert!((simulation.time() - 1.0).abs() < 1e-12);
            let totals = simulation.totals();
            assert!(totals.kinetic < 1e-6 * totals.strain, "{form:?}: {totals:?}");
        }
        let down = |simulation: &Simulation| {
            let u = vectors(simulation.solvers()[0].as_ref(), Quantity::Displacement);
            u.into_iter().map(length).fold(0.0, f64::max)
        };
        let (one, other) = (down(&both[0].0), down(&both[1].0));
        assert!(one > DP && (one / other - 1.0).abs() < 5e-4, "{form:?}: {one:e} {other:e}");
    }
}
