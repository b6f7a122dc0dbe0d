//! Lanes are scalars: every instruction set gives what one number at a time gives, except for the order of sums and for
//! the single precision of listed weights.

use crate::common::points::{block, disordered, ring, stir};
use crate::common::{Clock, FORMS, Form, SINGLE, Setup};
use taut::field::Quantity;
use taut::math::Tensor;
use taut::run::{Cpu, Double, InstructionSet, Serial, Single};
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;
const STEPS: usize = 5;
/// How much larger the sum of magnitudes is than the largest sum that is left: a divergence over the size of the body.
const CANCELLED: f64 = 10.0;
/// Sums of up to 64 terms in another order, with or without fused multiplication: 64 eps/2 of the sum of magnitudes, in
/// each step.
const ROUNDING: f64 = 64.0 * 1.1e-16 * CANCELLED * STEPS as f64;
/// As ROUNDING, with listed weights that are two roundings of single precision off: up to 16 in the worst case (those of r, three times
/// each in (1 - q/2)^3), of any sign, over dozens of neighbours.
const LISTED: f64 = 2.0 * SINGLE * CANCELLED * STEPS as f64;

type Fields = Vec<(&'static str, Vec<f64>)>;

/// What is compared: each field by particle id, flat. (Not the strain energy, a small difference of large numbers.)
fn fields(solver: &dyn Solver) -> Fields {
    let by_id = |value: &dyn Fn(usize) -> Vec<f64>| {
        let mut rows = vec![Vec::new(); solver.len()];
        solver.ids().iter().enumerate().for_each(|(place, &id)| rows[id as usize] = value(place));
        rows.concat()
    };
    let vector = |field: Quantity| (field.name(), by_id(&|i| solver.read(field, i).to_vec()));
    let flat = |t: Tensor<f64, 3>| t.0.concat();
    vec![
        vector(Quantity::Displacement),
        vector(Quantity::Velocity),
        vector(Quantity::Acceleration),
        ("Density", by_id(&|i| vec![solver.state(i).density])),
        ("CauchyStress", by_id(&|i| flat(solver.state(i).cauchy))),
        ("DeformationGradient", by_id(&|i| solver.state(i).deformation.map_or(vec![], flat))),
        ("Dissipated", by_id(&|i| vec![solver.scalar(Quantity::Dissipated, i)])),
    ]
}

fn marched(mut body: Box<dyn Solver>) -> Fields {
    Clock::start(body.as_mut()).expect("finite").steps(body.as_mut(), STEPS);
    fields(body.as_ref())
}

fn same(expected: &Fields, found: &Fields, (what, tolerance): (&str, f64)) {
    for ((name, expected), (_, found)) in expected.iter().zip(found) {
        assert_eq!(expected.len(), found.len());
        let most = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let error = expected.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error <= tolerance * most, "{what} {name}: {error:e} of {most:e}");
    }
}

/// Every instruction set against the other, and against one number at a time: within `tolerance` of serial, and among the sets, whose lists have weights of their own roundings, within `among`.
fn lanes_equal_serial<const D: usize>(form: Form, points: &[Point<D>], (tolerance, among): (f64, f64)) {
    let setup = Setup::new(DP);
    let serial = marched(setup.body_on(form, points, Serial::new));
    let lanes: Vec<Fields> = InstructionSet::all()
        .into_iter()
        .map(|set| marched(setup.body_on(form, points, |p| Cpu::<D, Double>::with(p, set))))
        .collect();
    for found in &lanes {
        same(&serial, found, (&format!("{form:?} {D}D lanes against serial"), tolerance));
        same(&lanes[0], found, (&format!("{form:?} {D}D lanes against other lanes"), among));
    }
}

fn stirred<const D: usize>(mut points: Vec<Point<D>>) -> Vec<Point<D>> {
    stir(&mut points, 0.05 * Setup::new(DP).moduli.sound_speed(), 12.0 * DP);
    points
}

/// A ring of 172 particles and a block of 210, without symmetry: two chunks of lists, and a rest that fills no lanes.
#[test]
fn on_lists() {
    let (plane, space) = (stirred(ring(DP)), stirred(disordered([7, 6, 5], DP, 0.25)));
    assert!(plane.len() > 128 && space.len() > 128 && space.len() % 4 != 0);
    for form in FORMS {
        lanes_equal_serial(form, &plane, (LISTED, LISTED));
        lanes_equal_serial(form, &space, (LISTED, LISTED));
    }
}

/// Total Lagrangian bodies born on a lattice, with a hole: one stencil, in double precision.
#[test]
fn on_lattices() {
    let mut plane = stirred(block([17, 13], DP));
    let mut space = stirred(block([9, 7, 6], DP));
    plane.retain(|p| (p.x[0] - 12.5 * DP).hypot(p.x[1] - 6.5 * DP) > 2.2 * DP);
    space.retain(|p| (p.x[0] - 6.5 * DP).hypot(p.x[1] - 3.5 * DP) > 1.2 * DP);
    for form in [Form::HourglassFree, Form::TotalNested, Form::Ganzenmueller] {
        lanes_equal_serial(form, &plane, (ROUNDING, ROUNDING));
        lanes_equal_serial(form, &space, (ROUNDING, ROUNDING));
    }
}

/// Pair sums in single precision, state in double: five steps differ by a few roundings of single precision (6e-8) of the
/// sums, which cancel to a tenth of their terms.
#[test]
fn in_single_precision() {
    let tolerance = 16.0 * f64::from(f32::EPSILON) * CANCELLED * STEPS as f64;
    let setup = Setup::new(DP);
    let plane = stirred(block([17, 13], DP));
    let double = marched(setup.body_on(Form::HourglassFree, &plane, Cpu::<2, Double>::new));
    let single = marched(setup.body_on(Form::HourglassFree, &plane, Cpu::<2, Single>::single));
    same(&double, &single, ("single precision", tolerance));
}
