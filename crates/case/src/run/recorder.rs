//! What a run notes as it goes: it reads what is due off the simulation; the writer does the rest.

use super::sheet::{Outbox, Sample, WriterGone};
use crate::Case;
use crate::build::ProbePoint;
use taut::simulation::{Simulation, Totals};

/// The run's side of the books.
pub struct Recorder<'a> {
    case: &'a Case,
    points: Vec<ProbePoint>,
    outbox: Outbox,
    due: Due,
    /// Energies and momenta at the start, once it has started.
    pub start: Option<Totals>,
}

/// When what is due next, s.
#[derive(Clone, Debug, Default)]
struct Due {
    frame: f64,
    disorder: f64,
    probes: Vec<f64>,
    framed: Option<f64>,
}

impl<'a> Recorder<'a> {
    /// A recorder before the start.
    pub fn new(case: &'a Case, points: Vec<ProbePoint>, outbox: Outbox) -> Self {
        let due = Due { probes: vec![0.0; points.len()], ..Due::default() };
        Self { case, points, outbox, due, start: None }
    }

    /// Notes the state before the first step.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn begin(&mut self, simulation: &Simulation) -> Result<(), WriterGone> {
        self.start = Some(simulation.totals());
        self.after_step(simulation)
    }

    /// Notes whatever is due.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn after_step(&mut self, simulation: &Simulation) -> Result<(), WriterGone> {
        let time = simulation.time();
        for i in 0..self.points.len() {
            if time >= self.due.probes[i] {
                self.due.probes[i] += self.case.probes[i].interval;
                let value = self.points[i].value(simulation);
                self.outbox.sheet.samples.push(Sample { probe: i, time, value });
            }
        }
        let (frame, look) = (time >= self.due.frame, time >= self.due.disorder);
        if look {
            self.due.disorder = later(self.due.disorder, self.case.monitor.interval, time);
        }
        if frame {
            self.due.frame = later(self.due.frame, self.case.time.output, time);
        }
        if frame || look {
            self.copy(simulation, look, frame);
        }
        self.outbox.post()
    }

    fn copy(&mut self, simulation: &Simulation, look: bool, frame: bool) {
        let sheet = &mut self.outbox.sheet;
        sheet.totals = simulation.snapshot(&mut sheet.snapshot);
        (sheet.step, sheet.look, sheet.frame) = (simulation.steps(), look, frame);
        if frame {
            self.due.framed = Some(simulation.time());
        }
    }

    /// Notes the state at the end, if it is not noted yet.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn end(mut self, simulation: &Simulation) -> Result<(), WriterGone> {
        if self.due.framed.is_none_or(|framed| simulation.time() > framed) {
            self.copy(simulation, true, true);
        }
        self.outbox.last()
    }

    /// Notes what is left of a run that diverged: its samples, and the initial state if there is no frame yet.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn abandon(mut self, simulation: &Simulation) -> Result<(), WriterGone> {
        if self.due.framed.is_none() {
            self.copy(simulation, false, true);
        }
        self.outbox.last()
    }
}

/// The next multiple of an interval after `time`.
fn later(due: f64, interval: f64, time: f64) -> f64 {
    due + interval * ((time - due) / interval).floor().max(0.0) + interval
}
