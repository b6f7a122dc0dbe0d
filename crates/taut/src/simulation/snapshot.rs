//! What a simulation looks like from outside, at one instant.

use super::{Seen, Simulation};
use crate::math::Tensor;

/// All particles of a simulation in the order of their ids.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Time, s.
    pub time: f64,
    /// Index of the body.
    pub body: Vec<u32>,
    /// Reference positions, m.
    pub reference: Vec<[f64; 3]>,
    /// Displacements, m.
    pub displacement: Vec<[f64; 3]>,
    /// Velocities, m/s.
    pub velocity: Vec<[f64; 3]>,
    /// Densities, kg/m^3.
    pub density: Vec<f64>,
    /// Cauchy stress, Pa, row by row.
    pub cauchy: Vec<[f64; 9]>,
    /// sqrt(3/2 s:s), Pa.
    pub von_mises: Vec<f64>,
    /// Deformation gradient, row by row; zero where the formulation has none.
    pub deformation: Vec<[f64; 9]>,
}

impl Snapshot {
    fn resize(&mut self, n: usize) {
        self.body.resize(n, 0);
        self.reference.resize(n, [0.0; 3]);
        self.displacement.resize(n, [0.0; 3]);
        self.velocity.resize(n, [0.0; 3]);
        self.density.resize(n, 0.0);
        self.cauchy.resize(n, [0.0; 9]);
        self.von_mises.resize(n, 0.0);
        self.deformation.resize(n, [0.0; 9]);
    }

    /// Current positions, m.
    pub fn positions(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        self.reference.iter().zip(&self.displacement).map(|(x, u)| std::array::from_fn(|i| x[i] + u[i]))
    }

    fn take(&mut self, i: usize, seen: &Seen) {
        let flat = |t: Tensor<f64, 3>| std::array::from_fn(|k| t[k / 3][k % 3]);
        let state = &seen.state;
        self.body[i] = seen.body;
        self.reference[i] = seen.reference;
        self.displacement[i] = seen.displacement;
        self.velocity[i] = seen.velocity;
        self.density[i] = state.density;
        self.cauchy[i] = flat(state.cauchy);
        self.von_mises[i] = state.cauchy.von_mises();
        self.deformation[i] = state.deformation.map_or([0.0; 9], flat);
    }
}

/// Energies and momenta of all particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Strain energy, J.
    pub strain: f64,
    /// Energy held by contact, J.
    pub contact: f64,
    /// Energy dissipated since the start, J.
    pub dissipated: f64,
    /// Work done from outside since the start, J.
    pub external_work: f64,
    /// Linear momentum, kg m/s.
    pub momentum: [f64; 3],
    /// Angular momentum about the origin, kg m^2/s.
    pub angular_momentum: [f64; 3],
}

impl Totals {
    fn add(&mut self, seen: &Seen) {
        let (m, v) = (seen.mass, seen.velocity);
        let x: [f64; 3] = std::array::from_fn(|i| seen.reference[i] + seen.displacement[i]);
        self.kinetic += 0.5 * m * v.iter().map(|c| c * c).sum::<f64>();
        self.strain += seen.state.strain_energy;
        self.dissipated += seen.dissipated;
        self.external_work += seen.external_work;
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            self.momentum[i] += m * v[i];
            self.angular_momentum[i] += m * (x[j] * v[k] - x[k] * v[j]);
        }
    }
}

impl Simulation {
    /// How many particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.solvers.iter().map(|s| s.len()).sum()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Fills `snapshot` with the present state, and adds it up. Ids of the bodies of later solvers follow those of
    /// earlier ones.
    pub fn snapshot(&self, snapshot: &mut Snapshot) -> Totals {
        snapshot.resize(self.len());
        snapshot.time = self.time;
        let mut totals = Totals::default();
        let mut first = 0;
        for solver in &self.solvers {
            solver.show(&mut |seen| {
                snapshot.take(first + seen.id as usize, seen);
                totals.add(seen);
            });
            first += solver.len();
        }
        self.meet(&mut totals);
        totals
    }

    /// Adds what contact holds, takes and passes on.
    fn meet(&self, totals: &mut Totals) {
        if let Some(contact) = &self.contact {
            totals.contact = contact.energy(&self.solvers);
            totals.dissipated += contact.dissipated();
            totals.external_work += contact.external_work();
        }
    }

    /// Energies and momenta now.
    #[must_use]
    pub fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        for solver in &self.solvers {
            solver.show(&mut |seen| totals.add(seen));
        }
        self.meet(&mut totals);
        totals
    }
}
