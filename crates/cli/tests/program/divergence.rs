//! Runs that cannot go on: who, what, when, why; and everything until then is kept.

use crate::{BLOCK, json, taut, with_case};

/// The block, kicked so hard (with a step that looks at the bulk speed only) that particles turn inside out.
fn hopeless() -> String {
    let text = BLOCK.replace("v0 = 10", "v0 = 130").replace("sin(80*x)", "sin(800*x)");
    text.replace("[time]", "[time]\ncfl = 1\nstep = \"paper\"")
        .replace("0.45", "0")
        .replace("0.1 ms", "20 ms")
}

#[test]
fn a_run_that_diverges_names_particle_field_time_and_cause_and_keeps_its_frames() {
    let folder = with_case(&hopeless());
    let message = taut(folder.path(), &["run", "case.toml"]).with(1).stderr;
    let error = message.lines().find(|line| line.starts_with("error: ")).expect("an error");
    for word in ["diverged at t = ", "of particle ", "(body ", "likely cause: "] {
        assert!(error.contains(word), "{word}: {error}");
    }
    assert!(
        ["energy gained", "Velocity", "Acceleration", "det F", "WaveSpeedSquared"]
            .iter()
            .any(|f| error.contains(f)),
        "{error}"
    );

    let results = folder.path().join("out/block");
    let summary = json(&results.join("summary.json"));
    assert_eq!(summary["status"], "diverged");
    assert_eq!(summary["case"], "block");
    assert_eq!(summary["particles"], 200);
    let told = summary["error"]["message"].as_str().expect("a message");
    assert!(error.contains(told), "{told}");
    assert!(summary["error"]["hint"].is_string() && summary["error"]["time"].is_number());
    assert!(
        summary["end_time"].as_f64().expect("a time") <= summary["error"]["time"].as_f64().expect("a time")
    );
    assert!(results.join("particles/particles.pvd").is_file());
    assert!(results.join("particles/particles_000000.vtp").is_file());
    assert!(results.join("start.png").is_file(), "what there is has a picture");
    let probe = std::fs::read_to_string(results.join("probes/tip.csv")).expect("the probe");
    assert!(probe.lines().count() > 2, "samples until then");
}

#[test]
fn a_speed_without_sense_stops_the_run_before_it_starts() {
    let folder = with_case(&BLOCK.replace("v0 = 10", "v0 = 1e6"));
    let ended = taut(folder.path(), &["run", "case.toml"]).with(1);
    assert!(ended.stderr.contains("Velocity of particle"), "{}", ended.stderr);
    let summary = json(&folder.path().join("out/block/summary.json"));
    assert_eq!(summary["status"], "diverged");
    assert_eq!(summary["steps"], 0);
    let results = folder.path().join("out/block");
    for file in ["particles/particles_000000.vtp", "start.png"] {
        assert!(results.join(file).is_file(), "the initial state can be looked at: {file}");
    }
}
