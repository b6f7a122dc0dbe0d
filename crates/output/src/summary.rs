//! `summary.json`: what came out of a run, in numbers. Its names are a contract with users' scripts.
//!
//! All numbers are SI. A number that is not finite is written as `null` and read back as NaN; a measured
//! value that does not exist is `null` with the reason beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::nullable;
use crate::{OutputError, ResultDir};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It goes on, or it was killed before it could say how it ended.
    #[default]
    Running,
    /// The end time was reached.
    Done,
    /// A quantity left the range in which it means something.
    Diverged,
    /// Stopped by the user before the end time.
    Interrupted,
    /// Something else went wrong, such as a full disk.
    Failed,
}

/// Energies of the whole system, J.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Energy {
    /// Kinetic and strain energy, and that of contact, at the start.
    #[serde(deserialize_with = "nullable::number")]
    pub initial: f64,
    /// The same at the end.
    #[serde(rename = "final", deserialize_with = "nullable::number")]
    pub at_end: f64,
    /// Kinetic energy at the end.
    #[serde(deserialize_with = "nullable::number")]
    pub kinetic: f64,
    /// Strain energy at the end.
    #[serde(deserialize_with = "nullable::number")]
    pub strain: f64,
    /// Held by contact at the end.
    #[serde(default, deserialize_with = "nullable::number")]
    pub contact: f64,
    /// Taken out by viscosity and damping during the run.
    #[serde(deserialize_with = "nullable::number")]
    pub dissipated: f64,
    /// Done by loads, gravity and moving boundaries during the run.
    #[serde(deserialize_with = "nullable::number")]
    pub external_work: f64,
    /// What is missing in the balance: initial + external_work - dissipated - final.
    #[serde(deserialize_with = "nullable::number")]
    pub residual: f64,
    /// The largest |residual| of all samples, over the largest energy that was put in: at the start and from outside.
    #[serde(default, deserialize_with = "nullable::number")]
    pub worst_residual: f64,
    /// Samples, one with every frame and every measurement of disorder: (time, kinetic, strain, kinetic + strain + contact).
    #[serde(default, deserialize_with = "nullable::energies")]
    pub history: Vec<[f64; 4]>,
}

/// A momentum, and whether it is what came from outside.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Balance {
    /// At the start.
    #[serde(deserialize_with = "nullable::vector")]
    pub initial: [f64; 3],
    /// At the end.
    #[serde(rename = "final", deserialize_with = "nullable::vector")]
    pub at_end: [f64; 3],
    /// Length of the difference.
    #[serde(deserialize_with = "nullable::number")]
    pub drift: f64,
    /// What constraints and body forces gave.
    #[serde(default, deserialize_with = "nullable::vector")]
    pub impulse: [f64; 3],
    /// Length of what is missing in the balance at the end: initial + impulse - final.
    #[serde(default, deserialize_with = "nullable::number")]
    pub residual: f64,
    /// The largest of all samples of what is missing, over `scale`.
    #[serde(default, deserialize_with = "nullable::number")]
    pub worst_residual: f64,
    /// The largest of all samples of the sum of m |v| (angular: m |x| |v|), and of the impulse.
    #[serde(default, deserialize_with = "nullable::number")]
    pub scale: f64,
}

impl Balance {
    /// From the vectors at the start and at the end, and what came from outside in between.
    pub fn new(initial: [f64; 3], at_end: [f64; 3], impulse: [f64; 3]) -> Self {
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let change: [f64; 3] = std::array::from_fn(|i| at_end[i] - initial[i]);
        let missing = std::array::from_fn(|i| change[i] - impulse[i]);
        Self { initial, at_end, impulse, drift: length(change), residual: length(missing), ..Self::default() }
    }
}

/// Momentum of the whole system. What supports and loads give changes it; bodies among themselves must not.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Momentum {
    /// Linear momentum, kg m/s.
    pub linear: Balance,
    /// Angular momentum about the origin, kg m^2/s.
    pub angular: Balance,
    /// What the pair forces themselves do to the angular momentum, where a form does not keep it.
    #[serde(default)]
    pub couples: Couples,
}

