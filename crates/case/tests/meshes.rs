//! Cases whose body is a file of triangles: what is said about bad ones, and that a run keeps what it was made of.

use case::run::{Checkpoints, Interrupted, Settings, Silent, run};
use case::{Case, Overrides};
use output::Manifest;
use std::fs;
use std::path::{Path, PathBuf};
use taut::simulation::Numbers;

const CASE: &str = r#"name = "part"
dimension = 3
spacing = "2 mm"
[material.rubber]
model = "neo-hookean"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45
[[body]]
name = "part"
material = "rubber"
shape = { mesh = { file = "FILE", unit = "mm" } }
[time]
end = "0.01 ms"
"#;

/// The line of the shape.
const LINE: &str = ":12:";

/// A mesh of the crate `geometry`'s tests.
fn foreign(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../geometry/tests/meshes").join(name);
    fs::read(path).expect(name)
}

/// A binary STL of these triangles.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = [vec![b' '; 80], (triangles.len() as u32).to_le_bytes().to_vec()].concat();
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A case beside a file of these bytes.
fn written(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    fs::write(folder.join(name), bytes).expect("the mesh is written");
    let path = folder.join("part.toml");
    fs::write(&path, CASE.replace("FILE", name)).expect("the case is written");
    path
}

fn read(name: &str, bytes: &[u8], overrides: &[&str]) -> Result<Case, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), name, bytes);
    Case::read(&path, &Overrides::set(overrides.iter().copied())).map_err(|error| error.render(false))
}

#[track_caller]
fn refused(name: &str, bytes: &[u8], words: &str) {
    let told = read(name, bytes, &[]).expect_err("refused");
    assert!(told.contains(words) && told.contains(LINE), "{words}\n{told}");
}

/// The warnings of a case that is taken, those of its particles included.
#[track_caller]
fn warned(name: &str, bytes: &[u8], overrides: &[&str]) -> String {
    let case = read(name, bytes, overrides).unwrap_or_else(|told| panic!("{told}"));
    let built = case::build::build(&case, Numbers::Double).unwrap_or_else(|error| panic!("{error}"));
    assert!(built.particles() > 100, "{} particles", built.particles());
    case.render_warnings(false) + &built.warnings.join("\n")
}

#[test]
fn files_that_are_no_mesh_are_refused() {
    let torus = foreign("torus.stl");
    refused("a.stl", &[], "it is empty: it holds no triangle");
    refused("a.stl", &stl(&[]), "it is empty: it holds no triangle");
    refused("a.stl", &torus[..10_000], "the file is cut off: it holds 198 of 702 triangles");
    refused("a.stl", &torus[..60], "the file is cut off: it holds 60 bytes of the 84 of a binary STL's head");
    refused("a.stl", &[&torus[..], b"more"].concat(), "702 triangles, and 4 bytes follow them");
    let mut lying = torus.clone();
    lying[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    refused("a.stl", &lying, "it holds 702 of 4294967295 triangles");
    let text = foreign("superellipsoid.ascii.stl");
    let lines: Vec<&[u8]> = text.split_inclusive(|&b| b == b'\n').collect();
    let cut = lines[..300].concat();
    refused("a.stl", &cut, "it holds 42 triangles up to line 300, but not the last line, of `endsolid`");
    refused("a.stl", &text[..20_000], "line 487: a corner has three coordinates, and z is missing");
    refused("a.png", b"\x89PNG\r\n", "it is no STL and no OBJ file: it begins with \"\\x89PNG");
    refused(
        "a.obj",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
        "line 4: there is no point 4: 3 stand before this line",
    );
    refused("a.obj", b"v 0 zero 0\n", "line 1: y is `zero`, which is no number");
}

#[test]
fn coordinates_that_are_no_numbers_or_enormous_are_refused() {
    let with = |x: f32| {
        stl(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[x, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 1.0]]])
    };
    refused("a.stl", &with(f32::NAN), "a corner of triangle 2 (counted from 1) is [NaN, 0.0, 0.0]");
    refused("a.stl", &with(f32::INFINITY), "is [inf, 0.0, 0.0]; every coordinate has to be a finite number");
    refused("a.stl", &with(3e38), "coordinates beyond 1e30 are not used");
    refused("a.obj", b"v nan 0 0\n", "x is NaN; every coordinate has to be a finite number");
}

