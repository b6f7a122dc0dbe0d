//! Starting, explaining and checking a case.

use crate::{BLOCK, taut, with_case};
use std::path::Path;

#[test]
fn a_new_case_is_written_once_explained_checked_and_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    taut(folder.path(), &["new", "first"]).with(0);
    let text = std::fs::read_to_string(folder.path().join("first.toml")).expect("the case");
    assert!(text.contains("name = \"first\"") && text.lines().filter(|l| l.contains('#')).count() > 15);
    let again = taut(folder.path(), &["new", "first.toml"]).with(2);
    assert!(again.stderr.contains("already exists"), "{}", again.stderr);
    assert_eq!(std::fs::read_to_string(folder.path().join("first.toml")).expect("the case"), text);
    let check = taut(folder.path(), &["check", "first.toml"]).with(0);
    assert!(!check.stdout.contains("warning") && check.stderr.is_empty(), "{}{}", check.stdout, check.stderr);
    taut(folder.path(), &["explain", "first.toml"]).with(0);
    let run = ["run", "first.toml", "--quiet", "--set", "time.end=0.01", "--set", "parameters.dp=H/6"];
    taut(folder.path(), &run).with(0);
    assert!(folder.path().join("out/first/summary.json").is_file());
}

#[test]
fn names_that_cannot_be_are_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["../up", "My Case", "a/b", "", ".toml", "a\"b"] {
        let ended = taut(folder.path(), &["new", name]).with(2);
        assert!(ended.stderr.contains("cannot be the name"), "{}", ended.stderr);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0);
    assert!(!folder.path().join("../up.toml").exists());
}

#[test]
fn explain_says_what_the_case_does() {
    let folder =
        with_case(&BLOCK.replace("[[probe]]", "[[gravity]]\nacceleration = [0, -9.81]\n\n[[probe]]"));
    let told = taut(folder.path(), &["explain", "case.toml"]).with(0).stdout;
    for words in [
        "A block is squeezed",
        "plane strain",
        "neo-Hookean",
        "17 MPa",
        "waves run at 242.1",
        "2 cm x 1 cm",
        "starts at (v0*sin(80*x), 0) m/s",
        "in region foot is held fast",
        "(0, -9.81) m/s^2",
        "it runs for 100 us, with a frame every 20 us (6 frames)",
        "tip: the displacement of the point [0.02, 0.005] m of block, every step",
        "tip_max: the largest x of probe tip",
        "200 particles",
    ] {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
}

/// What `taut check` says about the block with something replaced.
fn check(old: &str, new: &str) -> String {
    assert!(BLOCK.contains(old), "{old} is in the block");
    let block = BLOCK.replace("at = [0.02, 0.005]", "body = \"block\"\nat = [0.02, 0.005]");
    let folder = with_case(&block.replacen(old, new, 1));
    let ended = taut(folder.path(), &["check", "case.toml"]).with(0);
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1, "nothing is left behind");
    ended.stderr + &ended.stdout
}

