//! The result directory: what is in it, that it is never overwritten, and that it does not depend on the threads.

use crate::{BLOCK, json, taut, with_case};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A benchmark, small enough for a test: four layers instead of ten, until the rings have touched.
const RINGS: &[&str] = &["run", "--set", "parameters.resolution=4", "--set", "time.end=0.001"];

#[test]
fn a_run_leaves_frames_probes_pictures_summary_and_manifest() {
    let folder = with_case(BLOCK);
    let told = taut(folder.path(), &["run", "case.toml"]).with(0).stdout;
    assert!(told.contains("block: 200 particles") && told.contains("results in out/block"), "{told}");
    let results = folder.path().join("out/block");
    let list = fs::read_to_string(results.join("particles/particles.pvd")).expect("the list of frames");
    let frames = list.matches("<DataSet").count();
    // 0, 0.02, ..., 0.1 ms; the last may come once more, at the end of the run.
    assert!((6..=7).contains(&frames), "{frames} frames");
    for name in ["start.png", "middle.png", "end.png"] {
        assert_picture(&results.join(name));
    }
    assert!(fs::read_to_string(results.join("tip.svg")).expect("the plot").contains("<svg"));
    let probe = fs::read_to_string(results.join("probes/tip.csv")).expect("the probe");
    assert!(probe.lines().count() > 30, "a sample for every step");
}

/// Regions name particles: the right half is set in motion, and probes follow the means of both halves.
#[test]
fn regions_name_particles_for_probes_and_initial_fields() {
    let regions = r#"
[region.right]
shape = { box = { min = ["1 cm", -1], max = [1, 1] } }
[[initial]]
region = "right"
velocity = ["4 + 0*y", 1]
[[probe]]
name = "right"
region = "right"
quantity = "velocity"
[[probe]]
name = "left"
region = { box = { min = [-1, -1], max = ["1 cm", 1] } }
quantity = "velocity"
[[probe]]
name = "centre"
region = "right"
quantity = "position"
"#;
    let still = BLOCK.replace("velocity = [\"v0*sin(80*x)\", 0]\n", "");
    let folder = with_case(&format!("{still}{regions}"));
    taut(folder.path(), &["run", "case.toml"]).with(0);
    let first = |name: &str| {
        let table = fs::read_to_string(folder.path().join(format!("out/block/probes/{name}.csv")));
        let table = table.expect("the probe");
        let numbers = table.lines().nth(1).expect("the first sample").split(',').map(|n| n.parse());
        numbers.collect::<Result<Vec<f64>, _>>().expect("numbers")
    };
    // Means of equal numbers over 100 particles: rounding only.
    let near = |found: Vec<f64>, expected: [f64; 3]| {
        assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-12), "{found:?} {expected:?}");
    };
    near(first("right"), [0.0, 4.0, 1.0]);
    near(first("left"), [0.0, 0.0, 0.0]);
    near(first("centre"), [0.0, 0.015, 0.005]);
}

/// A PNG that can be decoded and is not empty.
fn assert_picture(path: &Path) {
    let file = fs::File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    assert!(info.width >= 400 && info.height >= 200, "{} x {}", info.width, info.height);
    assert!(pixels.iter().any(|&p| p != pixels[0]), "{} shows something", path.display());
}

