//! `taut mesh`, and `taut check` of a case with a mesh.

use crate::{taut, with_case};
use std::path::{Path, PathBuf};

fn foreign(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../geometry/tests/meshes").join(name)
}

/// What `taut mesh` prints about a file, from its own folder.
fn told(name: &str) -> String {
    let path = foreign(name);
    taut(path.parent().expect("a folder"), &["mesh", name]).with(0).stdout
}

#[test]
fn a_sound_mesh_is_told_line_by_line() {
    let expected = "\
plate-with-bores.stl: binary STL
  triangles   312, 156 points
  size        40.0 x 20.0 x 1.5 units, from (-20.0, -10.0, -0.75) units
  volume      976.4 units^3, area 1602.0 units^2
  thinnest    1.5 units at (";
    let told = told("plate-with-bores.stl");
    assert!(told.starts_with(expected), "{told}");
    for line in
        ["pieces      1", "surface     closed", "direction   all triangles look outwards", "crossings   none"]
    {
        assert!(told.contains(&format!("\n  {line}\n")), "{line}\n{told}");
    }
    assert!(told.ends_with("  inside by   normals of the nearest triangles\n"), "{told}");
}

#[test]
fn what_is_wrong_with_a_mesh_is_told_with_numbers() {
    for (name, words) in [
        ("pipe-without-ends.stl", "warning: it is open: 2 holes were closed by flat caps, the largest 14."),
        ("two-boxes-crossing.stl", "warning: it meets itself: "),
        ("capsule-flipped.stl", "direction   72 triangles were turned to look outwards"),
        ("hollow-ball-both-outwards.obj", "pieces      2, of which 1 is a cavity in another"),
    ] {
        let told = told(name);
        assert!(told.contains(words), "{words}\n{told}");
    }
}

#[test]
fn what_is_no_body_is_refused() {
    for (name, words) in [
        ("moebius.stl", "error: the mesh moebius.stl cannot be used: it has no inside"),
        ("make.py", "error: the mesh make.py cannot be used: it is no STL and no OBJ file"),
        ("nothing.stl", "error: cannot read nothing.stl: "),
        (".", "error: cannot read .: "),
    ] {
        let path = foreign(name);
        let folder = path.parent().expect("a folder");
        let folder = if name == "." { Path::new(env!("CARGO_MANIFEST_DIR")) } else { folder };
        let ended = taut(folder, &["mesh", name]).with(2);
        assert!(ended.stderr.contains(words) && ended.stdout.is_empty(), "{words}\n{}", ended.stderr);
    }
}

#[test]
fn check_tells_of_the_mesh_of_a_case() {
    let folder = with_case(
        r#"name = "part"
dimension = 3
spacing = "1 mm"
[material.rubber]
model = "neo-hookean"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45
[[body]]
name = "part"
material = "rubber"
shape = { mesh = { file = "pipe-without-ends.stl", unit = "mm" } }
[time]
end = "0.01 ms"
"#,
    );
    let file = "pipe-without-ends.stl";
    std::fs::copy(foreign(file), folder.path().join(file)).expect("copied");
    let ended = taut(folder.path(), &["check", "case.toml"]).with(0);
    let out = &ended.stdout;
    assert!(
        out.contains("  mesh pipe-without-ends.stl: binary STL\n    triangles   96, 50 points\n"),
        "{out}"
    );
    assert!(out.contains("    thinnest    0.0") && out.contains("particles   "), "{out}");
    let err = &ended.stderr;
    assert!(
        err.contains("the mesh pipe-without-ends.stl: it is open: 2 holes") && err.contains("case.toml:12"),
        "{err}"
    );
}
