//! What boundaries exert.

use taut::integrator::Impulse;
use taut::simulation::Simulation;

/// The impulse of a boundary when it was last read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter(Option<(f64, Impulse)>);

impl Meter {
    /// As numbers, to be kept; what is not known is no number.
    pub fn saved(&self) -> [f64; 7] {
        let (time, Impulse { linear: [a, b, c], angular: [d, e, f] }) =
            self.0.unwrap_or((f64::NAN, Impulse::default()));
        [time, a, b, c, d, e, f]
    }

    /// From numbers that were kept.
    pub fn restored(&[time, a, b, c, d, e, f]: &[f64; 7]) -> Self {
        let impulse = Impulse { linear: [a, b, c], angular: [d, e, f] };
        Self((!time.is_nan()).then_some((time, impulse)))
    }

    /// Mean force (N) and moment (N m) of a boundary since it was last read: what its impulse has grown by, over the time; in a quasi-static
    /// run that of the last step. `None` at the first reading.
    pub fn mean(&mut self, simulation: &Simulation, boundary: usize) -> Option<Impulse> {
        if let Some(force) = simulation.audit().grips()[boundary].force() {
            return Some(force);
        }
        let now = (simulation.time(), simulation.audit().grips()[boundary].exerted());
        let (time, before) = self.0.replace(now)?;
        (now.0 > time).then(|| (now.1 - before).times(1.0 / (now.0 - time)))
    }
}
