//! The books of momentum: what constraints and body forces have given to the bodies.

use super::{Drive, Solver};
use crate::contact::Contact;
use crate::field::Quantity;
use crate::integrator::{Held, Impulse, cross};
use std::collections::HashMap;

/// A constraint: which components of which particles it holds, and what that took so far.
#[derive(Clone, Debug, Default)]
pub struct Grip {
    /// For each solver that has a part in it.
    parts: Vec<(usize, Held)>,
    impulse: Impulse,
    /// What contact gave to the components that it holds.
    pressed: Impulse,
    /// The part of it of the present step.
    pressing: Impulse,
    /// What it exerted in the last step of a quasi-static run, N and N m.
    force: Option<Impulse>,
}

impl Grip {
    /// Adds components of a particle, by its solver and id. No component may be in two grips.
    pub fn hold(&mut self, solver: usize, id: u32, axes: [bool; 3]) {
        if self.parts.last().is_none_or(|(last, _)| *last != solver) {
            self.parts.push((solver, Held::default()));
        }
        if let Some((_, held)) = self.parts.last_mut() {
            held.ids.push(id);
            held.axes.push(axes);
            held.before.push([0.0; 3]);
        }
    }

    /// Whether it holds nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// What it gave to the bodies since the start.
    #[must_use]
    pub fn impulse(&self) -> Impulse {
        self.impulse
    }

    /// What it exerted since the start: what it gave to the bodies, and what it took up of contact with what it holds.
    #[must_use]
    pub fn exerted(&self) -> Impulse {
        self.impulse - self.pressed
    }

    /// Force (N) and moment (N m) of the last step of a quasi-static run; others have impulses instead.
    #[must_use]
    pub fn force(&self) -> Option<Impulse> {
        self.force
    }

    fn start(&mut self, solvers: &[Box<dyn Solver>]) {
        for (solver, held) in &mut self.parts {
            let solver = &solvers[*solver];
            for (id, before) in held.ids.iter().zip(&mut held.before) {
                *before = solver.read(Quantity::Velocity, solver.stored(*id as usize));
            }
        }
    }
}

/// The body force on the particles of a solver.
#[derive(Clone, Debug)]
enum Load {
    /// The same acceleration on all of them: its moment follows from the centre of mass, which moves by what all impulses
    /// make of the momentum.
    Uniform(Fall),
    /// On these particles, by id.
    On(Vec<u32>),
}

/// A solver under a uniform body force.
#[derive(Clone, Copy, Debug, Default)]
struct Fall {
    /// Force per mass, m/s^2.
    force: [f64; 3],
    /// Of all particles, kg.
    mass: f64,
    /// Sum of m x, kg m.
    first: [f64; 3],
    /// kg m/s.
    momentum: [f64; 3],
}

impl Fall {
    /// The impulse of the body force over a step in which constraints gave `held`.
    fn step(&mut self, held: Impulse, dt: f64) -> Impulse {
        let linear = self.force.map(|b| self.mass * b * dt);
        let half = |fall: &Self| std::array::from_fn(|i| fall.first[i] + 0.5 * dt * fall.momentum[i]);
        self.first = half(self);
        let angular = cross(self.first, self.force).map(|moment| moment * dt);
        for i in 0..3 {
            self.momentum[i] += linear[i] + held.linear[i];
        }
        self.first = half(self);
        Impulse { linear, angular }
    }
}

/// By solver and id of a particle: the constraints that hold it, by number, and which components.
type Holders = HashMap<(usize, u32), Vec<(usize, [bool; 3])>>;

/// All impulses of a run.
#[derive(Clone, Debug, Default)]
pub struct Audit {
    /// Constraints: those that were named, and one for all that is held besides.
    grips: Vec<Grip>,
    /// Which of them holds which components of a particle, by its solver and id, where contact may press on it.
    holders: Holders,
    /// By solver.
    loads: Vec<Load>,
    body_forces: Impulse,
}

impl Audit {
    /// Who is held by which constraint.
    pub fn name(&mut self, grips: Vec<Grip>) {
        self.grips = grips;
    }

    /// The constraints, in the order in which they were named; then one for what is held besides, if anything is.
    #[must_use]
    pub fn grips(&self) -> &[Grip] {
        &self.grips
    }

    /// Everything that came from outside since the start.
    #[must_use]
    pub fn total(&self) -> Impulse {
        let mut total = self.body_forces;
        self.grips.iter().for_each(|grip| total += grip.impulse);
        total
    }

    /// Finds out what is held and what is pulled at, and whether bodies may push each other meanwhile.
    pub fn start(&mut self, solvers: &[Box<dyn Solver>], drives: &[Box<dyn Drive>], touching: bool) {
        let others = self.unnamed(solvers);
        if !others.is_empty() {
            self.grips.push(others);
        }
        self.grips.iter_mut().for_each(|grip| grip.start(solvers));
        if touching {
            self.holders = holders(&self.grips);
        }
        let mut driven: Vec<Vec<u32>> = vec![Vec::new(); solvers.len()];
        for drive in drives {
            drive.pulls(&mut |solver, id| driven[solver].push(id));
        }
        self.loads =
            solvers.iter().zip(driven).map(|(s, driven)| load(s.as_ref(), driven, touching)).collect();
    }

