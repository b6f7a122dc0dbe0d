//! What a run writes down, off the critical path: disorder, frames and tables.

use super::alarm::{Alarm, Thresholds};
use super::audit::Audit;
use super::checkpoint::{Books, Notes, Saving};
use super::contact::Contact;
use super::error::RunError;
use super::frames::Framer;
use super::history::DisorderHistory;
use super::measures::Series;
use super::sheet::{Inbox, Sheet};
use super::watcher::Watcher;
use crate::Case;
use crate::build::Watch;
use output::checkpoint::{About, Keeper};
use output::manifest::utc;
use output::{Frame, OutputError, ProbeTable, ResultDir, Table};
use rayon::ThreadPool;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::SystemTime;

/// The writer's side of the books.
pub struct Writer<'a> {
    case: &'a Case,
    frames: output::Series,
    framer: Framer,
    tables: Vec<ProbeTable>,
    watch: Box<dyn Watch>,
    deformation: Vec<[f64; 9]>,
    contact: Contact,
    keeper: Keeper,
    about: About,
    /// The last checkpoint, or why it could not be written.
    pub kept: Option<Result<PathBuf, OutputError>>,
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
        (watch, about): (Box<dyn Watch>, About),
        warnings: Vec<String>,
    ) -> Result<Self, RunError> {
        let mut tables = Vec::new();
        for probe in &case.probes {
            let names = probe.quantity.components(case.dimension).iter();
            let columns: Vec<(&str, &str)> = names.map(|name| (*name, probe.quantity.unit())).collect();
            tables.push(ProbeTable::create(results, &probe.name, &columns)?);
        }
        references(case, results)?;
        Ok(Self {
            case,
            frames: output::Series::create(results)?,
            framer: Framer::new(case),
            tables,
            watch,
            deformation: Vec::new(),
            contact: untouched(case),
            keeper: Keeper::new(results),
            about,
            kept: None,
            series: vec![Series::default(); case.probes.len()],
            disorder: DisorderHistory::default(),
            audit: Audit::create(case, results)?,
            warnings,
            thresholds: Thresholds::default(),
            alarm: Arc::default(),
            framed: None,
        })
    }

    /// Goes on with the files of a run that was interrupted from where they were at a checkpoint: what came later is dropped.
    ///
    /// # Errors
    /// If they are not what they were, or cannot be written.
    pub fn reopen(
        case: &'a Case,
        results: &ResultDir,
        (watch, about): (Box<dyn Watch>, About),
        (books, notes): (Books, Notes),
    ) -> Result<Self, RunError> {
        let framed = books.frames.last().copied();
        let frames = output::Series::reopen(results, books.frames, notes.framed)?;
        let (mut tables, mut series) = (Vec::new(), Vec::new());
        for (probe, mark) in case.probes.iter().zip(&notes.tables) {
            let (table, rows) = ProbeTable::reopen(output::table_path(results.path(), &probe.name), mark)?;
            tables.push(table);
            series.push(samples(rows, probe.quantity.axes(case.dimension).start));
        }
        Ok(Self {
            case,
            frames,
            framer: Framer::new(case),
            tables,
            watch,
            deformation: Vec::new(),
            contact: books.contact,
            keeper: Keeper::new(results),
            about,
            kept: None,
            series,
            disorder: books.disorder,
            audit: Audit::reopen(case, results, &notes.audit, &books.audit)?,
            warnings: notes.warnings,
            // What ends a run ends it again.
            thresholds: Thresholds::restored(notes.crossed.map(|crossed| crossed && !case.monitor.stop)),
            alarm: Arc::default(),
            framed,
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
        while let Some(mut sheet) = inbox.next() {
            self.tabulate(&sheet)?;
            let frame = match threads {
                Some(threads) => threads.install(|| self.digest(&sheet, watcher))?,
                None => self.digest(&sheet, watcher)?,
            };
            let saving = sheet.saving.take();
            inbox.back(sheet);
            if let Some((frame, bytes)) = frame {
                self.frames.store(&frame, &bytes)?;
                self.framed = Some(frame.time);
                self.flush()?;
                watcher.with(|observer| observer.framed(frame));
            }
            if let Some(saving) = saving {
                self.save(saving, watcher)?;
            }
        }
        self.flush()?;
        Ok(self)
    }

    /// Adds the books to the run's part of a checkpoint, and writes it. If it cannot be written the one before it is still there: a
    /// run does not end for that.
    fn save(&mut self, saving: Saving, watcher: &Watcher<'_>) -> Result<(), RunError> {
        let Saving { mut draft, step, time, wall } = saving;
        let tables = self.tables.iter_mut().map(ProbeTable::mark).collect::<Result<Vec<_>, _>>()?;
        let notes = Notes {
            tables,
            warnings: self.warnings.clone(),
            framed: self.frames.last_step(),
            audit: self.audit.marks()?,
            crossed: self.thresholds.saved(),
        };
        let books = (&self.disorder, &self.contact);
        Books::add(&mut draft, self.frames.times(), &self.audit.saved(), books);
        let written = utc(SystemTime::now());
        let about = About { step, time, wall_seconds: wall, written, ..self.about.clone() };
        let kept = self.keeper.keep(&draft, &about, &notes.in_words());
        if let Err(error) = &kept {
            let warning = format!("no checkpoint at step {step}: {error}; {}", error.hint());
            watcher.with(|observer| observer.warned(&warning));
        }
        self.kept = Some(kept);
        Ok(())
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

/// Bodies that have not touched.
pub fn untouched(case: &Case) -> Contact {
    Contact::new(2.0 * case.spacing * case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max))
}

/// The samples in a table whose first column is this axis.
fn samples(table: Table, axis: usize) -> Series {
    let mut values: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; table.times.len()]);
    for (to, column) in values.iter_mut().skip(axis).zip(table.columns) {
        *to = column.values;
    }
    Series { times: table.times, values }
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