/// The moment of the pair forces of forms that do not keep angular momentum, summed up between the samples of the books.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Couples {
    /// Its impulse, N m s.
    #[serde(deserialize_with = "nullable::vector")]
    pub impulse: [f64; 3],
    /// The same with the sizes of the couples of all particles, as if none cancelled another, N m s: no more can be missing.
    #[serde(deserialize_with = "nullable::number")]
    pub bound: f64,
    /// The largest of all samples of what is missing of the angular momentum, over `bound`; not a number where there is none.
    #[serde(deserialize_with = "nullable::number")]
    pub share: f64,
    /// The largest of all samples of what is missing beside `impulse`, over the `scale` of the angular momentum: the error of the sum.
    #[serde(deserialize_with = "nullable::number")]
    pub worst_residual: f64,
}

/// One measure of disorder over the run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worst {
    /// The worst value of the run.
    #[serde(deserialize_with = "nullable::number")]
    pub worst: f64,
    /// When that was, s.
    #[serde(deserialize_with = "nullable::number")]
    pub time: f64,
    /// All samples, (time, value).
    #[serde(deserialize_with = "nullable::history")]
    pub history: Vec<[f64; 2]>,
}

/// How orderly the particles stayed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disorder {
    /// Zigzag of neighbouring particles over the spacing, root mean square over the particles.
    pub zigzag_rms: Worst,
    /// Zigzag that 99 of 100 particles stay below.
    pub zigzag_99: Worst,
    /// Zigzag of the worst particle.
    pub zigzag_max: Worst,
    /// Shortest bond over the spacing.
    pub bond_min: Worst,
    /// Smallest distance of two particles over the spacing.
    pub spacing_min: Worst,
    /// Share of the bonds that are broken.
    pub broken: Worst,
    /// Number of pieces the bodies are in.
    pub pieces: Worst,
}

/// A result that the case asked for by name.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The value; `None` if the run did not get that far, see `reason`.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// When it was found, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Why there is no value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// For a result that is a curve: (time, value).
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "nullable::history")]
    pub history: Vec<[f64; 2]>,
}

impl Measured {
    /// A value with its unit; one that is not finite is none, and says so.
    pub fn value(value: f64, unit: &str) -> Self {
        if !value.is_finite() {
            return Self::missing(unit, &format!("the value is {value}"));
        }
        Self { value: Some(value), unit: unit.to_string(), ..Self::default() }
    }

    /// No value, and why.
    pub fn missing(unit: &str, reason: &str) -> Self {
        Self { unit: unit.to_string(), reason: Some(reason.to_string()), ..Self::default() }
    }

    /// Says when, s.
    pub fn at(mut self, time: f64) -> Self {
        self.time = Some(time);
        self
    }
}

/// How a quasi-static run came to rest.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settled {
    /// Increments of the case.
    pub increments: u32,
    /// Those that came to rest.
    pub converged: u32,
    /// What counted as rest.
    #[serde(deserialize_with = "nullable::number")]
    pub tolerance: f64,
    /// Largest share of unbalanced forces at the end of an increment.
    #[serde(deserialize_with = "nullable::number")]
    pub worst_force: f64,
    /// Largest root of kinetic over elastic energy at the end of an increment.
    #[serde(deserialize_with = "nullable::number")]
    pub worst_motion: f64,
    /// (time, steps, share of unbalanced forces) of each increment.
    pub history: Vec<[f64; 3]>,
}

/// Why a run did not reach its end.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Failure {
    /// What happened, one sentence.
    pub message: String,
    /// What to do about it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// When, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
}

/// The whole file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Name of the case.
    pub case: String,
    /// Name of the formulation (of the first body, if they differ).
    pub formulation: String,
    /// 2 or 3.
    pub dimension: u32,
    /// Number of particles.
    pub particles: u64,
    /// Mean number of neighbours at the start.
    #[serde(deserialize_with = "nullable::number")]
    pub neighbours_mean: f64,
    /// Steps done.
    pub steps: u64,
    /// Time reached, s.
    #[serde(deserialize_with = "nullable::number")]
    pub end_time: f64,
    /// How it ended.
    pub status: Status,
    /// Time the run took, s.
    #[serde(deserialize_with = "nullable::number")]
    pub wall_seconds: f64,
    /// Particles times steps over the wall time, 1/s.
    #[serde(deserialize_with = "nullable::number")]
    pub particle_steps_per_second: f64,
    /// Checkpoints made since the run began or went on.
    #[serde(default)]
    pub checkpoints: u64,
    /// Part of the wall time that they held up the run, s.
    #[serde(default, deserialize_with = "nullable::number")]
    pub checkpoint_seconds: f64,
    /// Threads used.
    pub threads: u32,
    /// `double` or `single`: what sums over neighbours were computed with.
    pub precision: String,
    /// Where the energy went.
    pub energy: Energy,
    /// What happened to the momentum.
    pub momentum: Momentum,
    /// How orderly the particles stayed.
    pub disorder: Disorder,
    /// How a quasi-static run came to rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quasi_static: Option<Settled>,
    /// Results that the case asked for, by name.
    pub measured: BTreeMap<String, Measured>,
    /// What the user should know although the run went on.
    pub warnings: Vec<String>,
    /// Why the run did not reach its end.
    pub error: Option<Failure>,
}

