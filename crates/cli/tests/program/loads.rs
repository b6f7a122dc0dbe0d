//! Loads and quasi-static runs: what comes out of them can be written down.

use crate::{json, taut, with_case};
use serde_json::Value;
use std::path::Path;

/// A block of 2 cm x 1 cm, 200 particles of 1.1 mg (per metre of depth: 1.1 g), free to move, with a load to be put in.
fn block(load: &str, end: &str) -> String {
    format!(
        r#"name = "block"
dimension = 2
spacing = "1 mm"

[material.rubber]
model = "neo-hookean"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45

[[body]]
name = "block"
material = "rubber"
shape = {{ box = {{ min = [0, 0], max = ["2 cm", "1 cm"] }} }}

{load}

[time]
end = "{end}"
"#
    )
}

fn summary(folder: &Path) -> Value {
    json(&folder.join("out/block/summary.json"))
}

/// The momentum at the end and the time of the end.
fn momentum(load: &str) -> ([f64; 2], f64, Value) {
    let folder = with_case(&block(load, "0.2 ms"));
    std::fs::write(folder.path().join("ramp.csv"), "time,factor\n# up and down\n0,0\n1e-4,1\n\n2e-4,0\n")
        .expect("a table");
    taut(folder.path(), &["run", "case.toml", "--quiet"]).with(0);
    let summary = summary(folder.path());
    let at = |i: usize| summary["momentum"]["linear"]["final"][i].as_f64().expect("a number");
    ([at(0), at(1)], summary["end_time"].as_f64().expect("a number"), summary)
}

const RIGHT: &str = "{ box = { min = [\"1.97 cm\", -1], max = [\"2.03 cm\", 1] } }";
const EVERYWHERE: &str = "{ box = { min = [-1, -1], max = [1, 1] } }";

/// The impulse of a constant load is force times time, whatever the body does meanwhile: 200 particles and some 100 steps of rounding.
fn gives(load: &str, force: [f64; 2]) {
    let ([x, y], t, summary) = momentum(load);
    let scale = force[0].hypot(force[1]) * t;
    assert!(
        (x - force[0] * t).abs() < 1e-11 * scale && (y - force[1] * t).abs() < 1e-11 * scale,
        "{load}: {x} {y} at {t}"
    );
    let energy = |key: &str| summary["energy"][key].as_f64().expect("a number");
    let (work, residual) = (energy("external_work"), energy("residual"));
    // A load that sets in at once; the hourglass-free form is not adjoint at surfaces.
    assert!(work > 0.0 && residual.abs() < 0.1 * work, "{load}: {work} {residual}");
}

#[test]
fn forces_and_tractions_give_their_impulse() {
    gives("[[load]]\nat = [\"2 cm\", \"5 mm\"]\nforce = [30, \"-20 N\"]", [30.0, -20.0]);
    gives(&format!("[[load]]\nregion = {EVERYWHERE}\nforce = [0, 7]"), [0.0, 7.0]);
    // 1 cm of a side, and a second load on top.
    let two = format!(
        "[[load]]\nregion = {RIGHT}\ntraction = [\"2 kPa\", \"-1 kPa\"]\n[[load]]\nbody = \"block\"\nregion = {RIGHT}\ntraction = [500, 0]"
    );
    gives(&two, [25.0, -10.0]);
    // Pressure on one side of a body that is not turned: along its normal.
    let gravity = "[[gravity]]\nacceleration = [0, -3]\n[[load]]\nat = [0.005, 0.005]\nforce = [0, 1]";
    // 2 cm x 1 cm x 1100 kg/m^3 is 0.22 kg.
    gives(gravity, [0.0, 1.0 - 0.22 * 3.0]);
}

/// A history of 0, 1, 0 over 0.2 ms gives half of the impulse; steps do not end where it bends, which costs less than a step's share.
#[test]
fn histories_from_lists_and_files() {
    for history in ["[[0, 0], [\"0.1 ms\", 1], [2e-4, 0]]", "\"ramp.csv\""] {
        let ([x, y], _, _) =
            momentum(&format!("[[load]]\nregion = {RIGHT}\ntraction = [2000, 0]\nhistory = {history}"));
        assert!((x / (20.0 * 1e-4) - 1.0).abs() < 0.02 && y.abs() < 1e-12, "{history}: {x} {y}");
    }
    let ramp =
        "[[load]]\nregion = { box = { min = [-1, -1], max = [1, 1] } }\nforce = [\"5e4*min(t, 1e-4)\", 0]";
    let ([x, _], t, _) = momentum(ramp);
    assert!((x / (5.0 * (t - 0.5e-4)) - 1.0).abs() < 0.02, "{x} at {t}");
}

