//! What a run notes as it goes: it reads what is due off the simulation; the writer does the rest.

use super::checkpoint::{self, Saving, Settling};
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
pub struct Due {
    frame: f64,
    look: f64,
    probes: Vec<f64>,
    framed: Option<f64>,
    /// Steps at the last frame.
    framed_at: u64,
    /// Time and steps at which disorder was measured last.
    measured: Option<(f64, u64)>,
}

/// What a checkpoint remembers of a recorder.
pub struct Remembered {
    /// What is due.
    pub due: Due,
    /// Readings of probes and of boundaries.
    pub meters: [Vec<Meter>; 2],
    /// Energies and momenta at the start.
    pub start: Totals,
}

impl Remembered {
    /// Whether it is of so many probes and boundaries.
    pub fn fits(&self, probes: usize, boundaries: usize) -> bool {
        self.due.probes.len() == probes && self.meters.each_ref().map(Vec::len) == [probes, boundaries]
    }
}

impl Due {
    /// As numbers, to be kept; what is not known is no number.
    pub fn saved(&self) -> Vec<f64> {
        let (when, at) = self.measured.map_or((f64::NAN, 0.0), |(when, at)| (when, at as f64));
        let framed = self.framed.unwrap_or(f64::NAN);
        let few = [self.frame, self.look, framed, self.framed_at as f64, when, at];
        [&few, self.probes.as_slice()].concat()
    }

    /// From numbers that were kept; `None` if they are too few.
    pub fn restored(numbers: &[f64]) -> Option<Self> {
        let &[frame, look, framed, framed_at, when, at, ref probes @ ..] = numbers else { return None };
        let framed = (!framed.is_nan()).then_some(framed);
        let measured = (!when.is_nan()).then_some((when, at as u64));
        let framed_at = framed_at as u64;
        Some(Self { frame, look, probes: probes.to_vec(), framed, framed_at, measured })
    }
}

impl<'a> Recorder<'a> {
    /// A recorder before the start.
    pub fn new(case: &'a Case, points: Vec<ProbePoint>, outbox: Outbox) -> Self {
        let due = Due { probes: vec![0.0; points.len()], ..Due::default() };
        let meters = [points.len(), case.boundaries.len()].map(|n| vec![Meter::default(); n]);
        Self { case, points, meters, outbox, due, start: None }
    }

    /// The recorder of a run that goes on, with what a checkpoint remembered.
    pub fn remembering(self, Remembered { due, meters, start }: Remembered) -> Self {
        Self { due, meters, start: Some(start), ..self }
    }

    /// Writes a checkpoint of this simulation now, between two of its steps, with where a quasi-static run stands; `wall` is the wall time of the run so far, s. Everything that
    /// was noted before is on disk before it.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn checkpoint(
        &mut self,
        simulation: &Simulation,
        settling: Option<&Settling>,
        wall: f64,
    ) -> Result<(), WriterGone> {
        let Some(start) = &self.start else { return Ok(()) };
        let mut draft = checkpoint::draft(simulation);
        checkpoint::remember(&mut draft, (&self.due, &self.meters), start);
        if let Some(settling) = settling {
            settling.add(&mut draft);
        }
        let saving = Saving { draft, step: simulation.steps(), time: simulation.time(), wall };
        self.outbox.sheet.saving = Some(saving);
        self.outbox.post()
    }

    /// Notes the state before the first step.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn begin(&mut self, simulation: &mut Simulation) -> Result<(), WriterGone> {
        self.start = Some(simulation.totals());
        self.after_step(simulation)
    }

    /// Notes whatever is due.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn after_step(&mut self, simulation: &mut Simulation) -> Result<(), WriterGone> {
        let time = simulation.time();
        for i in 0..self.points.len() {
            if time >= self.due.probes[i] {
                self.due.probes[i] += self.case.probes[i].interval;
                let meter = &mut self.meters[0][i];
                let value = match &self.points[i] {
                    ProbePoint::Motion(followed) => {
                        if followed.is_looked_at() {
                            simulation.look();
                        }
                        Some(followed.value(simulation.solvers()))
                    }
                    ProbePoint::Force(boundary) => meter.mean(simulation, *boundary).map(|r| r.linear),
                    ProbePoint::Moment(boundary) => meter.mean(simulation, *boundary).map(|r| r.angular),
                    ProbePoint::Contact(touched) => Some(touched.value(simulation)),
                    ProbePoint::Gap(apart) => Some([apart.value(simulation.solvers()), 0.0, 0.0]),
                };
                let sample = value.map(|value| Sample { probe: i, time, value });
                self.outbox.sheet.samples.extend(sample);
            }
        }
        let frame = time >= self.due.frame && self.is_apart(simulation);
        // Unless the case says how often, energies are looked at with the frames.
        let look = time >= self.due.look && (frame || self.case.monitor.apart.0 == 0);
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

    /// Whether the last frame is far enough back for the next one; equilibria of a quasi-static run always are.
    fn is_apart(&self, simulation: &Simulation) -> bool {
        let (steps, time) = self.case.time.apart;
        self.case.quasi_static.is_some()
            || self.due.framed.is_none_or(|framed| {
                simulation.steps() >= self.due.framed_at + steps || simulation.time() >= framed + time
            })
    }

    /// Whether disorder is to be measured at a look: not again at once, unless the case says how often.
    fn is_due(&self, time: f64, step: u64) -> bool {
        let monitor = &self.case.monitor;
        self.due
            .measured
            .is_none_or(|(when, at)| step >= at + monitor.apart.0 || time >= when + monitor.apart.1)
    }

    fn copy(&mut self, simulation: &mut Simulation, look: bool, frame: bool) {
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
            (self.due.framed, self.due.framed_at) = (Some(time), step);
        }
    }

    /// Notes the state at the end, if it is not noted yet.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn end(mut self, simulation: &mut Simulation) -> Result<(), WriterGone> {
        if self.due.framed.is_none_or(|framed| simulation.time() > framed) {
            self.copy(simulation, true, true);
        }
        self.outbox.last()
    }

    /// Notes what is left of a run that diverged: its samples, and the initial state if there is no frame yet.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn abandon(mut self, simulation: &mut Simulation) -> Result<(), WriterGone> {
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
