//! The books of energy and momentum over the run: `audit.csv`, `reactions.csv`, and the worst that was missing.

use super::checkpoint::{TOTALS, of_totals, totals};
use super::couples::{Couples, NUMBERS};
use super::error::RunError;
use super::sheet::Sheet;
use crate::{Case, Quantity};
use output::summary::{Balance, Energy, Momentum};
use output::{Mark, OutputError, ProbeTable, ResultDir};
use std::path::{Path, PathBuf};
use taut::simulation::Totals;

/// The tables; the second only where there are boundaries.
const TABLES: [&str; 2] = ["audit", "reactions"];

/// The books.
pub struct Audit {
    table: ProbeTable,
    reactions: Option<ProbeTable>,
    dimension: usize,
    start: Option<Totals>,
    /// The largest of what is missing: energy, J; momentum, kg m/s; angular momentum, kg m^2/s.
    worst: [f64; 3],
    /// What that is small or large against, likewise.
    scale: [f64; 3],
    /// Time, kinetic, strain and total energy of every sample.
    history: Vec<[f64; 4]>,
    /// What the pair forces themselves did to the angular momentum.
    couples: Couples,
}

/// initial + external work - dissipated - (kinetic + strain + contact), J.
fn residual(start: &Totals, now: &Totals) -> f64 {
    supplied(start, now) - now.dissipated - energy(now)
}

/// Energy at the start and from outside, J.
fn supplied(start: &Totals, now: &Totals) -> f64 {
    energy(start) + now.external_work
}

/// What bodies and contact hold, J.
fn energy(totals: &Totals) -> f64 {
    totals.kinetic + totals.strain + totals.contact
}

