//! `taut stability`, `modes`, `static` and `spectrum`: what a case is without being run, and what its probes say.

use crate::{BLOCK, taut, with_case};
use std::path::Path;

/// The numbers of a table by the first column, of which there may be several of a name.
fn rows(path: &Path) -> Vec<(String, Vec<String>)> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let row = |line: &str| {
        let mut cells = line.split(',').map(str::to_string);
        (cells.next().unwrap_or_default(), cells.collect())
    };
    text.lines().skip(1).map(row).collect()
}

/// Marched to rest, and solved for: the same measures, to 5e-3 of the largest displacement.
#[test]
fn a_static_solution_is_where_a_damped_run_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    taut(folder.path(), &["run", "lk-rectangle", "--quiet"]).with(0);
    let told = taut(folder.path(), &["static", "lk-rectangle"]).with(0).stdout;
    assert!(told.contains("of the load would move the body as a whole"), "{told}");
    let run = crate::json(&folder.path().join("out/lk-rectangle/summary.json"));
    let solved = rows(&folder.path().join("out/lk-rectangle-static/measured.csv"));
    assert!(solved.len() >= 8);
    for (name, row) in solved {
        let (marched, found) = (
            run["measured"][&name]["value"].as_f64().expect("measured"),
            row[0].parse::<f64>().expect("a number"),
        );
        let scale = if name.starts_with("largest") { marched } else { 1.0 };
        assert!((marched - found).abs() < 5e-3 * scale, "{name}: {marched} and {found}");
    }
    let again = taut(folder.path(), &["static", "lk-rectangle"]).with(2).stderr;
    assert!(again.contains("lk-rectangle-static"), "{again}");
}

/// Where the particles of the last frame of a result are, m: in double precision, unlike displacements.
fn places(folder: &Path, frame: usize) -> Vec<[f64; 2]> {
    let path = folder.join(format!("particles/particles_{frame:06}.vtp"));
    let file = output::FrameFile::open(&path).unwrap_or_else(|error| panic!("{error}"));
    let frame = file.frame(|_| false).unwrap_or_else(|error| panic!("{error}"));
    frame.points.iter().map(|x| [x[0], x[1]]).collect()
}

/// Displacements of particles of different masses, and what is left of them without some modes.
struct Moved {
    mass: Vec<f64>,
}

impl Moved {
    fn product(&self, u: &[[f64; 2]], v: &[[f64; 2]]) -> f64 {
        self.mass.iter().zip(u).zip(v).map(|((m, u), v)| m * (u[0] * v[0] + u[1] * v[1])).sum()
    }

    fn without(&self, u: &[[f64; 2]], modes: &[Vec<[f64; 2]>]) -> Vec<[f64; 2]> {
        let mut u = u.to_vec();
        // Twice, for modes that are orthogonal up to rounding only.
        for mode in modes.iter().chain(modes) {
            let share = self.product(&u, mode) / self.product(mode, mode);
            u.iter_mut().zip(mode).for_each(|(u, m)| (0..2).for_each(|k| u[k] -= share * m[k]));
        }
        u
    }
}

