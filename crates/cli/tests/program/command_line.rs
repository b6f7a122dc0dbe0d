//! Commands, options, help, lists and checks.

use crate::{BLOCK, Ended, taut, with_case};
use std::path::Path;
use std::process::{Command, Stdio};

/// Benchmarks of the contract.
const BENCHMARKS: &[&str] = &[
    "tl-plate",
    "tl-punch",
    "tl-pull-2d",
    "tl-pull-3d",
    "tl-bending-column",
    "tl-twisting-column",
    "tl-stent",
    "ul-plate-2d",
    "ul-plate-3d",
    "ul-rings",
    "ul-hollow-balls",
    "ul-ball-plate-2d",
    "ul-ball-plate-3d",
    "lk-rectangle",
    "lk-formulations",
    "lk-annulus",
    "lk-stability",
    "lk-collision",
];

fn here(arguments: &[&str]) -> Ended {
    let folder = tempfile::tempdir().expect("a folder");
    let ended = taut(folder.path(), arguments);
    let left = std::fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(left, 0, "{arguments:?} leaves nothing behind");
    ended
}

/// The help of every command stands in `help.txt`. After a change of the command line, run the tests with
/// `TAUT_ACCEPT=1` in the environment, and read the difference.
#[test]
fn help_is_as_agreed() {
    let mut text = String::new();
    for command in [
        "",
        "run",
        "list",
        "check",
        "explain",
        "new",
        "mesh",
        "schema",
        "validate",
        "bench",
        "report",
        "particles",
        "surface",
    ] {
        let arguments: Vec<&str> = [command, "--help"].into_iter().filter(|word| !word.is_empty()).collect();
        let help = here(&arguments).with(0).stdout;
        text += &format!("$ taut {}\n{help}\n", arguments.join(" "));
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/help.txt");
    if std::env::var_os("TAUT_ACCEPT").is_some() {
        std::fs::write(&file, &text).expect("help.txt is written");
    }
    let agreed = std::fs::read_to_string(&file).expect("help.txt");
    assert_eq!(text, agreed, "the help changed: see the comment of this test");
}

#[test]
fn version_and_an_empty_command_line() {
    let version = here(&["--version"]).with(0).stdout;
    assert_eq!(version.trim(), format!("taut {}", env!("CARGO_PKG_VERSION")));
    let nothing = here(&[]).with(2);
    assert!(nothing.stderr.contains("Usage: taut <COMMAND>"), "{}", nothing.stderr);
}

#[test]
fn wrong_command_lines_say_what_is_wrong() {
    for (arguments, word) in [
        (&["frobnicate"][..], "frobnicate"),
        (&["run", "--bogus"], "--bogus"),
        (&["run", "--threads", "0"], "--threads"),
        (&["run", "--threads", "1000000"], "--threads"),
        (&["run", "--threads", "two"], "two"),
        (&["run", "--set"], "--set"),
        (&["run", "a", "b"], "'b'"),
        (&["run", "--precision", "half"], "half"),
        (&["check", "--quiet"], "--quiet"),
    ] {
        let ended = here(arguments).with(2);
        assert!(ended.stderr.starts_with("error: "), "{}", ended.stderr);
        assert!(ended.stderr.contains(word), "{arguments:?}: {}", ended.stderr);
    }
}

#[test]
fn every_case_of_the_folder_is_listed_and_checks() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let mut files: Vec<String> = std::fs::read_dir(cases)
        .expect("the folder of cases")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter_map(|file| file.strip_suffix(".toml").map(str::to_string))
        .collect();
    let list = here(&["list"]).with(0).stdout;
    let mut listed: Vec<String> = Vec::new();
    for line in list.lines() {
        let (name, title) = line.split_once(' ').expect("a name and a title");
        assert!(!title.trim().is_empty(), "{line}");
        listed.push(name.to_string());
    }
    files.sort();
    listed.sort();
    assert_eq!(listed, files, "built in = in the folder");
}

#[test]
fn all_benchmarks_are_there() {
    let list = here(&["list"]).with(0).stdout;
    for name in BENCHMARKS {
        assert!(list.lines().any(|line| line.split(' ').next() == Some(name)), "{name} is not in the list");
    }
}

#[test]
fn an_unknown_case_names_the_known_ones() {
    let message = here(&["run", "no-such-case"]).with(2).stderr;
    assert!(message.contains("no case file `no-such-case`"), "{message}");
    assert!(message.contains("ul-rings") && message.contains("tl-plate"), "{message}");
}

#[test]
fn check_tells_what_a_run_would_be() {
    let folder = with_case(BLOCK);
    let told = taut(folder.path(), &["check", "case.toml"]).with(0).stdout;
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines[0], "block: A block is squeezed");
    assert!(lines[1].starts_with("  body block: rubber, tl-hourglass-free, wave speed "), "{told}");
    // The longitudinal wave of E = 17 MPa, nu = 0.45, rho = 1100 kg/m^3: sqrt((K + 4G/3)/rho) = 242.117 m/s.
    assert!(lines[1].contains("242.117"), "{told}");
    assert!(lines[2].contains("10 particles across"), "{told}");
    assert!(lines[3].starts_with("  particles   200 with "), "{told}");
    for (line, heading) in lines[4..].iter().zip(["  memory ", "  disk ", "  time step ", "  run time "]) {
        assert!(line.starts_with(heading), "{told}");
    }
    assert!(!folder.path().join("out").exists(), "a check writes nothing");
}

#[test]
fn a_closed_pipe_is_no_crash() {
    let folder = with_case(BLOCK);
    for arguments in [&["list"][..], &["check", "case.toml"], &["run", "case.toml"], &["run", "no-such-case"]]
    {
        let closed = || {
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            writer
        };
        let ended = Command::new(env!("CARGO_BIN_EXE_taut"))
            .args(arguments)
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(closed())
            .stderr(closed())
            .status()
            .expect("the program starts");
        assert_ne!(ended.code(), Some(101), "{arguments:?} panics when nobody reads what it says");
    }
    assert!(folder.path().join("out/block/summary.json").is_file(), "the run went on");
}
