//! Disorder beyond a threshold: it warns, once for each threshold, or ends the run.

use crate::Monitor;
use std::sync::OnceLock;
use taut::diagnostics::disorder::Disorder;
use taut::field::Quantity;
use taut::integrator::{Cause, Diverged};
use taut::simulation::Simulation;

/// A threshold that was crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed {
    /// The measure.
    pub measure: &'static str,
    /// Its value.
    pub value: f64,
    /// The threshold.
    pub bound: f64,
}

/// Which thresholds have been crossed already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Thresholds([bool; 3]);

impl Thresholds {
    /// Those that this state crosses for the first time.
    pub fn crossed(&mut self, monitor: &Monitor, disorder: &Disorder) -> Vec<Crossed> {
        let measures = [
            ("zigzag_rms", disorder.zigzag_rms, monitor.zigzag, disorder.zigzag_rms > monitor.zigzag),
            ("bond_min", disorder.bond_min, monitor.bond_min, disorder.bond_min < monitor.bond_min),
            ("broken", disorder.broken, monitor.broken, disorder.broken > monitor.broken),
        ];
        let mut crossed = Vec::new();
        for (known, (measure, value, bound, beyond)) in self.0.iter_mut().zip(measures) {
            if beyond && !*known {
                *known = true;
                crossed.push(Crossed { measure, value, bound });
            }
        }
        crossed
    }
}

impl Crossed {
    /// The warning.
    pub fn warning(&self, time: f64) -> String {
        let (side, means) = match self.measure {
            "zigzag_rms" => ("above", "zero-energy modes grow"),
            "bond_min" => ("below", "particles clump"),
            _ => ("above", "the body tears"),
        };
        let Self { measure, value, bound } = self;
        format!("disorder: {measure} is {value:.4} at t = {time:.6} s, {side} {bound}; {means}")
    }
}

/// Where the writer, which measures, tells the run to end.
#[derive(Debug, Default)]
pub struct Alarm(OnceLock<(Crossed, u32)>);

impl Alarm {
    /// Ends the run; the particle is where the disorder is worst.
    pub fn raise(&self, crossed: Crossed, particle: u32) {
        // The first one counts.
        let _ = self.0.set((crossed, particle));
    }

    /// Why the run has to end, if it has to.
    pub fn stops(&self, simulation: &Simulation) -> Option<Diverged> {
        let &(Crossed { measure, value, bound }, particle) = self.0.get()?;
        let mut id = particle as usize;
        let mut solvers = simulation.solvers().iter();
        let solver = solvers.find(|solver| {
            id < solver.len() || {
                id -= solver.len();
                false
            }
        })?;
        let place = solver.stored(id);
        Some(Diverged {
            particle,
            body: solver.scalar(Quantity::Body, place) as usize,
            position: solver.read(Quantity::ReferencePosition, place),
            field: measure,
            value,
            bound,
            time: simulation.time(),
            step: simulation.steps(),
            cause: Cause::Disordered,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_is_told_once() {
        let monitor =
            Monitor { zigzag: 0.1, bond_min: 0.5, broken: 0.01, stop: false, interval: 1.0, apart: (0, 0.0) };
        let calm = Disorder {
            zigzag_rms: 0.05,
            zigzag_99: 0.1,
            zigzag_max: 0.3,
            bond_min: 0.8,
            spacing_min: 0.8,
            broken: 0.0,
            pieces: 1,
        };
        let wild = Disorder { zigzag_rms: 0.2, bond_min: 0.4, ..calm };
        let mut thresholds = Thresholds::default();
        let mut names = |d: &Disorder| -> Vec<_> {
            thresholds.crossed(&monitor, d).into_iter().map(|c| c.measure).collect()
        };
        assert_eq!(names(&calm), Vec::<&str>::new());
        assert_eq!(names(&wild), ["zigzag_rms", "bond_min"]);
        assert_eq!(names(&Disorder { broken: 0.02, ..wild }), ["broken"]);
        assert_eq!(names(&wild), Vec::<&str>::new());
    }
}
