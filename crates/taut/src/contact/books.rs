//! Forces between bodies, and the energy of contact.

use super::Contact;
use super::friction::Spring;
use crate::field::Quantity;
use crate::integrator::Solver;
use crate::math::Vector;

/// What contact does to a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Met {
    /// Force, N (in 2D per metre of depth).
    pub force: [f64; 3],
    /// Moment about the origin, N m.
    pub moment: [f64; 3],
}

/// What contact has done to energies and momenta since the start.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ledger {
    /// Put in by what moves as it is told: rigid bodies, and prescribed components of others, J.
    pub work: f64,
    /// Taken by friction, J.
    pub dissipated: f64,
    /// Momentum, and angular momentum about the origin, of all that moves freely, from what does not.
    pub impulse: Met,
}

/// Numbers of the ledger.
const BOOKS: usize = 8;

impl Met {
    /// Adds a force at a place.
    pub(super) fn add(&mut self, force: Vector<f64, 3>, x: Vector<f64, 3>) {
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            self.force[k] += force[k];
            self.moment[k] += x[i] * force[j] - x[j] * force[i];
        }
    }
}

impl Contact {
    /// The force on the particle of a facing, N.
    pub(super) fn force_on(&self, facing: usize) -> Vector<f64, 3> {
        let drag = self.springs.drag.get(facing).map_or(Vector::zero(), |drag| drag.0);
        self.pushed[facing].force.0 + drag
    }

    /// The contact force on a body, by one other or by all, as it was in the middle of the last step.
    #[must_use]
    pub fn met(&self, body: u32, by: Option<u32>) -> Met {
        let mut met = Met::default();
        for (i, facing) in self.facings.all.iter().enumerate() {
            let a = facing.a as usize;
            if self.surfaces.body[a] != body || by.is_some_and(|by| by != facing.body) {
                continue;
            }
            met.add(self.force_on(i), self.surfaces.x[a]);
        }
        self.penalties.met(&mut met, body, by);
        met
    }

