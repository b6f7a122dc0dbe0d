//! The particle at which a run stopped, and its neighbourhood.

use output::{Array, Frame, Values};
use taut::field::{Quantity, Rank};
use taut::integrator::Diverged;
use taut::run::Among;
use taut::simulation::{Simulation, Solver};

/// How far the neighbourhood reaches, in supports of the kernel.
const SUPPORTS: f64 = 3.0;

/// The culprit and what is around it.
pub struct Culprit<'a> {
    /// Its solver.
    pub solver: &'a dyn Solver,
    /// Where it is stored there.
    pub place: usize,
    /// Id of the first particle of the solver, as in the files.
    first: u32,
    /// Places within three supports, itself among them, with the distance, m.
    around: Vec<(usize, f64)>,
    /// The field of positions that neighbours are found by: the reference if the present position is no number.
    by: Quantity,
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

fn is_number(x: [f64; 3]) -> bool {
    x.iter().all(|c| c.is_finite())
}

impl<'a> Culprit<'a> {
    /// The particle that a run stopped at; `None` if there is no such particle.
    pub fn find(simulation: &'a Simulation, diverged: &Diverged) -> Option<Self> {
        let mut first = 0;
        for solver in simulation.solvers() {
            let len = solver.len() as u32;
            if diverged.particle < first + len {
                let place = solver.stored((diverged.particle - first) as usize);
                return Some(Self::at(solver.as_ref(), place, first));
            }
            first += len;
        }
        None
    }

    fn at(solver: &'a dyn Solver, place: usize, first: u32) -> Self {
        let reach = solver.reach();
        let present = is_number(solver.read(reach.positions, place));
        let by = if present { reach.positions } else { Quantity::ReferencePosition };
        let here = solver.read(by, place);
        let mut around: Vec<(usize, f64)> = (0..solver.len())
            .map(|other| (other, distance(solver.read(by, other), here)))
            .filter(|&(other, r)| other == place || r < SUPPORTS * reach.kernel.support())
            .collect();
        around.sort_by(|a, b| a.1.total_cmp(&b.1));
        Self { solver, place, first, around, by }
    }

    /// How many neighbours a particle of the neighbourhood has among those at these places.
    fn count(&self, place: usize, among: &[(usize, [f64; 3], f64)]) -> i64 {
        let reach = self.solver.reach();
        let (here, body) = (self.solver.read(self.by, place), self.solver.scalar(Quantity::Body, place));
        let near = |&&(other, x, its): &&(usize, [f64; 3], f64)| {
            let r = distance(x, here);
            other != place
                && r > 0.0
                && r < reach.kernel.support()
                && (reach.among == Among::All || its == body)
        };
        among.iter().filter(near).count() as i64
    }

    /// Neighbours of the culprit itself.
    pub fn neighbours(&self) -> i64 {
        self.counts()[0]
    }

    /// Neighbours of every particle of the neighbourhood, which may lie beyond it.
    fn counts(&self) -> Vec<i64> {
        let reach = self.solver.reach();
        let here = self.solver.read(self.by, self.place);
        let within = (SUPPORTS + 1.0) * reach.kernel.support();
        let candidates: Vec<_> = (0..self.solver.len())
            .map(|p| (p, self.solver.read(self.by, p), self.solver.scalar(Quantity::Body, p)))
            .filter(|(_, x, _)| distance(*x, here) < within)
            .collect();
        self.around.iter().map(|&(place, _)| self.count(place, &candidates)).collect()
    }

    /// Distance to the nearest particle that is held along some axis, m, if one is in the neighbourhood; 0 if it is held itself.
    pub fn held_within(&self) -> Option<f64> {
        let axes = self.solver.dimension();
        let held =
            |&&(place, _): &&(usize, f64)| self.solver.read(Quantity::Free, place)[..axes].contains(&0.0);
        self.around.iter().find(held).map(|&(_, r)| r)
    }

    /// The neighbourhood for ParaView: every field of the solver, stress, and the number of neighbours.
    pub fn frame(&self, simulation: &Simulation) -> Frame {
        let places: Vec<usize> = self.around.iter().map(|&(place, _)| place).collect();
        let displaced = |&place: &usize| {
            let (x, u) = (
                self.solver.read(Quantity::ReferencePosition, place),
                self.solver.read(Quantity::Displacement, place),
            );
            let now = std::array::from_fn(|i| x[i] + u[i]);
            if is_number(now) { now } else { x }
        };
        let whole = |name: &str, values: Vec<i64>| Array::scalar(name, "1", Values::I64(values));
        let mut arrays = vec![
            whole(
                "ParticleId",
                places.iter().map(|&p| i64::from(self.first + self.solver.ids()[p])).collect(),
            ),
            whole("Body", places.iter().map(|&p| self.solver.scalar(Quantity::Body, p) as i64).collect()),
            whole("IsCulprit", places.iter().map(|&p| i64::from(p == self.place)).collect()),
            whole("NeighbourCount", self.counts()),
            Array::scalar("Distance", "m", Values::F64(self.around.iter().map(|&(_, r)| r).collect())),
        ];
        let carried = self.solver.fields().iter().filter(|&&field| field != Quantity::Body);
        arrays.extend(carried.map(|&field| self.array(field, &places)));
        let states: Vec<_> = places.iter().map(|&place| self.solver.state(place)).collect();
        if !self.solver.fields().contains(&Quantity::Density) {
            let density = states.iter().map(|s| s.density).collect();
            arrays.push(Array::scalar(
                Quantity::Density.name(),
                Quantity::Density.unit(),
                Values::F64(density),
            ));
        }
        let cauchy = states.iter().map(|s| std::array::from_fn(|k| s.cauchy[k / 3][k % 3])).collect();
        arrays.push(Array::tensor(Quantity::CauchyStress.name(), "Pa", cauchy));
        let mises = states.iter().map(|s| s.cauchy.von_mises()).collect();
        arrays.push(Array::scalar(Quantity::VonMisesStress.name(), "Pa", Values::F64(mises)));
        Frame {
            time: simulation.time(),
            step: simulation.steps(),
            points: places.iter().map(displaced).collect(),
            arrays,
        }
    }

    /// One field of the particles at these places.
    fn array(&self, field: Quantity, places: &[usize]) -> Array {
        let (solver, d) = (self.solver, self.solver.dimension());
        let (name, unit) = (field.name(), field.unit());
        match field.rank() {
            Rank::Scalar => Array::scalar(
                name,
                unit,
                Values::F64(places.iter().map(|&p| solver.scalar(field, p)).collect()),
            ),
            Rank::Vector => {
                Array::vector(name, unit, places.iter().map(|&p| solver.read(field, p)).collect())
            }
            Rank::Tensor => {
                let component = |p: usize, k: usize| {
                    let (i, j) = (k / 3, k % 3);
                    if i < d && j < d { solver.word(field, i * d + j, p) } else { 0.0 }
                };
                let tensor = |&p: &usize| std::array::from_fn(|k| component(p, k));
                Array::tensor(name, unit, places.iter().map(tensor).collect())
            }
        }
    }
}
