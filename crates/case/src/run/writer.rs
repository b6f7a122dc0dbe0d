//! What a run writes down, off the critical path: disorder, frames and tables.

use super::alarm::{Alarm, Thresholds};
use super::audit::Audit;
use super::contact::Contact;
use super::error::RunError;
use super::frames::Framer;
use super::history::DisorderHistory;
use super::measures::Series;
use super::sheet::{Inbox, Sheet};
use super::watcher::Watcher;
use crate::Case;
use crate::build::Watch;
use output::{Frame, ProbeTable, ResultDir};
use rayon::ThreadPool;
use std::sync::Arc;

/// The writer's side of the books.
pub struct Writer<'a> {
    case: &'a Case,
    frames: output::Series,
    framer: Framer,
    tables: Vec<ProbeTable>,
    watch: Box<dyn Watch>,
    deformation: Vec<[f64; 9]>,
    contact: Contact,
    /// Samples of every probe.
    pub series: Vec<Series>,
    /// Measures of disorder.
    pub disorder: DisorderHistory,
    /// The books of energy and momentum.
    pub audit: Audit,
    /// What was doubtful.
    pub warnings: Vec<String>,
    thresholds: Thresholds,
    /// Where it is told that a run has to end.
    pub alarm: Arc<Alarm>,
    /// Time of the last frame, s.
    framed: Option<f64>,
}

impl<'a> Writer<'a> {
    /// Opens the files of a run.
    ///
    /// # Errors
    /// If one cannot be made.
    pub fn create(
        case: &'a Case,
        results: &ResultDir,
        watch: Box<dyn Watch>,
        warnings: Vec<String>,
    ) -> Result<Self, RunError> {
        let mut tables = Vec::new();
        for probe in &case.probes {
            let axes = &["x", "y", "z"][probe.quantity.axes(case.dimension)];
            let columns: Vec<(&str, &str)> = axes.iter().map(|axis| (*axis, probe.quantity.unit())).collect();
            tables.push(ProbeTable::create(results, &probe.name, &columns)?);
        }
        references(case, results)?;
        let support = 2.0 * case.spacing * case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max);
        Ok(Self {
            case,
            frames: output::Series::create(results)?,
            framer: Framer::new(case.spacing),
            tables,
            watch,
            deformation: Vec::new(),
            contact: Contact::new(support),
            series: vec![Series::default(); case.probes.len()],
            disorder: DisorderHistory::default(),
            audit: Audit::create(case, results)?,
            warnings,
            thresholds: Thresholds::default(),
            alarm: Arc::default(),
            framed: None,
        })
    }

    /// How many frames there are, and the time of the last one, s.
    pub fn last_frame(&self) -> Option<(usize, f64)> {
        Some((self.frames.frames(), self.framed?))
    }

    /// When bodies first touched, s.
    pub fn contact(&self) -> Option<f64> {
        self.contact.time
    }

    /// Writes down every sheet that comes, until the run is over. What has to be computed is computed here if there is a core to spare;
    /// otherwise it goes to the `threads` of the run, in between its sweeps: a thread more than there are cores would hold up whole sweeps.
    /// This one then only waits for the disk.
    ///
    /// # Errors
    /// A write that fails, particles whose disorder cannot be measured.
    pub fn work(
        mut self,
        inbox: Inbox,
        watcher: &Watcher<'_>,
        threads: Option<&ThreadPool>,
    ) -> Result<Self, RunError> {
        while let Some(sheet) = inbox.next() {
            self.tabulate(&sheet)?;
            let frame = match threads {
                Some(threads) => threads.install(|| self.digest(&sheet, watcher))?,
                None => self.digest(&sheet, watcher)?,
            };
            inbox.back(sheet);
            if let Some((frame, bytes)) = frame {
                self.frames.store(&frame, &bytes)?;
                self.framed = Some(frame.time);
                self.flush()?;
                watcher.with(|observer| observer.framed(frame));
            }
        }
        self.flush()?;
        Ok(self)
    }

    fn flush(&mut self) -> Result<(), RunError> {
        for table in &mut self.tables {
            table.flush()?;
        }
        self.audit.flush()
    }

    fn tabulate(&mut self, sheet: &Sheet) -> Result<(), RunError> {
        for sample in &sheet.samples {
            let axes = self.case.probes[sample.probe].quantity.axes(self.case.dimension);
            self.tables[sample.probe].push(sample.time, &sample.value[axes])?;
            let series = &mut self.series[sample.probe];
            series.times.push(sample.time);
            for (column, v) in series.values.iter_mut().zip(sample.value) {
                column.push(v);
            }
        }
        Ok(())
    }

    /// What is due of the disorder and, if one is due, a frame with the bytes of its file.
    fn digest(&mut self, sheet: &Sheet, watcher: &Watcher<'_>) -> Result<Option<(Frame, Vec<u8>)>, RunError> {
        if sheet.look || sheet.frame {
            self.audit.look(sheet)?;
        }
        if sheet.look {
            self.look(sheet, watcher)?;
        }
        if !sheet.frame {
            return Ok(None);
        }
        self.watch.deformation(&sheet.snapshot, &mut self.deformation);
        let frame = self.framer.frame(&sheet.snapshot, &self.deformation, sheet.step);
        let bytes = self.frames.encode(&frame)?;
        Ok(Some((frame, bytes)))
    }

    fn look(&mut self, sheet: &Sheet, watcher: &Watcher<'_>) -> Result<(), RunError> {
        let time = sheet.snapshot.time;
        if self.contact.is_awaited() {
            self.contact.look(time, self.watch.gap(&sheet.snapshot)?);
        }
        if !sheet.measure {
            return Ok(());
        }
        let disorder = self.watch.measure(&sheet.snapshot)?;
        let monitor = &self.case.monitor;
        for crossed in self.thresholds.crossed(monitor, &disorder) {
            if monitor.stop {
                self.alarm.raise(crossed, self.watch.most_zigzag().unwrap_or(0) as u32);
            }
            let warning = crossed.warning(time);
            watcher.with(|observer| observer.warned(&warning));
            self.warnings.push(warning);
        }
        self.disorder.push(time, disorder);
        Ok(())
    }
}

/// Keeps the curves that probes are compared with beside the results, so that plots can be made again from there.
fn references(case: &Case, results: &ResultDir) -> Result<(), RunError> {
    let mut folder = None;
    for probe in &case.probes {
        let Some(text) = probe.reference.as_ref().and_then(|curves| curves.text.as_ref()) else { continue };
        let folder = match &mut folder {
            Some(folder) => folder,
            none => none.insert(results.folder("reference")?),
        };
        output::write_atomically(&folder.join(format!("{}.csv", probe.name)), text.as_bytes())?;
    }
    Ok(())
}