    /// The forces (N) of the present step on particles that do not move freely, and where they are (m); by solver and id.
    pub fn on_held(&self) -> impl Iterator<Item = ((usize, u32), [f64; 3], [f64; 3])> + '_ {
        let mut first = 0;
        self.facings.owners.iter().filter_map(move |&(a, end)| {
            let (facings, a) = (std::mem::replace(&mut first, end as usize)..end as usize, a as usize);
            let held = self.surfaces.lightness[a].0.contains(&0.0);
            let member = &self.surfaces.members[self.surfaces.body[a] as usize];
            held.then(|| {
                let force = facings.fold(Vector::zero(), |sum, i| sum + self.force_on(i));
                ((member.solver, self.surfaces.ids[a]), self.surfaces.x[a].0, force.0)
            })
        })
    }

    /// What contact adds to the sum of (m a)^2 / V over the free components of particles, N^2/m^3: with it, forces balance where bodies press
    /// on each other.
    #[must_use]
    pub fn felt(&self, solvers: &[Box<dyn Solver>]) -> f64 {
        let mut first = 0;
        let mut sum = 0.0;
        for &(a, end) in &self.facings.owners {
            let facings = std::mem::replace(&mut first, end as usize)..end as usize;
            let a = a as usize;
            let solver = &solvers[self.surfaces.members[self.surfaces.body[a] as usize].solver];
            if solver.is_rigid() {
                continue;
            }
            let place = solver.stored(self.surfaces.ids[a] as usize);
            let force = facings.fold(Vector::zero(), |sum, i| sum + self.force_on(i));
            let (free, own) =
                (solver.read(Quantity::Free, place), solver.read(Quantity::Acceleration, place));
            let mass = solver.scalar(Quantity::Mass, place);
            let square = |k: usize| free[k] * force[k] * (2.0 * mass * own[k] + force[k]);
            sum += (0..solver.dimension()).map(square).sum::<f64>() / solver.scalar(Quantity::Volume, place);
        }
        sum
    }

    /// Notes the work and impulses of penalties in a step of `dt`.
    pub(super) fn note_penalties(&mut self, solvers: &[Box<dyn Solver>], dt: f64) {
        self.ledger.work += self.penalties.passed(solvers, dt, &mut self.ledger.impulse);
    }

    /// Notes the work of prescribed motion and the loss of a step of `dt`.
    pub(super) fn note(&mut self, dt: f64) {
        let mut first = 0;
        let mut work = 0.0;
        for &(a, end) in &self.facings.owners {
            let (a, end) = (a as usize, end as usize);
            let (light, v) = (self.surfaces.lightness[a], self.surfaces.v[a]);
            let f = (first..end).fold(Vector::zero(), |sum, i| sum + self.force_on(i));
            let moving = Vector::from_fn(|k| if light[k] > 0.0 { dt * f[k] } else { 0.0 });
            self.ledger.impulse.add(moving, self.surfaces.x[a]);
            if light.0.contains(&0.0) {
                work -= (0..3).filter(|&k| light[k] == 0.0).map(|k| f[k] * v[k]).sum::<f64>();
            }
            first = end;
        }
        self.ledger.work += dt * work;
        self.ledger.dissipated += self.springs.all.iter().map(|spring| spring.lost).sum::<f64>();
    }

    /// Energy that contact holds now, J: of the present positions, where the lists reach.
    #[must_use]
    pub fn energy(&self, solvers: &[Box<dyn Solver>]) -> f64 {
        let mut surfaces = self.surfaces.clone();
        for (a, _) in &self.facings.owners {
            let a = *a as usize;
            let solver = &solvers[self.surfaces.members[surfaces.body[a] as usize].solver];
            let u = solver.read(Quantity::Displacement, solver.stored(surfaces.ids[a] as usize));
            surfaces.x[a] = surfaces.reference[a] + Vector(u);
        }
        let scene = super::force::Scene { surfaces: &surfaces, ..self.scene() };
        let facings = self.facings.all.iter();
        let pressed = facings.clone().map(|facing| scene.energy(facing));
        let held = facings.zip(&self.springs.all).map(|(facing, spring)| scene.held(facing, spring));
        let penalties = self.penalties.energy(solvers);
        pressed.chain(held).fold(penalties, |sum, energy| sum + energy)
    }

    /// All that contact remembers from step to step: its books, and the springs of friction. Everything else follows from where the bodies
    /// are.
    #[must_use]
    pub fn memory(&self) -> Vec<f64> {
        let Ledger { work, dissipated, impulse } = self.ledger;
        let books = [work, dissipated].into_iter().chain(impulse.force).chain(impulse.moment);
        books.chain(self.springs.all.iter().flat_map(Spring::numbers)).collect()
    }

    /// Puts back what [`Contact::memory`] gave, into a contact of the same bodies that has begun; whether it fits.
    pub fn recall(&mut self, memory: &[f64]) -> bool {
        let Some((books, springs)) = memory.split_at_checked(BOOKS) else { return false };
        let (springs, rest) = springs.as_chunks::<5>();
        let vector = |from: usize| std::array::from_fn(|k| books[from + k]);
        self.ledger = Ledger {
            work: books[0],
            dissipated: books[1],
            impulse: Met { force: vector(2), moment: vector(5) },
        };
        self.springs.all = springs.iter().map(|&numbers| Spring::of(numbers)).collect();
        if self.rubs {
            self.springs.follow(&self.facings);
        }
        rest.is_empty()
    }

    /// Work that prescribed motion has put in through contact since the start, J.
    #[must_use]
    pub fn external_work(&self) -> f64 {
        self.ledger.work
    }

    /// Momentum (as a force) and angular momentum (as a moment) that what moves freely has had from rigid bodies and held particles since the
    /// start, kg m/s and kg m^2/s: nothing but rounding where there are none, if there is no friction.
    #[must_use]
    pub fn impulse(&self) -> Met {
        self.ledger.impulse
    }

    /// Energy that friction has taken since the start, J.
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.ledger.dissipated
    }
}
