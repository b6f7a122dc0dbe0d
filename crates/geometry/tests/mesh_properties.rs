//! What must hold for every mesh and every file, on random ones.

use geometry::{MAX_TRIANGLES, Mesh, Point, Shape};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

fn point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(-4.0..4.0)
}

fn gap(a: Point, b: Point) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// The triangles of a box: corners are numbered by the bits of their axes.
const BOX: [[usize; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

/// A box as triangles with corners of their own, in this order, some of them flipped.
fn boxed(min: Point, max: Point, order: &[usize], flipped: &[bool]) -> Mesh {
    let corner =
        |k: usize| -> Point { std::array::from_fn(|i| if k >> i & 1 == 0 { min[i] } else { max[i] }) };
    let mut points = Vec::new();
    for (&index, flip) in order.iter().zip(flipped) {
        let [a, b, c] = BOX[index].map(corner);
        points.extend(if *flip { [a, c, b] } else { [a, b, c] });
    }
    let faces = (0..order.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    Mesh::new(points, faces).expect("a box")
}

/// A sphere of radius 1 without some of its triangles; the planes of the others are at least `inner` from the middle.
fn sphere(n: u32, missing: &[usize]) -> (Mesh, f64) {
    let point = |i: u32, j: u32| {
        let (a, b) = (PI * f64::from(i) / f64::from(n), 2.0 * PI * f64::from(j % n) / f64::from(n));
        [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]
    };
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
        triangles.extend((i + 1 < n).then_some([a, b, c]));
        triangles.extend((i > 0).then_some([a, c, d]));
    }
    let count = triangles.len();
    let gone: Vec<usize> = missing.iter().map(|index| index % count).collect();
    let kept = triangles.into_iter().enumerate().filter(|(index, _)| !gone.contains(index));
    let points: Vec<Point> = kept.flat_map(|(_, corners)| corners).collect();
    let faces = (0..points.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    // A triangle reaches as deep as half of an angle both ways allows.
    (Mesh::new(points, faces).expect("a sphere"), (PI / f64::from(n)).cos().powi(2))
}

fn file(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes").join(name)).expect(name)
}

fn name() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec!["a.stl", "a.STL", "a.obj", "a", ""])
}

/// Text that is nearly right.
fn words() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "solid",
        "facet",
        "normal",
        "outer",
        "loop",
        "vertex",
        "endloop",
        "endfacet",
        "endsolid",
        "v",
        "f",
        "vt",
        "#",
        "0",
        "1",
        "-1",
        "2",
        "3",
        "nan",
        "1e999",
        "1/2/3",
        "-2//1",
        "\\",
        "x",
        "99999999999999999999",
    ]);
    let line = prop::collection::vec(word, 0..7).prop_map(|words| words.join(" "));
    prop::collection::vec(line, 0..40).prop_map(|lines| lines.join("\n"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_box_of_triangles_is_a_box(
        min in point(), size in prop::array::uniform3(0.1..3.0), x in point(),
        order in Just((0..12).collect::<Vec<usize>>()).prop_shuffle(), flipped in prop::array::uniform12(any::<bool>())
    ) {
        let max = std::array::from_fn(|i| min[i] + size[i]);
        let (mesh, solid) = (boxed(min, max, &order, &flipped), Shape::Box { min, max });
        // Coordinates of order 10, a few dozen roundings.
        prop_assert!((mesh.distance(x) - solid.distance(x)).abs() < 1e-13);
        prop_assert_eq!(mesh.bounds(), solid.bounds());
        let volume: f64 = size.iter().product();
        prop_assert!((mesh.volume() - volume).abs() < 1e-12);
        let thinnest = size.iter().fold(f64::INFINITY, |m: f64, &s| m.min(s));
        prop_assert!((mesh.thinnest().map_or(0.0, |thin| thin.thickness) - thinnest).abs() < 1e-12);
    }

    #[test]
    fn holes_do_not_turn_inside_out(missing in prop::collection::vec(any::<usize>(), 0..40), x in point()) {
        let (mesh, inner) = sphere(20, &missing);
        let r = gap(x, [0.0; 3]);
        // A cap over several triangles that hang together cuts deeper than one triangle; forty in a row of 20 can take a belt.
        let deepest = if missing.len() < 2 { inner } else { 0.5 };
        prop_assert!(r > deepest - 1e-9 || mesh.distance(x) < 0.0, "{x:?}");
        prop_assert!(r < 1.0 + 1e-9 || mesh.distance(x) > 0.0, "{x:?}");
    }

    #[test]
    fn distances_of_any_triangles_change_no_faster_than_the_way(
        corners in prop::collection::vec(prop::array::uniform3(point()), 1..40), a in point(), b in point()
    ) {
        let points: Vec<Point> = corners.as_flattened().to_vec();
        let faces = (0..corners.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        if let Ok(mesh) = Mesh::new(points, faces) {
            let report = mesh.report();
            prop_assert!(report.doubts("m").iter().chain(&report.lines("m")).all(|line| !line.contains("NaN")));
            prop_assert!((mesh.distance(a).abs() - mesh.distance(b).abs()).abs() <= gap(a, b) + 1e-12);
        }
    }

    #[test]
    fn any_bytes_are_a_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400), name in name()) {
        let _ = Mesh::read(&bytes, name, 1e-3);
    }

    #[test]
    fn a_head_and_any_triangles_are_a_mesh_or_an_error(
        triangles in prop::collection::vec(prop::array::uniform9(any::<f32>()), 0..30), more in 0_usize..3, name in name()
    ) {
        let mut bytes = [vec![0; 80], (triangles.len() as u32).to_le_bytes().to_vec()].concat();
        for triangle in &triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes.extend(vec![0; more]);
        if let Ok((mesh, _)) = Mesh::read(&bytes, name, 1e-3) {
            prop_assert!(mesh.faces().len() <= MAX_TRIANGLES && !mesh.distance([0.0; 3]).is_nan());
        }
    }

    #[test]
    fn nearly_right_text_is_a_mesh_or_an_error(text in words(), name in name()) {
        if let Err(error) = Mesh::read(text.as_bytes(), name, 1.0) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn damaged_files_are_a_mesh_or_an_error(
        which in 0_usize..3, cut in 0.0..1.0_f64, flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..20)
    ) {
        let name = ["ball-with-holes.stl", "superellipsoid.ascii.stl", "tube.obj"][which];
        let mut bytes = file(name);
        for (index, byte) in flips {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        // Half of them whole.
        bytes.truncate((bytes.len() as f64 * (2.0 * cut).min(1.0)) as usize);
        if let Ok((mesh, _)) = Mesh::read(&bytes, name, 1e-3) {
            prop_assert!(!mesh.distance([0.0; 3]).is_nan());
            let _ = mesh.report();
        }
    }
}
