//! What a simulation needs of a body in time.

use super::{Bounding, Diverged, Held, Impulse, Relax, Stiffness};
use crate::field::Quantity;
use crate::formulation::State;
use crate::math::Vector;
use crate::particles::saved::{Part, RestoreError, Shelf};
use crate::pass::Now;
use crate::run::Relist;
use std::ops::Range;

/// What there is to see of one particle, at the present time.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Its id.
    pub id: u32,
    /// Index of its body.
    pub body: u32,
    /// Mass, kg.
    pub mass: f64,
    /// Reference position, m.
    pub reference: [f64; 3],
    /// Displacement, m.
    pub displacement: [f64; 3],
    /// Velocity, m/s.
    pub velocity: [f64; 3],
    /// Energy dissipated since the start, J.
    pub dissipated: f64,
    /// Work done from outside since the start, J.
    pub external_work: f64,
    /// Stress and energy.
    pub state: State,
}

/// Bodies that one formulation advances: one virtual call for each half of a step.
pub trait Solver: Send + Sync {
    /// 2 or 3.
    fn dimension(&self) -> usize;
    /// How many particles.
    fn len(&self) -> usize {
        self.ids().len()
    }
    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The id of the particle stored at each place.
    fn ids(&self) -> &[u32];
    /// The place where the particle of an id is stored; it may change from step to step.
    fn stored(&self, id: usize) -> usize;
    /// Whether its particles have no mass and move as they are told.
    fn is_rigid(&self) -> bool {
        false
    }
    /// Mean number of neighbours.
    fn neighbours(&self) -> f64;

    /// How often the neighbours were found.
    fn lists(&self) -> u64;

    /// Makes lists and first rates.
    ///
    /// # Errors
    /// If the initial state is not finite.
    fn start(&mut self) -> Result<(), Diverged>;
    /// Moves what runs half a step ahead, before the first step `dt`.
    fn begin(&mut self, dt: f64);
    /// The longest stable step now, s.
    fn stable_step(&self) -> f64;
    /// What bounds that step.
    fn bounding(&self) -> Bounding;
    /// The particle, by id, that is at the bound: a search through all of them. `None` if all are alike.
    fn at_bound(&self, bounding: &Bounding) -> Option<u32>;
    /// How neighbours are found.
    fn reach(&self) -> Relist;
    /// The fields that its particles carry.
    fn fields(&self) -> &'static [Quantity];
    /// The step up to where the next one can be known.
    ///
    /// # Errors
    /// If the state has left its bounds.
    fn advance(&mut self, now: Now<f64>) -> Result<(), Diverged>;
    /// The rest of the step, when the next one is known.
    ///
    /// # Errors
    /// If the state has left its bounds.
    fn finish(&mut self, now: Now<f64>, next: f64) -> Result<(), Diverged>;

    /// Moves by what passes (s) in the step `now` on a clock of its own, instead of by the step: of what moves as it is told. The largest speed that makes, m/s.
    fn follow(&mut self, _: Now<f64>, _: f64) -> f64 {
        0.0
    }

    /// Everything that has to be kept so that the solver can go on bit by bit, between two steps: columns, and what is integrated
    /// beside them. What [`Solver::restore`] makes again identically is left out.
    fn save(&self) -> Vec<Part<'_>>;
    /// Puts back what [`Solver::save`] gave, into a solver that was made and started in the same way; lists are then those of the
    /// saved solver.
    ///
    /// # Errors
    /// If a part is not there or does not fit, or belongs to other particles.
    fn restore(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError>;

    /// What holding these particles took in the step of `dt` that [`advance`](Self::advance) has just made.
    fn holding(&self, held: &mut Held, dt: f64) -> Impulse;
    /// What the body forces on these particles, by id, gave in it.
    fn pulling(&self, ids: &[u32], dt: f64) -> Impulse;

    /// What the bodies do against small displacements from where they are, after the start; `None` for rigid ones.
    fn stiffness(&mut self) -> Option<Box<dyn Stiffness + '_>> {
        None
    }

