//! A run that is stopped and goes on leaves what it would have left undisturbed, bit by bit: frames, tables, the numbers of the summary.
//! Whatever does not belong to it is refused.

mod samples;

use case::run::{
    Checkpoints, Interrupted, Observer, Progress, ResumeError, RunError, Settings, Silent, Stop,
};
use case::{Case, Overrides};
use output::checkpoint::kept;
use samples::{BLOCK, PULLED, ROUND, text};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use taut::simulation::Numbers;

/// Asks a run to stop after a step, and counts.
struct After(u64, Stop);

impl Observer for After {
    fn stepped(&mut self, progress: &Progress) {
        if progress.step >= self.0 {
            self.1.request();
        }
    }
}

fn case(text: &str) -> Case {
    match Case::parse("case.toml", text, &Overrides::default()) {
        Ok(case) => case,
        Err(error) => panic!("{}", error.render(false)),
    }
}

fn settings(out: &Path, numbers: Numbers, threads: usize) -> Settings {
    Settings { out: out.to_path_buf(), threads: Some(threads), numbers, checkpoints: Checkpoints::default() }
}

/// Everything in a result directory that must not depend on interruptions; the summary without times of the clock.
fn left(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for folder in ["particles", "probes"] {
        for entry in fs::read_dir(out.join(folder)).expect("a folder").flatten() {
            let name = Path::new(folder).join(entry.file_name());
            files.insert(name, fs::read(entry.path()).expect("a file"));
        }
    }
    for table in ["audit.csv", "reactions.csv", "convergence.csv"] {
        files.extend(fs::read(out.join(table)).ok().map(|bytes| (table.into(), bytes)));
    }
    let text = fs::read(out.join("summary.json")).expect("a summary");
    let mut summary: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    let clocks =
        ["wall_seconds", "particle_steps_per_second", "threads", "checkpoints", "checkpoint_seconds"];
    for clock in clocks {
        summary.as_object_mut().expect("an object").remove(clock);
    }
    files.insert("summary.json".into(), summary.to_string().into_bytes());
    files
}

/// Runs until a step, on two threads; the error.
fn until(step: u64, case: &Case, out: &Path, numbers: Numbers) -> RunError {
    let settings = settings(out, numbers, 2);
    let mut observer = After(step, settings.checkpoints.stop.clone());
    case::run::run(case, &settings, &mut observer).expect_err("it was stopped")
}

/// Goes on until a step, on one thread.
fn on(step: u64, out: &Path) -> Result<(), RunError> {
    let run = Interrupted::find(out).unwrap_or_else(|error| panic!("{error}"));
    let checkpoints = Checkpoints::default();
    let mut observer = After(step, checkpoints.stop.clone());
    case::run::resume(run, Some(1), &checkpoints, &mut observer).map(drop)
}

/// The first line that differs.
fn differing(one: &[u8], other: &[u8]) -> String {
    let [one, other] = [one, other].map(String::from_utf8_lossy);
    let lines = one.lines().zip(other.lines()).enumerate().find(|(_, (a, b))| a != b);
    lines.map_or_else(|| "in length".to_string(), |(i, (a, b))| format!("line {}: {a} and {b}", i + 1))
}

/// Undisturbed, and stopped twice.
fn same_bits(text: &str, numbers: Numbers) {
    let scratch = tempfile::tempdir().expect("a folder");
    let (whole, parts) = (scratch.path().join("whole"), scratch.path().join("parts"));
    let case = case(text);
    let summary = case::run::run(&case, &settings(&whole, numbers, 1), &mut Silent).expect("it runs");
    assert!(summary.steps > 30, "{} steps", summary.steps);
    let error = until(13, &case, &parts, numbers);
    assert!(matches!(error, RunError::Interrupted { step: 13, checkpoint: Ok(_), .. }), "{error}");
    let told = on(29, &parts).expect_err("it was stopped again").to_string();
    assert!(told.contains("after step 29") && told.contains("taut run --resume"), "{told}");
    assert_eq!(kept(&parts).len(), 2);
    on(u64::MAX, &parts).unwrap_or_else(|error| panic!("{error}"));
    let (whole, parts) = (left(&whole), left(&parts));
    assert_eq!(whole.keys().collect::<Vec<_>>(), parts.keys().collect::<Vec<_>>());
    assert!(whole.len() >= 10, "frames and tables");
    for (name, bytes) in &whole {
        assert!(
            *bytes == parts[name],
            "{} differs: {}\n{text}",
            name.display(),
            differing(bytes, &parts[name])
        );
    }
}

