//! A run that is interrupted by a signal, and goes on.

use crate::{BLOCK, json, taut, with_case};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A run that would go on for hours.
fn long_run(folder: &Path, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_taut"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program can be started")
}

/// Checkpoints of the block, the last one first.
fn checkpoints(folder: &Path) -> Vec<PathBuf> {
    output::checkpoint::kept(&folder.join("out/block"))
}

/// Waits until there is a checkpoint other than `last`, at most a minute.
fn next_checkpoint(folder: &Path, last: Option<&PathBuf>) -> PathBuf {
    let begun = Instant::now();
    loop {
        match checkpoints(folder).first() {
            Some(path) if Some(path) != last => return path.clone(),
            _ => assert!(begun.elapsed() < Duration::from_secs(60), "no checkpoint was written"),
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Sends a signal, and waits for the end: status and what was said.
fn stop(child: Child, signal: &str) -> (Option<i32>, String) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill is there");
    assert!(sent.success());
    let ended = child.wait_with_output().expect("it ends");
    (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
}

#[cfg(unix)]
#[test]
fn signals_stop_a_run_with_a_checkpoint_and_it_goes_on() {
    let folder = with_case(&BLOCK.replace("end = \"0.1 ms\"", "end = \"100 s\""));
    let often = ["--checkpoint-every", "0.02 s", "--threads", "1"];
    let run = long_run(folder.path(), &[&["run", "case.toml"], &often[..]].concat());
    next_checkpoint(folder.path(), None);
    let (status, told) = stop(run, "-INT");
    assert_eq!(status, Some(130), "{told}");
    assert!(told.contains("to go on: taut run --resume out/block") && !told.contains("panicked"), "{told}");
    assert_eq!(json(&folder.path().join("out/block/summary.json"))["status"], "interrupted");
    assert!(folder.path().join("out/block/start.png").is_file());

    let last = checkpoints(folder.path())[0].clone();
    let again = long_run(folder.path(), &[&["run", "--resume", "out/block"], &often[..]].concat());
    next_checkpoint(folder.path(), Some(&last));
    let (status, told) = stop(again, "-TERM");
    assert_eq!(status, Some(143), "{told}");
    assert!(told.contains("going on from out/block/checkpoint/step-"), "{told}");
    assert_eq!(checkpoints(folder.path()).len(), 2);
    let manifest = json(&folder.path().join("out/block/manifest.json"));
    assert!(manifest["resumed"][0]["step"].as_u64().is_some_and(|step| step > 0), "{manifest}");

    // Who starts the case once more is told of what is there.
    let told = taut(folder.path(), &["run", "case.toml"]).with(2).stderr;
    assert!(told.contains("already exists") && told.contains("taut run --resume out/block"), "{told}");
}

/// Files of a result directory whose bits must not depend on interruptions.
fn results(out: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    for folder in ["particles", "probes"] {
        for entry in std::fs::read_dir(out.join(folder)).expect("a folder").flatten() {
            let bytes = std::fs::read(entry.path()).expect("a file");
            files.push((Path::new(folder).join(entry.file_name()), bytes));
        }
    }
    files.sort();
    files
}

/// Killed at moments that are spread over a run, it goes on and ends as if nothing had happened. `reliability/kill.sh` does it fifty
/// times, on larger runs.
#[test]
fn a_run_that_is_killed_goes_on_to_the_same_end() {
    let folder = with_case(&BLOCK.replace("end = \"0.1 ms\"", "end = \"1 ms\""));
    taut(folder.path(), &["run", "case.toml", "--out", "whole"]).with(0);
    let often = ["--checkpoint-every", "0", "--threads", "1"];
    let mut run = long_run(folder.path(), &[&["run", "case.toml"], &often[..]].concat());
    let mut last = None;
    for pause in [0, 7, 40, 3, 21] {
        last = Some(next_checkpoint(folder.path(), last.as_ref()));
        std::thread::sleep(Duration::from_millis(pause));
        run.kill().expect("it runs, or has ended");
        run.wait().expect("it has ended");
        if folder.path().join("out/block/summary.json").exists() {
            break;
        }
        run = long_run(folder.path(), &[&["run", "--resume", "out/block"], &often[..]].concat());
    }
    let ended = run.wait_with_output().expect("it ends");
    let told = String::from_utf8_lossy(&ended.stderr);
    assert!(!told.contains("cannot be used"), "{told}");
    let (whole, parts) = (results(&folder.path().join("whole")), results(&folder.path().join("out/block")));
    assert_eq!(whole.len(), parts.len());
    assert!(whole.iter().zip(&parts).all(|(a, b)| a == b), "the results differ");
}

#[test]
fn what_cannot_be_resumed_is_said() {
    let folder = with_case(BLOCK);
    taut(folder.path(), &["run", "case.toml"]).with(0);
    for (arguments, word) in [
        (["--resume", "nowhere"], "no such directory"),
        (["--resume", "."], "manifest.json"),
        (["--resume", "out/block"], "come to its end"),
        (["--resume", "out/block/manifest.json"], "cannot read"),
        (["--checkpoint-every", "5 apples"], "\"5 min\""),
        (["--checkpoint-every", "5 mm"], "\"5 min\""),
        (["--checkpoint-every", "-1"], "\"5 min\""),
    ] {
        let told = taut(folder.path(), &[&["run"], &arguments[..]].concat()).with(2).stderr;
        assert!(told.contains(word), "{arguments:?}: {told}");
    }
    let told = taut(folder.path(), &["run", "case.toml", "--resume", "out/block"]).with(2).stderr;
    assert!(told.contains("cannot be used with"), "{told}");
}

/// Killed in the middle of a picture, after the last frame.
#[test]
fn pictures_of_a_run_that_has_ended_are_drawn_later() {
    let folder = with_case(BLOCK);
    taut(folder.path(), &["run", "case.toml"]).with(0);
    let [picture, torn] =
        ["end.png", ".unfinished-abc"].map(|name| folder.path().join("out/block").join(name));
    let drawn = std::fs::read(&picture).expect("a picture");
    std::fs::rename(&picture, &torn).expect("renamed");
    let told = taut(folder.path(), &["run", "--resume", "out/block"]).with(0).stderr;
    assert!(told.contains("pictures are drawn now"), "{told}");
    assert!(std::fs::read(&picture).is_ok_and(|again| again == drawn) && !torn.exists());
}
