//! What a simulation looks like from outside, at one instant.

use super::{Seen, Simulation};
use crate::contact::Met;
use crate::integrator::{Impulse, Solver, cross};
use crate::math::Tensor;
use rayon::prelude::*;
use std::ops::Range;

/// Particles that a thread looks at in one go; sums are added up in this order, whatever the threads.
const CHUNK: usize = 512;

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
    /// Deformation gradient, row by row (1 + the gradient of the displacement where everything is linear in that); zero where the formulation
    /// has none.
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

    /// The columns of the particles of a range, cut into chunks.
    fn chunks(&mut self, of: Range<usize>) -> impl IndexedParallelIterator<Item = Chunk<'_>> {
        fn cut<'a, T: Send>(column: &'a mut [T], of: &Range<usize>) -> rayon::slice::ChunksMut<'a, T> {
            column[of.clone()].par_chunks_mut(CHUNK)
        }
        let moved =
            (cut(&mut self.reference, &of), cut(&mut self.displacement, &of), cut(&mut self.velocity, &of));
        let state =
            (cut(&mut self.cauchy, &of), cut(&mut self.von_mises, &of), cut(&mut self.deformation, &of));
        let (moved, state) = (moved.into_par_iter(), state.into_par_iter());
        (cut(&mut self.body, &of), cut(&mut self.density, &of), moved, state).into_par_iter().map(
            |(body, density, (reference, displacement, velocity), (cauchy, von_mises, deformation))| Chunk {
                body,
                reference,
                displacement,
                velocity,
                density,
                cauchy,
                von_mises,
                deformation,
            },
        )
    }
}

/// The columns of a snapshot for some particles.
struct Chunk<'a> {
    body: &'a mut [u32],
    reference: &'a mut [[f64; 3]],
    displacement: &'a mut [[f64; 3]],
    velocity: &'a mut [[f64; 3]],
    density: &'a mut [f64],
    cauchy: &'a mut [[f64; 9]],
    von_mises: &'a mut [f64],
    deformation: &'a mut [[f64; 9]],
}

impl Chunk<'_> {
    /// Fills in the particles from the id `first` on, and adds them up.
    fn fill(&mut self, solver: &dyn Solver, first: usize) -> Totals {
        let mut totals = Totals::default();
        solver.show(first..first + self.body.len(), &mut |seen| {
            self.take(seen.id as usize - first, seen);
            totals.add(seen);
        });
        totals
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
        let linear = state.gradient.map(|gradient| gradient.plus_diagonal(1.0));
        self.deformation[i] = state.deformation.or(linear).map_or([0.0; 9], flat);
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
    /// What constraints and body forces gave since the start.
    pub impulse: Impulse,
    /// Sum of m |v|, kg m/s, and of m |x| |v|, kg m^2/s: what an error of the momenta is small or large against.
    pub motion: [f64; 2],
    /// Moment of all pair forces, N m: what a form that does not keep angular momentum changes it by.
    pub couple: [f64; 3],
    /// Sum of the sizes of the couples of all particles, N m: what `couple` can be at most, and is where none cancels another.
    pub couples: f64,
}

impl Totals {
    /// Adds those of other particles; the impulse is that of all already.
    fn and(mut self, other: &Self) -> Self {
        self.kinetic += other.kinetic;
        self.strain += other.strain;
        self.dissipated += other.dissipated;
        self.external_work += other.external_work;
        for i in 0..3 {
            self.momentum[i] += other.momentum[i];
            self.angular_momentum[i] += other.angular_momentum[i];
            self.couple[i] += other.couple[i];
        }
        self.couples += other.couples;
        self.motion[0] += other.motion[0];
        self.motion[1] += other.motion[1];
        self
    }

    fn add(&mut self, seen: &Seen) {
        let (m, v) = (seen.mass, seen.velocity);
        let x: [f64; 3] = std::array::from_fn(|i| seen.reference[i] + seen.displacement[i]);
        self.kinetic += 0.5 * m * v.iter().map(|c| c * c).sum::<f64>();
        self.strain += seen.state.strain_energy;
        self.dissipated += seen.dissipated;
        self.external_work += seen.external_work;
        let moment = cross(x, v);
        for i in 0..3 {
            self.momentum[i] += m * v[i];
            self.angular_momentum[i] += m * moment[i];
            self.couple[i] += seen.state.couple[i];
        }
        self.couples += seen.state.couple.iter().map(|c| c * c).sum::<f64>().sqrt();
        let speed = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        self.motion[0] += m * speed;
        self.motion[1] += m * speed * x.iter().map(|c| c * c).sum::<f64>().sqrt();
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
    pub fn snapshot(&mut self, snapshot: &mut Snapshot) -> Totals {
        self.look();
        snapshot.resize(self.len());
        snapshot.time = self.time;
        let mut totals = Totals { impulse: self.audit.total(), ..Totals::default() };
        let mut first = 0;
        for solver in &self.solvers {
            let chunks = snapshot.chunks(first..first + solver.len()).enumerate();
            let sums: Vec<Totals> = chunks.map(|(k, mut chunk)| chunk.fill(&**solver, k * CHUNK)).collect();
            totals = sums.iter().fold(totals, Totals::and);
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
            let Met { force: linear, moment: angular } = contact.impulse();
            totals.impulse += Impulse { linear, angular };
        }
    }

    /// Energies and momenta now.
    #[must_use]
    pub fn totals(&self) -> Totals {
        let mut totals = Totals { impulse: self.audit.total(), ..Totals::default() };
        for solver in &self.solvers {
            for first in (0..solver.len()).step_by(CHUNK) {
                let mut sum = Totals::default();
                solver.show(first..solver.len().min(first + CHUNK), &mut |seen| sum.add(seen));
                totals = totals.and(&sum);
            }
        }
        self.meet(&mut totals);
        totals
    }
}
