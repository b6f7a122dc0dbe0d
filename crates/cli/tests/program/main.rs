//! The program as a user meets it: what is typed, what comes back, what lies in the result directory.

mod audit;
mod bench;
mod cases;
mod command_line;
mod diagnosis;
mod divergence;
mod loads;
mod mesh;
mod particles;
mod report;
mod results;
mod resume;
mod studies;
mod wrong_input;

use std::path::Path;
use std::process::{Command, Stdio};

/// A small case that is right: 200 particles, about 40 steps.
const BLOCK: &str = r#"name = "block"
title = "A block is squeezed"
dimension = 2
formulation = "tl-hourglass-free"
spacing = "dp"

[parameters]
dp = "1 mm"
v0 = 10

[material.rubber]
model = "neo-hookean"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45

[region.foot]
shape = { box = { min = [-1, -1], max = ["dp", 1] } }

[[body]]
name = "block"
material = "rubber"
shape = { box = { min = [0, 0], max = ["2 cm", "1 cm"] } }
velocity = ["v0*sin(80*x)", 0]

[[boundary]]
region = "foot"
fixed = true

[time]
end = "0.1 ms"
output = "0.02 ms"

[[probe]]
name = "tip"
at = [0.02, 0.005]

[[measure]]
name = "tip_max"
probe = "tip"
component = "x"
kind = "maximum"

[[measure]]
name = "period"
probe = "tip"
component = "x"
kind = "second-crossing"
"#;

/// How the program ended.
struct Ended {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Ended {
    /// Checks the status; a panic would be 101.
    #[track_caller]
    fn with(self, status: i32) -> Self {
        let (out, err) = (&self.stdout, &self.stderr);
        assert_eq!(self.status, Some(status), "stdout:\n{out}\nstderr:\n{err}");
        assert!(!err.contains("panicked"), "{err}");
        self
    }
}

/// Runs the program in a folder.
fn taut(folder: &Path, arguments: &[&str]) -> Ended {
    let done = Command::new(env!("CARGO_BIN_EXE_taut"))
        .args(arguments)
        .current_dir(folder)
        .env("MALLOC_ARENA_MAX", "1")
        .stdin(Stdio::null())
        .output()
        .expect("the program can be started");
    let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
    Ended { status: done.status.code(), stdout: text(done.stdout), stderr: text(done.stderr) }
}

/// An empty folder with the block in `case.toml`.
fn with_case(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("case.toml"), text).expect("the case is written");
    folder
}

/// A JSON file of a result directory.
fn json(path: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).expect("JSON")
}
