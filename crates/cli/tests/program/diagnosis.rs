//! Every reason to stop, made to happen in a small run; and the page and the picture that it leaves.

use crate::{BLOCK, json, taut, with_case};
use std::fs;
use std::path::{Path, PathBuf};

/// What a run that stopped has left.
struct Stopped {
    folder: tempfile::TempDir,
    stderr: String,
    page: String,
}

impl Stopped {
    fn results(&self) -> PathBuf {
        self.folder.path().join("out/block")
    }

    /// The row of the first table.
    #[track_caller]
    fn row(&self, name: &str) -> &str {
        let start = format!("| {name} | ");
        let line = self.page.lines().find_map(|line| line.strip_prefix(&start));
        line.and_then(|line| line.strip_suffix(" |")).unwrap_or_else(|| panic!("{name}: {}", self.page))
    }

    /// Whether the page proposes these arguments.
    #[track_caller]
    fn proposes(&self, arguments: &str) {
        assert!(self.page.contains(&format!("- `{arguments}`: ")), "{arguments}: {}", self.page);
    }
}

/// Runs a case that has to stop: all that any diagnosis has to have is there.
#[track_caller]
fn stops(case: &str, criterion: &str) -> Stopped {
    let folder = with_case(case);
    let stderr = taut(folder.path(), &["run", "case.toml"]).with(1).stderr;
    assert!(stderr.contains("read diagnosis.md there"), "{stderr}");
    let results = folder.path().join("out/block");
    let page = fs::read_to_string(results.join("diagnosis.md")).expect("the page");
    let stopped = Stopped { folder, stderr, page };
    assert_eq!(stopped.row("what must hold"), criterion, "{}", stopped.page);
    for part in ["# Why `block` stopped", "## Likely cause", "## What to try", "## What was kept"] {
        assert!(stopped.page.contains(part), "{part}: {}", stopped.page);
    }
    let summary = json(&results.join("summary.json"));
    assert_eq!(summary["status"], "diverged");
    let step = summary["error"]["time"].as_f64().expect("a time");
    assert!(step >= summary["end_time"].as_f64().expect("a time"), "{summary}");
    assert!(results.join("particles/particles_000000.vtp").is_file(), "a frame is kept");
    for kept in ["audit.csv", "audit.svg", "start.png"] {
        assert!(results.join(kept).is_file(), "{kept}");
    }
    culprit(&results.join("culprit.vtp"));
    stopped
}

/// The picture of the neighbourhood has every field of the solver, and the number of neighbours.
#[track_caller]
fn culprit(path: &Path) {
    let bytes = fs::read(path).expect("the picture of the culprit");
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(20_000)]).into_owned();
    for array in
        ["IsCulprit", "NeighbourCount", "Velocity", "Acceleration", "Free", "CauchyStress", "ParticleId"]
    {
        assert!(head.contains(&format!("Name=\"{array}\"")), "{array}: {head}");
    }
}

/// The block at rest.
fn still() -> String {
    BLOCK.replace("velocity = [\"v0*sin(80*x)\", 0]\n", "")
}

/// The block with all of its particles led.
fn led(displacement: &str) -> String {
    let all =
        format!("region = {{ box = {{ min = [-1, -1], max = [1, 1] }} }}\ndisplacement = {displacement}");
    still().replace("region = \"foot\"\nfixed = true", &all)
}

/// Pressed through zero width, with a step that does not look at how narrow it is.
#[test]
fn an_inverted_particle() {
    let text = led("[\"-x*2e4*t\", 0]").replace("[time]", "[time]\nstep = \"paper\"");
    let stopped = stops(&text, "the determinant of the deformation gradient is positive");
    assert_eq!(stopped.row("bound"), "0");
    assert!(stopped.row("value").starts_with("det F = -"), "{}", stopped.page);
    stopped.proposes("--set time.step=stretch");
    assert!(stopped.page.contains("## The time step"), "{}", stopped.page);
}

