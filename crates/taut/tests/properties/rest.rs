//! A hourglass-free body at rest feels nothing: not little, nothing, for any arrangement of particles.

use crate::common::points::{block, disordered};
use crate::common::{Clock, FORMS, Setup, largest};
use taut::field::Quantity;
use taut::formulation::total::HourglassFree;
use taut::material::{NeoHookean, NeoHookeanLog, PairShear, Plane};
use taut::math::Vector;
use taut::run::Run;
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;

/// Zero, without tolerance: at F = 1 the stress handed over is (0 - s ratio) 1 + s 1 with ratio exactly 1, and the pair
/// force is a multiple of u_a - u_b, so every term is a zero before it is added.
fn stays_at_rest(solver: &mut dyn Solver, what: &str) {
    let mut clock = Clock::start(solver).expect("finite");
    for step in 0..20 {
        clock.step(solver).expect("at rest");
        for field in [Quantity::Acceleration, Quantity::Velocity, Quantity::Displacement] {
            assert_eq!(largest(solver, field), 0.0, "{what}: {} at step {step}", field.name());
        }
    }
}

fn rests<const D: usize, M: PairShear>(material: M, points: &[Point<D>], what: &str) {
    let setup = Setup::new(DP);
    let form = HourglassFree::new(material, setup.total_kernel(D).h());
    stays_at_rest(&mut setup.total(form, points), what);
}

/// Both neo-Hookean solids, on a lattice and without one, with free surfaces all around.
fn both_solids<const D: usize>(n: [usize; D]) {
    let setup = Setup::new(DP);
    for (points, where_) in [(block(n, DP), "lattice"), (disordered(n, DP, 0.3), "disorder")] {
        for plane in [Plane::Strain, Plane::Papers] {
            let split = NeoHookean { moduli: setup.moduli, plane };
            rests(split, &points, &format!("{D}D {where_} {plane:?}"));
        }
        rests(NeoHookeanLog { moduli: setup.moduli }, &points, &format!("{D}D {where_} log"));
    }
}

#[test]
fn hourglass_free_in_the_plane() {
    both_solids([13, 9]);
}

#[test]
fn hourglass_free_in_space() {
    both_solids([7, 6, 5]);
}

#[test]
fn every_other_formulation_too() {
    let points = disordered([8, 7], DP, 0.3);
    for form in FORMS {
        stays_at_rest(Setup::new(DP).body(form, &points).as_mut(), &format!("{form:?}"));
    }
}

#[test]
fn one_displaced_particle_is_felt() {
    let setup = Setup::new(DP);
    let mut body = setup.total(setup.hourglass_free(2), &block([9, 9], DP));
    let mut clock = Clock::start(&mut body).expect("finite");
    let p = body.run_mut().particles_mut();
    p.set_vector(Quantity::Displacement, 40, Vector([1e-9 * DP, 0.0]));
    clock.step(&mut body).expect("a small push");
    // The pair force is of order G / (rho dp) per displacement in spacings.
    assert!(largest(&body, Quantity::Acceleration) > 1e-10 * setup.acceleration());
}
