//! Contact of bodies of every formulation, and of rigid ones.

mod balance;
mod held;
mod penalty;
mod scene;
mod unmoved;

use crate::common::Form;
use scene::{DP, Kind, blocks, pairings, simulation};
use taut::contact::Contact;
use taut::field::Quantity;
use taut::simulation::{Simulation, Solver, Totals};

const STEPS: usize = 150;

/// As for free bodies: the halves of a pair are equal bit by bit, their sums differ by 64 roundings of forces that change a velocity by less
/// than its size in a step.
const ROUNDING: f64 = 64.0 * 1.1e-16 * STEPS as f64;

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn between(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Momentum of one solver.
fn momentum(solver: &dyn Solver) -> [f64; 3] {
    (0..solver.len()).fold([0.0; 3], |sum, i| {
        let (m, v) = (solver.scalar(Quantity::Mass, i), solver.read(Quantity::Velocity, i));
        std::array::from_fn(|k| sum[k] + m * v[k])
    })
}

/// Sums of m |v| and of m |v| |x| at the start.
fn scales(simulation: &Simulation) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    for solver in simulation.solvers() {
        for i in 0..solver.len() {
            let mv = solver.scalar(Quantity::Mass, i) * length(solver.read(Quantity::Velocity, i));
            sums = (sums.0 + mv, sums.1 + mv * length(solver.read(Quantity::ReferencePosition, i)));
        }
    }
    sums
}

/// Momentum of both bodies stays; that of one does not.
fn momentum_stays<const D: usize>(kinds: (Kind, Kind), friction: f64) {
    let mut simulation = simulation::<D>(kinds, &blocks(0.15), friction);
    let (scale, start) = (scales(&simulation).0, simulation.totals());
    let first = momentum(simulation.solvers()[0].as_ref());
    for _ in 0..STEPS {
        simulation.step().expect("stable");
        let drift = length(between(simulation.totals().momentum, start.momentum)) / scale;
        assert!(drift < ROUNDING, "{kinds:?} in {D}D, friction {friction}: {drift:e}");
    }
    let exchanged = length(between(momentum(simulation.solvers()[0].as_ref()), first)) / scale;
    assert!(exchanged > 0.4, "{kinds:?} in {D}D: they must meet, {exchanged}");
}

#[test]
fn linear_momentum_is_exact() {
    for kinds in pairings().into_iter().filter(|kinds| kinds.1 != Kind::Rigid) {
        for friction in [0.0, 0.4] {
            momentum_stays::<2>(kinds, friction);
            momentum_stays::<3>(kinds, friction);
        }
    }
}

/// Contact forces are central. Of the formulations the total nested one keeps angular momentum itself.
fn angular_momentum_stays<const D: usize>() {
    let nested = Kind::Of(Form::TotalNested);
    let mut simulation = simulation::<D>((nested, nested), &blocks(0.15), 0.0);
    let (scale, start) = (scales(&simulation).1, simulation.totals());
    for _ in 0..STEPS {
        simulation.step().expect("stable");
        let drift = length(between(simulation.totals().angular_momentum, start.angular_momentum)) / scale;
        // As for one body: four times what linear momentum is allowed.
        assert!(drift < 4.0 * ROUNDING, "{D}D: {drift:e}");
    }
}

#[test]
fn angular_momentum_is_exact_without_friction() {
    angular_momentum_stays::<2>();
    angular_momentum_stays::<3>();
}

/// What a tool is pushed with is what the body loses: the sum of the forces over the steps is the change of momentum.
fn reaction_is_the_change_of_momentum<const D: usize>(form: Form, friction: f64) {
    let mut simulation = simulation::<D>((Kind::Of(form), Kind::Rigid), &blocks(0.1), friction);
    let (scale, start) = (scales(&simulation).0, simulation.totals());
    let mut impulse = [0.0; 3];
    for _ in 0..STEPS {
        let dt = simulation.dt();
        simulation.step().expect("stable");
        let force = simulation.contact().map(|contact| contact.met(1, Some(0)).force).unwrap_or_default();
        impulse = std::array::from_fn(|k| impulse[k] - dt * force[k]);
    }
    let change = between(simulation.totals().momentum, start.momentum);
    assert!(length(change) / scale > 0.4, "{form:?} in {D}D: they must meet");
    let booked = simulation.contact().map(|contact| contact.impulse().force).unwrap_or_default();
    for impulse in [impulse, booked] {
        let error = length(between(change, impulse)) / scale;
        assert!(error < ROUNDING, "{form:?} in {D}D: {error:e}");
    }
}