#[test]
fn surfaces_without_inside_are_refused() {
    refused(
        "a.stl",
        &foreign("moebius.stl"),
        "it has no inside: its triangles cannot be oriented alike (at ",
    );
    refused("a.stl", &foreign("sheet.stl"), "it encloses no volume: its 32 triangles are flat sheets");
}

#[test]
fn what_is_mended_is_a_warning_with_a_number() {
    for (name, words) in [
        ("pipe-without-ends.stl", "it is open: 2 holes were closed by flat caps, the largest 14.14"),
        ("ball-with-holes.stl", "it is open: 12 holes were closed by flat caps"),
        ("capsule-flipped.stl", "72 triangles were turned to look outwards"),
        ("two-boxes-crossing.stl", "it meets itself: "),
        ("hollow-ball-both-outwards.obj", "1 whole piece was the wrong way round"),
    ] {
        let told = warned(name, &foreign(name), &["spacing=0.0008"]);
        let words = words.replace("14.14", "0.01");
        assert!(told.contains(&words) && told.contains(LINE), "{words}\n{told}");
    }
}

#[test]
fn thinner_than_a_particle_is_a_warning_with_a_number() {
    let plate = foreign("plate-with-bores.stl");
    let layer = "body.part.fill={ lattice = { origin = [0, 0, -0.0008] } }";
    let told = warned("plate.stl", &plate, &["spacing=0.0016", layer]);
    let words = "`part` is thinner than a particle: the mesh plate.stl is 1.5000e-3 m thick at (";
    assert!(told.contains(words) && told.contains("the spacing is 1.6000e-3 m"), "{told}");
    assert!(!warned("plate.stl", &plate, &["spacing=0.0004"]).contains("thinner"), "it is not");
    // The lattice passes it by on both sides.
    let case = read("plate.stl", &plate, &["spacing=0.0016"]).expect("a case");
    let told = case::build::build(&case, Numbers::Double).err().expect("empty").to_string();
    assert!(told.contains("no particle fits inside: the shape spans 0.04 x 0.02 x 0.0015 m"), "{told}");
}

#[test]
fn an_enormous_part_is_refused_with_a_number() {
    let case = read("plate.stl", &foreign("plate-with-bores.stl"), &["body.part.shape.mesh.unit=m"])
        .expect("a case");
    let told = case::build::build(&case, Numbers::Double).err().expect("too large").to_string();
    assert!(
        told.contains("about 1.504e11 particles would be needed: the shape spans 40.0 x 20.0 x 1.5 m"),
        "{told}"
    );
}

#[test]
fn the_unit_is_asked_for_and_a_plane_case_has_no_mesh() {
    let torus = foreign("torus.stl");
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "torus.stl", &torus);
    let told = |text: String| {
        fs::write(&path, text).expect("written");
        Case::read(&path, &Overrides::default()).expect_err("refused").render(false)
    };
    let without = told(CASE.replace("FILE", "torus.stl").replace(", unit = \"mm\"", ""));
    assert!(without.contains("missing key `unit`") && without.contains("most are in \"mm\""), "{without}");
    let wrong = told(CASE.replace("FILE", "torus.stl").replace("\"mm\"", "\"inch\""));
    assert!(wrong.contains("unknown unit `inch`, expected one of"), "{wrong}");
    let flat = told(CASE.replace("FILE", "torus.stl").replace("dimension = 3", "dimension = 2"));
    assert!(flat.contains("the shape `mesh` exists in 3D only") && flat.contains("`polygon`"), "{flat}");
    let lost = told(CASE.replace("FILE", "tours.stl"));
    assert!(lost.contains("cannot read the mesh") && lost.contains("relative to the case file"), "{lost}");
}

