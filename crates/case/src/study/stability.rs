//! The longest stable step of a case about its undeformed state: by the formulas that there are, by the highest frequency, and by
//! running it.

use crate::build::{build, interior};
use crate::run::RunError;
use crate::{Case, March};
use std::fmt::Write as _;
use taut::field::Quantity;
use taut::integrator::{highest, scattered};
use taut::simulation::{Numbers, Simulation, Solver};

/// Lanczos steps for the highest frequency: six digits of a body of thousands of particles.
const LANCZOS: usize = 120;
/// Steps of a run that is tried. A mode beyond the limit by a thousandth grows by e^(2 sqrt(0.002)) in each, so by e^260.
const STEPS: u32 = 3000;
/// What counts as blown up, over the largest displacement of the stable run.
const BLOWN: f64 = 1e3;
/// The bisection ends with this share of the step.
const PRECISION: f64 = 1e-3;

/// Limits of the step of one body, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// SS Eq. (15), if it is a small-strain body.
    pub paper: Option<f64>,
    /// The exact bound for next neighbours only; likewise.
    pub four_neighbours: Option<f64>,
    /// That of the neighbours that there are, on a lattice without edges; likewise.
    pub lattice: Option<f64>,
    /// 2/sqrt(lambda) of the body as it is, if its neighbours are those of the reference configuration.
    pub operator: Option<f64>,
}

/// The limits that can be computed, of each solver: of each body of the reference configuration, and of all updated ones together.
///
/// # Errors
/// If the case cannot be built or started.
pub fn computed(case: &Case) -> Result<Vec<(String, Limits)>, RunError> {
    let mut built = build(&still(case), Numbers::Double)?;
    let mut all = Vec::new();
    for solver in built.solvers.iter_mut().filter(|solver| !solver.is_rigid()) {
        solver.start().map_err(RunError::unstarted)?;
        let index = solver.scalar(Quantity::Body, 0) as usize;
        all.push((case.name_of(index).to_string(), limits(case, index, solver.as_mut())));
    }
    Ok(all)
}

fn limits(case: &Case, index: usize, solver: &mut dyn Solver) -> Limits {
    let body = &case.bodies[index];
    let small = matches!(body.scheme.march, March::Small { .. });
    let interior = interior(case, body).filter(|_| small);
    let operator = solver.stiffness().map(|mut k| 2.0 / highest(k.as_mut(), LANCZOS).sqrt());
    Limits {
        paper: interior.map(|i| i.paper()),
        four_neighbours: interior.map(|i| i.four_neighbours()),
        lattice: interior.map(|i| i.lattice()),
        operator,
    }
}

/// The case without damping and contact, and at rest, unless it is small strain: there motion does not change the limit, and the loads stay.
fn still(case: &Case) -> Case {
    let mut case = case.clone();
    case.damping = None;
    case.quasi_static = None;
    case.tools.clear();
    case.contacts.clear();
    if !case.bodies.iter().all(|body| matches!(body.scheme.march, March::Small { .. })) {
        case.gravity.clear();
        case.loads.clear();
        case.boundaries.retain(|boundary| !boundary.constraint.is_led());
    }
    case.initial.clear();
    case.bodies.iter_mut().for_each(|body| body.velocity = crate::VectorField::default());
    case
}

/// The case under so many times its loads.
#[must_use]
pub fn times(case: &Case, factor: f64) -> Case {
    let mut case = case.clone();
    for gravity in &mut case.gravity {
        gravity.acceleration = gravity.acceleration.times(factor);
    }
    for load in &mut case.loads {
        load.kind = load.kind.times(factor);
    }
    case
}

/// The limit found by running the case, s: from a step that is stable and one that is not, by bisection.
///
/// # Errors
/// If the case cannot be built or started, or no step of up to four times `guess` (s) is unstable.
pub fn marched(case: &Case, guess: f64) -> Result<Option<f64>, RunError> {
    let case = still(case);
    let moved = trial(&case, 0.5 * guess, f64::INFINITY)?;
    let stable = |dt: f64| Ok::<bool, RunError>(trial(&case, dt, BLOWN * moved)? < BLOWN * moved);
    let (mut low, mut high) = (0.5 * guess, guess * 1.02);
    while stable(high)? {
        low = high;
        high *= 1.2;
        if high > 4.0 * guess {
            return Ok(None);
        }
    }
    while high - low > PRECISION * high {
        let middle =
            if low < 0.97 * high && low < 0.97 * guess { high.min(guess) * 0.98 } else { 0.5 * (low + high) };
        if stable(middle)? { low = middle } else { high = middle }
    }
    Ok(Some(0.5 * (low + high)))
}