    /// Displaces the particles, component by component in the order of storage, m: with everything that follows from displacements, but at rest. Nothing
    /// for what is not of the reference configuration.
    fn displace(&mut self, _: &[f64]) {}

    /// The same as something that can be brought to rest, if it can.
    fn relax(&mut self) -> Option<&mut dyn Relax> {
        None
    }

    /// A vector field of the particle stored at `place`, at the present time; components beyond the dimension are 0.
    fn read(&self, field: Quantity, place: usize) -> [f64; 3];
    /// One stored number of the particle stored at `place`.
    fn word(&self, field: Quantity, word: usize, place: usize) -> f64;
    /// Sets one stored number of the particle stored at `place`.
    fn set_word(&mut self, field: Quantity, word: usize, at: (usize, f64));
    /// Sets a vector field of the particle stored at `place`.
    fn write(&mut self, field: Quantity, place: usize, value: [f64; 3]) {
        for (i, &x) in value.iter().enumerate().take(self.dimension()) {
            self.set_word(field, i, (place, x));
        }
    }
    /// A scalar field of the particle stored at `place`.
    fn scalar(&self, field: Quantity, place: usize) -> f64 {
        self.word(field, 0, place)
    }
    /// Volume of the undeformed particle stored at `place`, m^3.
    fn rest_volume(&self, place: usize) -> f64 {
        self.scalar(Quantity::Volume, place)
    }
    /// The position that the forces of the coming step are functions of, m.
    fn configuration(&self, place: usize) -> [f64; 3];
    /// The same of particles by id: one virtual call for all of them.
    fn locate(&self, ids: &[u32], out: &mut [Vector<f64, 3>]) {
        for (&id, out) in ids.iter().zip(out) {
            *out = Vector(self.configuration(self.stored(id as usize)));
        }
    }
    /// Adds to the velocities of particles by id, m/s, what a force from elsewhere does in the coming step of `dt`.
    fn kick(&mut self, changes: &[(u32, Vector<f64, 3>)], dt: f64) {
        for &(id, change) in changes {
            let place = self.stored(id as usize);
            for k in 0..self.dimension() {
                let v = self.word(Quantity::Velocity, k, place);
                self.set_word(Quantity::Velocity, k, (place, v + change[k]));
            }
            self.correct(place, change, dt);
        }
    }
    /// The body's own kick takes the mean velocity of the step for the work of its forces, and finds it too large by half of a change that
    /// came before: takes back what that makes of the work of the body force.
    fn correct(&mut self, place: usize, change: Vector<f64, 3>, dt: f64) {
        let force = Vector(self.read(Quantity::BodyForce, place)).times(self.scalar(Quantity::Mass, place));
        let work = self.scalar(Quantity::ExternalWork, place) - 0.5 * dt * force.dot(change);
        self.set_word(Quantity::ExternalWork, 0, (place, work));
    }
    /// Brings up to date what is only looked at, such as a stress that follows the motion and does not act back.
    fn look(&mut self) {}

    /// Stress and energy of the particle stored at `place`; what is only looked at is that of the last [`Solver::look`].
    fn state(&self, place: usize) -> State;
    /// Shows the particles of these ids, in their order: one virtual call for all of them.
    fn show(&self, ids: Range<usize>, to: &mut dyn FnMut(&Seen)) {
        for id in ids {
            let place = self.stored(id);
            let state = self.state(place);
            to(&Seen {
                id: id as u32,
                body: self.scalar(Quantity::Body, place) as u32,
                mass: self.scalar(Quantity::Mass, place),
                reference: self.read(Quantity::ReferencePosition, place),
                displacement: self.read(Quantity::Displacement, place),
                velocity: self.read(Quantity::Velocity, place),
                dissipated: self.scalar(Quantity::Dissipated, place) - state.booked_ahead,
                external_work: self.scalar(Quantity::ExternalWork, place),
                state,
            });
        }
    }
}
