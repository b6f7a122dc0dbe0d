//! Rigid motion makes no stress: finite rotations of total Lagrangian bodies, translations of all, and in updated
//! Lagrangian bodies no stress rate from a rigid velocity field on a fresh configuration.

use crate::common::points::{block, deep, disordered};
use crate::common::{Clock, FINITE, ONE, SINGLE, STILL, Setup, largest, set, size, tensor};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::formulation::total::HourglassFree;
use taut::material::{NeoHookeanLog, Plane};
use taut::math::{Tensor, Vector};
use taut::run::Run;
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;
/// A sum of up to 60 pairs, each with a dozen roundings, of terms (K + G) |grad W| V with a sum of magnitudes of at
/// most 4 / dp: 60 x 12 x 4 x 1.1e-16 in units of the acceleration that a strain of one makes, if all err alike.
const ROUNDING: f64 = 3e-13;
/// The same where grad W, w and e come from a list: a dozen roundings cancel no better than two of single precision, times
/// the sum of magnitudes, 4, and |R - 1| < 2.
const LISTED: f64 = 16.0 * SINGLE;

/// A large turn about no special axis.
fn rotation<const D: usize>() -> Tensor<f64, D> {
    let (s, c) = 2.1f64.sin_cos();
    let (p, q) = if D == 3 { 0.8f64.sin_cos() } else { (0.0, 1.0) };
    let turn = Tensor([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]);
    let tilt = Tensor([[1.0, 0.0, 0.0], [0.0, q, -p], [0.0, p, q]]);
    let both = tilt.mul(turn);
    Tensor::from_fn(|i, j| both[i][j])
}

/// The antisymmetric gradient of a rotating flow, 1/s.
fn spin<const D: usize>() -> Tensor<f64, D> {
    let w = [[0.0, -3.0, 1.0], [3.0, 0.0, -2.0], [-1.0, 2.0, 0.0]];
    Tensor::from_fn(|i, j| w[i][j])
}

/// u = (R - 1) X and F = R, by hand.
fn turned<const D: usize, F: Formulation<D> + Copy>(
    form: F,
    points: &[Point<D>],
    (what, tolerance): (&str, f64),
) {
    let setup = Setup::new(DP);
    let mut body = setup.total(form, points);
    body.start().expect("finite");
    let r = rotation::<D>();
    let p = body.run_mut().particles_mut();
    set(p, Quantity::Displacement, |x| r.mul_vector(x) - x);
    for k in 0..D * D {
        p.column_mut(Quantity::DeformationGradient, k).fill(r[k / D][k % D]);
    }
    form.rates(body.run_mut(), STILL);
    form.accelerate(body.run_mut(), STILL);
    let a = largest(&body, Quantity::Acceleration) / setup.acceleration();
    assert!(a < tolerance, "{what}: {a:e}");
    for place in 0..body.len() {
        // Stress at F = R: J^2 - 1 and dev b are differences of numbers near 1, a few eps each.
        let stress = size(body.state(place).cauchy) / setup.moduli.bulk;
        assert!(stress < 20.0 * f64::EPSILON, "{what}: {stress:e}");
    }
}

fn turned_in_every_way<const D: usize>(n: [usize; D]) {
    let setup = Setup::new(DP);
    let h = setup.total_kernel(D).h();
    for (points, tolerance) in [(block(n, DP), ROUNDING), (disordered(n, DP, 0.25), LISTED)] {
        turned(setup.hourglass_free(D), &points, ("hourglass-free", tolerance));
        let log = NeoHookeanLog { moduli: setup.moduli };
        turned(HourglassFree::new(log, h), &points, ("hourglass-free, log", tolerance));
        // The nested form has no stress at all, so that the rounding of its weights does not matter.
        turned(setup.total_nested(D), &points, ("nested", ROUNDING));
        // The control compares F with distances, of which those of a list are on a grid.
        turned(setup.ganzenmueller(D), &points, ("ganzenmueller", tolerance));
    }
}

#[test]
fn a_finite_rotation_in_the_plane() {
    turned_in_every_way([11, 8]);
}

#[test]
fn a_finite_rotation_in_space() {
    turned_in_every_way([7, 6, 6]);
}

/// A body that moves with F = R must also be found at F = R by the solver's own rates: du = (R - 1) X in one step.
#[test]
fn a_rotation_found_by_the_rates() {
    let setup = Setup::new(DP);
    let form = setup.hourglass_free(3);
    let mut body = setup.total(form, &disordered([7, 6, 6], DP, 0.25));
    body.start().expect("finite");
    let r = rotation::<3>();
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| r.mul_vector(x) - x);
    form.rates(body.run_mut(), ONE);
    for place in 0..body.len() {
        let error = size(tensor(body.run().particles(), Quantity::DeformationGradient, place) - r);
        // The moment matrix of a corner of this set has a condition of about 10; 60 terms of eps each.
        assert!(error < 1e-13, "{error:e}");
    }
}

/// Differences of equal velocities are zero. What is left is rounding: displacements of particles in a full group of lanes
/// and behind the last one differ in the last bit (fused multiplication or not), and the pair force sees it.
#[test]
fn translation_makes_no_stress_in_any_formulation() {
    let setup = Setup { stepping: taut::integrator::Stepping::Single, ..Setup::new(DP) };
    let c = setup.moduli.sound_speed();
    let mut plane = disordered([9, 8], DP, 0.25);
    let mut space = disordered([6, 5, 5], DP, 0.25);
    plane.iter_mut().for_each(|p| p.v = Vector([0.1 * c, -0.07 * c]));
    space.iter_mut().for_each(|p| p.v = Vector([0.1 * c, -0.07 * c, 0.03 * c]));
    for form in FINITE {
        for mut body in [setup.body(form, &plane), setup.body(form, &space)] {
            Clock::start(body.as_mut()).expect("finite").steps(body.as_mut(), 20);
            let a = largest(body.as_ref(), Quantity::Acceleration) / setup.acceleration();
            assert!(a < ROUNDING, "{form:?}: {a:e}");
            body.look();
            let stress = (0..body.len()).map(|i| size(body.state(i).cauchy)).fold(0.0, f64::max);
            assert!(stress < ROUNDING * setup.moduli.bulk, "{form:?}: {stress:e}");
            assert!(largest(body.as_ref(), Quantity::Displacement) > 0.0, "it moved");
        }
    }
}

