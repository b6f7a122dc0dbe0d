//! What boundaries exert.

use taut::integrator::Impulse;
use taut::simulation::Simulation;

/// The impulse of a boundary when it was last read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter(Option<(f64, Impulse)>);

impl Meter {
    /// Mean force (N) and moment (N m) of a boundary since it was last read: what its impulse has grown by, over the time; in a quasi-static
    /// run that of the last step. `None` at the first reading.
    pub fn mean(&mut self, simulation: &Simulation, boundary: usize) -> Option<Impulse> {
        if let Some(force) = simulation.audit().grips()[boundary].force() {
            return Some(force);
        }
        let now = (simulation.time(), simulation.audit().grips()[boundary].impulse());
        let (time, before) = self.0.replace(now)?;
        (now.0 > time).then(|| (now.1 - before).times(1.0 / (now.0 - time)))
    }
}