/// The load of the annulus turns it as a whole, in the mode that is nearly a turn, for ever. Without that mode the run comes to rest where `taut static` says. Under
/// a constant load every mode from rest lacks at most (1 + xi t/2) e^(-xi t/2) of its share of the equilibrium if its own omega is no less than xi/2: so xi is twice
/// the lowest omega here, and the time ten of its inverse.
#[test]
fn an_annulus_comes_to_rest_where_it_should_but_for_its_turn() {
    for around in ["36", "94"] {
        let folder = tempfile::tempdir().expect("a folder");
        let around = format!("parameters.around={around}");
        taut(folder.path(), &["modes", "lk-annulus", "--count", "1", "--set", &around]).with(0);
        taut(folder.path(), &["static", "lk-annulus", "--set", &around]).with(0);
        let out = |what: &str| folder.path().join("out").join(what);
        let lowest = rows(&out("lk-annulus-modes/modes.csv"));
        assert_eq!(lowest.len(), 4, "two translations, what is nearly a turn, and a vibration");
        let omega = std::f64::consts::TAU * lowest[3].1[1].parse::<f64>().expect("a frequency");
        let (rate, end) = (format!("damping.rate={}", 2.0 * omega), format!("time.end={}", 10.0 / omega));
        let output = format!("time.output={}", 10.0 / omega);
        let set = ["--set", &around, "--set", &rate, "--set", &end, "--set", &output];
        taut(folder.path(), &[&["run", "lk-annulus", "--quiet"][..], &set].concat()).with(0);

        let rest = places(&out("lk-annulus"), 0);
        let apart = |folder: &Path, frame: usize| -> Vec<[f64; 2]> {
            let there = places(folder, frame);
            there.iter().zip(&rest).map(|(x, y)| [x[0] - y[0], x[1] - y[1]]).collect()
        };
        let modes: Vec<_> = (0..3).map(|k| apart(&out("lk-annulus-modes"), k)).collect();
        // Sectors of a ring, in proportion to its radius.
        let moved = Moved { mass: rest.iter().map(|x| x[0].hypot(x[1])).collect() };
        let solved = apart(&out("lk-annulus-static"), 0);
        let marched = apart(&out("lk-annulus"), 1);
        let size = |u: &[[f64; 2]]| moved.product(u, u).sqrt();
        let off = |u: &[[f64; 2]]| {
            let rest: Vec<_> = u.iter().zip(&solved).map(|(u, v)| [u[0] - v[0], u[1] - v[1]]).collect();
            size(&rest) / size(&solved)
        };
        // Steps of finite length change the rate by less than a tenth.
        let missing = 1.1 * 11.0 * (-10.0_f64).exp();
        let settled = off(&moved.without(&marched, &modes));
        assert!(settled < missing, "{around}: {settled:e}, at most {missing:e}");
        assert!(off(&marched) > 1.0, "{around}: it has turned by more than it is deformed");
    }
}

/// Modes of the annulus: finite elements have 150.9 Hz twice (n = 2) and 356.0 Hz (breathing); with 36 x 5 particles another program for the same
/// equations has 133 +- 5 and 344 +- 10 Hz.
#[test]
fn modes_of_the_annulus() {
    let folder = tempfile::tempdir().expect("a folder");
    taut(folder.path(), &["modes", "lk-collision", "--count", "45"]).with(0);
    let out = folder.path().join("out/lk-collision-modes");
    let all = rows(&out.join("modes.csv"));
    let number = |row: &[String], k: usize| row[k].parse::<f64>().expect("a number");
    let of = |body: &str| -> Vec<(f64, f64, f64)> {
        let mine = all.iter().filter(|(_, row)| row[0] == body);
        mine.map(|(_, row)| (number(row, 1), number(row, 3), number(row, 4))).collect()
    };
    for body in ["annulus", "block"] {
        let rigid = of(body).iter().filter(|mode| mode.2 > 0.9).count();
        assert_eq!(rigid, 3, "two translations and what is nearly a turn: {all:?}");
    }
    let near =
        |wanted: f64, within: f64| of("annulus").iter().filter(|m| (m.0 - wanted).abs() < within).count();
    assert!(near(133.0, 5.0) >= 2 && near(344.0, 10.0) >= 1, "{:?}", of("annulus"));
    // The lowest vibrations of the block alternate from particle to particle: central differences do not see them.
    assert!(of("block")[3].1 > 0.5, "{:?}", of("block"));
    let turn = of("block")[2];
    assert!(turn.1 < 0.2, "what is nearly a turn is smooth: {turn:?}");
    assert!(out.join("particles/particles.pvd").is_file() && out.join("mode-04.png").is_file());
}

#[test]
fn modes_are_those_of_small_strain() {
    let folder = with_case(BLOCK);
    let told = taut(folder.path(), &["modes", "case.toml"]).with(2).stderr;
    assert!(told.contains("`block` is not solved by small-strain") && told.contains("hint"), "{told}");
    assert!(!folder.path().join("out").exists(), "nothing was made");
}

