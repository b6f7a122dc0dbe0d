//! Modes and equilibria of small-strain bodies, from their matrix.

use super::StudyError;
use super::operator::{Mode, Operator};
use crate::build::{Watch, build, interior};
use crate::run::{Framer, fields_measured, masses};
use crate::{Case, Formulation};
use output::Frame;
use output::summary::Measured;
use std::collections::BTreeMap;
use taut::field::Quantity;
use taut::simulation::{Numbers, Simulation, Snapshot, Solver};

/// Largest displacement of a mode as it is shown, in spacings.
const SHOWN: f64 = 2.0;

/// A mode as it is told.
#[derive(Debug)]
pub struct Shown {
    /// Name of the body.
    pub body: String,
    /// The mode.
    pub mode: Mode,
    /// Zigzag (root mean square, over the spacing) for a root mean square displacement of one spacing: near 0 for a smooth mode, up to 1 for one that alternates
    /// from particle to particle.
    pub zigzag: f64,
    /// The body in it, two spacings away where it moves most.
    pub frame: Frame,
}

/// A state of equilibrium.
#[derive(Debug)]
pub struct Balanced {
    /// What the case measures of fields at the end of a run.
    pub measured: BTreeMap<String, Measured>,
    /// The bodies.
    pub frame: Frame,
    /// Share of the loads that rigid motion would take, of each body: left out.
    pub left_out: Vec<(String, f64)>,
}

/// The bodies of a case, begun.
struct Bodies {
    simulation: Simulation,
    watch: Box<dyn Watch>,
    framer: Framer,
}

fn bodies(case: &Case) -> Result<Bodies, StudyError> {
    if let Some(body) = case.bodies.iter().find(|body| body.scheme.formulation != Formulation::SmallStrain) {
        return Err(StudyError::NotSmall(body.name.clone()));
    }
    let mut case = case.clone();
    (case.tools, case.contacts) = (Vec::new(), Vec::new());
    let built = build(&case, Numbers::Double)?;
    let simulation = Simulation::start(built.solvers, Vec::new()).map_err(StudyError::unstarted)?;
    Ok(Bodies { simulation, watch: built.watch, framer: Framer::new(&case) })
}

fn operator(case: &Case, solver: &mut dyn Solver) -> Result<(usize, Operator), StudyError> {
    let index = solver.scalar(Quantity::Body, 0) as usize;
    let support = interior(case, &case.bodies[index]).map_or(0.0, |i| i.kernel.support());
    Ok((index, Operator::of(solver, support)?))
}

/// The `count` lowest modes of each body that are no rigid motions, in the order of their frequencies, with those that are before them.
///
/// # Errors
/// If the case has other bodies, or they do not hold together.
pub fn modes(case: &Case, count: usize) -> Result<Vec<Shown>, StudyError> {
    let mut bodies = bodies(case)?;
    let mut shown = Vec::new();
    for s in 0..bodies.simulation.solvers().len() {
        let (index, operator) = operator(case, bodies.simulation.solvers_mut()[s].as_mut())?;
        let mut vibrations = 0;
        for mode in operator.lowest(count)? {
            if vibrations == count {
                break;
            }
            vibrations += usize::from(!mode.is_rigid());
            let d = case.dimension;
            let most = (0..mode.shape.len() / d)
                .map(|p| (0..d).map(|k| mode.shape[p * d + k].powi(2)).sum::<f64>().sqrt())
                .fold(0.0, f64::max);
            let zigzag = bodies.zigzag(case, s, &mode.shape)?;
            let frame = bodies.frame(s, &mode.shape, (SHOWN * case.spacing / most, mode.frequency()));
            shown.push(Shown { body: case.name_of(index).to_string(), mode, zigzag, frame });
        }
    }
    Ok(shown)
}

/// The state in which all constant body forces and surface loads are in balance with the stress, solved for.
///
/// # Errors
/// As [`modes`]; if loads change with time.
pub fn equilibrium(case: &Case) -> Result<Balanced, StudyError> {
    let mut bodies = bodies(case)?;
    let mut left_out = Vec::new();
    for s in 0..bodies.simulation.solvers().len() {
        let solver = bodies.simulation.solvers_mut()[s].as_mut();
        let (index, operator) = operator(case, solver)?;
        let d = case.dimension;
        let force = |i: usize| solver.read(Quantity::BodyForce, i / d)[i % d];
        let b: Vec<f64> = (0..solver.len() * d).map(force).collect();
        let (u, left) = operator.balance(&b)?;
        solver.displace(&u);
        left_out.push((case.name_of(index).to_string(), left));
    }
    let mut snapshot = Snapshot::default();
    bodies.simulation.snapshot(&mut snapshot);
    let measured = fields_measured(case, &snapshot, &masses(&bodies.simulation));
    let frame = bodies.framed(&snapshot);
    Ok(Balanced { measured, frame, left_out })
}

impl Bodies {
    /// The zigzag of a mode whose root mean square is a spacing.
    fn zigzag(&mut self, case: &Case, solver: usize, shape: &[f64]) -> Result<f64, StudyError> {
        // Small, so that the measure is linear in it.
        let small = 1e-3 * case.spacing;
        let particles = (shape.len() / case.dimension) as f64;
        let size = (shape.iter().map(|c| c * c).sum::<f64>() / particles).sqrt();
        let snapshot = self.moved(solver, shape, small / size);
        let share = (self.simulation.len() as f64 / particles).sqrt();
        Ok(self.watch.measure(&snapshot)?.zigzag_rms / 1e-3 * share)
    }

    /// The bodies with one of them displaced, for a look.
    fn moved(&mut self, solver: usize, shape: &[f64], factor: f64) -> Snapshot {
        let there: Vec<f64> = shape.iter().map(|u| factor * u).collect();
        let back: Vec<f64> = there.iter().map(|u| -u).collect();
        let mut snapshot = Snapshot::default();
        self.simulation.solvers_mut()[solver].displace(&there);
        self.simulation.snapshot(&mut snapshot);
        self.simulation.solvers_mut()[solver].displace(&back);
        snapshot
    }

    fn frame(&mut self, solver: usize, shape: &[f64], (factor, time): (f64, f64)) -> Frame {
        let snapshot = Snapshot { time, ..self.moved(solver, shape, factor) };
        self.framed(&snapshot)
    }

    fn framed(&mut self, snapshot: &Snapshot) -> Frame {
        self.framer.frame(snapshot, &snapshot.deformation, 0)
    }
}
