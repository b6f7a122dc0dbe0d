//! What must hold for every shape, on random ones.

use geometry::{Dimension, Fill, MAX_PARTICLES, Point, Shape, Stent, fill};
use proptest::prelude::*;
use std::f64::consts::PI;

/// Coordinates and sizes below are of order 10; the longest chain of motions here loses a few hundred roundings of
/// 1e-16 times that.
const ROUNDING: f64 = 1e-12;

fn point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(-4.0..4.0)
}

fn gap(a: Point, b: Point) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// A star around the origin: simple, and not convex for most radii.
fn star() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(0.5..2.0, 3..9).prop_map(|radii| {
        let step = 2.0 * PI / radii.len() as f64;
        radii
            .iter()
            .enumerate()
            .map(|(i, r)| [r * (step * i as f64).cos(), r * (step * i as f64).sin()])
            .collect()
    })
}

fn stent() -> impl Strategy<Value = Shape> {
    let share = || 0.1..0.9;
    let cells = (2..9_usize, 1..5_usize);
    (0.5..6.0, 1.0..4.0, share(), cells, share(), share()).prop_map(
        |(length, diameter, wall, (around, along), strut, bridge): (f64, f64, f64, _, f64, f64)| {
            // Shares of the room that is left, in the order in which it is taken.
            let thickness = 0.2 * wall * diameter;
            let half: f64 = 0.5 * PI * (diameter - thickness) / around as f64;
            let strut = 0.3 * strut * half.min(length / (2 * along) as f64);
            let bridge = 0.5 * bridge * (length - strut) / (2 * along) as f64;
            Shape::Stent(Stent { length, diameter, thickness, around, along, strut, bridge })
        },
    )
}

fn primitive() -> impl Strategy<Value = Shape> {
    let size = || 0.1..3.0;
    prop_oneof![
        (point(), prop::array::uniform3(size()))
            .prop_map(|(min, l)| Shape::Box { min, max: [min[0] + l[0], min[1] + l[1], min[2] + l[2]] }),
        (point(), size()).prop_map(|(center, radius)| Shape::Ball { center, radius }),
        (point(), size(), size()).prop_map(|(center, r, w)| Shape::Ring { center, inner: r, outer: r + w }),
        (point(), point(), size()).prop_map(|(from, to, radius)| Shape::Cylinder { from, to, radius }),
        (star(), -2.0..2.0, size())
            .prop_map(|(points, z, h)| Shape::Polygon { points, height: Some([z, z + h]) }),
    ]
}

fn motion(shape: impl Strategy<Value = Shape>) -> impl Strategy<Value = Shape> {
    (shape, point(), point(), -7.0..7.0, 0.2..3.0, 0..3).prop_map(|(shape, a, b, angle, factor, kind)| {
        let shape = Box::new(shape);
        match kind {
            0 => Shape::Translate { by: a, shape },
            1 => Shape::Rotate { angle, axis: a, about: b, shape },
            _ => Shape::Scale { factor, about: a, shape },
        }
    })
}

fn any_shape() -> impl Strategy<Value = Shape> {
    let leaf = prop_oneof![primitive(), motion(primitive()), stent()];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let list = prop::collection::vec(inner.clone(), 1..3);
        prop_oneof![
            list.clone().prop_map(Shape::Union),
            list.clone().prop_map(Shape::Intersection),
            (inner.clone(), list).prop_map(|(first, cuts)| Shape::Difference(Box::new(first), cuts)),
            motion(inner),
        ]
    })
}

