//! `manifest.json`: what was run, with what, on what.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::{OutputError, ResultDir};

/// The machine of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Processor family, such as `x86_64`.
    pub arch: String,
    /// Operating system, such as `linux`.
    pub os: String,
    /// Vector instructions that the run used, such as `avx2`.
    pub instruction_set: String,
    /// Processors that the operating system lets the program use.
    pub cores: usize,
}

impl Machine {
    /// This machine; which vector instructions the run uses is for the caller to say.
    pub fn here(instruction_set: &str) -> Self {
        Self {
            arch: std::env::consts::ARCH.to_string(),
            os: std::env::consts::OS.to_string(),
            instruction_set: instruction_set.to_string(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

/// The whole file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of taut.
    pub taut: String,
    /// Text of the case as it was run, after all overrides: run it again with `taut run`.
    pub case: String,
    /// [`hash`] of that text.
    pub case_hash: String,
    /// When the run started, UTC, `2026-01-31T12:00:00Z`.
    pub started: String,
    /// Threads used.
    pub threads: usize,
    /// `double` or `single`.
    pub precision: String,
    /// Where it ran.
    pub machine: Machine,
    /// The files that the case refers to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<KeptFile>,
    /// When it was interrupted and went on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub resumed: Vec<Resumed>,
}

/// A file that a case refers to, and the copy that the run kept of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptFile {
    /// Its path, as the case says it.
    pub name: String,
    /// The path of the copy, from the result directory.
    pub kept: String,
    /// [`hash`] of its bytes.
    pub hash: String,
}

/// A run that went on from a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Resumed {
    /// When, UTC.
    pub at: String,
    /// Step of the checkpoint.
    pub step: u64,
    /// Threads used from there on.
    pub threads: usize,
    /// Where it ran from there on.
    pub machine: Machine,
}

impl Resumed {
    /// Now, from this step.
    pub fn now(step: u64, machine: Machine, threads: usize) -> Self {
        Self { at: utc(SystemTime::now()), step, threads, machine }
    }
}

impl Manifest {
    /// The manifest of a run that starts now, with `threads` threads in `precision`.
    pub fn new(case: &str, machine: Machine, threads: usize, precision: &str) -> Self {
        Self {
            taut: env!("CARGO_PKG_VERSION").to_string(),
            case: case.to_string(),
            case_hash: hash(case.as_bytes()),
            started: utc(SystemTime::now()),
            threads,
            precision: precision.to_string(),
            machine,
            files: Vec::new(),
            resumed: Vec::new(),
        }
    }

    /// Writes `manifest.json` in one step.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn write(&self, results: &ResultDir) -> Result<PathBuf, OutputError> {
        results.write_json("manifest.json", self)
    }

    /// Reads `manifest.json` from a result directory.
    ///
    /// # Errors
    /// [`OutputError::Read`] if it is not there or is not a manifest.
    pub fn read(directory: &Path) -> Result<Self, OutputError> {
        crate::directory::read_json(&directory.join("manifest.json"))
    }
}

/// FNV-1a, 128 bits, as 32 hexadecimal digits: tells cases apart and stays the same for ever and on every
/// machine. It identifies; it does not protect against anyone who wants two texts with one hash.
///
/// Constants: <http://www.isthe.com/chongo/tech/comp/fnv/>.
pub fn hash(bytes: &[u8]) -> String {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = (1 << 88) + (1 << 8) + 0x3b;
    let hash = bytes.iter().fold(OFFSET, |hash, &byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME));
    format!("{hash:032x}")
}

/// `time` as `2026-01-31T12:00:00Z`; times before 1970 count as 1970.
pub fn utc(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let (year, month, day) = date(days);
    format!("{year:04}-{month:02}-{day:02}T{:02}:{:02}:{:02}Z", rest / 3600, rest / 60 % 60, rest % 60)
}

/// Year, month and day of the Gregorian calendar, `days` after 1970-01-01.
fn date(mut days: u64) -> (u64, usize, u64) {
    let leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    // 400 years are always 146 097 days: skipping them keeps the loop short for any clock.
    let mut year = 1970 + 400 * (days / 146_097);
    days %= 146_097;
    while days >= 365 + u64::from(leap(year)) {
        days -= 365 + u64::from(leap(year));
        year += 1;
    }
    let mut lengths = [31, 28 + u64::from(leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31].into_iter();
    let mut month = 1;
    while let Some(length) = lengths.next().filter(|&length| days >= length) {
        days -= length;
        month += 1;
    }
    (year, month, days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn manifest_comes_back() {
        let scratch = tempfile::tempdir().unwrap();
        let manifest =
            Manifest::new("name = \"a\"\n# \u{3bd} \"quoted\"\n", Machine::here("avx2"), 2, "double");
        manifest.write(&ResultDir::create(scratch.path()).unwrap()).unwrap();
        assert_eq!(Manifest::read(scratch.path()).unwrap(), manifest);
        assert!(manifest.machine.cores >= 1);
    }

    #[test]
    fn hash_agrees_with_values_published_for_fnv_1a() {
        assert_eq!(hash(b""), "6c62272e07bb014262b821756295c58d");
        assert_eq!(hash(b"a"), "d228cb696f1a8caf78912b704e4a8964");
        assert_ne!(hash(b"ab"), hash(b"ba"));
    }

    #[test]
    fn dates_agree_with_the_calendar() {
        // From `date -u -d @SECONDS`: an ordinary day, leap days, the ends of years, a century.
        for (seconds, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (1_772_323_199, "2026-02-28T23:59:59Z"),
            (1_772_323_200, "2026-03-01T00:00:00Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (13_569_465_600, "2400-01-01T00:00:00Z"),
        ] {
            assert_eq!(utc(UNIX_EPOCH + Duration::from_secs(seconds)), expected);
        }
    }
}
