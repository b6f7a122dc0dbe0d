//! Modes that alternate from particle to particle (TL Fig. 1): a nested form is blind to them, a hourglass-free one
//! pushes back, by an amount that can be written down.

use crate::common::points::{block, deep};
use crate::common::{ONE, PLACED, SINGLE, STILL, Setup, largest, set};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::kernel::Kernel;
use taut::math::Vector;
use taut::run::Run;
use taut::simulation::Solver;

const DP: f64 = 0.002;
/// Amplitude in spacings; the statements below hold for any.
const AMPLITUDE: f64 = 0.1;
/// 20 pairs of a dozen roundings each, as in the test of rigid motion.
const ROUNDING: f64 = 1e-13;
/// A single row has no lattice in the plane, so it is listed; two pairs count.
const LISTED: f64 = 2.0 * SINGLE;

/// +1 and -1 in turn along the axes of the mode.
fn sign<const D: usize>(x: Vector<f64, D>, axes: [bool; D]) -> f64 {
    let k = (0..D).filter(|&i| axes[i]).map(|i| (x[i] / DP).floor()).sum::<f64>();
    if k.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

/// sum_b V w (1 - s_a s_b) over the lattice neighbours of an inner particle (of a row, if an axis has one layer): what a
/// mode is multiplied by in sum_b w u_ab.
fn symbol<const D: usize>(kernel: &Kernel, layers: [usize; D], axes: [bool; D]) -> f64 {
    let side = 7_usize;
    let weight = |k: usize| {
        let n: [i64; D] = std::array::from_fn(|i| (k / side.pow(i as u32) % side) as i64 - side as i64 / 2);
        let there = (0..D).all(|i| n[i] == 0 || layers[i] > 1);
        let odd = (0..D).filter(|&i| axes[i]).map(|i| n[i]).sum::<i64>() % 2 != 0;
        let r = n.iter().map(|&c| (c * c) as f64).sum::<f64>().sqrt() * DP;
        if there && odd { 2.0 * DP.powi(D as i32) * kernel.dw(r) / r } else { 0.0 }
    };
    (0..side.pow(D as u32)).map(weight).sum()
}

/// u = amplitude sign direction by the solver's own rates, then the acceleration it makes, in an undamped body.
fn pushed<const D: usize, F: Formulation<D> + Copy>(
    form: F,
    n: [usize; D],
    (axes, along): ([bool; D], usize),
) -> Vec<(Vector<f64, D>, Vector<f64, D>)> {
    let mut body = Setup::new(DP).total(form, &block(n, DP));
    body.start().expect("finite");
    let unit: Vector<f64, D> = Vector::from_fn(|i| if i == along { AMPLITUDE * DP } else { 0.0 });
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| unit.times(sign(x, axes)));
    form.rates(body.run_mut(), ONE);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |_| Vector::zero());
    form.rates(body.run_mut(), STILL);
    form.accelerate(body.run_mut(), STILL);
    let p = body.run().particles();
    let of = |i| (p.vector_at(Quantity::ReferencePosition, i), p.vector_at(Quantity::Acceleration, i));
    (0..p.len()).map(of).collect()
}

/// The last axis has one layer in a row; its particles count as inner ones.
fn inner<const D: usize>(x: Vector<f64, D>, n: [usize; D]) -> bool {
    (0..D).all(|i| n[i] == 1 || deep(Vector([x[i]]), [n[i]], (DP, 4)))
}

/// In every direction and for every mode: nothing from the nested form; from the hourglass-free form
/// rho0 a = 2 zeta G symbol u, with symbol < 0: against the displacement.
fn blind_and_restoring<const D: usize>(n: [usize; D], modes: &[[bool; D]], rounding: f64) {
    let setup = Setup::new(DP);
    let tolerance = rounding * setup.acceleration();
    let (hf, nested) = (setup.hourglass_free(D), setup.total_nested(D));
    for &axes in modes {
        let factor = symbol(&setup.total_kernel(D), n, axes);
        let expected = 2.0 * hf.zeta * setup.moduli.shear * factor * AMPLITUDE * DP / setup.moduli.density;
        assert!(expected < -0.1 * setup.acceleration() * AMPLITUDE, "a restoring force worth the name");
        for along in 0..D {
            let ours = pushed(hf, n, (axes, along));
            let theirs = pushed(nested, n, (axes, along));
            let inner = |v: &&(Vector<f64, D>, Vector<f64, D>)| inner(v.0, n);
            assert!(ours.iter().filter(inner).count() >= 4);
            for (x, a) in ours.iter().filter(inner) {
                let error: Vector<f64, D> =
                    Vector::from_fn(|i| a[i] - if i == along { expected * sign(*x, axes) } else { 0.0 });
                assert!(error.norm_squared().sqrt() < tolerance, "{error:?}");
            }
            for (_, a) in theirs.iter().filter(inner) {
                assert!(a.norm_squared().sqrt() < tolerance, "{a:?}");
            }
        }
    }
}

/// Ganzenmueller's control: rho0 a = -alpha E sum_b W V_b / R^2 (u_ab . x_ab) x_ab / |x_ab|^2 over the neighbours that move against the particle,
/// x_ab = X_ab + u_ab; by hand, over the lattice.
fn control<const D: usize>((axes, along): ([bool; D], usize)) -> Vector<f64, D> {
    let (setup, side) = (Setup::new(DP), 7_usize);
    let kernel = setup.total_kernel(D);
    let mut sum = Vector::zero();
    for k in 0..side.pow(D as u32) {
        let n: [f64; D] = std::array::from_fn(|i| (k / side.pow(i as u32) % side) as f64 - 3.0);
        let r2 = n.iter().map(|c| c * c).sum::<f64>() * DP * DP;
        if (0..D).filter(|&i| axes[i]).map(|i| n[i]).sum::<f64>().rem_euclid(2.0) == 1.0 {
            let u: Vector<f64, D> = Vector::from_fn(|i| if i == along { 2.0 * AMPLITUDE * DP } else { 0.0 });
            let x = u - Vector::from_fn(|i| n[i] * DP);
            let weight = kernel.w(r2.sqrt()) * DP.powi(D as i32) / r2;
            sum = sum.plus(-10.0 * setup.moduli.young() * weight * u.dot(x) / x.norm_squared(), x);
        }
    }
    sum.times(1.0 / setup.moduli.density)
}