pub(super) fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Audit {
    /// Starts the tables of a run.
    ///
    /// # Errors
    /// If one cannot be made.
    pub fn create(case: &Case, results: &ResultDir) -> Result<Self, RunError> {
        let energies = ["kinetic", "strain", "contact", "dissipated", "external work", "residual"];
        let mut columns: Vec<(String, &str)> = energies.map(|name| (name.to_string(), "J")).to_vec();
        let vectors = [
            ("momentum", "kg m/s", Quantity::Reaction),
            ("impulse", "kg m/s", Quantity::Reaction),
            ("angular momentum", "kg m^2/s", Quantity::Moment),
            ("angular impulse", "kg m^2/s", Quantity::Moment),
        ];
        for (name, unit, kind) in vectors {
            columns.extend(kind.axes(case.dimension).map(|i| (format!("{name} {}", AXES[i]), unit)));
        }
        let mut exerted: Vec<(String, &str)> = Vec::new();
        for boundary in &case.boundaries {
            for (word, kind) in [("force", Quantity::Reaction), ("moment", Quantity::Moment)] {
                let axes = kind.axes(case.dimension);
                exerted.extend(axes.map(|i| (format!("{} {word} {}", boundary.name, AXES[i]), kind.unit())));
            }
        }
        let table = |name, columns: &[(String, &str)]| {
            let columns: Vec<(&str, &str)> =
                columns.iter().map(|(name, unit)| (name.as_str(), *unit)).collect();
            ProbeTable::beside_summary(results, name, &columns)
        };
        let reactions = (!exerted.is_empty()).then(|| table(TABLES[1], &exerted)).transpose()?;
        Ok(Self {
            table: table(TABLES[0], &columns)?,
            reactions,
            dimension: case.dimension,
            start: None,
            worst: [0.0; 3],
            scale: [0.0; 3],
            history: Vec::new(),
            couples: Couples::default(),
        })
    }

    /// The files of so many of its tables.
    pub fn files(results: &Path, tables: usize) -> impl Iterator<Item = PathBuf> {
        TABLES.iter().take(tables).map(move |name| output::table_beside(results, name))
    }

    /// How long the tables are.
    ///
    /// # Errors
    /// If they cannot be stored.
    pub fn marks(&mut self) -> Result<Vec<Mark>, RunError> {
        let tables = std::iter::once(&mut self.table).chain(&mut self.reactions);
        Ok(tables.map(ProbeTable::mark).collect::<Result<_, _>>()?)
    }

    /// The books as numbers, to be kept.
    pub fn saved(&self) -> Vec<f64> {
        let start = self.start.map(|start| of_totals(&start)).unwrap_or(vec![f64::NAN; TOTALS]);
        let couples = self.couples.saved();
        [&start[..], &self.worst, &self.scale, &couples, self.history.as_flattened()].concat()
    }

    /// Goes on with the tables from where they were at these marks, and with books that were kept.
    ///
    /// # Errors
    /// If they are not what they were.
    pub fn reopen(case: &Case, results: &ResultDir, marks: &[Mark], books: &[f64]) -> Result<Self, RunError> {
        let damaged = || OutputError::Inconsistent {
            what: "the audit of a checkpoint".to_string(),
            problem: "it has another length".to_string(),
        };
        let mut tables = Vec::new();
        for (path, mark) in Self::files(results.path(), 2).zip(marks) {
            tables.push(ProbeTable::reopen(path, mark)?.0);
        }
        let mut tables = tables.into_iter();
        let (start, rest) = books.split_at_checked(TOTALS).ok_or_else(damaged)?;
        let (worst, rest) = rest.split_first_chunk::<3>().ok_or_else(damaged)?;
        let (scale, rest) = rest.split_first_chunk::<3>().ok_or_else(damaged)?;
        let (couples, history) = rest.split_first_chunk::<NUMBERS>().ok_or_else(damaged)?;
        Ok(Self {
            table: tables.next().ok_or_else(damaged)?,
            reactions: tables.next(),
            dimension: case.dimension,
            start: totals(start).filter(|start| !start.kinetic.is_nan()),
            worst: *worst,
            scale: *scale,
            history: history.as_chunks::<4>().0.to_vec(),
            couples: Couples::restored(couples),
        })
    }

    /// Takes down a look.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn look(&mut self, sheet: &Sheet) -> Result<(), RunError> {
        let (time, now) = (sheet.snapshot.time, &sheet.totals);
        self.note(time, now);
        let start = self.start.unwrap_or_default();
        let mut row = vec![now.kinetic, now.strain, now.contact, now.dissipated, now.external_work];
        row.push(residual(&start, now));
        let (line, around) = (Quantity::Reaction.axes(self.dimension), Quantity::Moment.axes(self.dimension));
        row.extend(&now.momentum[line.clone()]);
        row.extend(&now.impulse.linear[line.clone()]);
        row.extend(&now.angular_momentum[around.clone()]);
        row.extend(&now.impulse.angular[around.clone()]);
        self.table.push(time, &row)?;
        if let Some(table) = self.reactions.as_mut().filter(|_| !sheet.reactions.is_empty()) {
            let mut row = Vec::new();
            for mean in &sheet.reactions {
                row.extend(&mean.linear[line.clone()]);
                row.extend(&mean.angular[around.clone()]);
            }
            table.push(time, &row)?;
        }
        Ok(())
    }

    fn note(&mut self, time: f64, now: &Totals) {
        let start = *self.start.get_or_insert(*now);
        self.history.push([time, now.kinetic, now.strain, energy(now)]);
        let turned = missing(start.angular_momentum, now.angular_momentum, now.impulse.angular);
        self.couples.look(time, now, turned);
        let missing = [
            residual(&start, now).abs(),
            length(missing(start.momentum, now.momentum, now.impulse.linear)),
            length(turned),
        ];
        let scale = [
            supplied(&start, now),
            now.motion[0].max(length(now.impulse.linear)),
            now.motion[1].max(length(now.impulse.angular)),
        ];
        for i in 0..3 {
            // A value that is not a number stays: it is the worst.
            self.worst[i] =
                if missing[i] > self.worst[i] || missing[i].is_nan() { missing[i] } else { self.worst[i] };
            self.scale[i] = self.scale[i].max(scale[i]);
        }
    }

    /// Time, kinetic, strain and total energy of every sample.
    pub fn history(&self) -> &[[f64; 4]] {
        &self.history
    }

    /// Hands written rows to the system.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn flush(&mut self) -> Result<(), RunError> {
        self.table.flush()?;
        Ok(self.reactions.as_mut().map_or(Ok(()), ProbeTable::flush)?)
    }

    fn share(&self, i: usize) -> f64 {
        if self.worst[i] == 0.0 { 0.0 } else { self.worst[i] / self.scale[i] }
    }

    /// The block `energy` of the summary.
    pub fn energy(&self, start: &Totals, end: &Totals) -> Energy {
        Energy {
            initial: energy(start),
            at_end: energy(end),
            kinetic: end.kinetic,
            strain: end.strain,
            contact: end.contact,
            dissipated: end.dissipated,
            external_work: end.external_work,
            residual: residual(start, end),
            worst_residual: self.share(0),
            history: self.history.clone(),
        }
    }

    /// The block `momentum` of the summary.
    pub fn momentum(&self, start: &Totals, end: &Totals) -> Momentum {
        let with =
            |balance: Balance, i| Balance { worst_residual: self.share(i), scale: self.scale[i], ..balance };
        Momentum {
            linear: with(Balance::new(start.momentum, end.momentum, end.impulse.linear), 1),
            angular: with(Balance::new(start.angular_momentum, end.angular_momentum, end.impulse.angular), 2),
            couples: self.couples.summary(self.worst[2], self.scale[2]),
        }
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// What a momentum has changed by beside what was given.
fn missing(before: [f64; 3], after: [f64; 3], given: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| after[i] - before[i] - given[i])
}
