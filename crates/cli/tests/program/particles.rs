//! `taut particles`: made once, looked at, and used again.

use crate::{BLOCK, json, taut, with_case};

/// The block with a hole, filled as it is told.
fn holed(fill: &str) -> String {
    let shape = "shape = { box = { min = [0, 0], max = [\"2 cm\", \"1 cm\"] } }";
    assert!(BLOCK.contains(shape));
    let holed = "shape = { difference = [{ box = { min = [0, 0], max = [\"2 cm\", \"1 cm\"] } }, { ball = { center = [\"14 mm\", \"5 mm\"], radius = \"2 mm\" } }] }";
    BLOCK.replace(shape, &format!("{holed}\nfill = {fill}"))
}

#[test]
fn particles_are_saved_drawn_and_used_again() {
    let folder = with_case(&holed("\"fitted\""));
    let told = taut(folder.path(), &["particles", "case.toml", "-o", "made"]).with(0).stdout;
    // 200 mm^2 less 4 pi.
    assert!(told.contains("block: 187 particles") && told.contains("at rest after"), "{told}");
    assert!(told.contains("patch test: force inside over stress / dp, rms"), "{told}");
    assert!(folder.path().join("made.vtp").is_file() && folder.path().join("made.png").is_file());
    let again = taut(folder.path(), &["particles", "case.toml", "-o", "made.vtp"]).with(2).stderr;
    assert!(again.contains("made.vtp exists already"), "{again}");
    taut(folder.path(), &["run", "case.toml", "--quiet", "--out", "now"]).with(0);
    std::fs::write(folder.path().join("case.toml"), holed("{ particles = \"made.vtp\" }")).expect("written");
    taut(folder.path(), &["run", "case.toml", "--quiet", "--out", "saved"]).with(0);
    let end = |run: &str| json(&folder.path().join(run).join("summary.json"))["measured"].clone();
    assert!(end("now") == end("saved") && !end("now").is_null());
}

#[test]
fn what_is_no_filling_of_the_body_is_refused_with_numbers() {
    let folder = with_case(&holed("{ particles = \"made.vtp\" }"));
    let said = |arguments: &[&str]| taut(folder.path(), arguments).with(2).stderr;
    let missing = said(&["check", "case.toml"]);
    assert!(missing.contains("made.vtp") && missing.contains("case.toml:"), "{missing}");
    std::fs::write(folder.path().join("made.vtp"), "no particles").expect("written");
    assert!(said(&["check", "case.toml"]).contains("it is no whole .vtp file"));
    std::fs::remove_file(folder.path().join("made.vtp")).expect("removed");
    let disc = "{ ball = { center = [0.005, 0.005], radius = \"5 mm\" } }";
    taut(folder.path(), &["particles", disc, "--spacing", "1 mm", "-o", "made"]).with(0);
    let other = said(&["check", "case.toml"]);
    assert!(other.contains("78 of 79 lie in its shape") || other.contains("79 of 79"), "{other}");
    let fine = said(&["check", "case.toml", "--set", "parameters.dp=0.5 mm"]);
    assert!(fine.contains("0.001 m apart, and the case has 0.0005 m"), "{fine}");
}

#[test]
fn shapes_are_read_as_in_a_case() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = |arguments: &[&str]| taut(folder.path(), arguments).with(2).stderr;
    assert!(said(&["particles", "{ ball = { } }", "-o", "a"]).contains("needs --spacing"));
    let wrong = said(&["particles", "{ bal = { } }", "--spacing", "1 mm", "-o", "a"]);
    assert!(wrong.contains("did you mean `ball`"), "{wrong}");
    assert!(said(&["particles", "tl-plate", "-o", "a.stl"]).contains("ends in .stl"));
    assert!(said(&["particles", "tl-plate", "--spacing", "1", "-o", "a"]).contains("goes with a shape"));
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0);
}

#[test]
fn the_surface_of_a_stent_is_written_once_as_stl() {
    let folder = tempfile::tempdir().expect("a folder");
    let stent = "{ stent = { length = 20, diameter = 10, thickness = 0.1, around = 8, along = 4, strut = 0.3, bridge = 0.6 } }";
    taut(folder.path(), &["surface", stent, "-o", "stent"]).with(0);
    let bytes = std::fs::read(folder.path().join("stent.stl")).expect("the file");
    let count = u32::from_le_bytes([bytes[80], bytes[81], bytes[82], bytes[83]]) as usize;
    assert!(bytes.len() == 84 + 50 * count && count > 10_000, "{count}");
    assert!(
        taut(folder.path(), &["surface", stent, "-o", "stent"]).with(2).stderr.contains("exists already")
    );
    let ball = "{ ball = { center = [0, 0, 0], radius = 1 } }";
    // 48 strips of 96 pairs, less the halves at the poles.
    assert!(
        taut(folder.path(), &["surface", ball, "-o", "b"]).with(0).stdout.contains("9024 triangles in b.stl")
    );
    let both = format!("{{ union = [{ball}, {ball}] }}");
    let none = taut(folder.path(), &["surface", &both, "-o", "u"]).with(2).stderr;
    assert!(none.contains("polygons and combined shapes have none"), "{none}");
    let disc = taut(folder.path(), &["surface", "{ ball = { center = [0, 0], radius = 1 } }", "-o", "d"])
        .with(2)
        .stderr;
    assert!(disc.contains("a shape of the plane has no surface"), "{disc}");
    let crowded = stent.replace("0.3", "1.9");
    let said = taut(folder.path(), &["surface", &crowded, "-o", "c"]).with(2).stderr;
    assert!(said.contains("`strut` is 1.9") && said.contains("room for less than"), "{said}");
}