/// Rates of a spinning velocity field on a fresh updated Lagrangian configuration, relative to those of a strain rate of
/// the same size: density, shear acceleration, shear stress where that is integrated.
fn spinning<const D: usize, F: Formulation<D> + Copy>(
    form: F,
    points: &[Point<D>],
) -> Vec<(Vector<f64, D>, [f64; 3])> {
    let setup = Setup { plane: Plane::Strain, ..Setup::new(DP) };
    let mut body = setup.updated(form, points);
    let w = spin::<D>();
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| w.mul_vector(x));
    body.start().expect("finite");
    form.rates(body.run_mut(), ONE);
    let p = body.run().particles();
    let (m, rate, integrated) = (setup.moduli, size(w), p.has(Quantity::ShearStressRate));
    let of = |place: usize| {
        let a = p.vector_at(Quantity::ShearAcceleration, place).norm_squared().sqrt();
        let rates = [
            p.column(Quantity::DensityRate, 0)[place].abs() / (m.density * rate),
            a / (setup.acceleration() * rate),
            if integrated {
                size(tensor(p, Quantity::ShearStressRate, place)) / (m.shear * rate)
            } else {
                0.0
            },
        ];
        (p.vector_at(Quantity::ReferencePosition, place), rates)
    };
    (0..p.len()).map(of).collect()
}

/// Each pair sees v_ab perpendicular to e: no density rate and no shear acceleration, anywhere, but for the rounding of e.
#[test]
fn spin_makes_no_rates_in_the_non_hourglass_form() {
    let setup = Setup::new(DP);
    let plane = spinning(setup.non_hourglass(2), &disordered([11, 9], DP, 0.25));
    let space = spinning(setup.non_hourglass(3), &disordered([7, 6, 6], DP, 0.25));
    for rates in plane.into_iter().map(|p| p.1).chain(space.into_iter().map(|p| p.1)) {
        assert!(rates[0] < LISTED && rates[1] < LISTED, "{rates:?}");
    }
}

/// Velocity w x for a second, w antisymmetric: the gradient of what was travelled is corrected by B, made with the same weights, so it is
/// exactly w, and has no strain.
#[test]
fn spin_makes_no_stress_that_follows_the_motion() {
    fn stress<const D: usize>(points: &[Point<D>]) -> f64 {
        let setup = Setup { plane: Plane::Strain, ..Setup::new(DP) };
        let mut body = setup.updated(setup.non_hourglass(D), points);
        body.start().expect("finite");
        let w = spin::<D>();
        set(body.run_mut().particles_mut(), Quantity::Position, |x| x + w.mul_vector(x));
        body.look();
        let of = |place| size(body.state(place).cauchy) / (setup.moduli.shear * size(w));
        (0..body.len()).map(of).fold(0.0, f64::max)
    }
    let found = [stress(&disordered([11, 9], DP, 0.25)), stress(&disordered([7, 6, 6], DP, 0.25))];
    assert!(found.iter().all(|&stress| stress < ROUNDING), "{found:?}");
}

/// The plain Laplacian (UL Eq. 18) takes differences of velocity across the pair for shear: at a surface, where they do not cancel, a spin makes
/// shear accelerations of the order of those that a strain rate of the same size would make; inside of a lattice they cancel.
#[test]
fn spin_makes_shear_in_the_plain_laplacian() {
    let (setup, n) = (Setup::new(DP), [12, 11]);
    let rates = spinning(setup.laplacian(), &block(n, DP));
    let inside = rates.iter().filter(|p| deep(p.0, n, (DP, 3))).map(|p| p.1[1]);
    assert!(inside.clone().count() > 20 && inside.clone().all(|r| r < LISTED));
    let surface = rates.iter().map(|p| p.1[1]).fold(0.0, f64::max);
    let unit = setup.moduli.shear / (setup.moduli.bulk + setup.moduli.shear);
    assert!(surface > 0.3 * unit, "{surface} of {unit}");
}

/// The nested form has no correction, as in its paper: L = w M with the moment matrix M. Density is right anywhere; the
/// stress rate is that of w M - M w, zero where M is a multiple of 1 (inside a lattice) and not at a surface.
#[test]
fn spin_makes_no_stress_rate_inside_the_nested_form() {
    let setup = Setup::new(DP);
    let (n, m) = ([12, 11], [8, 7, 7]);
    let plane = spinning(setup.updated_nested(), &block(n, DP));
    let space = spinning(setup.updated_nested(), &block(m, DP));
    assert!(plane.iter().all(|(_, r)| r[0] < LISTED) && space.iter().all(|(_, r)| r[0] < LISTED));
    let inside = plane.iter().filter(|p| deep(p.0, n, (DP, 3))).map(|p| p.1[2]);
    let inside = inside.chain(space.iter().filter(|p| deep(p.0, m, (DP, 3))).map(|p| p.1[2]));
    assert!(inside.clone().count() > 30 && inside.clone().all(|r| r < LISTED));
    let surface = plane.iter().map(|p| p.1[2]).fold(0.0, f64::max);
    assert!(surface > 0.05, "what the missing correction costs: {surface}");
}
