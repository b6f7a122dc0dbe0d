//! What is known of a run that stopped.

use super::Evidence;
use super::culprit::Culprit;
use crate::{Family, Formulation};
use taut::field::Quantity;
use taut::math::Tensor;

/// The facts that a likely cause is chosen from.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Formulation of the culprit's body.
    pub formulation: Option<Formulation>,
    /// sqrt(K/rho0) of its material, m/s.
    pub wave_speed: f64,
    /// Its Poisson's ratio.
    pub poisson: f64,
    /// The Courant number, and the default one.
    pub cfl: (f64, f64),
    /// Its speed, m/s.
    pub speed: f64,
    /// The largest speed that the remembered steps saw, m/s.
    pub fastest: f64,
    /// The largest prescribed speed now, m/s.
    pub led: f64,
    /// What acts on it and is no number.
    pub senseless: Option<&'static str>,
    /// Its neighbours.
    pub neighbours: Option<i64>,
    /// Its distance to the nearest held particle, in spacings.
    pub held: Option<f64>,
    /// The largest stretch at the particle: the norm of F.
    pub stretch: Option<f64>,
    /// Zigzag at the first and at the last measurement, and its time, s.
    pub zigzag: Option<(f64, f64, f64)>,
    /// Particles across the thinnest part of its body.
    pub across: Option<usize>,
    /// Whether the run stopped before its first step was done.
    pub at_start: bool,
}

impl Facts {
    /// Gathers them.
    pub fn gather(evidence: &Evidence<'_>, culprit: Option<&Culprit<'_>>) -> Self {
        let (case, diverged) = (evidence.case, evidence.diverged);
        let mut facts = Self { at_start: diverged.step == 0, ..Self::default() };
        if let Some(body) = case.bodies.get(diverged.body) {
            facts.formulation = Some(body.scheme.formulation);
            facts.cfl = (body.scheme.cfl, crate::checked::default_cfl(body.scheme.formulation));
            if let Some(material) = case.material_of(body) {
                facts.poisson = material.elastic.poisson_ratio;
                facts.wave_speed = (material.elastic.bulk_modulus / material.density).sqrt();
            }
            facts.across = evidence.across.get(diverged.body).copied();
        }
        let steps = evidence.simulation.history().steps();
        facts.fastest = steps.map(|step| step.bounding.speed).fold(0.0, f64::max);
        facts.zigzag = evidence.writer.disorder.zigzag();
        if let Some(culprit) = culprit {
            facts.look(culprit, case.spacing);
        }
        facts
    }

    fn look(&mut self, culprit: &Culprit<'_>, spacing: f64) {
        let (solver, place) = (culprit.solver, culprit.place);
        let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        self.speed = length(solver.read(Quantity::Velocity, place));
        let loads =
            [(Quantity::BodyForce, "body force"), (Quantity::PrescribedVelocity, "prescribed motion")];
        let nonsense = |field| solver.read(field, place).iter().any(|x| !x.is_finite());
        self.senseless = loads.into_iter().find(|(field, _)| nonsense(*field)).map(|(_, name)| name);
        self.neighbours = Some(culprit.neighbours());
        self.held = culprit.held_within().map(|r| r / spacing);
        let given = (0..solver.len()).map(|p| length(solver.read(Quantity::PrescribedVelocity, p)));
        self.led = given.fold(0.0, f64::max);
        let norm = |f: Tensor<f64, 3>| f.double_dot(f).sqrt();
        self.stretch = solver.state(place).deformation.map(norm).filter(|s| s.is_finite());
    }

    /// Whether the body is solved by a form that is blind to zigzag modes.
    pub fn is_nested(&self) -> bool {
        self.formulation.is_some_and(|f| f == Formulation::TlNested || f.is_updated_nested())
    }

    /// Whether its neighbours are those of the undeformed body.
    pub fn is_total(&self) -> bool {
        self.formulation.is_some_and(|f| f.family() == Family::Total)
    }
}
