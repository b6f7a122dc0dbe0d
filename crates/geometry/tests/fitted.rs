//! Particles that fit a body: what must hold of them.

use Dimension::{Three, Two};
use geometry::{Dimension, Fill, FillError, Fit, Point, Shape, fill, fit};

fn rectangle(min: [f64; 2], max: [f64; 2]) -> Shape {
    Shape::Box { min: [min[0], min[1], 0.0], max: [max[0], max[1], 0.0] }
}

fn turned(shape: Shape, axis: Point) -> Shape {
    Shape::Rotate { angle: 0.3, axis, about: [0.0; 3], shape: Box::new(shape) }
}

/// Round, sharp, hollow, with a hole, of parts that touch.
fn bodies() -> Vec<(Shape, f64, Dimension)> {
    let z = [0.0, 0.0, 1.0];
    let ring = Shape::Ring { center: [0.0; 3], inner: 0.3, outer: 0.4 };
    let hole = Shape::Ball { center: [0.5, 0.5, 0.0], radius: 0.23 };
    let plate = Shape::Difference(Box::new(rectangle([0.0; 2], [1.0; 2])), vec![hole]);
    let halves = Shape::Union(vec![rectangle([0.0; 2], [0.5, 0.6]), rectangle([0.5, 0.0], [1.0, 0.6])]);
    let cylinder = Shape::Cylinder { from: [0.0; 3], to: [0.0, 0.0, 1.0], radius: 0.5 };
    let brick = Shape::Box { min: [0.0; 3], max: [1.0, 0.7, 0.5] };
    let hollow = Shape::Ring { center: [0.0; 3], inner: 0.4, outer: 0.7 };
    vec![
        (turned(rectangle([0.0; 2], [1.0, 0.6]), z), 0.05, Two),
        (ring, 0.02, Two),
        (plate, 0.05, Two),
        (turned(halves, z), 0.05, Two),
        (cylinder, 0.1, Three),
        (turned(brick, [0.3, 0.5, 1.0]), 0.1, Three),
        (hollow, 0.1, Three),
    ]
}

#[test]
fn fitted_particles_are_better_than_a_lattice_in_all_that_is_measured() {
    for (shape, spacing, dimension) in bodies() {
        let Fit { points, quality, lattice, at_rest, .. } = fit(&shape, spacing, dimension).unwrap();
        let told = format!("{} {quality:?} {lattice:?}", shape.name());
        assert!(at_rest, "{told}");
        // At rest means 2e-3 over all; the lattices have 0.01 to 0.1.
        assert!(quality.interior < 3e-3 && quality.interior < 0.35 * lattice.interior, "{told}");
        assert!(quality.residual < 0.5 * lattice.residual, "{told}");
        // The surface is where it belongs to a twentieth of a spacing, as root mean square; on edges of the plane that the kernel
        // rounds off particles stay up to a third of a spacing behind.
        assert!(quality.surface < 0.05 && quality.surface_max < 0.35, "{told}");
        assert!(quality.surface < 0.35 * lattice.surface, "{told}");
        assert!(quality.spacing_min > 0.8 && quality.thin == 0, "{told}");
        // Sums of some thousand equal numbers.
        assert!(quality.volume_error.abs() < 1e-11, "{told}");
        // One particle more or less, and what cells of half a spacing know of the volume.
        assert!(quality.count_error.abs() < 1e-3 + 1.0 / points.len() as f64, "{told}");
    }
}

#[test]
fn a_box_of_whole_spacings_keeps_its_lattice() {
    let brick = Shape::Box { min: [0.2, 0.1, 0.0], max: [1.2, 0.8, 0.5] };
    let fitted = fill(&brick, &Fill::Fitted, 0.1, Three).unwrap();
    let lattice = fill(&brick, &Fill::Lattice { origin: [0.0; 3] }, 0.1, Three).unwrap();
    assert_eq!(fitted.len(), lattice.len());
    for x in &fitted.x {
        let gap = |y: &Point| (0..3).map(|i| (x[i] - y[i]).powi(2)).sum::<f64>().sqrt();
        let nearest = lattice.x.iter().map(gap).fold(f64::INFINITY, f64::min);
        // What sums over a lattice and integrals over the outside differ by moves the second layer.
        assert!(nearest < 0.02 * 0.1, "{nearest}");
    }
}

#[test]
fn walls_thinner_than_their_spacings_are_kept_whole() {
    for (thickness, dimension) in [(0.06, Three), (0.15, Three), (0.25, Three), (0.13, Two)] {
        // A sheet that lies askew to everything.
        let (min, max) = ([0.0, 0.0, 0.0], [2.0, if dimension == Two { thickness } else { 1.0 }, 0.0]);
        let flat = if dimension == Two {
            turned(Shape::Box { min, max }, [0.0, 0.0, 1.0])
        } else {
            turned(Shape::Box { min, max: [max[0], max[1], thickness] }, [0.3, 0.5, 1.0])
        };
        let dp = 0.1;
        let Fit { points, quality, .. } = fit(&flat, dp, dimension).unwrap();
        assert!(points.x.iter().all(|&x| flat.contains(x)), "{thickness}");
        // Of two sheets that are closer than a spacing some particles face each other.
        let least = if thickness > dp { (thickness / dp - 1.0).min(0.6) } else { 0.6 };
        assert!(quality.spacing_min > 0.99 * least, "{thickness} {quality:?}");
        assert!(quality.count_error.abs() < 0.01, "{thickness} {quality:?}");
        // No hole: a body of thickness t has one particle for every dp^2/(t/dp); a gap is less than twice what these are apart.
        let apart = dp * (dp / thickness).max(1.0).powf(1.0 / (dimension.axes() as f64 - 1.0));
        for (i, j) in (1..20).flat_map(|i| (1..10).map(move |j| (i, j))) {
            let middle = if dimension == Two {
                [0.1 * f64::from(i), 0.5 * thickness, 0.0]
            } else {
                [0.1 * f64::from(i), 0.1 * f64::from(j), 0.5 * thickness]
            };
            // Where the rotation takes it is found by the distance of a ball turned alike.
            let at = |x: Point| {
                let axis = if dimension == Two { [0.0, 0.0, 1.0] } else { [0.3, 0.5, 1.0] };
                turned(Shape::Ball { center: middle, radius: apart }, axis).contains(x)
            };
            assert!(points.x.iter().any(|&x| at(x)), "a hole at {middle:?} of {thickness}");
        }
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let ball = Shape::Ball { center: [0.1, 0.2, 0.3], radius: 0.5 };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| fit(&ball, 0.07, Three).unwrap())
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}

#[test]
fn what_cannot_be_fitted_says_why() {
    let speck = rectangle([0.0; 2], [0.1, 0.1]);
    assert!(matches!(fit(&speck, 1.0, Two), Err(FillError::Empty { .. })));
    assert!(matches!(fit(&speck, 1e-9, Two), Err(FillError::TooMany { .. })));
    assert!(matches!(fit(&speck, f64::NAN, Two), Err(FillError::Spacing(_))));
    let far = Shape::Translate { by: [1e12, 0.0, 0.0], shape: Box::new(speck) };
    assert!(matches!(fit(&far, 0.01, Two), Err(FillError::TooFar { .. })));
    let nothing =
        Shape::Difference(Box::new(rectangle([0.0; 2], [1.0; 2])), vec![rectangle([-1.0; 2], [2.0; 2])]);
    assert!(matches!(fit(&nothing, 0.1, Two), Err(FillError::Empty { .. })));
}