impl Summary {
    /// Writes (or replaces) `summary.json` in one step.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn write(&self, results: &ResultDir) -> Result<PathBuf, OutputError> {
        results.write_json("summary.json", self)
    }

    /// Reads `summary.json` from a result directory.
    ///
    /// # Errors
    /// [`OutputError::Read`] if it is not there or is not a summary.
    pub fn read(directory: &Path) -> Result<Self, OutputError> {
        crate::directory::read_json(&directory.join("summary.json"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Summary {
        let worst = Worst { worst: 0.1 + 0.2, time: 1e-5, history: vec![[0.0, 0.25], [1e-5, 0.1 + 0.2]] };
        let mut measured = BTreeMap::new();
        measured.insert("period".to_string(), Measured::value(0.254, "s").at(0.6));
        measured
            .insert("tip_max".to_string(), Measured::missing("m", "the run ended before the first swing"));
        Summary {
            case: "ul-plate-2d".to_string(),
            particles: 1 << 40,
            disorder: Disorder { zigzag_rms: worst, ..Disorder::default() },
            momentum: Momentum {
                linear: Balance::new([0.0; 3], [3.0, 0.0, 4.0], [3.0, 0.0, 3.0]),
                ..Momentum::default()
            },
            measured,
            status: Status::Done,
            error: Some(Failure { message: "stopped".to_string(), ..Failure::default() }),
            ..Summary::default()
        }
    }

    #[test]
    fn what_was_written_comes_back_exactly() {
        let scratch = tempfile::tempdir().unwrap();
        let results = ResultDir::create(scratch.path()).unwrap();
        example().write(&results).unwrap();
        assert_eq!(Summary::read(scratch.path()).unwrap(), example());
    }

    #[test]
    fn the_names_of_the_contract_are_there() {
        let json = serde_json::to_value(example()).unwrap();
        for path in [
            "/energy/initial",
            "/energy/final",
            "/energy/external_work",
            "/energy/history",
            "/momentum/linear/final",
            "/momentum/angular/drift",
            "/disorder/zigzag_99/worst",
            "/disorder/pieces/history",
            "/measured/period/time",
            "/measured/tip_max/reason",
            "/particle_steps_per_second",
        ] {
            assert!(json.pointer(path).is_some(), "{path}");
        }
        assert_eq!(json["status"], "done");
        assert_eq!(json["momentum"]["linear"]["drift"], 5.0);
        assert_eq!(json["momentum"]["linear"]["residual"], 1.0);
        assert!(json["measured"]["tip_max"]["value"].is_null());
    }

    #[test]
    fn numbers_that_are_not_finite_become_null_and_come_back_as_nan() {
        let mut broken = example();
        broken.energy.residual = f64::NAN;
        broken.energy.history.push([0.0, 1.0, f64::NAN, f64::NAN]);
        broken.momentum.linear.at_end = [1.0, f64::INFINITY, 2.0];
        broken.disorder.zigzag_rms.history.push([2.0, f64::NAN]);
        broken.measured.insert("bad".to_string(), Measured::value(f64::NAN, "m").at(f64::INFINITY));
        let scratch = tempfile::tempdir().unwrap();
        broken.write(&ResultDir::create(scratch.path()).unwrap()).unwrap();
        let read = Summary::read(scratch.path()).unwrap();
        assert!(read.energy.residual.is_nan());
        assert!(read.energy.history[0][1] == 1.0 && read.energy.history[0][2].is_nan());
        assert!(read.momentum.linear.at_end[1].is_nan() && read.momentum.linear.at_end[2] == 2.0);
        assert!(read.disorder.zigzag_rms.history[2][1].is_nan());
        assert_eq!(read.measured["bad"].value, None);
        assert_eq!(read.measured["bad"].time, None);
        assert_eq!(read.measured["bad"].reason.as_deref(), Some("the value is NaN"));
    }
}
