//! Linear fields: gradients are exact at every particle, and a homogeneous deformation leaves the inside in balance.

use crate::common::points::{block, deep, disordered};
use crate::common::{ONE, PLACED, STILL, Setup, set, size, tensor};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::math::{Tensor, Vector};
use taut::run::Run;
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;
/// B is the inverse of a sum of up to 60 dyads; at a corner of the disordered sets its condition is about 10, so that
/// 60 eps/2 become a few 1e-14 at worst.
const EXACT: f64 = 2e-13;

/// A gradient without symmetry, of the size 0.3.
fn gradient<const D: usize>() -> Tensor<f64, D> {
    let h = [[0.12, 0.15, -0.05], [-0.08, -0.06, 0.11], [0.07, -0.13, 0.04]];
    Tensor::from_fn(|i, j| h[i][j])
}

/// F after the velocity field H X has acted for a second on a total Lagrangian body at rest: 1 + H.
fn deformation_is_exact<const D: usize>(points: &[Point<D>]) {
    let setup = Setup::new(DP);
    let form = setup.hourglass_free(D);
    let mut body = setup.total(form, points);
    body.start().expect("finite");
    let h = gradient::<D>();
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| h.mul_vector(x));
    form.rates(body.run_mut(), ONE);
    for i in 0..body.len() {
        let f = tensor(body.run().particles(), Quantity::DeformationGradient, i);
        let error = size(f - h.plus_diagonal(1.0));
        assert!(error < EXACT, "particle {i}: {error:e}");
    }
}

/// The stress that follows the motion u = sym(H) x of an updated Lagrangian body without a stress: 2 G dev sym H.
fn followed_stress_is_exact<const D: usize>(points: &[Point<D>]) {
    let setup = Setup::new(DP);
    let mut body = setup.updated(setup.non_hourglass(D), points);
    body.start().expect("finite");
    let strain = gradient::<D>().symmetric();
    set(body.run_mut().particles_mut(), Quantity::Position, |x| x + strain.mul_vector(x));
    body.look();
    let expected = strain.lift(0.0).plus_diagonal(-strain.trace() / 3.0).times(2.0 * setup.moduli.shear);
    for i in 0..body.len() {
        let error = size(body.state(i).cauchy - expected) / setup.moduli.shear;
        assert!(error < EXACT, "particle {i}: {error:e}");
    }
}

#[test]
fn gradients_in_the_plane() {
    for points in [block([9, 8], DP), disordered([12, 9], DP, 0.3)] {
        deformation_is_exact(&points);
        followed_stress_is_exact(&points);
    }
}

#[test]
fn gradients_in_space() {
    for points in [block([6, 5, 5], DP), disordered([7, 6, 6], DP, 0.3)] {
        deformation_is_exact(&points);
        followed_stress_is_exact(&points);
    }
}

/// Largest accelerations deep inside a lattice and anywhere, in units of what a strain of one makes.
fn accelerations<const D: usize>(body: &dyn Solver, n: [usize; D], layers: usize) -> (f64, f64) {
    let scale = Setup::new(DP).acceleration();
    let (mut inside, mut anywhere) = (0.0f64, 0.0f64);
    for i in 0..body.len() {
        let x = body.read(Quantity::ReferencePosition, i);
        let a = crate::common::length(body.read(Quantity::Acceleration, i)) / scale;
        anywhere = anywhere.max(a);
        if deep(Vector::<f64, D>::from_fn(|k| x[k]), n, (DP, layers)) {
            inside = inside.max(a);
        }
    }
    (inside, anywhere)
}

/// u = H X, F = 1 + H: the stress is the same everywhere, and inside a lattice the sums of gradients vanish. At the
/// surface there is traction.
fn stretched<const D: usize, F: Formulation<D> + Copy>(form: F, n: [usize; D]) {
    let mut body = Setup::new(DP).total(form, &block(n, DP));
    body.start().expect("finite");
    let h = gradient::<D>();
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| h.mul_vector(x));
    form.rates(body.run_mut(), ONE);
    set(body.run_mut().particles_mut(), Quantity::Velocity, |_| Vector::zero());
    form.rates(body.run_mut(), STILL);
    form.accelerate(body.run_mut(), STILL);
    // Four layers: B is that of the inside for all that an inner particle sees.
    let (inside, anywhere) = accelerations(&body, n, 4);
    assert!(inside < 2.0 * EXACT, "{inside:e}");
    assert!(anywhere > 0.01, "traction: {anywhere}");
}

#[test]
fn a_homogeneous_deformation_is_in_balance_inside() {
    let setup = Setup::new(DP);
    stretched(setup.hourglass_free(2), [12, 11]);
    stretched(setup.total_nested(2), [12, 11]);
    stretched(setup.hourglass_free(3), [10, 10, 9]);
    stretched(setup.total_nested(3), [10, 10, 9]);
    stretched(setup.ganzenmueller(2), [12, 11]);
    stretched(setup.ganzenmueller(3), [10, 10, 9]);
}

/// Density and shear stress the same everywhere: balance inside, traction at the surface.
fn stressed<F: Formulation<2> + Copy>(form: F, layers: usize) {
    let (setup, n) = (Setup::new(DP), [12, 11]);
    let mut body = setup.updated(form, &block(n, DP));
    body.start().expect("finite");
    let p = body.run_mut().particles_mut();
    p.column_mut(Quantity::Density, 0).fill(0.99 * setup.moduli.density);
    for (k, s) in [0.02, 0.03, 0.03, -0.02].into_iter().enumerate() {
        p.column_mut(Quantity::ShearStress, k).fill(s * setup.moduli.shear);
    }
    form.accelerate(body.run_mut(), STILL);
    let (inside, anywhere) = accelerations(&body, n, layers);
    // Tension and shear stress together are 0.02 (K + G), from both particles of a pair; artificial stress adds 0.3 of it.
    assert!(inside < 2.6 * 0.02 * PLACED, "{inside:e}");
    assert!(anywhere > 0.005, "traction: {anywhere}");
}

#[test]
fn a_homogeneous_stress_is_in_balance_inside() {
    let setup = Setup::new(DP);
    stressed(setup.updated_nested(), 3);
    stressed(setup.artificial_stress(2), 3);
    // Four layers, as above: B is that of the inside for all that an inner particle sees.
    stressed(setup.corrected_artificial_stress(2), 4);
}
