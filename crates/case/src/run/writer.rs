//! What a run writes down, off the critical path: disorder, frames and tables.

use super::contact::Contact;
use super::error::RunError;
use super::frames::frame;
use super::history::DisorderHistory;
use super::measures::Series;
use super::sheet::{Inbox, Sheet};
use super::watcher::Watcher;
use crate::Case;
use crate::build::{Observed, Watch};
use output::{Frame, ProbeTable, ResultDir};
use rayon::ThreadPool;

/// The writer's side of the books.
pub struct Writer<'a> {
    case: &'a Case,
    frames: output::Series,
    tables: Vec<ProbeTable>,
    watch: Box<dyn Watch>,
    deformation: Vec<[f64; 9]>,
    contact: Contact,
    /// Samples of every probe.
    pub series: Vec<Series>,
    /// Measures of disorder.
    pub disorder: DisorderHistory,
    /// Time, kinetic, strain and total energy.
    pub energies: Vec<[f64; 4]>,
    /// What was doubtful.
    pub warnings: Vec<String>,
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
            let (unit, axes) = (probe.quantity.unit(), probe.quantity.components(case.dimension));
            let columns: Vec<(&str, &str)> =
                ["x", "y", "z"].into_iter().take(axes).map(|axis| (axis, unit)).collect();
            tables.push(ProbeTable::create(results, &probe.name, &columns)?);
        }
        let support = 2.0 * case.spacing * case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max);
        Ok(Self {
            case,
            frames: output::Series::create(results)?,
            tables,
            watch,
            deformation: Vec::new(),
            contact: Contact::new(support),
            series: vec![Series::default(); case.probes.len()],
            disorder: DisorderHistory::default(),
            energies: Vec::new(),
            warnings,
        })
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
        Ok(())
    }

    fn tabulate(&mut self, sheet: &Sheet) -> Result<(), RunError> {
        for sample in &sheet.samples {
            let axes = self.case.probes[sample.probe].quantity.components(self.case.dimension);
            self.tables[sample.probe].push(sample.time, &sample.value[..axes])?;
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
        if sheet.look {
            self.look(sheet, watcher)?;
        }
        if !sheet.frame {
            return Ok(None);
        }
        self.watch.deformation(&sheet.snapshot, &mut self.deformation);
        let frame = frame(&sheet.snapshot, &self.deformation, self.case.spacing, sheet.step);
        let bytes = self.frames.encode(&frame)?;
        Ok(Some((frame, bytes)))
    }

    fn look(&mut self, sheet: &Sheet, watcher: &Watcher<'_>) -> Result<(), RunError> {
        let (time, totals) = (sheet.snapshot.time, &sheet.totals);
        self.energies.push([
            time,
            totals.kinetic,
            totals.strain,
            totals.kinetic + totals.strain + totals.contact,
        ]);
        let Observed { disorder, gap } = self.watch.measure(&sheet.snapshot, self.contact.is_awaited())?;
        self.contact.look(time, gap);
        let zigzag = disorder.zigzag_rms;
        let warned = self.warnings.iter().any(|w| w.starts_with("disorder"));
        if self.case.monitor.zigzag.is_some_and(|limit| zigzag > limit) && !warned {
            let warning =
                format!("disorder: zigzag_rms is {zigzag:.4} at t = {time:.6} s; zero-energy modes grow");
            watcher.with(|observer| observer.warned(&warning));
            self.warnings.push(warning);
        }
        self.disorder.push(time, disorder);
        Ok(())
    }
}