/// Stretches along x and y in the middle of a block of this spacing under a pressure all around, and the folder of the run.
fn pressed(spacing: &str) -> ([f64; 2], tempfile::TempDir) {
    let load = format!("[[load]]\nregion = {EVERYWHERE}\npressure = \"1e7*t\"");
    let probe = |name: &str, x: f64, y: f64| {
        format!("[[probe]]\nname = \"{name}\"\nat = [{x}, {y}]\nquantity = \"position\"\n")
    };
    let text = block(&load, "1 s")
        + "[quasi_static]\nincrements = 4\n"
        + &probe("left", 0.007, 0.005)
        + &probe("right", 0.013, 0.005)
        + &probe("low", 0.01, 0.003)
        + &probe("high", 0.01, 0.007);
    let nested = format!("spacing = \"{spacing}\"\nformulation = \"tl-nested\"");
    let folder = with_case(&text.replace("spacing = \"1 mm\"", &nested));
    let told = taut(folder.path(), &["run", "case.toml"]).with(0);
    let rests = told.stderr.matches("at rest after").count();
    assert!(
        rests == 4 && told.stdout.contains("4 of 4 increments at rest"),
        "{}{}",
        told.stderr,
        told.stdout
    );
    let last = |name: &str, column: usize| {
        let table = std::fs::read_to_string(folder.path().join(format!("out/block/probes/{name}.csv")))
            .expect("a probe");
        assert_eq!(table.lines().count(), 1 + 5, "the start and four equilibria\n{table}");
        table.lines().last().and_then(|l| l.split(',').nth(column)?.parse::<f64>().ok()).expect("a number")
    };
    let along = |ends: [&str; 2], column: usize, length: f64| {
        (last(ends[1], column) - last(ends[0], column)) / length
    };
    ([along(["left", "right"], 1, 0.006), along(["low", "high"], 2, 0.004)], folder)
}

/// A pressure all around a free body: no impulse, and in equilibrium a stress that can be written down. Loads on faces act on rows of
/// particles, so an error of first order is left: with 10 rows 0.45 % in one direction and -0.4 % in the other (a fifth of a row of load too
/// much), with 20 rows half of that; the volume is that of the pressure to the thousandth that unbalanced forces may have.
#[test]
fn a_pressure_all_around_compresses_evenly() {
    let expected = evenly_pressed(17e6, 0.45, 1e7);
    let (coarse, folder) = pressed("1 mm");
    let (fine, _) = pressed("0.5 mm");
    let off = |s: [f64; 2]| (s[0] / expected - 1.0).abs().max((s[1] / expected - 1.0).abs());
    assert!(off(coarse) < 5e-3 && off(fine) < 0.55 * off(coarse), "{coarse:?} and {fine:?} for {expected}");
    for s in [coarse, fine] {
        assert!(((s[0] * s[1]).sqrt() / expected - 1.0).abs() < 1e-3, "{s:?} for {expected}");
    }
    let convergence =
        std::fs::read_to_string(folder.path().join("out/block/convergence.csv")).expect("the table");
    assert!(
        convergence.starts_with("time [s],increment [1],steps [1],force [1]")
            && convergence.lines().count() == 5,
        "{convergence}"
    );
    let drift = summary(folder.path())["momentum"]["linear"]["drift"].as_f64().expect("a number");
    assert!(drift < 1e-9, "{drift}");
}

/// The stretch of a square prism in plane strain under pressure p: sigma_11 = [K/2 (J^2 - 1) + G J^(-2/3) (s^2 - tr b / 3)] / J = -p with
/// J = s^2, tr b = 2 s^2 + 1, by bisection.
fn evenly_pressed(young: f64, poisson: f64, p: f64) -> f64 {
    let (bulk, shear) = (young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)));
    let stress = |s: f64| {
        let j = s * s;
        (0.5 * bulk * (j * j - 1.0) + shear * j.powf(-2.0 / 3.0) * (j - (2.0 * j + 1.0) / 3.0)) / j
    };
    let (mut low, mut high) = (0.5, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if stress(middle) < -p { low = middle } else { high = middle }
    }
    low
}

/// What is wrong with loads is told with its place.
#[test]
fn loads_that_cannot_be() {
    let region = "region = { box = { min = [0.4, 0], max = [0.6, 1] } }";
    for (load, words) in [
        (format!("[[load]]\n{region}\ntraction = [1, 0]"), "no outer face"),
        (format!("[[load]]\n{region}\nforce = [1, 0]"), "no particle is where this force acts"),
        ("[[load]]\nat = [0, 0]\npressure = 1".into(), "only a `force` can act at a point"),
        (
            format!("[[load]]\n{region}\nforce = [1, 0]\ntraction = [1, 0]"),
            "exactly one thing, found force, traction",
        ),
        (format!("[[load]]\n{region}"), "exactly one thing, found none"),
        ("[[load]]\nforce = [1, 0]".into(), "missing key `region`"),
        (
            "[[load]]\nat = [0, 0]\nforce = [1, 0]\nhistory = \"gone.csv\"".into(),
            "cannot read the history gone.csv",
        ),
        ("[[load]]\nat = [0, 0]\nforce = [1, 0]\nhistory = [[1, 0], [0, 1]]".into(), "have to ascend"),
        ("[[load]]\nat = [0, 0]\nforce = [\"1 MPa\", 0]".into(), "expected a force (N), found a pressure"),
        ("[[load]]\nat = [0.01, 0.005]\nforce = [\"1/(x - x)\", 0]".into(), "is not a number at"),
    ] {
        let folder = with_case(&block(&load, "1 ms"));
        let error = taut(folder.path(), &["run", "case.toml"]).with(2).stderr;
        assert!(error.contains(words) && error.contains("case.toml:"), "{load}\n{error}");
    }
    let updated = block(&format!("[[load]]\nregion = {RIGHT}\npressure = 1"), "1 ms")
        .replace("spacing =", "formulation = \"ul-non-hourglass\"\nspacing =")
        .replace("\"neo-hookean\"", "\"linear-elastic\"");
    let error = taut(with_case(&updated).path(), &["run", "case.toml"]).with(2).stderr;
    assert!(error.contains("`pressure` needs a total Lagrangian body"), "{error}");
    let damped = updated.replace("pressure = 1", "traction = [1, 0]") + "\n[damping]\n";
    let error = taut(with_case(&damped).path(), &["run", "case.toml"]).with(2).stderr;
    assert!(error.contains("`[damping]` is for total Lagrangian bodies"), "{error}");
}