#[test]
fn total_lagrangian_bodies_go_on_bit_by_bit() {
    for formulation in ["tl-hourglass-free", "tl-nested", "tl-ganzenmueller"] {
        for dimension in [2, 3] {
            for bodies in [BLOCK, ROUND] {
                same_bits(&text(formulation, dimension, bodies), Numbers::Double);
            }
        }
        same_bits(&text(formulation, 2, BLOCK), Numbers::Single);
        same_bits(&text(formulation, 2, ROUND), Numbers::Single);
    }
}

#[test]
fn updated_lagrangian_bodies_go_on_bit_by_bit() {
    for formulation in ["ul-non-hourglass", "ul-nested"] {
        for dimension in [2, 3] {
            for bodies in [BLOCK, ROUND] {
                same_bits(&text(formulation, dimension, bodies), Numbers::Double);
            }
        }
        same_bits(&text(formulation, 2, BLOCK), Numbers::Single);
        same_bits(&text(formulation, 2, ROUND), Numbers::Single);
    }
}

#[test]
fn quasi_static_runs_go_on_bit_by_bit() {
    same_bits(PULLED, Numbers::Double);
    same_bits(&PULLED.replace("increments = 8", "increments = 300"), Numbers::Single);
    let damped = "[damping]\nprobability = 0.2\nviscosity = \"100 Pa*s\"\n[[body]]";
    same_bits(&PULLED.replace("[[body]]", damped).replace("tl-nested", "tl-ganzenmueller"), Numbers::Double);
    let tool = r#"
[[tool]]
name = "punch"
shape = { box = { min = ["2 mm", "8 mm"], max = ["8 mm", "11 mm"] } }
displacement = [0, "-0.001*t"]
"#;
    same_bits(&format!("{PULLED}{tool}"), Numbers::Double);
}

/// Forms that are there for comparison differ from the others in what they remember, not in how it is kept: one body each, double precision.
#[test]
fn every_other_formulation_goes_on_bit_by_bit() {
    for formulation in [
        "ul-generalised",
        "ul-artificial-stress",
        "ul-artificial-stress-corrected",
        "ul-laplacian",
        "ul-low-dissipation",
    ] {
        same_bits(&text(formulation, 2, BLOCK), Numbers::Double);
        same_bits(&text(formulation, 3, ROUND), Numbers::Double);
    }
    for dimension in [2, 3] {
        let text = text("small-strain", dimension, BLOCK).replace("\"neo-hookean\"", "\"linear-elastic\"");
        // Its steps are twice as long.
        let text = text.replace("end = \"0.1 ms\"", "end = \"0.25 ms\"");
        same_bits(&text, Numbers::Double);
    }
}

/// Checkpoints as often as can be leave the same results.
#[test]
fn checkpoints_leave_no_trace_in_the_results() {
    let scratch = tempfile::tempdir().expect("a folder");
    let case = case(&text("ul-non-hourglass", 2, ROUND));
    let [none, many] = [Duration::MAX, Duration::ZERO].map(|every| {
        let out = scratch.path().join(format!("{every:?}"));
        let mut settings = settings(&out, Numbers::Double, 2);
        settings.checkpoints.every = Some(every);
        case::run::run(&case, &settings, &mut Silent).expect("it runs");
        (left(&out), kept(&out).len())
    });
    assert_eq!((none.1, many.1), (0, 2));
    assert!(none.0 == many.0);
}

/// A run that was stopped at step 13 and again at 29; its directory.
fn stopped(scratch: &Path, numbers: Numbers) -> PathBuf {
    let out = scratch.join("run");
    until(13, &case(&text("tl-nested", 2, BLOCK)), &out, numbers);
    on(29, &out).expect_err("stopped again");
    assert_eq!(kept(&out).len(), 2);
    out
}

fn refused(place: &Path) -> String {
    Interrupted::find(place).expect_err("it should be refused").to_string()
}