/// The limits of the plate of the small-strain paper, by another program: 2.355e-3 s with a Gaussian of one spacing; Eq. 15 says 3.14e-3 s.
#[test]
fn limits_stand_side_by_side() {
    let folder = tempfile::tempdir().expect("a folder");
    let told = taut(folder.path(), &["stability", "lk-stability", "--set", "parameters.resolution=20"])
        .with(0)
        .stdout;
    let value = |what: &str| -> f64 {
        let line = told.lines().find(|line| line.contains(what)).unwrap_or_else(|| panic!("{what}: {told}"));
        line.split_whitespace()
            .rev()
            .nth(usize::from(line.contains("of 2/sqrt")) * 3 + 1)
            .and_then(|n| n.parse().ok())
            .unwrap_or_else(|| panic!("{line}"))
    };
    let (paper, operator) = (value("Eq. 15"), value("as it is"));
    assert!((paper / 3.14e-3 - 1.0).abs() < 2e-3 && (operator / 2.355e-3 - 1.0).abs() < 1e-3, "{told}");
    assert!((value("running") / operator - 1.0).abs() < 5e-3, "{told}");
    let widths = rows(&folder.path().join("out/lk-stability-stability/smoothing.csv"));
    let least = |column: usize| {
        let of = |row: &(String, Vec<String>)| row.1[column].parse::<f64>().expect("a number");
        let row = widths.iter().min_by(|a, b| of(a).total_cmp(&of(b))).expect("rows");
        row.0.parse::<f64>().expect("a width")
    };
    assert!((0.8..=0.95).contains(&least(0)) && (0.7..=0.8).contains(&least(1)), "minima of Fig. 16");
    let number = |row: &(String, Vec<String>), k: usize| row.1[k].parse::<f64>().expect("a number");
    let above = |row: &&(String, Vec<String>)| number(row, 0) > number(row, 1);
    let crossed: f64 = widths.iter().rfind(above).and_then(|row| row.0.parse().ok()).expect("narrow kernels");
    assert!(
        (0.69..0.75).contains(&crossed),
        "normalisation raises the limit of narrow kernels: Fig. 16, {crossed}"
    );
    let table = |name: &str| rows(&folder.path().join(format!("out/lk-stability-stability/{name}.csv")));
    // Under 1 to 64 times the load: what bisection leaves, and no more.
    let loads = table("loads");
    assert!(loads.len() == 7, "Table 1: {loads:?}");
    for (row, k) in loads.iter().flat_map(|row| [(row, 0), (row, 1)]) {
        assert!((number(row, k) / number(&loads[0], k) - 1.0).abs() < 5e-3, "Fig. 15: {row:?}");
    }
    // The step times sqrt(stiffness/density) is one number.
    for (name, power) in [("density", -0.5), ("stiffness", 0.5)] {
        let all = table(name);
        let one = all.iter().find(|row| row.0 == "1").expect("the case itself");
        for (row, k) in all.iter().flat_map(|row| [(row, 0), (row, 1)]) {
            let scaled = number(row, k) * row.0.parse::<f64>().expect("a factor").powf(power);
            let one = number(one, k);
            assert!((scaled / one - 1.0).abs() < 1e-6, "Fig. 17: {name} {row:?}");
        }
    }
}

/// The block is no vibration of one frequency, but its first one is a longitudinal wave: 4 x 2 cm at 242 m/s and less.
#[test]
fn a_spectrum_of_a_run() {
    let folder = with_case(&BLOCK.replace("end = \"0.1 ms\"", "end = \"3 ms\""));
    taut(folder.path(), &["run", "case.toml", "--quiet"]).with(0);
    let told = taut(folder.path(), &["spectrum", "out/block", "tip"]).with(0).stdout;
    assert!(told.contains("resolution") && told.contains("Hz +-"), "{told}");
    for file in ["spectrum-tip.csv", "spectrum-tip.svg", "spectrum-tip-peaks.csv"] {
        assert!(folder.path().join("out/block").join(file).is_file(), "{file}");
    }
    let wrong = taut(folder.path(), &["spectrum", "out/block", "top"]).with(2).stderr;
    assert!(wrong.contains("probes of this run: tip"), "{wrong}");
    let short = taut(folder.path(), &["spectrum", "out/block", "tip", "--from", "2"]).with(2).stderr;
    assert!(short.contains("fewer than eight samples"), "{short}");
}