/// A mesh is placed by the shapes that move others, and scaled.
#[test]
fn a_mesh_is_moved_turned_and_scaled() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "torus.stl", &foreign("torus.stl"));
    let plain = fs::read_to_string(&path).expect("the case");
    let mesh = "{ mesh = { file = \"torus.stl\", unit = \"mm\" } }";
    let placed = format!(
        "{{ translate = {{ by = [1, 0, 0], shape = {{ rotate = {{ angle = \"90 deg\", axis = [1, 0, 0], shape = {{ scale = {{ factor = 2, shape = {mesh} }} }} }} }} }} }}"
    );
    fs::write(&path, plain.replace(mesh, &placed)).expect("written");
    let case = Case::read(&path, &Overrides::default()).unwrap_or_else(|e| panic!("{}", e.render(false)));
    let built = case::build::build(&case, Numbers::Double).unwrap_or_else(|error| panic!("{error}"));
    // Eight times 1692.79 mm^3 in cells of 8 mm^3; the surface of a torus, 4 pi^2 R r, cuts a cell for each 4 mm^2.
    let (cells, cut) = (1692.79, 4.0 * std::f64::consts::PI.powi(2) * 20.0 * 6.0 / 4.0);
    assert!((built.particles() as f64 - cells).abs() < 0.5 * cut, "{} particles", built.particles());
    assert!(
        case::explain(&case).contains(" triangles, scaled by 2, turned by 90 degrees, moved"),
        "{}",
        case::explain(&case)
    );
}

fn settings(out: PathBuf) -> Settings {
    Settings { out, threads: Some(1), numbers: Numbers::Double, checkpoints: Checkpoints::default() }
}

#[test]
fn a_run_keeps_the_file_and_goes_on_without_the_original() {
    let folder = tempfile::tempdir().expect("a folder");
    let torus = foreign("torus.stl");
    let path = written(folder.path(), "torus.stl", &torus);
    let case = Case::read(&path, &Overrides::default()).unwrap_or_else(|e| panic!("{}", e.render(false)));
    let out = folder.path().join("out");
    let settings = settings(out.clone());
    settings.checkpoints.stop.request();
    let stopped = run(&case, &settings, &mut Silent).expect_err("stopped");
    assert!(matches!(stopped, case::run::RunError::Interrupted { .. }), "{stopped}");
    let manifest = Manifest::read(&out).expect("a manifest");
    assert_eq!((manifest.files.len(), manifest.files[0].name.as_str()), (1, "torus.stl"));
    assert_eq!(manifest.files[0].hash, output::manifest::hash(&torus));
    assert_eq!(fs::read(out.join(&manifest.files[0].kept)).expect("the copy"), torus);
    fs::remove_file(folder.path().join("torus.stl")).expect("the original goes");
    let found = Interrupted::find(&out).unwrap_or_else(|error| panic!("{error}"));
    let summary = case::run::resume(found, Some(1), &Checkpoints::default(), &mut Silent);
    assert!(summary.is_ok(), "{summary:?}");
}

#[test]
fn a_run_does_not_go_on_with_another_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "torus.stl", &foreign("torus.stl"));
    let case = Case::read(&path, &Overrides::default()).unwrap_or_else(|e| panic!("{}", e.render(false)));
    let out = folder.path().join("out");
    let settings = settings(out.clone());
    settings.checkpoints.stop.request();
    run(&case, &settings, &mut Silent).expect_err("stopped");
    fs::write(out.join("files/0-torus.stl"), foreign("plate-with-bores.stl")).expect("another file");
    let told = Interrupted::find(&out).expect_err("refused").to_string();
    assert!(told.contains("it is not what the run began with"), "{told}");
}
