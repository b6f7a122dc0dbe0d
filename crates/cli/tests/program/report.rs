//! `taut report`: what a run left is drawn again, as far as it is there; what is not is named.

use crate::{BLOCK, Ended, taut, with_case};
use std::fs;
use std::path::Path;

/// A folder with the finished run of the block in `out/block`.
fn finished() -> tempfile::TempDir {
    let folder =
        with_case(&BLOCK.replace("at = [0.02, 0.005]", "at = [0.02, 0.005]\nreference = \"curve.csv\""));
    fs::write(folder.path().join("curve.csv"), "# a paper\ntime [s],x [m]\n0,0\n0.0001,1e-5\n")
        .expect("curves");
    taut(folder.path(), &["run", "case.toml", "--quiet"]).with(0);
    folder
}

fn report(folder: &Path, options: &[&str]) -> Ended {
    taut(folder, &[&["report", "out/block"], options].concat())
}

fn made(ended: &Ended) -> Vec<&str> {
    ended.stdout.lines().map(|line| line.rsplit('/').next().unwrap_or_default()).collect()
}

#[test]
fn pictures_and_plots_come_again_as_they_were() {
    let folder = finished();
    let results = folder.path().join("out/block");
    let names = ["start.png", "middle.png", "end.png", "audit.svg", "tip.svg"];
    let before = names.map(|name| fs::read(results.join(name)).expect("made by the run"));
    names.iter().for_each(|name| fs::remove_file(results.join(name)).expect("it was there"));
    let told = report(folder.path(), &[]).with(0);
    assert_eq!(made(&told), names);
    for (name, before) in names.iter().zip(before) {
        assert!(fs::read(results.join(name)).expect("made again") == before, "{name}");
    }
    let plot = fs::read_to_string(results.join("tip.svg")).expect("a plot");
    assert!(plot.contains("x, reference") && plot.contains("reference: a paper"));
}

#[test]
fn fields_frames_views_and_animations_are_as_asked() {
    let folder = finished();
    let ask = |options: &[&str]| {
        report(folder.path(), &[options, &["--size", "400", "--out", "pictures"]].concat())
    };
    let told = ask(&["--field", "Velocity.x", "--field", "Pressure", "--frames", "0,2-3"]).with(0);
    let mut expected: Vec<String> = ["Velocity.x", "Pressure"]
        .iter()
        .flat_map(|field| [0, 2, 3].map(|number| format!("frame-{number:06}-{field}.png")))
        .collect();
    expected.extend(["audit.svg", "tip.svg"].map(str::to_string));
    assert_eq!(made(&told), expected);
    assert_eq!(made(&ask(&["--animation", "gif"]).with(0)), ["animation.gif", "audit.svg", "tip.svg"]);
    let gif = fs::read(folder.path().join("pictures/animation.gif")).expect("an animation");
    assert!(gif.starts_with(b"GIF89a"));
    let told = ask(&["--animation", "frames", "--view", "top", "--range", "0,1e6"]).with(0);
    // 0, 0.02, ..., 0.1 ms; the last may come once more, at the end of the run.
    assert!((7..=8).contains(&made(&told).len()), "{}", told.stdout);
    assert!(folder.path().join("pictures/animation/000005.png").is_file());
}

#[test]
fn wrong_wishes_are_told_apart() {
    let folder = finished();
    for (options, words) in [
        (
            &["--field", "Temperature"][..],
            "the frames have no `Temperature`; they have Displacement, Velocity",
        ),
        (&["--field", "Velocity.q"], "Velocity has no component `q`: x, y, z"),
        (&["--frames", "4000"], "there is no frame 4000: the frames are 0 to"),
    ] {
        let told = report(folder.path(), options).with(1);
        assert!(told.stderr.contains(words), "{}", told.stderr);
        assert_eq!(made(&told), ["audit.svg", "tip.svg"], "what can be made is");
    }
    for options in [
        ["--frames", "first"],
        ["--view", "up"],
        ["--range", "2,1"],
        ["--size", "10"],
        ["--animation", "avi"],
    ] {
        let told = report(folder.path(), &options).with(2);
        assert!(told.stderr.contains(options[1]), "{}", told.stderr);
    }
}

#[test]
fn damage_is_named_and_the_rest_is_drawn() {
    let folder = finished();
    let results = folder.path().join("out/block");
    let particles = results.join("particles");
    fs::write(particles.join("particles_000000.vtp"), "torn").expect("a file");
    fs::remove_file(particles.join("particles_000003.vtp")).expect("a file");
    fs::remove_file(results.join("summary.json")).expect("a run that was killed has none");
    let told = report(folder.path(), &["--frames", "all"]).with(1);
    for words in [
        "particles_000000.vtp: it is no whole .vtp file",
        "particles_000003.vtp is listed but missing",
        "not everything",
    ] {
        assert!(told.stderr.contains(words), "{}", told.stderr);
    }
    assert!(made(&told).len() > 3, "{}", told.stdout);
    fs::write(results.join("manifest.json"), "{").expect("a file");
    fs::write(results.join("probes/tip.csv"), "nonsense\n").expect("a file");
    fs::remove_file(particles.join("particles.pvd")).expect("a file");
    let told = report(folder.path(), &["--frames", "end"]).with(1);
    for words in ["manifest.json", "particles.pvd", "tip.csv"] {
        assert!(told.stderr.contains(words), "{words}: {}", told.stderr);
    }
    assert_eq!(made(&told), ["end.png", "audit.svg"]);
}

#[test]
fn what_is_no_result_is_said_to_be_none() {
    let folder = with_case(BLOCK);
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    for (place, words) in [
        ("empty", "empty is no result of a run"),
        ("nowhere", "no directory nowhere"),
        ("case.toml", "no directory case.toml"),
    ] {
        let told = taut(folder.path(), &["report", place]).with(2);
        assert!(told.stderr.contains(words) && told.stdout.is_empty(), "{}", told.stderr);
    }
    fs::create_dir(folder.path().join("empty/particles")).expect("a folder");
    let told = taut(folder.path(), &["report", "empty"]).with(1);
    assert!(told.stderr.contains("nothing could be made from empty"), "{}", told.stderr);
}
