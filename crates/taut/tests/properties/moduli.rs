//! The moduli that long waves feel inside of a lattice.

use crate::common::points::{block, deep};
use crate::common::{ONE, STILL, Setup, set};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::formulation::total::HourglassFree;
use taut::math::Vector;
use taut::particles::Particles;
use taut::run::Run;
use taut::simulation::Solver;

const DP: f64 = 0.002;
/// Curvature times spacing of the displacement field.
const CURVATURE: f64 = 1e-7;
/// Strains are up to 1e-6, and so is what is not linear in them; forces are differences of numbers that are eps / (curvature dp) = 2e-9
/// off, 100 times over in all sums.
const TOLERANCE: f64 = 1e-5;

/// A displacement field of constant second derivative u'': along which axis, of which place, and along which axis the force is looked at.
struct Bend {
    moved: usize,
    shape: fn(f64, f64) -> f64,
    resists: usize,
}

/// u = u'' x^2/2 along the first axis, which a lattice resists with C11: K + 4/3 G.
const ALONG: Bend = Bend { moved: 0, shape: |x, _| 0.5 * x * x, resists: 0 };
/// u = u'' x^2/2 along the second: C66, G.
const ACROSS: Bend = Bend { moved: 1, shape: |x, _| 0.5 * x * x, resists: 1 };
/// u = u'' x y along the second, with a force along the first: C12 + C66, K + G/3.
const MIXED: Bend = Bend { moved: 1, shape: |x, y| x * y, resists: 0 };

/// Sets the field as velocities, which in one second make the displacement.
fn bend<const D: usize>(p: &mut Particles<D>, n: [usize; D], by: &Bend) {
    let [x0, y0] = [0, 1].map(|k| 0.5 * n[k] as f64 * DP);
    set(p, Quantity::Velocity, |x| {
        let u = CURVATURE / DP * (by.shape)(x[0] - x0, x[1] - y0);
        Vector::from_fn(|i| if i == by.moved { u } else { 0.0 })
    });
}

/// rho0 a / u'', inside of a block.
fn resisted<const D: usize>(p: &Particles<D>, n: [usize; D], by: &Bend) -> f64 {
    let inside = |&i: &usize| deep(p.vector_at(Quantity::ReferencePosition, i), n, (DP, 4));
    let all: Vec<f64> =
        (0..p.len()).filter(inside).map(|i| p.column(Quantity::Acceleration, by.resists)[i]).collect();
    assert!(!all.is_empty());
    all.iter().sum::<f64>() / all.len() as f64 * Setup::new(DP).moduli.density * DP / CURVATURE
}

/// What a total Lagrangian body resists a field with.
fn modulus<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D], by: &Bend) -> f64 {
    let mut body = Setup::new(DP).total(form, &block(n, DP));
    body.start().expect("finite");
    bend(body.run_mut().particles_mut(), n, by);
    form.rates(body.run_mut(), ONE);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |_| Vector::zero());
    form.rates(body.run_mut(), STILL);
    form.accelerate(body.run_mut(), STILL);
    resisted(body.run().particles(), n, by)
}

/// The same of an updated Lagrangian body: half of the second is behind the rates, half ahead of the force, as in any of its steps.
fn updated_modulus<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D], by: &Bend) -> f64 {
    let mut body = Setup::new(DP).updated(form, &block(n, DP));
    body.start().expect("finite");
    bend(body.run_mut().particles_mut(), n, by);
    form.rates(body.run_mut(), ONE);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |_| Vector::zero());
    form.accelerate(body.run_mut(), ONE);
    resisted(body.run().particles(), n, by)
}

/// (K + 4/3 G, G) as a formulation has them, over what they should be.
fn shares<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D]) -> [f64; 2] {
    let m = Setup::new(DP).moduli;
    [modulus(form, n, &ALONG) / (m.bulk + 4.0 / 3.0 * m.shear), modulus(form, n, &ACROSS) / m.shear]
}

fn assert_close(found: [f64; 2], expected: [f64; 2], what: &str) {
    let near = (0..2).all(|k| (found[k] - expected[k]).abs() < TOLERANCE);
    assert!(near, "{what}: {found:?} for {expected:?}");
}

/// The paper's zeta gives M (K + 4/3 zeta G) and M zeta G, M the moment of the lattice; calibrated, both are exact.
fn of_both<const D: usize>(n: [usize; D], moment: f64) {
    let setup = Setup::new(DP);
    let m = setup.moduli;
    let (longitudinal, zeta) = (m.bulk + 4.0 / 3.0 * m.shear, 1.07);
    let paper = [moment * (m.bulk + 4.0 / 3.0 * zeta * m.shear) / longitudinal, moment * zeta];
    assert_close(shares(setup.hourglass_free(D), n), paper, "paper");
    let kernel = setup.total_kernel(D);
    let calibrated = HourglassFree::calibrated::<D>(setup.material(), &kernel, DP);
    assert_close(shares(calibrated, n), [1.0, 1.0], "calibrated");
}