#[test]
fn summary_and_manifest_have_the_names_of_the_contract() {
    let folder = with_case(BLOCK);
    let set = ["--set", "parameters.v0=5", "--set", "monitor.interval=2e-5"];
    taut(folder.path(), &[&["run", "case.toml", "--threads", "1"], &set[..]].concat()).with(0);
    let summary = json(&folder.path().join("out/block/summary.json"));
    let words = [
        ("case", "block"),
        ("formulation", "tl-hourglass-free"),
        ("status", "done"),
        ("precision", "double"),
    ];
    for (key, wanted) in words {
        assert_eq!(summary[key], wanted);
    }
    for (key, wanted) in [("dimension", 2), ("particles", 200), ("threads", 1)] {
        assert_eq!(summary[key], wanted);
    }
    let numbers = ["neighbours_mean", "steps", "end_time", "wall_seconds", "particle_steps_per_second"];
    assert!(numbers.iter().all(|key| summary[key].as_f64().is_some_and(|x| x > 0.0)), "{summary}");
    for key in ["initial", "final", "kinetic", "strain", "dissipated", "external_work", "residual"] {
        assert!(summary["energy"][key].is_number(), "energy.{key}");
    }
    assert!(summary["momentum"]["linear"]["final"].is_array());
    for key in ["zigzag_rms", "zigzag_99", "zigzag_max", "bond_min", "spacing_min", "broken", "pieces"] {
        let measure = &summary["disorder"][key];
        assert!(measure["worst"].is_number() && measure["time"].is_number(), "disorder.{key}: {measure}");
        assert!(measure["history"].as_array().is_some_and(|h| h.len() > 4), "disorder.{key}");
    }
    assert!(summary["measured"]["tip_max"]["value"].is_number());
    assert_eq!(summary["measured"]["tip_max"]["unit"], "m");
    let period = &summary["measured"]["period"];
    assert!(period["value"].is_null() && period["reason"].is_string(), "too short a run: {period}");
    assert_manifest(&json(&folder.path().join("out/block/manifest.json")));
}

fn assert_manifest(manifest: &Value) {
    assert_eq!(manifest["taut"], env!("CARGO_PKG_VERSION"));
    assert_eq!(manifest["threads"], 1);
    assert_eq!(manifest["precision"], "double");
    assert!(manifest["case_hash"].as_str().is_some_and(|hash| hash.len() == 32));
    assert!(manifest["started"].as_str().is_some_and(|time| time.ends_with('Z')));
    assert!(["arch", "os", "instruction_set", "cores"].iter().all(|key| !manifest["machine"][key].is_null()));
    // The case in the manifest is the case as run, overrides included: it can be run again.
    let again = with_case(manifest["case"].as_str().expect("the case"));
    assert!(manifest["case"].as_str().is_some_and(|text| text.contains("v0 = 5")));
    taut(again.path(), &["check", "case.toml"]).with(0);
}

/// Single precision is a choice of a run: it is written down, and it computes something else, but not much else.
#[test]
fn single_precision_is_written_down_and_is_near_double() {
    let folder = with_case(BLOCK);
    let [double, single] = ["double", "single"].map(|precision| {
        taut(folder.path(), &["run", "case.toml", "--precision", precision, "--out", precision]).with(0);
        let results = folder.path().join(precision);
        assert_eq!(json(&results.join("summary.json"))["precision"], precision);
        assert_eq!(json(&results.join("manifest.json"))["precision"], precision);
        json(&results.join("summary.json"))["measured"]["tip_max"]["value"].as_f64().expect("a number")
    });
    // 40 steps of sums that are rounded to 6e-8 of terms that nearly cancel; three digits are what is promised.
    assert!(double != single && (single / double - 1.0).abs() < 1e-3, "{double:e} {single:e}");
    for command in ["check", "explain"] {
        taut(folder.path(), &[command, "case.toml", "--precision", "single"]).with(0);
    }
}

#[test]
fn the_case_of_the_readme_runs() {
    let readme = concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md");
    let readme = fs::read_to_string(readme).expect("the README");
    let (_, rest) = readme.split_once("```toml\n").expect("a case in the README");
    let folder = with_case(rest.split("```").next().unwrap_or_default());
    taut(folder.path(), &["check", "case.toml"]).with(0);
    taut(folder.path(), &["run", "case.toml", "--set", "time.end=0.002"]).with(0);
    assert!(folder.path().join("out/strip/probes/tip.csv").is_file());
}

#[test]
fn a_result_directory_is_never_touched_again() {
    let folder = with_case(BLOCK);
    fs::create_dir_all(folder.path().join("mine")).expect("a folder");
    fs::write(folder.path().join("mine/notes.txt"), "keep me").expect("a file");
    for (out, name) in [("mine", "directory"), ("case.toml", "file")] {
        let message = taut(folder.path(), &["run", "case.toml", "--out", out]).with(2).stderr;
        assert!(message.contains(&format!("{out} already exists")), "{name}: {message}");
        assert!(message.contains("--out"), "the way out: {message}");
    }
    let left: Vec<_> = fs::read_dir(folder.path().join("mine")).expect("the folder").flatten().collect();
    assert_eq!(left.len(), 1, "nothing was added");
    assert_eq!(fs::read_to_string(folder.path().join("mine/notes.txt")).expect("the file"), "keep me");
    assert_eq!(fs::read_to_string(folder.path().join("case.toml")).expect("the case"), BLOCK);
}

