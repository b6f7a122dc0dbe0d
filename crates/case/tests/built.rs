//! Cases that are changed at random and still right, or nearly: whatever the reader lets through is built and marched a few
//! steps, and nothing panics, hangs, or takes memory without bound.
//!
//! `PROPTEST_CASES=200000 cargo test --release -p taut-case --test built` is the long form.

mod samples;

use case::build::{build, reckon};
use case::run::{Checkpoints, RunError, Settings, Silent, run};
use case::{Case, Overrides};
use proptest::prelude::*;
use std::time::{Duration, Instant};
use taut::simulation::{Numbers, Simulation};

/// The built-in cases, made coarse enough that a case takes milliseconds.
const BASES: &[(&str, &[&str])] = &[
    (include_str!("../../../cases/tl-plate.toml"), &["parameters.resolution=3"]),
    (include_str!("../../../cases/tl-bending-column.toml"), &["parameters.resolution=2"]),
    (include_str!("../../../cases/tl-twisting-column.toml"), &["parameters.resolution=2"]),
    (include_str!("../../../cases/ul-plate-2d.toml"), &["parameters.resolution=3"]),
    (include_str!("../../../cases/ul-rings.toml"), &["parameters.resolution=2"]),
    (samples::RINGS, &["parameters.resolution=2"]),
    (samples::PLATE, &[]),
    (samples::COLUMN, &[]),
];

/// Values that are legal somewhere and extreme elsewhere.
const VALUES: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "3",
    "0.499999",
    "1e-300",
    "1e300",
    "1e-9",
    "1e9",
    "4294967296",
    "nan",
    "inf",
    "true",
    "\"\"",
    "\"0\"",
    "\"-x\"",
    "\"1/x\"",
    "\"t\"",
    "\"if(x > 0, 1/0, 0)\"",
    "\"free\"",
    "\"lattice\"",
    "\"concentric\"",
    "\"fitted\"",
    "\"10 MPa\"",
    "\"1 mm\"",
    "\"1e300 km\"",
    "\"tl-nested\"",
    "\"ul-nested\"",
    "\"ul-non-hourglass\"",
    "\"tl-hourglass-free\"",
    "\"linear-elastic\"",
    "\"neo-hookean\"",
    "\"saint-venant-kirchhoff\"",
    "\"strain\"",
    "\"papers\"",
    "\"single\"",
    "\"dual\"",
    "[0, 0]",
    "[0, 0, 0]",
    "[1e300, -1e300]",
    "[\"x\", \"y\"]",
    "[]",
    "{}",
    "{ box = { min = [0, 0], max = [1e6, 1e6] } }",
    "{ ball = { center = [0, 0, 0], radius = 1e-3 } }",
    "{ union = [] }",
    "{ ring = { center = [0, 0], inner = 0, outer = 1 } }",
];

