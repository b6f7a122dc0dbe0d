//! The moduli that long waves feel inside of a lattice.

use crate::common::points::{block, deep};
use crate::common::{ONE, STILL, Setup, set};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::formulation::total::HourglassFree;
use taut::math::Vector;
use taut::run::Run;
use taut::simulation::Solver;

const DP: f64 = 0.002;
/// Curvature times spacing of the displacement field.
const CURVATURE: f64 = 1e-7;
/// Strains are up to 1e-6, and so is what is not linear in them; forces are differences of numbers that are eps / (curvature dp) = 2e-9
/// off, 100 times over in all sums.
const TOLERANCE: f64 = 1e-5;

/// rho0 a / u'' of the field u = u'' x^2/2 along `axis`, inside of a block.
fn modulus<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D], axis: usize) -> f64 {
    let setup = Setup::new(DP);
    let mut body = setup.total(form, &block(n, DP));
    body.start().expect("finite");
    let bent = |x: f64| 0.5 * CURVATURE / DP * (x - 0.5 * n[0] as f64 * DP).powi(2);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| {
        Vector::from_fn(|i| if i == axis { bent(x[0]) } else { 0.0 })
    });
    form.rates(body.run_mut(), ONE);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |_| Vector::zero());
    form.rates(body.run_mut(), STILL);
    form.accelerate(body.run_mut(), STILL);
    let p = body.run().particles();
    let inside = |&i: &usize| deep(p.vector_at(Quantity::ReferencePosition, i), n, (DP, 4));
    let all: Vec<f64> =
        (0..p.len()).filter(inside).map(|i| p.column(Quantity::Acceleration, axis)[i]).collect();
    assert!(!all.is_empty());
    all.iter().sum::<f64>() / all.len() as f64 * setup.moduli.density * DP / CURVATURE
}

/// (K + 4/3 G, G) as a formulation has them, over what they should be.
fn shares<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D]) -> [f64; 2] {
    let m = Setup::new(DP).moduli;
    [modulus(form, n, 0) / (m.bulk + 4.0 / 3.0 * m.shear), modulus(form, n, 1) / m.shear]
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
