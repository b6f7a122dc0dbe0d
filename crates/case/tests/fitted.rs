//! Bodies of fitted particles as they begin: at rest they stay at rest, they have the volume of the body, and gradients are exact.

use case::build::build;
use case::{Case, Overrides};
use std::f64::consts::PI;
use taut::field::Quantity;
use taut::kernel::Kernel;
use taut::math::{Tensor, Vector};
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

/// The relaxation calls particles at rest when the residual times the spacing, of which nothing inside is borne by walls, has this root mean square.
const REST: f64 = 2e-3;

/// What a linear velocity does in its first step.
struct Patch {
    /// The largest error of the rate of F over H.
    rate: f64,
    /// The accelerations, m/s^2.
    a: Vec<Vector<f64, 3>>,
    /// The sum V grad W of each particle, reckoned here, 1/m.
    s: Vec<Vector<f64, 3>>,
    /// Whether nothing of the surface reaches it.
    deep: Vec<bool>,
}

/// The root mean square over some of the particles.
fn rms(of: &[Vector<f64, 3>], which: impl Fn(usize) -> bool) -> f64 {
    let squares: Vec<f64> = (0..of.len()).filter(|&i| which(i)).map(|i| of[i].norm_squared()).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// The velocity field H X acts over the first step on a ball of radius 1/2.
fn patch(dimension: usize, shape: &str, spacing: f64, fill: &str) -> Patch {
    let row = |i: usize| {
        let term = |j: usize| format!("({})*{}", H[i][j], ["x", "y", "z"][j]);
        format!("\"{}\"", (0..dimension).map(term).collect::<Vec<_>>().join(" + "))
    };
    let velocity = format!("[{}]", (0..dimension).map(row).collect::<Vec<_>>().join(", "));
    let mut simulation = begun(&case(dimension, (shape, spacing, fill), &velocity), 0);
    let body = &simulation.solvers()[0];
    let words = || (0..dimension * dimension).map(|k| (k, H[k / dimension][k % dimension]));
    let off =
        |i: usize| words().map(move |(k, h)| (body.word(Quantity::DeformationRate, k, i) - h).abs() / 1e-3);
    let rate = (0..body.len()).flat_map(off).fold(0.0, f64::max);
    simulation.step().expect("finite");
    let body = &simulation.solvers()[0];
    let read = |field, i| Vector::from_fn(|k| body.read(field, i)[k]);
    let x: Vec<Vector<f64, 3>> = (0..body.len()).map(|i| read(Quantity::ReferencePosition, i)).collect();
    let kernel = Kernel::new(taut::kernel::Shape::WendlandC2, 1.15 * spacing, dimension);
    let sum = |i: usize| {
        (0..x.len()).fold(Vector::zero(), |sum, j| {
            let way = x[i].plus(-1.0, x[j]);
            let r = way.norm_squared().sqrt();
            if r == 0.0 || r >= kernel.support() {
                sum
            } else {
                sum.plus(body.rest_volume(j) * kernel.dw(r) / r, way)
            }
        })
    };
    // Surfaces of particles are half a spacing outside of the outermost.
    let deep = x.iter().map(|x| x.norm_squared().sqrt() < 0.5 - 0.5 * spacing - kernel.support()).collect();
    let a = (0..x.len()).map(|i| read(Quantity::Acceleration, i)).collect();
    Patch { rate, a, s: (0..x.len()).map(sum).collect(), deep }
}

/// The tensor M that makes a = M s, by least squares.
fn tied(a: &[Vector<f64, 3>], s: &[Vector<f64, 3>], dimension: usize) -> Tensor<f64, 3> {
    // In the plane nothing is said about the third row.
    let flat = Tensor::from_fn(|i, j| f64::from(u8::from(i == j && i >= dimension)));
    let squares = s.iter().fold(flat, |sum, s| sum.plus(1.0, s.outer(*s)));
    let products = a.iter().zip(s).fold(Tensor::zero(), |sum, (a, s)| sum.plus(1.0, a.outer(*s)));
    products.mul(squares.inverse())
}

#[test]
fn gradients_are_exact_and_a_patch_is_out_of_balance_by_the_residual_and_no_more() {
    for (dimension, shape, spacing) in [
        (2, "{ ball = { center = [0, 0], radius = 0.5 } }", 0.02),
        (3, "{ ball = { center = [0, 0, 0], radius = 0.5 } }", 0.04),
    ] {
        let Patch { rate, a, s, deep } = patch(dimension, shape, spacing, "fitted");
        let lattice = patch(dimension, shape, spacing, "lattice");
        // B is the inverse of a sum of up to 80 dyads, well conditioned: some 100 roundings of 1e-16.
        assert!(rate < 2e-13 && lattice.rate < 2e-13, "{rate:e} {:e}", lattice.rate);
        // F is the same everywhere, and so is what the force multiplies grad W with: rho a = 2 (Q + zeta G J^(-2/d) (1 + H)) sum V grad W, for every
        // particle. Pair lists keep W'/r in single precision: 2^-24 of the sum of |V grad W|, which is less than 2/dp, where the root mean
        // square of the sums themselves is a tenth of 1/dp or more.
        let m = tied(&a, &s, dimension);
        let rest: Vec<_> = a.iter().zip(&s).map(|(a, s)| a.plus(-1.0, m.mul_vector(*s))).collect();
        let (off, all, inside) = (rms(&rest, |_| true), rms(&a, |_| true), rms(&a, |i| deep[i]));
        assert!(rms(&s, |_| true) * spacing > 0.1 && off < 2e-6 * all, "{off:e} of {all:e}");
        // Particles at rest have REST over all of them, so at most this over those inside; M multiplies it by its norm at most.
        let share = deep.iter().filter(|deep| **deep).count() as f64 / deep.len() as f64;
        let bound = m.double_dot(m).sqrt() * REST / share.sqrt() / spacing;
        let (told, balanced) = (inside / all, rms(&lattice.a, |i| lattice.deep[i]));
        println!(
            "{dimension}D: inside {told:.2e} of all, at most {:.2e}; off {:.1e}",
            bound / all,
            off / all
        );
        assert!(inside < bound, "{told:e} of all, {:e}", bound / all);
        // On a lattice pairs cancel.
        assert!(balanced < 1e-10 * rms(&lattice.a, |_| true), "{balanced:e}");
    }
}