#[test]
fn a_damaged_checkpoint_is_passed_over_with_a_notice_and_set_aside() {
    let scratch = tempfile::tempdir().expect("a folder");
    let out = stopped(scratch.path(), Numbers::Double);
    let last = kept(&out)[0].clone();
    let mut bytes = fs::read(&last).expect("a checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    fs::write(&last, &bytes).expect("damaged");
    // By name it is refused, and the other is offered.
    let told = refused(&last);
    assert!(
        told.contains("checksum") && told.contains("--resume") && told.contains("step-000000013.taut"),
        "{told}"
    );
    let run = Interrupted::find(&out).expect("the one before it");
    assert_eq!(run.stands_at().1, 13);
    assert!(
        run.notices[0].contains("step-000000029.taut") && run.notices[0].contains("checksum"),
        "{:?}",
        run.notices
    );
    drop(run);
    on(u64::MAX, &out).expect("it goes on");
    assert!(last.with_extension("taut.damaged").exists());
    let whole = scratch.path().join("whole");
    let case = case(&text("tl-nested", 2, BLOCK));
    case::run::run(&case, &settings(&whole, Numbers::Double, 1), &mut Silent).expect("it runs");
    assert!(left(&whole) == left(&out));
    assert!(matches!(Interrupted::find(&out), Err(ResumeError::Done(_))));
}

#[test]
fn what_is_foreign_or_gone_is_refused_with_the_reason() {
    let scratch = tempfile::tempdir().expect("a folder");
    let out = stopped(scratch.path(), Numbers::Double);
    let change = |file: &str, from: &str, to: &str, reason: &str| {
        let path = out.join(file);
        let before = fs::read_to_string(&path).expect("a file");
        assert!(before.contains(from), "{file}: {from}");
        fs::write(&path, before.replacen(from, to, 1)).expect("changed");
        let told = refused(&out);
        assert!(told.contains(reason) && told.contains("step-000000013.taut"), "{told}");
        fs::write(&path, before).expect("as before");
    };
    change("manifest.json", "17 MPa", "18 MPa", "another case");
    change("manifest.json", "\"double\"", "\"single\"", "double precision, and the run is in single");
    change("probes/tip.csv", "0.0,", "0.1,", "no longer what it was");
    fs::remove_file(out.join("particles/particles_000000.vtp")).expect("a frame");
    assert!(refused(&out).contains("particles_000000.vtp: it is missing"));
    for checkpoint in kept(&out) {
        fs::remove_file(checkpoint).expect("removed");
    }
    assert!(refused(&out).contains("before it wrote one"));
    fs::remove_file(out.join("manifest.json")).expect("removed");
    assert!(refused(&out).contains("manifest.json"));
    assert!(refused(&scratch.path().join("nothing")).contains("no such directory"));
}

#[test]
fn a_directory_in_which_a_run_writes_is_left_alone() {
    let scratch = tempfile::tempdir().expect("a folder");
    let out = stopped(scratch.path(), Numbers::Single);
    let first = Interrupted::find(&out).expect("it can go on");
    assert!(refused(&out).contains("a run is writing into"));
    drop(first);
    // An earlier checkpoint by name: the later one goes, since what it counts on is dropped.
    let earlier = kept(&out)[1].clone();
    on(20, &earlier).expect_err("stopped");
    let names: Vec<_> = kept(&out).iter().map(|p| p.file_name().expect("a name").to_owned()).collect();
    assert_eq!(names, ["step-000000020.taut", "step-000000013.taut"]);
}

/// A checkpoint whose contents were changed and whose checksum was made right again: refused, or run, or diverged, but never a panic.
fn forged(whole: &[u8], out: &Path, changes: &[(usize, u8)]) {
    let mut bytes = whole[..whole.len() - 16].to_vec();
    for &(place, byte) in changes {
        let place = place % bytes.len();
        bytes[place] = byte;
    }
    let sum = xxhash_rust::xxh3::xxh3_128(&bytes);
    bytes.extend(sum.to_le_bytes());
    fs::write(&kept(out)[0], bytes).expect("forged");
    let Ok(run) = Interrupted::find(&kept(out)[0]) else { return };
    let checkpoints = Checkpoints::default();
    let mut observer = After(20, checkpoints.stop.clone());
    let _ = case::run::resume(run, Some(1), &checkpoints, &mut observer);
}

#[test]
fn forged_contents_do_no_harm() {
    for (formulation, seed) in [("tl-hourglass-free", 1_u64), ("ul-non-hourglass", 2)] {
        let scratch = tempfile::tempdir().expect("a folder");
        let small = text(formulation, 2, BLOCK).replace("\"1 mm\"\n[material", "\"2 mm\"\n[material");
        let small = small.replace("\"1 mm\", 1", "\"2 mm\", 1").replace("\"9 mm\", -1", "\"8 mm\", -1");
        until(13, &case(&small), &scratch.path().join("run"), Numbers::Double);
        let whole = fs::read(&kept(&scratch.path().join("run"))[0]).expect("a checkpoint");
        // A linear congruence: the same changes every time.
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize
        };
        for _ in 0..60 {
            let out = scratch.path().join("run");
            let changes: Vec<(usize, u8)> = (0..1 + next() % 4).map(|_| (next(), next() as u8)).collect();
            forged(&whole, &out, &changes);
            fs::remove_dir_all(&out).expect("removed");
            until(13, &case(&small), &out, Numbers::Double);
        }
    }
}
