//! The third axis of a plane body: plane strain, and what the papers print instead.

use crate::common::points::{block, deep, stir};
use crate::common::{Clock, Setup, set};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::material::Plane;
use taut::math::{Tensor, Vector};
use taut::run::Run;
use taut::simulation::Solver;

const DP: f64 = 0.002;
const N: [usize; 2] = [13, 12];

/// Stress after a small confined compression e along the first axis, by one second of the first rates, or of the first motion where stress follows that: (sigma_xx, sigma_yy,
/// sigma_zz) of an inner particle in units of e, and the share of the true compression that its density rate found.
fn confined<F: Formulation<2> + Copy>(form: F, plane: Plane) -> ([f64; 3], f64) {
    let setup = Setup { plane, ..Setup::new(DP) };
    let e = -1e-6;
    let mut body = setup.updated(form, &block(N, DP));
    set(body.run_mut().particles_mut(), Quantity::Velocity, |x| Vector([e * x[0], 0.0]));
    body.start().expect("finite");
    let p = body.run_mut().particles_mut();
    for (field, rate, words) in [
        (Quantity::ShearStress, Quantity::ShearStressRate, 4),
        (Quantity::AxialShearStress, Quantity::AxialShearStressRate, 1),
        (Quantity::Density, Quantity::DensityRate, 1),
        (Quantity::Position, Quantity::Velocity, 2),
    ] {
        for k in 0..if p.has(rate) { words } else { 0 } {
            let rate = p.column(rate, k).to_vec();
            p.column_mut(field, k).iter_mut().zip(rate).for_each(|(x, r)| *x += r);
        }
    }
    body.look();
    let p = body.run().particles();
    let inner = |&i: &usize| deep(p.vector_at(Quantity::ReferencePosition, i), N, (DP, 3));
    let i = (0..p.len()).find(inner).expect("a particle inside");
    let sigma = body.state(i).cauchy;
    let found = -p.column(Quantity::DensityRate, 0)[i] / (setup.moduli.density * e);
    ([0, 1, 2].map(|k| sigma[k][k] / e), found)
}

/// The shear part of that stress in units of G. The uncorrected gradient of a lattice is a fixed share of the true one, the
/// same for density and for the nested stress; the stress of the non-hourglass form is corrected, its share is 1.
fn confined_moduli(nested: bool, plane: Plane) -> [f64; 3] {
    let setup = Setup::new(DP);
    let (sigma, share) = if nested {
        confined(taut::formulation::updated::Nested { stress: stress(plane) }, plane)
    } else {
        confined(taut::formulation::updated::NonHourglass::new(stress(plane), 2), plane)
    };
    // Pressure scales with the share of the density rate; take it out of sigma before scaling the shear part.
    let pressure = setup.moduli.bulk * share;
    let scale = if nested { 1.0 / share } else { 1.0 };
    sigma.map(|s| (s - pressure) * scale / setup.moduli.shear)
}

fn stress(plane: Plane) -> taut::formulation::updated::Hypoelastic {
    taut::formulation::updated::Hypoelastic { plane }
}

/// s / (G e) = (4/3, -2/3, -2/3) in plane strain, as Hooke's law has it in three dimensions; (1, -1, 0) in the papers'
/// plane. Tolerance: density differences lose 1e-16 / 1e-6, times K/G = 5.
#[test]
fn confined_compression() {
    for nested in [true, false] {
        for (plane, expected) in
            [(Plane::Strain, [4.0 / 3.0, -2.0 / 3.0, -2.0 / 3.0]), (Plane::Papers, [1.0, -1.0, 0.0])]
        {
            let found = confined_moduli(nested, plane);
            for k in 0..3 {
                assert!((found[k] - expected[k]).abs() < 1e-8, "nested {nested} {plane:?}: {found:?}");
            }
        }
    }
}

/// The deviator has no trace, whatever the motion: 2D trace plus s_zz is zero, and in the papers' plane s_zz is.
fn deviator_stays_one<F: Formulation<2> + Copy>(form: F, plane: Plane) {
    let setup = Setup { plane, ..Setup::new(DP) };
    let mut points = block(N, DP);
    stir(&mut points, 0.02 * setup.moduli.sound_speed(), 10.0 * DP);
    let mut body = setup.updated(form, &points);
    Clock::start(&mut body).expect("finite").steps(&mut body, 60);
    form.relisting(body.run_mut());
    let p = body.run().particles();
    let (mut most, mut axial, mut trace) = (0.0f64, 0.0f64, 0.0f64);
    for i in 0..p.len() {
        let s: Tensor<f64, 2> = crate::common::tensor(p, Quantity::ShearStress, i);
        let zz = p.column(Quantity::AxialShearStress, 0)[i];
        most = most.max(crate::common::size(s));
        axial = axial.max(zz.abs());
        trace = trace.max((s.trace() + zz).abs());
    }
    // 60 steps of a few roundings each.
    assert!(trace < 1e-13 * most, "{trace:e} of {most:e}");
    match plane {
        Plane::Strain => assert!(axial > 0.05 * most, "{axial} of {most}"),
        Plane::Papers => assert_eq!(axial, 0.0),
    }
}

#[test]
fn the_deviator_stays_a_deviator() {
    for plane in [Plane::Strain, Plane::Papers] {
        deviator_stays_one(taut::formulation::updated::Nested { stress: stress(plane) }, plane);
        deviator_stays_one(taut::formulation::updated::NonHourglass::new(stress(plane), 2), plane);
        let setup = Setup { plane, ..Setup::new(DP) };
        deviator_stays_one(setup.artificial_stress(2), plane);
        deviator_stays_one(setup.corrected_artificial_stress(2), plane);
    }
}
