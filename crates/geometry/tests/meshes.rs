//! Meshes that other programs made (tests/meshes/README.md): what is said about them, and that inside is inside.

use geometry::{Dimension, Fill, Mesh, MeshError, MeshFormat, MeshReport, Point, Shape, fill};
use std::path::Path;

const MM: f64 = 1e-3;

fn file(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes").join(name)).expect(name)
}

fn read(name: &str) -> Result<Mesh, MeshError> {
    Mesh::read(&file(name), name, MM).map(|(mesh, _)| mesh)
}

fn report(name: &str) -> (Mesh, MeshReport) {
    let mesh = read(name).expect(name);
    let report = mesh.report();
    (mesh, report)
}

/// The volume in cubic millimetres, to the six digits that make.py printed.
#[track_caller]
fn has_volume(report: &MeshReport, expected: f64) {
    let volume = report.volume / (MM * MM * MM);
    assert!((volume / expected - 1.0).abs() < 1e-5, "{volume} mm^3 for {expected}");
}

#[test]
fn closed_meshes_are_taken_as_they_are() {
    for (name, volume, pieces) in
        [("plate-with-bores.stl", 976.38, 1), ("tube.obj", 3371.16, 1), ("torus.stl", 1692.79, 1)]
    {
        let (_, report) = report(name);
        assert!(report.is_closed() && !report.winding, "{name}: {report:?}");
        assert_eq!(report.doubts("m"), [""; 0], "{name}");
        assert_eq!(report.pieces, pieces);
        has_volume(&report, volume);
    }
}

#[test]
fn distances_are_those_of_vtk() {
    for name in ["plate-with-bores", "torus"] {
        let mesh = read(&format!("{name}.stl")).expect(name);
        let table = String::from_utf8(file(&format!("{name}.csv"))).expect("text");
        let mut count = 0;
        for line in table.lines().skip(2) {
            let row: Vec<f64> = line.split(',').map(|n| n.parse().expect(line)).collect();
            let distance = mesh.distance([row[0] * MM, row[1] * MM, row[2] * MM]) / MM;
            // VTK holds points in single precision: a few roundings of 6e-8 of 50 mm, and nine digits are written.
            assert!((distance - row[3]).abs() < 2e-5, "{name} at {line}: {distance}");
            count += 1;
        }
        assert_eq!(count, 150);
    }
}

#[test]
fn small_holes_are_closed_and_told() {
    let (mesh, report) = report("ball-with-holes.stl");
    assert_eq!((report.mended.holes.len(), report.mended.large_holes(report.area)), (12, 0));
    assert!(!report.is_closed() && !report.winding);
    // The full icosphere of make.py has 4047.05 mm^3 as printed by trimesh; flat caps of single triangles give all of it back.
    has_volume(&report, FULL_BALL);
    let doubts = report.doubts("m");
    assert!(
        doubts[0].starts_with("it is open: 12 holes were closed by flat caps, the largest "),
        "{doubts:?}"
    );
    // Every point of a grid: the ball of the inscribed radius is inside, that of the circumscribed one holds all.
    for x in grid(12.0 * MM, 25) {
        let r = x.iter().map(|c| c * c).sum::<f64>().sqrt();
        let d = mesh.distance(x);
        assert!(r > 9.6 * MM || d < 0.0, "{x:?} {d}");
        assert!(r < 10.01 * MM || d > 0.0, "{x:?} {d}");
    }
}

/// mm^3, of the icosphere of 320 triangles and radius 10 mm: printed by make.py.
const FULL_BALL: f64 = 4047.05;

/// A grid of n^3 points in a cube around the origin.
fn grid(half: f64, n: usize) -> impl Iterator<Item = Point> {
    let at = move |i: usize| half * (2.0 * (i as f64 + 0.5) / n as f64 - 1.0);
    (0..n * n * n).map(move |k| [at(k % n), at(k / n % n), at(k / n / n)])
}

#[test]
fn flipped_triangles_are_turned_and_counted() {
    let (mesh, report) = report("capsule-flipped.stl");
    assert_eq!(report.mended.turned, FLIPPED);
    assert!(report.is_closed() && !report.winding);
    assert_eq!(report.doubts("m"), [format!("{FLIPPED} triangles were turned to look outwards")]);
    assert!(mesh.distance([0.0, 0.0, 10.0 * MM]) < -4.5 * MM);
}

/// A quarter of the triangles of the capsule.
const FLIPPED: usize = 72;