fn garbage() -> impl Strategy<Value = Shape> {
    let number = prop_oneof![
        Just(0.0),
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::MAX),
        Just(-f64::MAX),
        Just(f64::MIN_POSITIVE),
        Just(1.0),
        any::<f64>(),
    ]
    .boxed();
    let place = prop::array::uniform3(number.clone()).boxed();
    let corners = prop::collection::vec(prop::array::uniform2(number.clone()), 0..6);
    let leaf = prop_oneof![
        (place.clone(), place.clone()).prop_map(|(min, max)| Shape::Box { min, max }),
        (place.clone(), number.clone()).prop_map(|(center, radius)| Shape::Ball { center, radius }),
        (place.clone(), number.clone(), number.clone()).prop_map(|(center, inner, outer)| Shape::Ring {
            center,
            inner,
            outer
        }),
        (place.clone(), place.clone(), number.clone()).prop_map(|(from, to, radius)| Shape::Cylinder {
            from,
            to,
            radius
        }),
        (corners, prop::option::of(prop::array::uniform2(number.clone())))
            .prop_map(|(points, height)| Shape::Polygon { points, height }),
    ];
    leaf.prop_recursive(3, 8, 3, move |inner| {
        let list = prop::collection::vec(inner.clone(), 0..3);
        prop_oneof![
            list.clone().prop_map(Shape::Union),
            list.clone().prop_map(Shape::Intersection),
            (inner.clone(), list).prop_map(|(first, cuts)| Shape::Difference(Box::new(first), cuts)),
            (place.clone(), inner.clone()).prop_map(|(by, s)| Shape::Translate { by, shape: Box::new(s) }),
            (number.clone(), place.clone(), place.clone(), inner.clone()).prop_map(
                |(angle, axis, about, s)| { Shape::Rotate { angle, axis, about, shape: Box::new(s) } }
            ),
            (number.clone(), place.clone(), inner).prop_map(|(factor, about, s)| Shape::Scale {
                factor,
                about,
                shape: Box::new(s)
            }),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn distance_changes_no_faster_than_the_way(shape in any_shape(), a in point(), b in point()) {
        prop_assert!(shape.validate(Dimension::Three).is_ok());
        prop_assert!((shape.distance(a) - shape.distance(b)).abs() <= gap(a, b) + ROUNDING);
    }

    #[test]
    fn a_ball_of_the_distance_does_not_cross_the_boundary(
        shape in any_shape(), a in point(), way in point(), share in 0.0..0.999
    ) {
        let d = shape.distance(a);
        let length = gap(way, [0.0; 3]);
        prop_assume!(d.abs() > 1e-6 && length > 1e-6);
        let b = std::array::from_fn(|i| a[i] + way[i] / length * d.abs() * share);
        prop_assert_eq!(shape.contains(a), d < 0.0);
        prop_assert_eq!(shape.contains(b), d < 0.0);
    }

    #[test]
    fn distance_of_a_primitive_is_reached(shape in primitive(), a in point()) {
        // the nearest point of the boundary lies downhill: walk there along the numerical gradient
        let d = shape.distance(a);
        let e = 1e-6;
        let slope: Point = std::array::from_fn(|i| {
            let at = |s: f64| { let mut x = a; x[i] += s; shape.distance(x) };
            (at(e) - at(-e)) / (2.0 * e)
        });
        // next to a ridge, where two points are nearest, the difference quotient means nothing
        prop_assume!((gap(slope, [0.0; 3]) - 1.0).abs() < 1e-9 && d.abs() > 1e-3);
        let foot: Point = std::array::from_fn(|i| a[i] - d * slope[i]);
        // central differences: rounding 1e-15/e and curvature e^2/d^2 leave 1e-6 of the direction
        prop_assert!(shape.distance(foot).abs() < 1e-5, "{} from {}", shape.distance(foot), d);
    }

    #[test]
    fn bounds_hold_what_is_inside(shape in any_shape(), a in point()) {
        let mut bounds = shape.bounds();
        bounds.min = bounds.min.map(|x| x - ROUNDING);
        bounds.max = bounds.max.map(|x| x + ROUNDING);
        prop_assert!(!shape.contains(a) || bounds.contains(a));
    }

    #[test]
    fn a_move_there_and_back_changes_nothing(
        shape in any_shape(), by in point(), about in point(), angle in -7.0..7.0, x in point()
    ) {
        let d = shape.distance(x);
        let back = by.map(|c| -c);
        let boxed = |s| Box::new(s);
        let moved = Shape::Translate { by, shape: boxed(shape.clone()) };
        let moved = Shape::Translate { by: back, shape: boxed(moved) };
        prop_assert!((moved.distance(x) - d).abs() <= ROUNDING);
        let turned = Shape::Rotate { angle, axis: by, about, shape: boxed(shape.clone()) };
        let turned = Shape::Rotate { angle, axis: back, about, shape: boxed(turned) };
        prop_assert!((turned.distance(x) - d).abs() <= ROUNDING);
        let scaled = Shape::Scale { factor: 0.7, about, shape: boxed(shape) };
        let scaled = Shape::Scale { factor: 1.0 / 0.7, about, shape: boxed(scaled) };
        prop_assert!((scaled.distance(x) - d).abs() <= ROUNDING);
    }

    #[test]
    fn garbage_never_panics(shape in garbage(), x in point(), spacing in any::<f64>(), origin in point()) {
        for dimension in [Dimension::Two, Dimension::Three] {
            let valid = shape.validate(dimension).is_ok();
            let _ = (shape.distance(x), shape.contains(x), shape.bounds());
            // a spacing that a valid shape could really be filled with would take long, and is not garbage
            let spacing = if valid { spacing.abs().min(1e-300) } else { spacing };
            for how in [Fill::Lattice { origin }, Fill::Concentric, Fill::Fitted] {
                let filled = fill(&shape, &how, spacing, dimension);
                prop_assert!(filled.is_err() || valid && filled.unwrap().len() <= MAX_PARTICLES);
            }
        }
    }
}

/// A shape of known volume and boundary (area and perimeter in 2D).
struct Known {
    shape: Shape,
    volume: f64,
    surface: f64,
    dimension: Dimension,
}

fn known() -> Vec<Known> {
    use Dimension::{Three, Two};
    let ring = Shape::Ring { center: [0.1, 0.2, 0.0], inner: 0.5, outer: 1.0 };
    let ball = Shape::Ball { center: [0.1, 0.2, 0.0], radius: 1.0 };
    let cylinder = Shape::Cylinder { from: [0.0; 3], to: [1.0, 2.0, 2.0], radius: 0.5 };
    let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let polygon = Shape::Polygon { points: points.clone(), height: None };
    let turned =
        Shape::Rotate { angle: 0.4, axis: [0.0, 0.0, 1.0], about: [0.3, 0.3, 0.0], shape: Box::new(polygon) };
    let prism = Shape::Polygon { points, height: Some([-0.3, 0.7]) };
    let known = |shape, volume, surface, dimension| Known { shape, volume, surface, dimension };
    vec![
        known(ball.clone(), PI, 2.0 * PI, Two),
        known(ball, 4.0 / 3.0 * PI, 4.0 * PI, Three),
        known(ring.clone(), PI * 0.75, 3.0 * PI, Two),
        known(ring, 4.0 / 3.0 * PI * 0.875, 5.0 * PI, Three),
        known(cylinder, 3.0 * PI * 0.25, 3.0 * PI + PI * 0.5, Three),
        known(turned, 3.0, 8.0, Two),
        known(prism, 3.0, 8.0 + 6.0, Three),
    ]
}

#[test]
fn lattice_volumes_converge_to_the_exact_ones() {
    for Known { shape, volume, surface, dimension } in known() {
        for spacing in [0.2, 0.1, 0.05, 0.025] {
            let points = fill(&shape, &Fill::Lattice { origin: [0.0; 3] }, spacing, dimension).unwrap();
            // only cells that the boundary cuts can be counted wrongly; of those at most half a cell each is wrong
            // on average, and the boundary cuts about surface/spacing^(d-1) of them: half of surface * spacing
            let bound = 0.5 * surface * spacing;
            let error = (points.total_volume() - volume).abs();
            assert!(error <= bound, "{} at {spacing}: {error} > {bound}", shape.name());
        }
    }
}
