//! The matrix of the small-strain form, number by number: what makes steps stable and energy constant.

use super::Operator;
use crate::build::{build, interior};
use crate::{Case, Overrides};
use faer::Mat;
use taut::field::Quantity;
use taut::simulation::{Numbers, Solver};

const PLATE: &str = include_str!("../../../../../cases/lk-rectangle.toml");
const ANNULUS: &str = include_str!("../../../../../cases/lk-annulus.toml");

/// The body of a case, begun, and how far its particles see.
fn body(text: &str, set: &[&str]) -> (Box<dyn Solver>, f64) {
    let overrides = Overrides::set(set.iter().copied());
    let case = Case::parse("case.toml", text, &overrides).expect("a case");
    let mut built = build(&case, Numbers::Double).expect("particles");
    let mut solver = built.solvers.swap_remove(0);
    solver.start().expect("finite");
    let support = interior(&case, &case.bodies[0]).expect("small strain").kernel.support();
    (solver, support)
}

/// All bodies that are looked at: the plate in every normalisation, and the annulus, whose particles are on no lattice and of several masses.
fn bodies(particles: &str) -> [(&'static str, Box<dyn Solver>, f64); 4] {
    let plate = |normalisation: &str| body(PLATE, &[particles, &format!("normalisation={normalisation}")]);
    let named = |name, (solver, support)| (name, solver, support);
    [
        named("adjoint", plate("adjoint")),
        named("none", plate("none")),
        named("literal", plate("literal")),
        named("annulus", body(ANNULUS, &["parameters.radial=5"])),
    ]
}

/// V L is symmetric (m s L where the literal form multiplies by 1/s): entry by entry, over the largest.
#[test]
fn the_matrix_is_symmetric() {
    for (name, mut solver, support) in bodies("parameters.resolution=20") {
        let operator =
            Operator::of(solver.as_mut(), support).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(operator.asymmetry < 1e-12, "{name}: {:e}", operator.asymmetry);
    }
}

/// a = L u as a matrix, column by column, as it is: not made symmetric by anything.
fn dense(solver: &mut dyn Solver) -> Mat<f64> {
    let mut stiffness = solver.stiffness().expect("a body");
    let n = stiffness.len();
    let (mut u, mut a) = (vec![0.0; n], vec![0.0; n]);
    let mut matrix = Mat::zeros(n, n);
    for j in 0..n {
        u.fill(0.0);
        u[j] = 1.0;
        stiffness.apply(&u, &mut a);
        a.iter().enumerate().for_each(|(i, a)| matrix[(i, j)] = *a);
    }
    matrix
}

/// Eigenvalues of L, found without using that it is symmetric in any product: real, and none positive, so that no displacement grows by itself whatever the stress.
#[test]
fn the_spectrum_is_real_and_not_positive() {
    for (name, mut solver, _) in bodies("parameters.resolution=12") {
        let eigenvalues = dense(solver.as_mut()).eigenvalues().expect("converged");
        let largest = eigenvalues.iter().map(|l| l.re.abs()).fold(0.0, f64::max);
        for l in eigenvalues {
            // The two translations, and what is nearly a turn, are zero beside the rounding of the largest.
            assert!(l.im.abs() < 1e-10 * l.re.abs().max(1e-4 * largest), "{name}: {l:?} of {largest:e}");
            assert!(l.re <= 1e-12 * largest, "{name}: {l:?} of {largest:e}");
        }
    }
}

/// Tangential loads on the outermost and the innermost ring: the moment of either is 2 pi q, and so the sum vanishes to the last digits, however few particles there are.
#[test]
fn the_loads_of_the_annulus_have_no_moment() {
    for around in ["36", "94"] {
        let (solver, _) = body(ANNULUS, &[&format!("parameters.around={around}")]);
        let moment = |place: usize| {
            let (x, b) =
                (solver.read(Quantity::ReferencePosition, place), solver.read(Quantity::BodyForce, place));
            solver.scalar(Quantity::Mass, place) * (x[0] * b[1] - x[1] * b[0])
        };
        let all: Vec<f64> = (0..solver.len()).map(moment).collect();
        let (sum, one): (f64, f64) = (all.iter().sum(), all.iter().map(|m| 0.5 * m.abs()).sum());
        // Of the case: 1.7227e-9 N.
        assert!((one / (std::f64::consts::TAU * 1.7227e-9) - 1.0).abs() < 1e-12, "{around}: {one:e}");
        assert!(sum.abs() < 1e-13 * one, "{around}: {sum:e} of {one:e}");
    }
}
