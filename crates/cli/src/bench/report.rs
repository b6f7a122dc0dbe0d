//! What a measurement leaves: its rows, and on what they were measured. Names are a contract with scripts.

use super::limits::Limits;
use crate::Failure;
use output::limited::{LONGEST_TEXT, read_text};
use output::manifest::Machine;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The first entry of a file of ours.
pub const FORMAT: &str = "taut bench 1";

/// One body on so many threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the body.
    pub name: String,
    /// Threads.
    pub threads: usize,
    /// Particles.
    pub particles: usize,
    /// Mean number of neighbours.
    pub neighbours: f64,
    /// Particles times steps, 1/s: the fastest batch of steps.
    pub particle_steps_per_second: f64,
    /// The same, the median batch.
    pub median_particle_steps_per_second: f64,
    /// Pairs (a, b) times steps, 1/s.
    pub pairs_per_second: f64,
    /// Most memory for each particle.
    pub bytes_per_particle: Option<f64>,
    /// Operations of a particle in a step, with those of its pairs.
    pub flops_per_particle_step: f64,
    /// Operations per second over those of a loop of multiply-adds.
    pub of_flops: f64,
    /// Memory of the body times steps per second over what a triad moves.
    pub of_triad: Option<f64>,
    /// Steps that share a list, with dual stepping.
    pub steps_per_list: Option<f64>,
    /// Share of the time that goes into new lists, with dual stepping.
    pub relist_share: Option<f64>,
}

/// The whole file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// [`FORMAT`].
    pub format: String,
    /// Version of taut.
    pub taut: String,
    /// When it was measured, UTC.
    pub started: String,
    /// Whether with `--quick`.
    pub quick: bool,
    /// Name of the processor, where the system tells.
    pub processor: Option<String>,
    /// The machine.
    pub machine: Machine,
    /// Its limits, for each number of threads.
    pub limits: Vec<Limits>,
    /// The rows.
    pub rows: Vec<Row>,
}

impl Report {
    /// Writes the file, which must not exist.
    pub fn write(&self, path: &Path) -> Result<(), Failure> {
        let failed = |error: String| Failure::Run(format!("cannot write {}: {error}", path.display()));
        let text = serde_json::to_string_pretty(self).map_err(|error| failed(error.to_string()))?;
        let mut file = std::fs::File::create_new(path).map_err(|error| failed(error.to_string()))?;
        std::io::Write::write_all(&mut file, (text + "\n").as_bytes())
            .map_err(|error| failed(error.to_string()))
    }

    /// Reads a file of `taut bench --json`.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let wrong = |what: String| Failure::Input(format!("cannot compare with {}: {what}", path.display()));
        let text = read_text(path, LONGEST_TEXT).map_err(|error| wrong(error.to_string()))?;
        let hint = "expected a file that `taut bench --json FILE` has written";
        let json: serde_json::Value = serde_json::from_str(&text)
            .map_err(|error| wrong(format!("this is no JSON: {error}\n{hint}")))?;
        match json.get("format").and_then(serde_json::Value::as_str) {
            Some(FORMAT) => {}
            Some(other) => return Err(wrong(format!("its format is `{other}`, not `{FORMAT}`\n{hint}"))),
            None => return Err(wrong(format!("it has no `format`\n{hint}"))),
        }
        serde_json::from_value(json).map_err(|error| wrong(format!("{error}\n{hint}")))
    }

    /// The row of a body on so many threads.
    pub fn row(&self, name: &str, threads: usize) -> Option<&Row> {
        self.rows.iter().find(|row| row.name == name && row.threads == threads)
    }

    /// Where it was measured, in a line.
    pub fn place(&self) -> String {
        let m = &self.machine;
        let processor = self.processor.as_deref().unwrap_or(&m.arch);
        let quick = if self.quick { ", quick" } else { "" };
        let (cores, set) = (m.cores, &m.instruction_set);
        format!("{processor}, {cores} cores, {set}, {}, taut {}, {}{quick}", m.os, self.taut, self.started)
    }
}

/// Name of the processor, where the system tells.
pub fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'))?.1.trim();
    Some(name.to_string()).filter(|name| !name.is_empty())
}