/// The root of a body force becomes negative in the middle of the run.
#[test]
fn a_number_that_is_none() {
    let text = format!("{BLOCK}\n[[gravity]]\nacceleration = [0, \"1e5*sqrt(50 - 1e6*t)\"]\n");
    let stopped = stops(&text, "every number is finite");
    assert_eq!(stopped.row("bound"), "any finite number");
    assert!(stopped.row("value").ends_with("NaN"), "{}", stopped.page);
    assert!(stopped.page.contains("The body force on this particle is not a number"), "{}", stopped.page);
}

#[test]
fn a_density_that_is_lost() {
    let text = led("[\"x*4e4*t\", \"y*4e4*t\"]");
    let stopped = stops(&text, "the density stays between a tenth and ten times that at rest");
    assert_eq!(stopped.row("bound"), "110");
    assert!(stopped.page.contains("A boundary moves at"), "{}", stopped.page);
}

#[test]
fn a_speed_beyond_all_waves_stops_before_the_first_step() {
    let stopped = stops(&BLOCK.replace("v0 = 10", "v0 = 1e6"), "no particle is faster than ten wave speeds");
    assert!(stopped.page.contains("The run stopped before the first step"), "{}", stopped.page);
    assert!(stopped.page.contains("is the unit right?"), "{}", stopped.page);
    stopped.proposes("--set parameters.v0=500000");
}

#[test]
fn a_particle_that_loses_its_neighbours() {
    let text = still().replace("tl-hourglass-free", "ul-nested").replace("neo-hookean", "linear-elastic");
    let shot =
        "\n[[initial]]\nregion = { box = { min = [0.019, 0.009], max = [1, 1] } }\nvelocity = [300, 300]\n";
    let stopped = stops(&(text + shot), "a particle has at least as many neighbours as there are dimensions");
    assert_eq!(stopped.row("bound"), "2");
    assert!(stopped.row("particle").starts_with("199, of body `block`"), "{}", stopped.page);
    stopped.proposes("--formulation ul-non-hourglass");
}

#[test]
fn energy_from_nowhere() {
    let text = BLOCK.replace("[time]", "[time]\ncfl = 0.7\nstep = \"paper\"").replace("0.45", "0");
    let stopped = stops(
        &text.replace("0.1 ms", "20 ms"),
        "the bodies have at most twice the energy that was put into them",
    );
    stopped.proposes("--set time.cfl=0.6");
    assert!(stopped.page.contains("## Energies"), "{}", stopped.page);
}

/// Drawn out at constant volume, about its middle, without end; six particles wide, so that nothing gets too fast.
#[test]
fn a_time_step_that_collapses() {
    let text = led("[\"(x - 0.003)*(exp(9000*t) - 1)\", \"(y - 0.003)*(exp(-9000*t) - 1)\"]");
    let text =
        text.replace("\"2 cm\", \"1 cm\"", "\"6 mm\", \"6 mm\"").replace("[0.02, 0.005]", "[0.006, 0.003]");
    let stopped =
        stops(&text.replace("0.1 ms", "5 ms"), "the time step is at least a thousandth of the first one");
    assert!(stopped.row("value").starts_with("time step = "), "{}", stopped.page);
}

/// Disorder warns, once for each threshold; told to, it stops, and the state at which it stopped is the last frame.
#[test]
fn disorder_warns_or_stops() {
    let text = BLOCK.replace("0.1 ms", "1 ms").replace("tl-hourglass-free", "tl-nested");
    let text = text.replace("v0 = 10", "v0 = 60") + "\n[monitor]\nzigzag = 0.01\ninterval = \"0.01 ms\"\n";
    let stopped =
        stops(&format!("{text}stop = true\n"), "the disorder stays within the thresholds of [monitor]");
    assert_eq!(stopped.row("bound"), "0.01");
    stopped.proposes("--formulation tl-hourglass-free");
    let summary = json(&stopped.results().join("summary.json"));
    assert!(
        stopped
            .page
            .contains(&format!("the last is of t = {:.6e} s", summary["end_time"].as_f64().expect("a time")))
    );
    assert_eq!(stopped.stderr.matches("disorder: zigzag_rms").count(), 1, "{}", stopped.stderr);
    let folder = with_case(&text);
    let ended = taut(folder.path(), &["run", "case.toml"]);
    assert_eq!(ended.stderr.matches("warning: disorder: zigzag_rms").count(), 1, "{}", ended.stderr);
}
