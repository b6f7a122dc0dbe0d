//! Contact of bodies that do not share their pairs: total Lagrangian bodies and rigid ones with everybody, and bodies with themselves.
//!
//! Contact stands beside the bodies and is no part of a formulation. It reads where surface particles are and changes their velocities
//! by what the contact force does in a step, before the bodies do theirs. Both are kicks at the same positions, so position Verlet
//! stays what it is, and momentum and (without friction) energy are kept.

mod books;
mod facing;
mod force;
mod friction;
mod law;
mod meetings;
mod penalty;
mod surface;

pub use books::Met;
pub use law::{Law, stiffness};
pub use meetings::{Meeting, Meetings};
pub use penalty::{PairPenalty, Penalties};

use crate::integrator::{Diverged, Solver};
use crate::math::Vector;
use crate::neighbours::SearchError;
use crate::pass::Now;
use books::Ledger;
use facing::Facings;
use force::{Pressing, Pushed};
use friction::Springs;
use surface::Surfaces;

/// Contact forces between bodies.
#[derive(Debug)]
pub struct Contact {
    law: Law,
    dimension: usize,
    meetings: Meetings,
    rubs: bool,
    surfaces: Surfaces,
    facings: Facings,
    pressing: Vec<Pressing>,
    pushed: Vec<Pushed>,
    springs: Springs,
    /// Bodies that push each other by pairs of particles instead.
    penalties: Penalties,
    /// Owners of facings: id in the solver, and change of velocity in the step, m/s.
    kicks: Vec<(u32, Vector<f64, 3>)>,
    ledger: Ledger,
    /// A bound of the square of the fastest contact vibration, 1/s^2.
    fastest: f64,
}

/// The step is this share of what is just stable, since surfaces stiffen while they come closer.
const SAFETY: f64 = 0.8;

impl Contact {
    /// Contact of the particles of a simulation, `spacing` (m) apart, in dimension 2 or 3. Bodies of which no meeting speaks pass through
    /// each other; updated Lagrangian bodies, which touch by their own pairs, must not meet each other here.
    #[must_use]
    pub fn new(meetings: &[Meeting], spacing: f64, dimension: usize) -> Self {
        let meetings = Meetings::new(meetings);
        Self {
            law: Law::new(spacing, dimension),
            dimension,
            rubs: meetings.rub(),
            meetings,
            surfaces: Surfaces::default(),
            facings: Facings::new(dimension),
            pressing: Vec::new(),
            pushed: Vec::new(),
            springs: Springs::default(),
            penalties: Penalties::default(),
            kicks: Vec::new(),
            ledger: Ledger::default(),
            fastest: 0.0,
        }
    }

    /// The same, with bodies that push each other by pairs of particles about `spacing` (m) apart.
    #[must_use]
    pub fn with_penalties(self, penalties: &[PairPenalty], spacing: f64) -> Self {
        Self { penalties: Penalties::new(penalties, spacing), ..self }
    }

    /// Those bodies.
    #[must_use]
    pub fn penalties(&self) -> &Penalties {
        &self.penalties
    }

    /// Finds the surfaces, once the solvers have started.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn begin(&mut self, solvers: &[Box<dyn Solver>]) -> Result<(), Diverged> {
        self.surfaces = Surfaces::of(solvers, &self.law, self.dimension).map_err(|_| Diverged::unlisted())?;
        self.meet().map_err(|_| Diverged::unlisted())?;
        self.penalties.begin(solvers);
        self.bound();
        Ok(())
    }

    /// Finds who is near whom now, of bodies that have been moved since contact [began](Self::begin): masses and surfaces stay those of the
    /// set-up, which a state in single precision would round.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn relocate(&mut self, solvers: &[Box<dyn Solver>]) -> Result<(), Diverged> {
        self.surfaces.locate(solvers);
        self.meet().map_err(|_| Diverged::unlisted())?;
        self.penalties.relocate(solvers);
        self.bound();
        Ok(())
    }

    /// Changes velocities by the contact forces of a step.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) -> Result<(), Diverged> {
        self.relocate(solvers)?;
        self.note_penalties(solvers, now.dt);
        self.penalties.kick(solvers, now.dt);
        if self.facings.all.is_empty() {
            return Ok(());
        }
        self.watch(solvers);
        if self.rubs {
            self.rub(now.dt);
        }
        self.note(now.dt);
        self.kick(solvers, now.dt);
        Ok(())
    }

    /// Lists, overlaps and forces of the present positions.
    fn meet(&mut self) -> Result<(), SearchError> {
        if self.facings.are_old(&self.surfaces.x) {
            self.facings.renew(&self.surfaces, &self.meetings, &self.law)?;
            if self.rubs {
                self.springs.follow(&self.facings);
            }
        }
        self.press();
        self.push();
        Ok(())
    }

    /// Velocities of all that may touch.
    fn watch(&mut self, solvers: &[Box<dyn Solver>]) {
        for &(a, _) in &self.facings.owners {
            let a = a as usize;
            let solver = &solvers[self.surfaces.members[self.surfaces.body[a] as usize].solver];
            let place = solver.stored(self.surfaces.ids[a] as usize);
            self.surfaces.v[a] = Vector(solver.read(crate::field::Quantity::Velocity, place));
        }
    }

    fn kick(&mut self, solvers: &mut [Box<dyn Solver>], dt: f64) {
        let mut kicks = std::mem::take(&mut self.kicks);
        kicks.clear();
        let mut first = 0;
        let mut owners = self.facings.owners.iter().peekable();
        for (body, member) in self.surfaces.members.iter().enumerate() {
            kicks.clear();
            while let Some(&&(a, end)) =
                owners.peek().filter(|owner| self.surfaces.body[owner.0 as usize] as usize == body)
            {
                let force = (first..end as usize).fold(Vector::zero(), |sum, i| sum + self.force_on(i));
                let light = self.surfaces.lightness[a as usize];
                let change = Vector::from_fn(|k| dt * light[k] * force[k]);
                if change.norm_squared() > 0.0 {
                    kicks.push((self.surfaces.ids[a as usize], change));
                }
                first = end as usize;
                owners.next();
            }
            solvers[member.solver].kick(&kicks, dt);
        }
        self.kicks = kicks;
    }

    /// omega^2 <= max_a sum_b |d2E/dx_a dx_b| / m_a (Gershgorin).
    fn bound(&mut self) {
        let mut first = 0;
        self.fastest = self.penalties.fastest;
        for &(a, end) in &self.facings.owners {
            let stiffness: f64 = self.pushed[first..end as usize].iter().map(|p| p.stiffness).sum();
            let light = self.surfaces.lightness[a as usize].0.iter().fold(0.0_f64, |most, l| most.max(*l));
            self.fastest = self.fastest.max(light * stiffness);
            first = end as usize;
        }
    }

    /// How often the lists of who is near whom were made.
    #[must_use]
    pub fn lists(&self) -> u64 {
        self.facings.lists
    }

    /// The longest step that contact alone would allow, s; infinite where nobody touches.
    #[must_use]
    pub fn stable_step(&self) -> f64 {
        2.0 * SAFETY / self.fastest.sqrt()
    }
}
