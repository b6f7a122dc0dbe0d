//! The time step at rest, against what can be written down.

use crate::common::Setup;
use crate::common::points::block;
use taut::integrator::WaveSpeed;
use taut::material::{Moduli, Plane};
use taut::simulation::{Simulation, Solver, total, updated};

const DP: f64 = 0.002;
/// A dozen operations.
const ROUNDING: f64 = 1e-14;

fn first_step(solver: Box<dyn Solver>) -> f64 {
    Simulation::start(vec![solver], vec![]).expect("finite").dt()
}

fn assert_close(found: f64, expected: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < ROUNDING, "{what}: {found:e} for {expected:e}");
}

fn at(poisson: f64) -> Setup {
    Setup { moduli: Moduli::from_young(1000.0, 2e6, poisson), ..Setup::new(DP) }
}

fn total_step<const D: usize>(setup: Setup, wave_speed: WaveSpeed, n: [usize; D]) -> f64 {
    let options = taut::integrator::TotalOptions { wave_speed, ..setup.total_options(D) };
    let form = (setup.hourglass_free(D), setup.moduli);
    first_step(Box::new(total(&block(n, DP), form, options, taut::run::Cpu::new)))
}

/// CFL h / sqrt((K + 2 G (1 - 1/d)) / rho0): at rest the bound is the longitudinal wave of d dimensions.
#[test]
fn stretch_takes_the_longitudinal_wave() {
    for poisson in [0.0, 0.3, 0.45] {
        for (plane, d) in [(Plane::Strain, 3.0), (Plane::Papers, 2.0)] {
            let setup = Setup { plane, ..at(poisson) };
            let Moduli { bulk, shear, density } = setup.moduli;
            let c = ((bulk + 2.0 * shear * (1.0 - 1.0 / d)) / density).sqrt();
            let expected = 0.6 * 1.15 * DP / c;
            assert_close(total_step(setup, WaveSpeed::Stretch, [6, 5]), expected, "2D");
        }
        let setup = at(poisson);
        let expected = 0.6 * 1.15 * DP / setup.moduli.wave_speed();
        assert_close(total_step(setup, WaveSpeed::Stretch, [5, 4, 4]), expected, "3D");
    }
}

/// CFL h / sqrt(K / rho0) (TL Eq. 33), a longer step.
#[test]
fn paper_takes_the_bulk_wave() {
    let setup = at(0.3);
    let expected = 0.6 * 1.15 * DP / setup.moduli.sound_speed();
    let step = total_step(setup, WaveSpeed::Paper, [6, 5]);
    assert_close(step, expected, "paper");
    assert!(step > 1.1 * total_step(setup, WaveSpeed::Stretch, [6, 5]));
}

fn acoustic_step<const D: usize>(setup: Setup, n: [usize; D]) -> f64 {
    first_step(Box::new(setup.updated(setup.non_hourglass(D), &block(n, DP))))
}

/// 0.4 h / c0 as printed, down to the Poisson ratio where 0.6 h / c_M is shorter: c_M^2 = 2.25 c0^2, which is at
/// G/K = 1.25 (d + 2) / (3 zeta), or nu = 0.2946 in 2D (zeta 3.5) and 0.2870 in 3D (zeta 4.2).
#[test]
fn the_acoustic_step_is_the_papers_where_that_is_stable() {
    for (poisson, printed_2d, printed_3d) in [
        (0.45, true, true),
        (0.3, true, true),
        (0.29, false, true),
        (0.28, false, false),
        (0.1, false, false),
    ] {
        let setup = at(poisson);
        let Moduli { bulk, shear, density } = setup.moduli;
        let expected = |d: f64, printed: bool| {
            let longitudinal = bulk + 3.0 * (0.7 * d + 2.1) * shear / (d + 2.0);
            let modulus = if printed { bulk } else { longitudinal };
            let cfl = if printed { 0.4 } else { 0.6 };
            cfl * 1.3 * DP / (modulus / density).sqrt()
        };
        assert_close(acoustic_step(setup, [6, 5]), expected(2.0, printed_2d), "2D");
        assert_close(acoustic_step(setup, [5, 4, 4]), expected(3.0, printed_3d), "3D");
    }
}

/// The nested form has no such wave: shear_speed = 0 leaves the paper's step at any Poisson ratio.
#[test]
fn without_a_shear_speed_the_paper_decides() {
    let setup = at(0.1);
    let options = taut::integrator::UpdatedOptions { shear_speed: 0.0, ..setup.updated_options(2) };
    let all = |_| setup.moduli;
    let body = updated(&block([6, 5], DP), (setup.updated_nested(), &all), options, taut::run::Cpu::new);
    let expected = 0.4 * 1.3 * DP / setup.moduli.sound_speed();
    assert_close(first_step(Box::new(body)), expected, "nested");
}

/// Motion shortens both: h / (c + |v|).
#[test]
fn motion_shortens_the_step() {
    let setup = at(0.4);
    let c = setup.moduli.sound_speed();
    let mut points = block([6, 5], DP);
    points.iter_mut().for_each(|p| p.v = taut::math::Vector([0.3 * c, 0.4 * c]));
    let paper = first_step(Box::new(setup.updated(setup.non_hourglass(2), &points)));
    assert_close(paper, 0.4 * 1.3 * DP / (1.5 * c), "updated");
    let wave = setup.moduli.wave_speed();
    let stretch = first_step(Box::new(setup.total(setup.hourglass_free(2), &points)));
    assert_close(stretch, 0.6 * 1.15 * DP / (wave + 0.5 * c), "total");
}