#[test]
fn check_tells_numbers() {
    let told = check("title", "title");
    // sqrt((K + 4G/3)/rho) with E = 17 MPa, nu = 0.45: M = E (1 - nu) / ((1 + nu)(1 - 2 nu)).
    let speed = (17e6 * 0.55 / (1.45 * 0.1) / 1100.0_f64).sqrt();
    let speed = format!("wave speed {speed:.4} m/s");
    for words in
        [speed.as_str(), "200 with", "10 particles across", "MB", "time step", "run time", "of frames"]
    {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
    assert!(!told.contains("warning"), "{told}");
}

#[test]
fn every_warning_of_check() {
    let second = "[[body]]\nname = \"two\"\nmaterial = \"rubber\"\nshape = { box = { min = [0.0201, 0], max = [0.03, 0.01] } }\n\n[[boundary]]";
    let hole = "{ difference = [{ box = { min = [0, 0], max = [\"2 cm\", \"1 cm\"] } }, { ball = { center = [0.005, 0.005], radius = 1e-5 } }] }";
    let rib = "{ union = [{ box = { min = [0, 0], max = [\"2 cm\", \"1 cm\"] } }, { box = { min = [0.02, 0.0011], max = [0.03, 0.0012] } }] }";
    let shape = "{ box = { min = [0, 0], max = [\"2 cm\", \"1 cm\"] } }";
    for (old, new, words) in [
        ("\"1 cm\"]", "\"3 mm\"]", "3 particles across its thinnest part"),
        ("0.45", "0.499", "close to 0.5"),
        ("v0 = 10", "v0 = 90", "of its wave speed"),
        ("fixed = true", "velocity = [\"200 m/s\", 0]", "of its wave speed"),
        (shape, hole, "1 hole takes no particle away"),
        (shape, rib, "1 part of its shape holds no particle"),
        ("1.1 g/cm^3", "1.1 kg/m^3", "is the unit right?"),
        ("17 MPa", "5000 GPa", "is the unit right?"),
    ] {
        let told = check(old, new);
        assert!(told.contains(words), "{new}: {words} is not in\n{told}");
    }
    // Bodies that overlap by a particle push each other apart as fast as sound: the first steps fail, and the warning says why.
    let folder =
        with_case(&BLOCK.replace("at = [0.02, 0.005]", "body = \"block\"\nat = [0.02, 0.005]").replacen(
            "[[boundary]]",
            &second.replace("0.0201", "0.0191"),
            1,
        ));
    let told = taut(folder.path(), &["check", "case.toml"]).with(1).stderr;
    assert!(
        told.contains("the first steps of this case fail") && told.contains("overlap at the start"),
        "{told}"
    );
    // The block is total Lagrangian; this warning belongs to the other family.
    let updated =
        BLOCK.replace("tl-hourglass-free", "ul-non-hourglass").replace("neo-hookean", "linear-elastic");
    let folder = with_case(&updated.replace("0.45", "0.3"));
    let told = taut(folder.path(), &["check", "case.toml"]).with(0).stderr;
    assert!(told.contains("will be too stiff"), "{told}");
}

#[test]
fn a_case_that_is_too_large_is_refused_before_it_is_built() {
    let folder = with_case(&BLOCK.replace("dp = \"1 mm\"", "dp = \"0.5 um\""));
    for command in ["check", "run"] {
        let told = taut(folder.path(), &[command, "case.toml"]).with(2).stderr;
        assert!(told.contains("particles need") && told.contains("choose a larger spacing"), "{told}");
        assert!(told.contains("8.0e8 particles"), "2 cm x 1 cm over 0.5 um squared: {told}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1);
}

/// What check says about memory is what the run then takes, within a tenth. (With one arena for all threads: how much freed memory the
/// C library holds back in others depends on who was where, and differs by a sixth from run to run.)
#[cfg(target_os = "linux")]
#[test]
fn memory_is_what_a_run_takes() {
    for resolution in ["0.2 mm", "0.05 mm"] {
        let text =
            BLOCK.replace("dp = \"1 mm\"", &format!("dp = \"{resolution}\"")).replace("0.1 ms", "1 us");
        let folder = with_case(&text.replace("output = \"0.02 ms\"", "output = \"0.3 us\""));
        // The middle one of three: of a program this small (30 MB) some megabytes are what the C library and the threads of the pictures
        // happen to hold.
        let told = middle([(); 3].map(|()| told_by_check(folder.path())));
        let peak = middle([0, 1, 2].map(|k| peak_of_run(folder.path(), k)));
        assert!((told - peak).abs() < 0.1 * peak, "told {told} MB, took {peak} MB at {resolution}");
    }
}

/// The middle one of three numbers.
#[cfg(target_os = "linux")]
fn middle(mut of: [f64; 3]) -> f64 {
    of.sort_by(f64::total_cmp);
    of[1]
}

/// What check says about the memory of the case, MB.
#[cfg(target_os = "linux")]
fn told_by_check(folder: &Path) -> f64 {
    let told = taut(folder, &["check", "case.toml"]).with(0).stdout;
    let line = told.lines().find(|l| l.contains("memory")).expect("a line about memory");
    line.split_whitespace().nth(2).and_then(|n| n.parse().ok()).expect("a number")
}

/// Runs the case, watching what the system says about its memory, MB.
#[cfg(target_os = "linux")]
fn peak_of_run(folder: &Path, run: u32) -> f64 {
    use std::process::{Command, Stdio};
    let mut run = Command::new(env!("CARGO_BIN_EXE_taut"))
        .args(["run", "case.toml", "--quiet", "--out", &format!("run-{run}")])
        .current_dir(folder)
        .env("MALLOC_ARENA_MAX", "1")
        .stdin(Stdio::null())
        .spawn()
        .expect("the program can be started");
    let mut peak = 0.0_f64;
    while run.try_wait().expect("a child").is_none() {
        let status = std::fs::read_to_string(format!("/proc/{}/status", run.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
        peak = peak.max(kilobytes.unwrap_or(0.0) * 1024.0 / 1e6);
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    peak
}
