//! Particles fitted to meshes that other programs made (tests/meshes/README.md): with holes, flipped faces, thin parts, parts that overlap.

use geometry::{Dimension, Fit, Mesh, Shape, fit};
use std::path::Path;

const MM: f64 = 1e-3;

fn mesh(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes").join(name);
    Mesh::read(&std::fs::read(path).expect(name), name, MM).expect(name).0
}

fn fitted(shape: &Shape) -> Fit {
    fit(shape, MM, Dimension::Three).expect("particles")
}

#[test]
fn what_is_left_of_odd_meshes_is_filled_well() {
    for name in [
        "plate-with-bores.stl",
        "tube.obj",
        "ball-with-holes.stl",
        "capsule-flipped.stl",
        "hollow-ball-both-outwards.obj",
        "two-boxes-crossing.stl",
    ] {
        let mesh = mesh(name);
        let Fit { points, quality, lattice, .. } = fitted(&Shape::Mesh(mesh.clone()));
        let told = format!("{name}: {} particles, {quality:?}, lattice {lattice:?}", points.len());
        println!("{told}");
        assert!(points.x.iter().all(|&x| mesh.distance(x) < 0.0), "{told}");
        // Sums of some thousand equal numbers; one particle more or less, and what cells of half a spacing know of the volume.
        assert!(quality.volume_error.abs() < 1e-11, "{told}");
        assert!(quality.count_error.abs() < 1e-3 + 1.0 / points.len() as f64, "{told}");
        // As for drawn shapes (tests/fitted.rs). The plate and the tube have no inside: they are 1.5 and 2 spacings thick.
        assert!(quality.interior <= 0.35 * lattice.interior, "{told}");
        assert!(quality.surface < 0.05 && quality.surface < 0.35 * lattice.surface.max(0.05), "{told}");
        // In the plate sheets are half a spacing apart.
        assert!(quality.spacing_min > 0.5 && quality.thin == 0, "{told}");
    }
}

#[test]
fn walls_that_lie_inside_of_a_mesh_are_none() {
    let brick =
        |min: [f64; 3], max: [f64; 3]| Shape::Box { min: min.map(|c| c * MM), max: max.map(|c| c * MM) };
    let drawn = Shape::Union(vec![
        brick([-10.0, -5.0, -5.0], [10.0, 5.0, 5.0]),
        brick([0.0, -3.0, -5.0], [10.0, 7.0, 15.0]),
    ]);
    let (of_mesh, of_boxes) = (fitted(&Shape::Mesh(mesh("two-boxes-crossing.stl"))), fitted(&drawn));
    let (got, expected) = (of_mesh.quality, of_boxes.quality);
    // 2000 and 2000 cubes, of which 800 are common.
    assert_eq!((of_mesh.points.len(), of_boxes.points.len()), (3200, 3200));
    assert_eq!(got.at_surface, expected.at_surface);
    // Both know the same walls, by other roundings.
    for (got, expected) in [
        (got.interior, expected.interior),
        (got.surface, expected.surface),
        (got.spacing_min, expected.spacing_min),
    ] {
        assert!((got - expected).abs() < 1e-6, "{got} for {expected}");
    }
}