#[test]
fn the_force_on_a_tool_is_the_rate_of_momentum() {
    for form in [Form::HourglassFree, Form::TotalNested, Form::NonHourglass, Form::UpdatedNested] {
        reaction_is_the_change_of_momentum::<2>(form, 0.0);
        reaction_is_the_change_of_momentum::<3>(form, 0.3);
    }
}

fn ledger(t: &Totals) -> f64 {
    t.kinetic + t.strain + t.contact + t.dissipated - t.external_work
}

/// Over a collision: the largest change of the ledger, that at the end, and the largest energy in contact; all over the largest energy.
fn worst<const D: usize>(kinds: (Kind, Kind), friction: f64) -> [f64; 3] {
    let mut simulation = simulation::<D>(kinds, &blocks(0.0), friction);
    let start = simulation.totals();
    let (mut most, mut error, mut end, mut held) = (0.0_f64, 0.0_f64, 0.0, 0.0_f64);
    for _ in 0..STEPS {
        simulation.step().expect("stable");
        let now = simulation.totals();
        end = (ledger(&now) - ledger(&start)).abs();
        (error, held) = (error.max(end), held.max(now.contact));
        most = most.max(now.kinetic + now.strain + now.contact);
    }
    [error, end, held].map(|energy| energy / most)
}

/// With the nested form, which keeps its own books. Position Verlet with a step dt changes the energy of a vibration of frequency omega by
/// (omega dt)^2/8 of it and less, to and fro. The step holds omega dt < 2 SAFETY = 1.6 for contact, so at most a third of what contact holds while it
/// does; what is left when it does not is what the body's damper misses, half a step of its power: below 2 per cent.
#[test]
fn energy_is_accounted_for() {
    let nested = Kind::Of(Form::TotalNested);
    for kinds in [(nested, nested), (nested, Kind::Rigid)] {
        for friction in [0.0, 0.4] {
            for [error, end, held] in [worst::<2>(kinds, friction), worst::<3>(kinds, friction)] {
                assert!(held > 0.02, "{kinds:?}: they must meet, {held}");
                assert!(error < 0.32 * held + 0.02, "{kinds:?}, friction {friction}: {error} of {held}");
                assert!(end < 0.02, "{kinds:?}, friction {friction}: {end} is left");
            }
        }
    }
}

/// Every position and velocity as bits.
fn bits(simulation: &Simulation) -> Vec<u64> {
    let mut out = Vec::new();
    for solver in simulation.solvers() {
        for id in 0..solver.len() {
            let place = solver.stored(id);
            for field in [Quantity::Displacement, Quantity::Velocity] {
                out.extend(solver.read(field, place).map(f64::to_bits));
            }
        }
    }
    out
}

#[test]
fn the_number_of_threads_does_not_show() {
    for kinds in pairings() {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| {
                let mut simulation = simulation::<3>(kinds, &blocks(0.15), 0.3);
                (0..60).for_each(|_| simulation.step().expect("stable"));
                bits(&simulation)
            })
        };
        let one = run(1);
        assert!(one == run(2) && one == run(3), "{kinds:?}");
    }
}

/// A run goes on bit by bit with what contact remembers, whatever its lists were.
#[test]
fn contact_remembers_what_it_needs() {
    let kind = Kind::Of(Form::HourglassFree);
    let run = |disturb: bool| {
        let mut simulation = simulation::<2>((kind, kind), &blocks(0.15), 0.3);
        (0..40).for_each(|_| simulation.step().expect("stable"));
        let memory = simulation.contact().map(Contact::memory).unwrap_or_default();
        assert!(memory.len() > 8, "they rub");
        if disturb {
            let contact = simulation.contact_mut().expect("they touch");
            assert!(!contact.recall(&memory[..3]) && !contact.recall(&memory[1..]), "it does not fit");
            assert!(contact.recall(&memory));
        }
        (0..40).for_each(|_| simulation.step().expect("stable"));
        (bits(&simulation), simulation.contact().map(Contact::memory).unwrap_or_default())
    };
    assert!(run(false) == run(true));
}

/// Bodies that start further apart than they reach do not feel each other, and the step is theirs.
#[test]
fn bodies_apart_are_left_alone() {
    let mut bodies = blocks::<2>(0.0);
    bodies[1].iter_mut().for_each(|p| p.x[1] += 40.0 * DP);
    let kind = Kind::Of(Form::HourglassFree);
    let touching = simulation((kind, kind), &bodies, 0.0);
    let own = touching.solvers().iter().map(|s| s.stable_step()).fold(f64::INFINITY, f64::min);
    assert_eq!(touching.dt(), own);
    assert_eq!(touching.contact().map(|c| c.met(0, None)).unwrap_or_default().force, [0.0; 3]);
}
