//! What a run notes as it goes: it reads what is due off the simulation; the writer does the rest.

use super::reactions::Meter;
use super::sheet::{Outbox, Sample, WriterGone};
use crate::Case;
use crate::build::ProbePoint;
use taut::simulation::{Simulation, Totals};

/// The run's side of the books.
pub struct Recorder<'a> {
    case: &'a Case,
    points: Vec<ProbePoint>,
    /// What each probe of a boundary, and each boundary for the looks, has seen.
    meters: [Vec<Meter>; 2],
    outbox: Outbox,
    due: Due,
    /// Energies and momenta at the start, once it has started.
    pub start: Option<Totals>,
}

/// When what is due next, s.
#[derive(Clone, Debug, Default)]
struct Due {
    frame: f64,
    look: f64,
    probes: Vec<f64>,
    framed: Option<f64>,
    /// Time and steps at which disorder was measured last.
    measured: Option<(f64, u64)>,
}

impl<'a> Recorder<'a> {
    /// A recorder before the start.
    pub fn new(case: &'a Case, points: Vec<ProbePoint>, outbox: Outbox) -> Self {
        let due = Due { probes: vec![0.0; points.len()], ..Due::default() };
        let meters = [points.len(), case.boundaries.len()].map(|n| vec![Meter::default(); n]);
        Self { case, points, meters, outbox, due, start: None }
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
                let meter = &mut self.meters[0][i];
                let value = match &self.points[i] {
                    ProbePoint::Motion(followed) => Some(followed.value(simulation.solvers())),
                    ProbePoint::Force(boundary) => meter.mean(simulation, *boundary).map(|r| r.linear),
                    ProbePoint::Moment(boundary) => meter.mean(simulation, *boundary).map(|r| r.angular),
                    ProbePoint::Contact(touched) => Some(touched.value(simulation)),
                };
                let sample = value.map(|value| Sample { probe: i, time, value });
                self.outbox.sheet.samples.extend(sample);
            }
        }
        let (frame, look) = (time >= self.due.frame, time >= self.due.look);
        if look {
            self.due.look = later(self.due.look, self.case.monitor.interval, time);
        }
        if frame {
            self.due.frame = later(self.due.frame, self.case.time.output, time);
        }
        if frame || look {
            self.copy(simulation, look, frame);
        }
        self.outbox.post()
    }

    /// Whether disorder is to be measured at a look: not again at once, unless the case says how often.
    fn is_due(&self, time: f64, step: u64) -> bool {
        let monitor = &self.case.monitor;
        self.due
            .measured
            .is_none_or(|(when, at)| step >= at + monitor.apart.0 || time >= when + monitor.apart.1)
    }

    fn copy(&mut self, simulation: &Simulation, look: bool, frame: bool) {
        let (time, step) = (simulation.time(), simulation.steps());
        let ending = time >= self.case.time.end;
        let measure = look && (ending || self.is_due(time, step));
        if measure {
            self.due.measured = Some((time, step));
        }
        let sheet = &mut self.outbox.sheet;
        sheet.totals = simulation.snapshot(&mut sheet.snapshot);
        (sheet.step, sheet.look, sheet.measure, sheet.frame) = (step, look, measure, frame);
        let means = self.meters[1].iter_mut().enumerate().filter_map(|(i, m)| m.mean(simulation, i));
        sheet.reactions.extend(means);
        if frame {
            self.due.framed = Some(time);
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