    /// Held components that no grip has.
    fn unnamed(&self, solvers: &[Box<dyn Solver>]) -> Grip {
        let mut others = Grip::default();
        for (s, solver) in solvers.iter().enumerate().filter(|(_, solver)| !solver.is_rigid()) {
            let mut named = vec![[false; 3]; solver.len()];
            for (_, held) in self.grips.iter().flat_map(|g| &g.parts).filter(|(part, _)| *part == s) {
                for (&id, axes) in held.ids.iter().zip(&held.axes) {
                    let named = &mut named[id as usize];
                    *named = std::array::from_fn(|i| named[i] || axes[i]);
                }
            }
            for (id, named) in named.iter().enumerate() {
                let free = solver.read(Quantity::Free, solver.stored(id));
                let axes = std::array::from_fn(|i| i < solver.dimension() && free[i] == 0.0 && !named[i]);
                if axes.contains(&true) {
                    others.hold(s, id as u32, axes);
                }
            }
        }
        others
    }

    /// What it remembers from step to step, as numbers.
    #[must_use]
    pub fn saved(&self) -> Vec<f64> {
        let mut copy = self.clone();
        copy.numbers().into_iter().map(|number| *number).collect()
    }

    /// Takes back what [`Audit::saved`] gave, of the same bodies after [`Audit::start`]; whether it fits.
    pub fn restore(&mut self, saved: &[f64]) -> bool {
        let numbers = self.numbers();
        if numbers.len() != saved.len() {
            return false;
        }
        numbers.into_iter().zip(saved).for_each(|(to, &from)| *to = from);
        true
    }

    fn numbers(&mut self) -> Vec<&mut f64> {
        let mut numbers: Vec<&mut f64> = Vec::new();
        for grip in &mut self.grips {
            for impulse in [&mut grip.impulse, &mut grip.pressed] {
                numbers.extend(impulse.linear.iter_mut().chain(&mut impulse.angular));
            }
            numbers.extend(grip.parts.iter_mut().flat_map(|(_, held)| held.before.as_flattened_mut()));
        }
        for load in &mut self.loads {
            if let Load::Uniform(fall) = load {
                numbers.extend(fall.first.iter_mut().chain(&mut fall.momentum));
            }
        }
        numbers.extend(self.body_forces.linear.iter_mut().chain(&mut self.body_forces.angular));
        numbers
    }

    /// Takes down what constraints exert in the step of `dt` that solver number `index` has just made, where motion is a means only: masses are
    /// scaled and velocities taken, so momentum has no books.
    pub fn weighed(&mut self, index: usize, solver: &dyn Solver, dt: f64) {
        for grip in &mut self.grips {
            for (k, (owner, part)) in grip.parts.iter_mut().enumerate() {
                if *owner == index {
                    let first = || grip.pressing.times(-1.0 / dt);
                    let mut force = if k == 0 { first() } else { grip.force.unwrap_or_default() };
                    force += solver.holding(part, dt).times(1.0 / dt);
                    grip.force = Some(force);
                }
            }
        }
    }

    /// Takes down what contact does in a step of `dt` to what constraints hold: it moves nothing, but the constraints feel it.
    pub fn pressed(&mut self, contact: &Contact, dt: f64) {
        for grip in &mut self.grips {
            grip.pressing = Impulse::default();
        }
        for (particle, x, force) in contact.on_held() {
            for (grip, axes) in self.holders.get(&particle).into_iter().flatten() {
                let taken = std::array::from_fn(|k| if axes[k] { dt * force[k] } else { 0.0 });
                self.grips[*grip].pressed.push(x, taken);
                self.grips[*grip].pressing.push(x, taken);
            }
        }
    }

    /// Takes down what damping gave: what held particles did to their neighbours by it, and its moment, which is not kept inside.
    pub fn damped(&mut self, impulse: Impulse) {
        self.body_forces += impulse;
    }

    /// Takes down what came from outside in the step that solver number `index` has just made.
    pub fn advanced(&mut self, index: usize, solver: &dyn Solver, dt: f64) {
        let mut held = Impulse::default();
        for grip in &mut self.grips {
            for (_, part) in grip.parts.iter_mut().filter(|(solver, _)| *solver == index) {
                let impulse = solver.holding(part, dt);
                grip.impulse += impulse;
                held += impulse;
            }
        }
        self.body_forces += match &mut self.loads[index] {
            Load::Uniform(fall) => fall.step(held, dt),
            Load::On(ids) if ids.is_empty() => return,
            Load::On(ids) => solver.pulling(ids, dt),
        };
    }
}

/// The constraints of every particle that has one.
fn holders(grips: &[Grip]) -> Holders {
    let mut holders = Holders::new();
    for (number, grip) in grips.iter().enumerate() {
        for (solver, held) in &grip.parts {
            for (&id, &axes) in held.ids.iter().zip(&held.axes) {
                holders.entry((*solver, id)).or_default().push((number, axes));
            }
        }
    }
    holders
}

/// What pulls at a solver; `driven` are the particles whose body force changes. Where bodies touch, the centre of mass does not follow from
/// constraints and body forces alone.
fn load(solver: &dyn Solver, mut driven: Vec<u32>, touching: bool) -> Load {
    let ids = 0..solver.len() as u32;
    let force = |id: u32| solver.read(Quantity::BodyForce, solver.stored(id as usize));
    let first = if solver.is_empty() { [0.0; 3] } else { force(0) };
    if !touching && driven.is_empty() && first != [0.0; 3] && ids.clone().all(|id| force(id) == first) {
        return Load::Uniform(ids.fold(Fall { force: first, ..Fall::default() }, |mut fall, id| {
            let place = solver.stored(id as usize);
            let (m, v) = (solver.scalar(Quantity::Mass, place), solver.read(Quantity::Velocity, place));
            let x = solver.read(Quantity::ReferencePosition, place);
            fall.mass += m;
            for i in 0..3 {
                fall.first[i] += m * x[i];
                fall.momentum[i] += m * v[i];
            }
            fall
        }));
    }
    driven.extend(ids.filter(|&id| force(id) != [0.0; 3]));
    driven.sort_unstable();
    driven.dedup();
    Load::On(driven)
}
