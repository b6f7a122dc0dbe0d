//! How a body of the reference configuration is brought to rest.

use super::super::relax::{self, Exchange, Relax, Unrest};
use super::super::{Impulse, Solver};
use super::Total;
use crate::field::Quantity;
use crate::formulation::Formulation;
use crate::run::{Run, Sweeper};

impl<const D: usize, F: Formulation<D>, R: Run<D>> Relax for Total<D, F, R> {
    fn exchange(&mut self, viscosity: f64, dt: f64) -> Impulse {
        let before = relax::momentum(&self.run);
        // Positions were checked when the body was started.
        let sweeper = self.sweeper.take().or_else(|| Sweeper::new(&self.run, &self.reach()).ok());
        self.sweeper = sweeper.map(|mut sweeper| {
            sweeper.sweep(&mut self.run, &Exchange { eta_dt: viscosity * dt });
            sweeper
        });
        relax::momentum(&self.run) - before
    }

    fn rest(&mut self) {
        relax::rest(&mut self.run, self.heavier_from);
    }

    fn slow(&mut self, taken: f64) -> Impulse {
        let before = relax::momentum(&self.run);
        relax::slow(&mut self.run, taken);
        relax::momentum(&self.run) - before
    }

    fn even_out(&mut self) {
        self.heavier_from = self.at_rest;
    }

    fn pace(&mut self, factor: f64) {
        relax::pace(&mut self.run, factor);
    }

    fn unrest(&mut self) -> Unrest {
        let p = self.run.particles();
        let density = p.column(Quantity::Mass, 0)[0] / p.column(Quantity::Volume, 0)[0];
        relax::unrest(&mut self.run, self.heavier_from, density * self.at_rest)
    }

    fn extent(&self) -> f64 {
        relax::extent(&self.run)
    }

    fn wave_speed(&self) -> f64 {
        self.at_rest.sqrt()
    }
}