/// 1/1.0332 = 0.9679 and 1/1.0059 = 0.9941, to more digits as the sums over the lattice have them.
#[test]
fn hourglass_free() {
    let moment = |d: usize| {
        let (kernel, side) = (Setup::new(DP).total_kernel(d), 7_usize);
        let term = |k: usize| {
            let cell: Vec<f64> = (0..d).map(|i| (k / side.pow(i as u32) % side) as f64 - 3.0).collect();
            let r = cell.iter().map(|c| c * c).sum::<f64>().sqrt() * DP;
            if r > 0.0 { -kernel.dw(r) / r * (cell[0] * DP).powi(2) * DP.powi(d as i32) } else { 0.0 }
        };
        (0..side.pow(d as u32)).map(term).sum::<f64>()
    };
    assert!((moment(2) - 0.9679).abs() < 1e-4 && (moment(3) - 0.9941).abs() < 1e-4);
    of_both([13, 12], moment(2));
    of_both([11, 10, 9], moment(3));
}

/// sum_b f(X, Y, r) |W'| V_b over a lattice around a particle, for the kernel of updated Lagrangian bodies.
fn lattice_sum(dimension: usize, f: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let (kernel, side) = (Setup::new(DP).updated_kernel(dimension), 7_usize);
    let term = |k: usize| {
        let cell: Vec<f64> =
            (0..dimension).map(|i| (k / side.pow(i as u32) % side) as f64 - 3.0).map(|c| c * DP).collect();
        let r = cell.iter().map(|c| c * c).sum::<f64>().sqrt();
        if r > 0.0 { -kernel.dw(r) * f(cell[0], cell[1], r) * DP.powi(dimension as i32) } else { 0.0 }
    };
    (0..side.pow(dimension as u32)).map(term).sum()
}

/// C11, C66 and C12 of an updated Lagrangian form.
fn stiffnesses<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D]) -> [f64; 3] {
    let [along, across, mixed] = [ALONG, ACROSS, MIXED].map(|by| updated_modulus(form, n, &by));
    [along, across, mixed - across]
}

fn assert_stiffnesses(found: [f64; 3], expected: [f64; 3], what: &str) {
    let near = (0..3).all(|k| (found[k] / expected[k] - 1.0).abs() < TOLERANCE);
    assert!(near, "{what}: {found:?} for {expected:?}");
}

/// The generalised form has K + 4/3 G, G and K - 2/3 G as they are, in the plane and in space.
fn generalised_in<const D: usize>(n: [usize; D]) -> [f64; 3] {
    let (setup, m) = (Setup::new(DP), Setup::new(DP).moduli);
    let found = stiffnesses(setup.generalised(), n);
    let hooke = [m.bulk + 4.0 / 3.0 * m.shear, m.shear, m.bulk - 2.0 / 3.0 * m.shear];
    assert_stiffnesses(found, hooke, "generalised");
    assert_stiffnesses(stiffnesses(setup.generalised_rubber(), n), hooke, "generalised, rubber");
    found
}

/// The non-hourglass form (UL Eq. 19) has C11 = M^2 K + zeta G sum X^4/r^3 |W'| V and, as central forces have it, one sum for C66 and for
/// the shear part of C12, zeta G sum X^2 Y^2/r^3 |W'| V: 0.71 G in the plane, where the continuum has zeta/(d + 2) G = 0.875 G.
fn non_hourglass_in<const D: usize>(n: [usize; D]) -> [f64; 3] {
    let (form, m) = (Setup::new(DP).non_hourglass(D), Setup::new(DP).moduli);
    let zeta = 0.7 * D as f64 + 2.1;
    let bulk = lattice_sum(D, |x, _, r| x * x / r).powi(2) * m.bulk;
    let along = zeta * lattice_sum(D, |x, _, r| x.powi(4) / r.powi(3)) * m.shear;
    let across = zeta * lattice_sum(D, |x, y, r| (x * y).powi(2) / r.powi(3)) * m.shear;
    let found = stiffnesses(form, n);
    assert_stiffnesses(found, [bulk + along, across, bulk + across], "non-hourglass");
    found
}

/// In the plane, what a strip resists bending with is C11 - C12^2/C11: E / (1 - nu^2) in plane strain, for the generalised form. The
/// non-hourglass form is 3 per cent stiffer at nu = 0.4, and more below.
#[test]
fn updated_lagrangian() {
    let strain = 2e6 / (1.0 - 0.4 * 0.4);
    let bending = |[c11, _, c12]: [f64; 3]| (c11 - c12 * c12 / c11) / strain;
    let (generalised, non_hourglass) =
        (bending(generalised_in([13, 12])), bending(non_hourglass_in([13, 12])));
    assert!((generalised - 1.0).abs() < TOLERANCE, "{generalised}");
    assert!((non_hourglass - 1.03).abs() < 0.005, "{non_hourglass}");
    generalised_in([11, 10, 9]);
    non_hourglass_in([11, 10, 9]);
}