/// A change of the lines of a case.
#[derive(Debug, Clone)]
enum Change {
    /// The value of a line is replaced by one of [`VALUES`].
    Value(prop::sample::Index, &'static str),
    /// The value of a line is replaced by that of another.
    Copy(prop::sample::Index, prop::sample::Index),
    /// A number of a line is multiplied.
    Scale(prop::sample::Index, f64),
    /// A line goes away.
    Drop(prop::sample::Index),
    /// A line is written again behind another.
    Again(prop::sample::Index, prop::sample::Index),
}

fn change() -> impl Strategy<Value = Change> {
    let any = any::<prop::sample::Index>;
    prop_oneof![
        (any(), prop::sample::select(VALUES)).prop_map(|(at, value)| Change::Value(at, value)),
        (any(), any()).prop_map(|(at, from)| Change::Copy(at, from)),
        (any(), prop::sample::select(vec![-1.0, 0.5, 2.0, 10.0, 1e-6, 1e6, 1e200]))
            .prop_map(|(at, by)| Change::Scale(at, by)),
        any().prop_map(Change::Drop),
        (any(), any()).prop_map(|(from, to)| Change::Again(from, to)),
    ]
}

fn value_of(line: &str) -> &str {
    line.split_once(" = ").map_or(line, |(_, value)| value)
}

fn with_value(line: &str, value: &str) -> String {
    line.split_once(" = ").map_or(line.to_string(), |(key, _)| format!("{key} = {value}"))
}

/// The first number of a text, multiplied.
fn scaled(line: &str, by: f64) -> String {
    let value = value_of(line);
    let start = value.find(|c: char| c.is_ascii_digit());
    let Some(start) = start else { return line.to_string() };
    let end =
        value[start..].find(|c: char| !c.is_ascii_digit() && c != '.').map_or(value.len(), |n| start + n);
    match value[start..end].parse::<f64>() {
        Ok(number) => with_value(line, &format!("{}{:e}{}", &value[..start], number * by, &value[end..])),
        Err(_) => line.to_string(),
    }
}

fn changed(text: &str, changes: &[Change]) -> String {
    let mut lines: Vec<String> =
        text.lines().filter(|l| !l.is_empty() && !l.starts_with('#')).map(str::to_string).collect();
    for change in changes {
        let count = lines.len().max(1);
        match change {
            Change::Value(at, value) => lines[at.index(count)] = with_value(&lines[at.index(count)], value),
            Change::Copy(at, from) => {
                lines[at.index(count)] =
                    with_value(&lines[at.index(count)], value_of(&lines[from.index(count)]))
            }
            Change::Scale(at, by) => lines[at.index(count)] = scaled(&lines[at.index(count)], *by),
            Change::Drop(at) if count > 1 => drop(lines.remove(at.index(count))),
            Change::Drop(_) => {}
            Change::Again(from, to) => {
                let line = lines[from.index(count)].clone();
                lines.insert(to.index(count), line);
            }
        }
    }
    lines.join("\n") + "\n"
}

/// More particles than this are read but not built: that only costs time.
const BUILT: f64 = 3000.0;
/// Reading, building and a few steps take a hundredth of a second; this long is a hang.
const HANG: Duration = Duration::from_secs(60);

/// A few steps, and then a whole run of one step.
fn march(text: &str, set: &[&str]) {
    let start = Instant::now();
    let overrides = Overrides::set(set.iter().copied());
    match Case::parse("case.toml", text, &overrides) {
        Ok(case) if reckon(&case) <= BUILT => {
            let _ = case::explain(&case);
            if let Ok(built) = build(&case, Numbers::Double) {
                let mut simulation = Simulation::new(built.solvers, built.drives);
                let _ = simulation.begin().and_then(|()| (0..3).try_for_each(|_| simulation.step()));
            }
            leaves_all_or_nothing(case);
        }
        Ok(case) => assert!(!case.name.is_empty()),
        Err(error) => assert!(!error.render(false).is_empty()),
    }
    assert!(start.elapsed() < HANG, "{text}");
}

/// A run that could begin leaves a whole result directory, also when it diverges; any other leaves none.
fn leaves_all_or_nothing(mut case: Case) {
    case.time.end = f64::MIN_POSITIVE;
    let scratch = tempfile::tempdir().expect("a folder for the test");
    let out = scratch.path().join("out");
    let checkpoints = Checkpoints::default();
    let settings = Settings { out: out.clone(), threads: Some(1), numbers: Numbers::Double, checkpoints };
    let began = match run(&case, &settings, &mut Silent) {
        Ok(_) | Err(RunError::Diverged { .. }) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    };
    assert_eq!(out.join("manifest.json").exists(), began);
    assert_eq!(out.join("summary.json").exists(), began);
    assert_eq!(out.exists(), began, "half a result directory");
    let beside = std::fs::read_dir(scratch.path()).expect("the folder").count();
    assert_eq!(beside, usize::from(began), "something was written beside the result directory");
}

/// So many cases, or as the environment says.
fn cases(few: u32) -> ProptestConfig {
    let said = std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok());
    ProptestConfig { cases: said.unwrap_or(few), failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn what_the_reader_accepts_can_be_built_and_marched(
        base in prop::sample::select(BASES),
        changes in prop::collection::vec(change(), 0..4),
    ) {
        march(&changed(base.0, &changes), base.1);
    }
}

/// The unchanged cases are right, so that changes of them mean something.
#[test]
fn the_bases_are_built() {
    for (text, set) in BASES {
        let case = Case::parse("case.toml", &changed(text, &[]), &Overrides::set(set.iter().copied()))
            .expect("right");
        assert!(reckon(&case) <= BUILT, "{}: {} particles", case.name, reckon(&case));
        build(&case, Numbers::Double).expect("right");
    }
}
