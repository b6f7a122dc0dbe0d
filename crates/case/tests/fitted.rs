//! Bodies of fitted particles as they begin: at rest they stay at rest, they have the volume of the body, and gradients are exact.

use case::build::build;
use case::{Case, Overrides};
use std::f64::consts::PI;
use taut::field::Quantity;
use taut::simulation::{Numbers, Simulation};

/// A body of steel-like numbers, so that the wave speed is of the order of 1 with sizes of the order of 1.
fn case(dimension: usize, (shape, spacing, fill): (&str, f64, &str), velocity: &str) -> Case {
    let text = format!(
        "name = \"body\"\ndimension = {dimension}\nspacing = {spacing}\n\
         [material.rubber]\nmodel = \"neo-hookean\"\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0.4\n\
         [[body]]\nname = \"body\"\nmaterial = \"rubber\"\nshape = {shape}\nfill = \"{fill}\"\nvelocity = {velocity}\n\
         [time]\nend = 1\n"
    );
    Case::parse("body.toml", &text, &Overrides::default()).unwrap_or_else(|e| panic!("{}", e.render(false)))
}

fn begun(case: &Case, steps: usize) -> Simulation {
    let built = build(case, Numbers::Double).unwrap_or_else(|e| panic!("{}", e.render(false)));
    let mut simulation = Simulation::new(built.solvers, built.drives);
    simulation.begin().expect("finite");
    (0..steps).for_each(|_| simulation.step().expect("finite"));
    simulation
}

/// Dimension, shape, spacing and volume of what no lattice fits.
fn bodies() -> [(usize, &'static str, f64, f64); 4] {
    let ring = "{ ring = { center = [0, 0], inner = 0.3, outer = 0.5 } }";
    let hollow = "{ ring = { center = [0, 0, 0], inner = 0.3, outer = 0.5 } }";
    let cylinder = "{ cylinder = { from = [0, 0, 0], to = [0, 0, 1], radius = 0.5 } }";
    let tilted = "{ rotate = { angle = 0.4, axis = [1, 2, 3], shape = { box = { min = [0, 0, 0], max = [1, 0.5, 0.4] } } } }";
    [
        (2, ring, 0.02, PI * 0.16),
        (3, hollow, 0.06, 4.0 / 3.0 * PI * (0.125 - 0.027)),
        (3, cylinder, 0.07, PI * 0.25),
        (3, tilted, 0.06, 0.2),
    ]
}

#[test]
fn at_rest_nothing_moves_and_volumes_sum_to_the_body() {
    for (dimension, shape, spacing, volume) in bodies() {
        let still = if dimension == 2 { "[0, 0]" } else { "[0, 0, 0]" };
        let simulation = begun(&case(dimension, (shape, spacing, "fitted"), still), 3);
        let body = &simulation.solvers()[0];
        let mut sum = 0.0;
        for i in 0..body.len() {
            assert_eq!(body.read(Quantity::Acceleration, i), [0.0; 3], "{shape}");
            assert_eq!(body.read(Quantity::Displacement, i), [0.0; 3], "{shape}");
            sum += body.rest_volume(i);
        }
        // Sums of some thousand equal numbers.
        assert!((sum / volume - 1.0).abs() < 1e-11, "{shape}: {sum}");
    }
}

/// A gradient without symmetry, of the size 1e-3 times the time.
const H: [[f64; 3]; 3] = [[0.0012, 0.0015, -0.0005], [-0.0008, -0.0006, 0.0011], [0.0007, -0.0013, 0.0004]];

/// After the velocity field H X has acted over the first step: the largest error of the rate of F over H, and the root mean squares of the
/// accelerations of particles that are deeper inside than anything of the surface reaches, and of all.
fn patch(dimension: usize, shape: &str, spacing: f64, fill: &str) -> [f64; 3] {
    let row = |i: usize| {
        let term = |j: usize| format!("({})*{}", H[i][j], ["x", "y", "z"][j]);
        format!("\"{}\"", (0..dimension).map(term).collect::<Vec<_>>().join(" + "))
    };
    let velocity = format!("[{}]", (0..dimension).map(row).collect::<Vec<_>>().join(", "));
    let mut simulation = begun(&case(dimension, (shape, spacing, fill), &velocity), 0);
    let body = &simulation.solvers()[0];
    let mut error = 0.0_f64;
    for i in 0..body.len() {
        for (k, h) in (0..dimension * dimension).map(|k| (k, H[k / dimension][k % dimension])) {
            error = error.max((body.word(Quantity::DeformationRate, k, i) - h).abs() / 1e-3);
        }
    }
    simulation.step().expect("finite");
    let body = &simulation.solvers()[0];
    let (mut inside, mut all, mut count) = (0.0, 0.0, 0);
    // Two supports: B is that of the inside for all that a particle sees.
    let deep = |x: [f64; 3]| x.iter().map(|c| c * c).sum::<f64>().sqrt() < 0.5 - 5.0 * spacing;
    for i in 0..body.len() {
        let a = body.read(Quantity::Acceleration, i).iter().map(|c| c * c).sum::<f64>();
        all += a;
        if deep(body.read(Quantity::ReferencePosition, i)) {
            inside += a;
            count += 1;
        }
    }
    [error, (inside / f64::from(count)).sqrt(), (all / body.len() as f64).sqrt()]
}

#[test]
fn gradients_are_exact_and_the_inside_of_a_patch_is_nearly_in_balance() {
    for (dimension, shape, spacing) in [
        (2, "{ ball = { center = [0, 0], radius = 0.5 } }", 0.02),
        (3, "{ ball = { center = [0, 0, 0], radius = 0.5 } }", 0.04),
    ] {
        let [error, inside, all] = patch(dimension, shape, spacing, "fitted");
        let [on_lattice, balanced, around] = patch(dimension, shape, spacing, "lattice");
        println!("{dimension}D fitted: rate of F {error:.1e}, inside {:.2e} of all", inside / all);
        println!("{dimension}D lattice: rate of F {on_lattice:.1e}, inside {:.2e} of all", balanced / around);
        // B is the inverse of a sum of up to 80 dyads, well conditioned: some 100 roundings of 1e-16.
        assert!(error < 2e-13 && on_lattice < 2e-13, "{error:e} {on_lattice:e}");
        // Accelerations inside are the residual of sum V grad W (2e-3), those at the surface a one-sided sum (about a half), and a tenth of the
        // particles or more are there: about a hundredth of the root mean square of all.
        assert!(inside < 3e-2 * all && balanced < 1e-10 * around, "{inside:e} of {all:e}; {balanced:e}");
    }
}