#[test]
fn a_hollow_ball_with_both_surfaces_outwards_is_hollow() {
    let (mesh, report) = report("hollow-ball-both-outwards.obj");
    assert_eq!((report.pieces, report.mended.cavities, report.mended.inside_out), (2, 1, 1));
    // The inner icosphere has 80 triangles and the radius 6 mm: 4837.33 of both together is 4047.05 + 790.28.
    has_volume(&report, FULL_BALL - 790.28);
    assert!(mesh.distance([0.0; 3]) > 5.0 * MM && mesh.distance([8.0 * MM, 0.0, 0.0]) < -MM);
}

#[test]
fn parts_that_cross_are_joined() {
    let (mesh, report) = report("two-boxes-crossing.stl");
    assert!(report.winding && report.crossings.pairs > 0, "{report:?}");
    let doubt =
        format!("it meets itself: {} pairs of triangles cross or touch, first at (", report.crossings.pairs);
    assert!(report.doubts("m")[0].starts_with(&doubt), "{:?}", report.doubts("m"));
    let inside = |x: Point| {
        let [x, y, z] = x.map(|c| c / MM);
        let one = x.abs() < 10.0 && y.abs() < 5.0 && z.abs() < 5.0;
        one || ((x - 5.0).abs() < 5.0 && (y - 2.0).abs() < 5.0 && (z - 5.0).abs() < 10.0)
    };
    for x in grid(16.0 * MM, 30) {
        assert_eq!(mesh.distance(x) < 0.0, inside(x), "{x:?}");
    }
}

#[test]
fn a_pipe_without_ends_gets_flat_ones_and_a_warning() {
    let (mesh, report) = report("pipe-without-ends.stl");
    assert_eq!((report.mended.holes.len(), report.mended.large_holes(report.area)), (2, 2));
    assert!(
        report.winding
            && report.doubts("m")[0].contains("2 so large that the body is what the caps make of it")
    );
    // The axis of a PyVista cylinder is x. A prism over a polygon of 24 corners.
    has_volume(&report, 20.0 * 12.0 * 25.0 * (std::f64::consts::TAU / 24.0).sin());
    assert!(mesh.distance([9.9 * MM, 0.0, 0.0]) < 0.0 && mesh.distance([10.1 * MM, 0.0, 0.0]) > 0.0);
}

#[test]
fn text_with_poles_and_seams_is_closed() {
    let (mesh, format) =
        Mesh::read(&file("superellipsoid.ascii.stl"), "superellipsoid.ascii.stl", MM).expect("text");
    assert_eq!(format, MeshFormat::StlText);
    let report = mesh.report();
    assert!(report.is_closed() && report.mended.degenerate > 0, "{report:?}");
    has_volume(&report, 1063.99);
}

#[test]
fn surfaces_without_inside_are_refused() {
    assert!(
        matches!(read("moebius.stl"), Err(MeshError::OneSided(edges)) if edges > 0),
        "{:?}",
        read("moebius.stl")
    );
    assert_eq!(read("sheet.stl"), Err(MeshError::Flat { triangles: 32 }));
}

#[test]
fn the_thinnest_part_is_found() {
    for (name, thickness) in [("plate-with-bores.stl", 1.5), ("tube.obj", 2.0)] {
        let thin = report(name).1.thinnest.expect(name).thickness / MM;
        // The wall of the tube is that between polygons of 32 corners: cos(pi/32) = 0.995 of it.
        assert!((0.99 * thickness..1.000_001 * thickness).contains(&thin), "{name}: {thin} mm");
    }
}

#[test]
fn particles_fill_a_mesh_as_they_fill_the_shape() {
    let spacing = 0.5 * MM;
    for name in ["plate-with-bores.stl", "tube.obj", "ball-with-holes.stl", "two-boxes-crossing.stl"] {
        let (mesh, report) = report(name);
        let points =
            fill(&Shape::Mesh(mesh.clone()), &Fill::Lattice { origin: [0.0; 3] }, spacing, Dimension::Three)
                .expect(name);
        // Only cells that the surface cuts are counted wrongly, half a cell each at most (see the shapes' own test). Where
        // parts overlap the volume by triangles counts them twice.
        let overlap = if report.winding { 10.0 * 8.0 * 10.0 * MM.powi(3) } else { 0.0 };
        let error = (points.total_volume() - report.volume + overlap).abs();
        assert!(error < 0.5 * report.area * spacing, "{name}: {error}");
        assert!(points.x.iter().all(|&x| mesh.distance(x) <= 1e-6 * spacing));
    }
}

#[test]
fn a_mesh_is_of_space() {
    let mesh = Shape::Mesh(read("tube.obj").expect("a tube"));
    let told = mesh.validate(Dimension::Two).unwrap_err().to_string();
    assert_eq!(told, "mesh: a mesh of triangles exists in 3D only; in 2D draw its section as a polygon");
    assert!(mesh.validate(Dimension::Three).is_ok());
}