/// Runs with steps of `dt` (s); the largest displacement, m, infinite if it diverged. It ends where that is beyond `bound`.
fn trial(case: &Case, dt: f64, bound: f64) -> Result<f64, RunError> {
    let mut simulation = begun(&stepping(case, dt)?)?;
    let mut largest = 0.0;
    for count in 1..=STEPS {
        if simulation.step().is_err() {
            return Ok(f64::INFINITY);
        }
        if count % 50 == 0 || count == STEPS {
            largest = displacement(&simulation).max(largest);
            if largest >= bound {
                break;
            }
        }
    }
    Ok(largest)
}

/// The case with steps of `dt`, s: given to small-strain bodies, and to others by their Courant number.
fn stepping(case: &Case, dt: f64) -> Result<Case, RunError> {
    let mut case = case.clone();
    let natural = begun(&case)?.dt();
    for body in &mut case.bodies {
        match &mut body.scheme.march {
            March::Small { dt: given, .. } => *given = Some(dt),
            _ => body.scheme.cfl *= dt / natural,
        }
    }
    Ok(case)
}

/// The bodies of the case, stirred and begun.
fn begun(case: &Case) -> Result<Simulation, RunError> {
    let mut built = build(case, Numbers::Double)?;
    built.solvers.retain(|solver| !solver.is_rigid());
    built.solvers.iter_mut().for_each(|solver| stir(case, solver.as_mut()));
    Simulation::start(built.solvers, built.drives).map_err(RunError::unstarted)
}

/// A millionth of the wave speed in every direction, without order, so that every mode is there from the beginning.
fn stir(case: &Case, solver: &mut dyn Solver) {
    let index = solver.scalar(Quantity::Body, 0) as usize;
    let speed = case.material_of(&case.bodies[index]).map_or(0.0, |material| 1e-6 * material.wave_speed());
    let noise = scattered(3 * solver.len());
    for place in 0..solver.len() {
        let free = solver.read(Quantity::Free, place);
        let v = std::array::from_fn(|i| speed * free[i] * noise[3 * place + i]);
        solver.write(Quantity::Velocity, place, v);
    }
}

fn displacement(simulation: &Simulation) -> f64 {
    let of = |solver: &dyn Solver| {
        let sizes = (0..solver.len()).map(|place| solver.read(Quantity::Displacement, place));
        sizes.flatten().fold(0.0, |most: f64, u| if u.is_nan() { f64::INFINITY } else { most.max(u.abs()) })
    };
    simulation.solvers().iter().map(|solver| of(solver.as_ref())).fold(0.0, f64::max)
}

/// The limits as a table, in plain text.
#[must_use]
pub fn table(rows: &[(String, Limits)], marched: Option<f64>) -> String {
    let mut text = String::new();
    let mut line = |what: &str, dt: Option<f64>, share: Option<f64>| {
        let share =
            dt.zip(share).map_or(String::new(), |(dt, of)| format!("   {:.4} of 2/sqrt(lambda)", dt / of));
        if let Some(dt) = dt {
            let _ = writeln!(text, "  {what:<54} {dt:.4e} s{share}");
        }
    };
    for (name, limits) in rows {
        let of = limits.operator;
        line(&format!("{name}: small-strain paper, Eq. 15"), limits.paper, of);
        line(&format!("{name}: exact for next neighbours only"), limits.four_neighbours, of);
        line(&format!("{name}: lattice without edges, this kernel"), limits.lattice, of);
        line(&format!("{name}: 2/sqrt(lambda) of the body as it is"), of, None);
    }
    let shortest = rows.iter().filter_map(|(_, limits)| limits.operator).reduce(f64::min);
    line("found by running the case", marched, shortest);
    text
}