#[test]
fn quiet_is_silent() {
    let folder = with_case(BLOCK);
    let ended = taut(folder.path(), &["run", "case.toml", "--quiet"]).with(0);
    assert_eq!((ended.stdout.as_str(), ended.stderr.as_str()), ("", ""));
    assert!(folder.path().join("out/block/summary.json").is_file());
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    for formulation in ["tl-hourglass-free", "tl-nested"] {
        let folder = with_case(&BLOCK.replace("tl-hourglass-free", formulation));
        let [one, two] = ["1", "2"].map(|threads| {
            taut(folder.path(), &["run", "case.toml", "--threads", threads, "--out", threads]).with(0);
            fs::read(folder.path().join(threads).join("probes/tip.csv")).expect("the probe")
        });
        assert!(one == two, "{formulation}: probes differ between one thread and two");
    }
}

#[test]
fn the_rings_are_the_same_for_one_thread_and_two() {
    let folder = tempfile::tempdir().expect("a folder");
    let [one, two] = ["1", "2"].map(|threads| {
        let own = [RINGS, &["--threads", threads, "--out", threads]].concat();
        taut(folder.path(), &own).with(0);
        let results = folder.path().join(threads);
        let last = frames(&results).last().cloned().expect("a frame");
        (frames(&results).len(), fs::read(last).expect("the last frame"), json(&results.join("summary.json")))
    });
    assert_eq!(one.0, two.0, "frames");
    assert!(one.1 == two.1, "the last frames differ between one thread and two");
    assert_eq!((&one.2["energy"], &one.2["measured"]), (&two.2["energy"], &two.2["measured"]));
    let touched = one.2["measured"]["contact_start"]["value"].as_f64().expect("the rings touch");
    // The outermost particles start 0.01 m + dp apart, touch at the support of the kernel, 2.6 dp, and close in at twice
    // 0.06 c0 with c0 = 117.85 m/s. The first to touch need not stand on the axis: up to dp^2/(4 outer) later.
    assert!((touched - 0.006 / (2.0 * 0.06 * 117.85)).abs() < 2e-5, "{touched}");
}

fn frames(results: &Path) -> Vec<std::path::PathBuf> {
    let mut files: Vec<_> = fs::read_dir(results.join("particles"))
        .expect("the frames")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "vtp"))
        .collect();
    files.sort();
    files
}

/// A probe of one number has one column; at the end it says what is measured of the field.
#[test]
fn the_largest_stress_of_a_run_is_followed() {
    let more = "\n[[probe]]\nname = \"stress\"\nregion = { box = { min = [0, 0], max = [1, 1] } }\nquantity = \"von-mises\"\n\n\
        [[measure]]\nname = \"most\"\nkind = \"maximum\"\nprobe = \"stress\"\n\n[[measure]]\nname = \"last\"\nkind = \"largest\"\nfield = \"von-mises\"\n";
    let folder = with_case(&format!("{BLOCK}{more}"));
    taut(folder.path(), &["run", "case.toml", "--quiet"]).with(0);
    let out = folder.path().join("out/block");
    let table = fs::read_to_string(out.join("probes/stress.csv")).expect("the table");
    assert!(table.starts_with("time [s],von-mises [Pa]\n"), "{table}");
    let column =
        |line: &str| line.split(',').nth(1).and_then(|cell| cell.parse::<f64>().ok()).expect("a number");
    let values: Vec<f64> = table.lines().skip(1).map(column).collect();
    let measured = |name: &str| json(&out.join("summary.json"))["measured"][name]["value"].as_f64();
    assert_eq!(values.last().copied(), measured("last"), "the same particles, the same formula");
    assert_eq!(values.iter().copied().reduce(f64::max), measured("most"));
    // At rest there is what 17 MPa round to.
    assert!(values[0] < 1e-7 && measured("most") > Some(1e5), "{values:?}");
}
