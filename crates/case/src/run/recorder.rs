//! What a run notes as it goes: it reads what is due off the simulation; the writer does the rest.

use super::reactions::Meter;
use super::sheet::{Outbox, Sample, WriterGone};
use crate::Case;
use crate::build::ProbePoint;
use crate::checked::LOOK_STEPS;
use taut::simulation::{Simulation, Totals};

/// The run's side of the books.
pub struct Recorder<'a> {
    case: &'a Case,
    points: Vec<ProbePoint>,
    /// What each probe of a boundary, and each boundary for the looks, has seen.
    meters: [Vec<Meter>; 2],
    outbox: Outbox,
    /// Time between two measurements of disorder, s.
    looks: f64,
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
        let meters = [points.len(), case.boundaries.len()].map(|n| vec![Meter::default(); n]);
        Self { case, points, meters, outbox, looks: case.time.end, due, start: None }
    }

    /// Notes the state before the first step.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn begin(&mut self, simulation: &Simulation) -> Result<(), WriterGone> {
        self.start = Some(simulation.totals());
        let seldom = self.case.time.output.max(LOOK_STEPS * simulation.dt());
        self.looks = self.case.monitor.interval.unwrap_or(seldom);
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
                };
                let sample = value.map(|value| Sample { probe: i, time, value });
                self.outbox.sheet.samples.extend(sample);
            }
        }
        let (frame, look) = (time >= self.due.frame, time >= self.due.disorder);
        if look {
            self.due.disorder = later(self.due.disorder, self.looks, time);
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
        let means = self.meters[1].iter_mut().enumerate().filter_map(|(i, m)| m.mean(simulation, i));
        sheet.reactions.extend(means);
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