/// Of a particle that moves along +, and against the mode.
fn controlled<const D: usize>(n: [usize; D], modes: &[[bool; D]]) {
    let setup = Setup::new(DP);
    for (axes, along) in modes.iter().flat_map(|&axes| (0..D).map(move |along| (axes, along))) {
        let expected = control((axes, along));
        assert!(expected[along] < -0.1 * setup.acceleration() * AMPLITUDE, "{expected:?}");
        let found = pushed(setup.ganzenmueller(D), n, (axes, along));
        let up = found.iter().filter(|(x, _)| inner(*x, n) && sign(*x, axes) > 0.0);
        assert!(up.clone().count() >= 2);
        for (_, a) in up {
            let error = (*a - expected).norm_squared().sqrt();
            assert!(error < ROUNDING * setup.acceleration(), "{axes:?} {along}: {a:?} for {expected:?}");
        }
    }
}

#[test]
fn the_control_pushes_back() {
    controlled([12, 11], &[[true, false], [false, true], [true, true]]);
    controlled([10, 10, 10], &[[true, false, false], [true, true, false], [true, true, true]]);
}

#[test]
fn a_single_row() {
    blind_and_restoring([16, 1], &[[true, false]], LISTED);
}

#[test]
fn every_mode_of_a_block_in_the_plane() {
    blind_and_restoring([12, 11], &[[true, false], [false, true], [true, true]], ROUNDING);
}

#[test]
fn every_mode_of_a_block_in_space() {
    let modes: Vec<[bool; 3]> = (1..8).map(|k| [k & 1 != 0, k & 2 != 0, k & 4 != 0]).collect();
    blind_and_restoring([10, 10, 10], &modes, ROUNDING);
}

/// Velocity alternates in an updated Lagrangian body: (largest rates inside of density, of shear stress where it is integrated), and the shear
/// acceleration gained in one second, per velocity, against the mode.
fn flowing<F: Formulation<2> + Copy>(form: F, axes: [bool; 2]) -> (f64, f64, Vec<f64>) {
    let (setup, n) = (Setup::new(DP), [13, 12]);
    let mut body = setup.updated(form, &block(n, DP));
    let v = Vector([0.6, -0.8]);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| v.times(sign(x, axes)));
    body.start().expect("finite");
    form.rates(body.run_mut(), ONE);
    let p = body.run().particles();
    let inside: Vec<usize> =
        (0..p.len()).filter(|&i| deep(p.vector_at(Quantity::ReferencePosition, i), n, (DP, 3))).collect();
    let most = |value: &dyn Fn(usize) -> f64| inside.iter().map(|&i| value(i)).fold(0.0, f64::max);
    let density = most(&|i| p.column(Quantity::DensityRate, 0)[i].abs() * DP / setup.moduli.density);
    let rate = |i| crate::common::size(crate::common::tensor(p, Quantity::ShearStressRate, i));
    let integrated = p.has(Quantity::ShearStressRate);
    let stress = most(&|i| if integrated { rate(i) * DP / setup.moduli.shear } else { 0.0 });
    let gained = |&i: &usize| {
        let velocity = p.vector_at(Quantity::Velocity, i);
        p.vector_at(Quantity::ShearAcceleration, i).dot(velocity) / velocity.norm_squared()
    };
    (density, stress, inside.iter().map(gained).collect())
}

/// The nested forms have no rate of stress: they cannot know. The non-hourglass form gains an acceleration against the mode
/// (at least 0.3 G / (rho dp^2) per velocity, from the four nearest neighbours alone).
#[test]
fn alternating_velocity_in_the_updated_forms() {
    let setup = Setup::new(DP);
    let unit = setup.moduli.shear / (setup.moduli.density * DP * DP);
    for axes in [[true, false], [false, true], [true, true]] {
        for (density, stress, _) in [
            flowing(setup.updated_nested(), axes),
            flowing(setup.artificial_stress(2), axes),
            flowing(setup.corrected_artificial_stress(2), axes),
        ] {
            // Neighbours differ by twice the velocity; the stress takes 2G of the gradient. (A live mode has rates of order 1.)
            assert!(density < 2.0 * PLACED && stress < 4.0 * PLACED, "{density:e} {stress:e}");
        }
        let (density, _, gained) = flowing(setup.non_hourglass(2), axes);
        assert!(density < 2.0 * PLACED, "pressure is as blind: {density:e}");
        assert!(gained.len() >= 42 && gained.iter().all(|&g| g < -0.3 * unit), "{axes:?} {gained:?}");
    }
}

/// The blindness of Fig. 1 has a limit that the tests above rely on: at the ends of a row the nested form does feel it.
#[test]
fn the_ends_of_a_row_feel_the_mode() {
    let setup = Setup::new(DP);
    let row = pushed(setup.total_nested(2), [16, 1], ([true, false], 0));
    let most = row.iter().map(|(_, a)| a.norm_squared().sqrt()).fold(0.0, f64::max);
    assert!(most > 1e-3 * setup.acceleration());
    assert!(largest(&setup.total(setup.total_nested(2), &block([16, 1], DP)), Quantity::Acceleration) == 0.0);
}
