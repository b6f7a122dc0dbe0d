//! What ends a run although no single number is wrong yet: energy from nowhere, a time step without end.

use super::{Seen, Solver};
use crate::contact::Contact;
use crate::field::Quantity;
use crate::integrator::{Cause, Diverged};

/// Energies and densities are looked at after so many steps, and after 1, 2, 4, ... at the beginning: looking costs about as much
/// as a step does.
const EVERY: u64 = 256;

/// The energy of the bodies may exceed what was put in, by so much of it. Position Verlet keeps an energy that differs from kinetic + strain
/// by (omega dt / 2)^2 of the strain energy of a mode. At the default Courant numbers omega dt / 2 of the shortest wave is 0.6, so a body whose
/// energy is all in such waves may seem to gain 0.36 / (1 - 0.36) = 0.56 of it and lose it again; the hourglass-free form, whose operators are
/// not adjoint, gains at most 0.02 in any published case. Twice is beyond both.
pub const GAIN: f64 = 1.0;

/// The energy has to stay beyond the bound for so many steps: a load that sets in at once makes waves of the shortest kind, whose energy seems to
/// come and go within their period, 2 pi / 1.2 steps.
const LASTING: u32 = 8;

/// Energy below which nothing is told, as a strain: numbers are rounded, and a body at rest has none.
const STILL: f64 = 1e-6;

/// A step shorter than this of the first one is none. Speeds are bounded by ten wave speeds, which shortens it to a tenth; the wave in the metric
/// of the list gets faster by the stretch and, at the stiffness of rubber at ten times its length, as much again: a hundredth. A tenth of
/// that is no deformation that can be meant.
pub const COLLAPSE: f64 = 1e-3;

/// J = rho0/rho of total Lagrangian particles; updated ones are looked at in every step.
const DENSEST: f64 = 10.0;

/// Keeps watch over a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Guard {
    /// The first time step, s.
    first: f64,
    /// Kinetic and strain energy at the start, J.
    initial: f64,
    /// The largest energy that was put in so far, J.
    supplied: f64,
    /// For how many steps on end there has been too much.
    beyond: u32,
}

/// What a look at all particles finds.
#[derive(Clone, Copy, Debug, Default)]
struct Look {
    energy: f64,
    dissipated: f64,
    work: f64,
    mass: f64,
    /// The particle with the most energy per mass, J/kg.
    liveliest: Option<(f64, Particle)>,
    /// A particle whose volume has changed too much, and its density over that at rest.
    squeezed: Option<(f64, Particle)>,
}

/// A particle as a message names it.
#[derive(Clone, Copy, Debug, Default)]
struct Particle {
    id: u32,
    body: u32,
    position: [f64; 3],
    density: f64,
}

impl Look {
    fn of(solvers: &[Box<dyn Solver>], contact: Option<&Contact>) -> Self {
        let (mut look, mut first) = (Self::default(), 0);
        if let Some(contact) = contact {
            look.energy = contact.energy(solvers);
            look.dissipated = contact.dissipated();
            look.work = contact.external_work();
        }
        for solver in solvers {
            solver.show(0..solver.len(), &mut |seen| look.take(first, seen));
            first += solver.len() as u32;
        }
        look
    }

    fn take(&mut self, first: u32, seen: &Seen) {
        if seen.mass == 0.0 {
            return;
        }
        let speed = seen.velocity.iter().map(|c| c * c).sum::<f64>();
        let energy = 0.5 * seen.mass * speed + seen.state.strain_energy;
        self.energy += energy;
        self.dissipated += seen.dissipated;
        self.work += seen.external_work;
        self.mass += seen.mass;
        let particle = Particle {
            id: first + seen.id,
            body: seen.body,
            position: seen.reference,
            density: seen.state.density,
        };
        let live = energy / seen.mass;
        if self.liveliest.is_none_or(|(most, _)| live > most) {
            self.liveliest = Some((live, particle));
        }
        if let Some(f) = seen.state.deformation {
            let ratio = 1.0 / f.det();
            if !(1.0 / DENSEST..DENSEST).contains(&ratio)
                && self.squeezed.is_none_or(|(_, p)| particle.id < p.id)
            {
                self.squeezed = Some((ratio, particle));
            }
        }
    }
}

impl Guard {
    /// A guard of bodies before their first step, which is `dt` long.
    pub fn start(solvers: &[Box<dyn Solver>], dt: f64) -> Self {
        let initial = Look::of(solvers, None).energy;
        Self { first: dt, initial, supplied: initial, beyond: 0 }
    }

    /// What it remembers, as numbers.
    #[must_use]
    pub fn saved(&self) -> [f64; 4] {
        [self.first, self.initial, self.supplied, f64::from(self.beyond)]
    }

    /// Takes back what [`Guard::saved`] gave.
    #[must_use]
    pub fn restored([first, initial, supplied, beyond]: [f64; 4]) -> Self {
        Self { first, initial, supplied, beyond: beyond as u32 }
    }

    /// Looks at the step that comes next, and that a solver asked for.
    ///
    /// # Errors
    /// If it has collapsed.
    pub fn step(&self, solvers: &[Box<dyn Solver>], (index, next): (usize, f64)) -> Result<(), Diverged> {
        let bound = COLLAPSE * self.first;
        if next >= bound {
            return Ok(());
        }
        let (solver, first) = (&solvers[index], solvers[..index].iter().map(|s| s.len() as u32).sum::<u32>());
        let place = solver.stored(solver.at_bound(&solver.bounding()).unwrap_or(0) as usize);
        let particle = Particle {
            id: first + solver.ids()[place],
            body: solver.scalar(Quantity::Body, place) as u32,
            position: solver.read(Quantity::ReferencePosition, place),
            density: 0.0,
        };
        Err(particle.beyond("time step", (next, bound), Cause::Collapsed))
    }

    /// Looks at energies and densities, if it is time to.
    ///
    /// # Errors
    /// If energy came from nowhere, or a density is out of bounds.
    pub fn look(
        &mut self,
        steps: u64,
        solvers: &[Box<dyn Solver>],
        contact: Option<&Contact>,
    ) -> Result<(), Diverged> {
        if !(steps.is_power_of_two() || steps.is_multiple_of(EVERY) || self.beyond > 0) {
            return Ok(());
        }
        let look = Look::of(solvers, contact);
        if let Some((ratio, particle)) = look.squeezed {
            let rest = particle.density / ratio;
            let bound = if ratio > 1.0 { DENSEST * rest } else { rest / DENSEST };
            return Err(particle.beyond("Density", (particle.density, bound), Cause::Density));
        }
        self.supplied = self.supplied.max(self.initial + look.work);
        let speed = solvers.iter().map(|s| s.bounding().wave_speed).fold(0.0, f64::max);
        let floor = look.mass * (speed * STILL).powi(2);
        let (has, bound) =
            (look.energy + look.dissipated - look.work - self.initial, GAIN * self.supplied.max(floor));
        self.beyond = if has > bound { self.beyond + 1 } else { 0 };
        match look.liveliest {
            Some((_, particle)) if self.beyond > LASTING => {
                Err(particle.beyond("energy gained", (has, bound), Cause::Gained))
            }
            _ => Ok(()),
        }
    }
}

impl Particle {
    fn beyond(self, field: &'static str, (value, bound): (f64, f64), cause: Cause) -> Diverged {
        let (particle, body, position) = (self.id, self.body as usize, self.position);
        Diverged { particle, body, position, field, value, bound, time: 0.0, step: 0, cause }
    }
}
