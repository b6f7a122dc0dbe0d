//! The measures on states whose disorder is known.

use std::f64::consts::{PI, TAU};

use super::{Disorder, DisorderError, Reference};
use crate::neighbours::{SearchError, sample};

const SUPPORT: f64 = 2.6;

/// The reference of one body with unit spacing.
fn reference<const D: usize>(x0: &[Vec<f64>; D]) -> Reference<D> {
    let n = x0[0].len();
    Reference::new(sample::slices(x0), &vec![0; n], &vec![1.0; n], SUPPORT).unwrap()
}

/// The set `x0` with every particle moved to `place` of where it was.
fn moved<const D: usize>(x0: &[Vec<f64>; D], place: impl Fn([f64; D]) -> [f64; D]) -> [Vec<f64>; D] {
    let mut x = x0.clone();
    for i in 0..x0[0].len() {
        let to = place(std::array::from_fn(|axis| x0[axis][i]));
        (0..D).for_each(|axis| x[axis][i] = to[axis]);
    }
    x
}

fn measure<const D: usize>(x0: &[Vec<f64>; D], x: &[Vec<f64>; D]) -> Disorder {
    reference(x0).measure(sample::slices(x)).unwrap()
}

/// Zigzags of the particles at least `depth` inside the box that `x0` fills.
fn zigzags_inside<const D: usize>(x0: &[Vec<f64>; D], x: &[Vec<f64>; D], depth: f64) -> Vec<f64> {
    let mut field = vec![f64::NAN; x0[0].len()];
    reference(x0).zigzag_field(sample::slices(x), &mut field).unwrap();
    let high: [f64; D] = std::array::from_fn(|axis| x0[axis].iter().copied().fold(0.0, f64::max));
    let inside = |i: usize| (0..D).all(|axis| (depth..=high[axis] - depth).contains(&x0[axis][i]));
    let values: Vec<f64> = (0..field.len()).filter(|&i| inside(i)).map(|i| field[i]).collect();
    assert!(!values.is_empty());
    values
}

/// Where the neighbours of a particle's nearest neighbours lie on all sides.
const DEEP: f64 = 4.0;

/// Every mode that alternates along some of the axes, in every direction of displacement.
fn alternating_modes<const D: usize>(count: [usize; D]) {
    let x0 = sample::lattice(count, 1.0);
    let amplitude = 0.01;
    for mode in 1..1_usize << D {
        for direction in 0..D {
            let x = moved(&x0, |mut x| {
                let turns: f64 = (0..D).filter(|axis| mode >> axis & 1 == 1).map(|axis| x[axis]).sum();
                x[direction] += amplitude * if turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
                x
            });
            let expected = amplitude * f64::from(mode.count_ones()) / D as f64;
            for zigzag in zigzags_inside(&x0, &x, DEEP) {
                // Roundings of coordinates up to 12.
                assert!((zigzag - expected).abs() < 1e-14, "mode {mode:b}: {zigzag} for {expected}");
            }
            let all = measure(&x0, &x);
            // One-sided fits beside the surface see part of the mode as gradient.
            assert!((all.zigzag_rms / expected - 1.0).abs() < 0.2, "mode {mode:b}: {all:?}");
            assert!(all.zigzag_99 >= all.zigzag_rms && all.zigzag_max >= all.zigzag_99);
            assert_eq!((all.broken, all.pieces), (0.0, 1));
        }
    }
}

#[test]
fn every_alternating_mode_has_the_amplitude_it_should() {
    alternating_modes([12, 11]);
    alternating_modes([10, 11, 10]);
}

#[test]
fn linear_fields_have_no_zigzag_and_break_nothing() {
    let x0 = sample::lattice([9, 8, 7], 1.0);
    let x = moved(&x0, |[x, y, z]| [1.2 * x - 0.3 * y + 5.0, 0.1 * x + 0.7 * y + 0.4 * z, 3.0 * z - y]);
    let result = measure(&x0, &x);
    // Roundings of coordinates up to 20, added up over some 80 neighbours.
    assert!(result.zigzag_max < 1e-13, "{result:?}");
    assert_eq!((result.broken, result.pieces), (0.0, 1));
}

#[test]
fn linear_fields_have_no_zigzag_on_irregular_sets() {
    let noise = sample::random::<2>(400, 2);
    let mut x0 = sample::lattice([20, 20], 1.0);
    for axis in 0..2 {
        x0[axis].iter_mut().zip(&noise[axis]).for_each(|(x, noise)| *x += 0.1 * noise);
    }
    let result = measure(&x0, &moved(&x0, |[x, y]| [1.3 * x + 0.5 * y, 0.9 * y - 0.5 * x]));
    assert!(result.zigzag_max < 1e-13, "roundings of coordinates up to 40: {result:?}");
    assert!((0..400).filter(|&i| reference(&x0).has_full_shell(i)).count() > 200);
}

#[test]
fn quadratic_fields_have_no_zigzag_away_from_the_surface() {
    let x0 = sample::lattice([12, 12], 1.0);
    let bent = |[x, y]: [f64; 2]| [x + 0.01 * x * y - 0.02 * y * y, y + 0.03 * x * x + 0.01 * y * y];
    let x = moved(&x0, bent);
    // Roundings of coordinates up to 20.
    assert!(zigzags_inside(&x0, &x, DEEP).iter().all(|&zigzag| zigzag < 1e-13));
    // The one-sided fit at a surface errs by some 0.75 u'' dp, an eighth of which reaches the layer inside
    // as a step, that is a sixteenth as a zigzag, from each of at most two sides.
    assert!(measure(&x0, &x).zigzag_max < 0.06 * 2.0 * 0.75 / 16.0, "{:?}", measure(&x0, &x));
}

#[test]
fn rotations_have_no_disorder() {
    let x0 = sample::lattice([15, 10], 1.0);
    for angle in [0.3, 2.0, PI] {
        let (sin, cos) = f64::sin_cos(angle);
        let result = measure(&x0, &moved(&x0, |[x, y]| [cos * x - sin * y, sin * x + cos * y]));
        assert!(result.zigzag_max < 1e-13, "roundings of coordinates up to 20: {result:?}");
        assert!((result.bond_min - 1.0).abs() < 1e-14 && (result.spacing_min - 1.0).abs() < 1e-14);
        assert_eq!((result.broken, result.pieces), (0.0, 1));
    }
}

#[test]
fn a_uniform_stretch_is_not_broken() {
    let x0 = sample::lattice([10, 10], 1.0);
    let result = measure(&x0, &moved(&x0, |[x, y]| [3.0 * x, y / 3.0]));
    assert_eq!((result.broken, result.pieces), (0.0, 1));
    assert!((result.bond_min - 1.0 / 3.0).abs() < 1e-14, "roundings of coordinates up to 3");
}

#[test]
fn a_torn_body_has_its_torn_bonds_and_pieces() {
    let x0 = sample::lattice([12, 8], 1.0);
    let result = measure(&x0, &moved(&x0, |[x, y]| [if x < 5.5 { x } else { x + 6.0 }, y]));
    // 8 bonds cross the gap; 11 x 8 lie along x and 12 x 7 along y.
    assert_eq!((result.broken, result.pieces), (8.0 / (11.0 * 8.0 + 12.0 * 7.0), 2));
    let loose = measure(&x0, &moved(&x0, |[x, y]| if (x, y) == (0.0, 0.0) { [-9.0, -9.0] } else { [x, y] }));
    assert_eq!(loose.pieces, 2);
}

#[test]
fn two_bodies_are_two_pieces_and_may_come_close() {
    let [x, y] = sample::lattice([10, 6], 1.0);
    let body: Vec<u32> = x.iter().map(|&x| u32::from(x > 4.5)).collect();
    let mut reference = Reference::new([&x, &y], &body, &[1.0; 60], SUPPORT).unwrap();
    let near: Vec<f64> = x.iter().map(|&x| if x > 4.5 { x - 0.75 } else { x }).collect();
    let result = reference.measure([&near, &y]).unwrap();
    assert_eq!((result.bond_min, result.spacing_min), (1.0, 0.25));
    assert!(result.zigzag_max < 1e-14, "each body moved rigidly: {result:?}");
    assert_eq!((result.broken, result.pieces), (0.0, 2));
    assert_eq!(reference.bonds().len(), 2 * (4 * 6 + 5 * 5));
    assert!((0..60).all(|i| reference.has_full_shell(i) == (x[i] % 5.0 % 4.0 > 0.0 && y[i] % 5.0 > 0.0)));
}

/// A ring of ten concentric layers, odd ones shifted by half a spacing, and the layer of each particle.
fn ring() -> ([Vec<f64>; 2], Vec<usize>) {
    let (mut x, mut layers) = ([vec![], vec![]], vec![]);
    for layer in 0..10 {
        let radius = 30.5 + layer as f64;
        let count = (TAU * radius).round();
        for k in 0..count as usize {
            let angle = (k as f64 + 0.5 * (layer % 2) as f64) * TAU / count;
            x[0].push(radius * angle.cos());
            x[1].push(radius * angle.sin());
            layers.push(layer);
        }
    }
    (x, layers)
}

#[test]
fn rings_count_all_but_the_two_surface_layers() {
    let (x0, layers) = ring();
    let reference = reference(&x0);
    for (i, &layer) in layers.iter().enumerate() {
        assert_eq!(reference.has_full_shell(i), (1..9).contains(&layer), "particle {i} of layer {layer}");
    }
}

#[test]
fn rings_tell_smooth_from_alternating() {
    let (x0, layers) = ring();
    let amplitude = 0.05;
    // Into an ellipse whose wall thickens and thins around it: strains of 0.2 over the circumference.
    let smooth = measure(&x0, &moved(&x0, |[x, y]| [1.2 * x + 1e-4 * x * y * y, 0.85 * y - 1e-3 * x * x]));
    let mut x = x0.clone();
    for (i, &layer) in layers.iter().enumerate() {
        let factor = 1.0 + amplitude * if layer % 2 == 0 { 1.0 } else { -1.0 } / x0[0][i].hypot(x0[1][i]);
        x[0][i] *= factor;
        x[1][i] *= factor;
    }
    let zigzag = measure(&x0, &x);
    // Two or so neighbours of four or five lie in other layers: about half the amplitude.
    assert!((0.4..0.65).contains(&(zigzag.zigzag_rms / amplitude)), "{zigzag:?}");
    // Second derivatives of up to 0.006 / dp, times the few hundredths of dp by which F of a set that is not a
    // lattice (and of the surface layers) errs on them.
    assert!(smooth.zigzag_rms < 2e-4 && smooth.zigzag_rms < 0.01 * zigzag.zigzag_rms, "{smooth:?}");
}

#[test]
fn the_same_for_any_number_of_threads_and_again() {
    let x0 = sample::lattice([17, 16, 15], 1.0);
    let noise = sample::random::<3>(x0[0].len(), 8);
    let x: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        x0[axis].iter().zip(&noise[axis]).map(|(x, noise)| 1.1 * x + noise).collect()
    });
    let one = sample::on_threads(1, || measure(&x0, &x));
    assert!(one.broken > 0.0 && one.zigzag_rms > 0.1, "the state should be disordered: {one:?}");
    for threads in 1..=3 {
        let again = sample::on_threads(threads, || {
            let mut reference = reference(&x0);
            reference.measure(sample::slices(&noise)).unwrap();
            reference.measure(sample::slices(&x)).unwrap()
        });
        assert_eq!(again, one, "{threads} threads");
    }
}

#[test]
fn spacings_scale_every_measure() {
    let x0 = sample::lattice([8, 8], 1.0);
    let x = moved(&x0, |[x, y]| [x + 0.03 * (x * PI).cos(), 0.9 * y + 0.01 * x * y]);
    let large = measure(&x0, &x);
    let small = |set: &[Vec<f64>; 2]| moved(set, |x| x.map(|x| x / 1024.0));
    let (x0, x) = (small(&x0), small(&x));
    let mut reference =
        Reference::new(sample::slices(&x0), &[7; 64], &[1.0 / 1024.0; 64], SUPPORT / 1024.0).unwrap();
    // A power of two: no rounding differs.
    assert_eq!(reference.measure(sample::slices(&x)).unwrap(), large);
}

#[test]
fn few_particles() {
    let mut none = Reference::<2>::new([&[], &[]], &[], &[], 1.0).unwrap();
    let result = none.measure([&[], &[]]).unwrap();
    assert!(result.zigzag_rms.is_nan() && result.bond_min.is_infinite());
    assert_eq!((result.broken, result.pieces), (0.0, 0));
    let mut one = Reference::new([&[1.0], &[2.0], &[3.0]], &[0], &[0.1], 1.0).unwrap();
    let result = one.measure([&[4.0], &[5.0], &[6.0]]).unwrap();
    assert_eq!((result.spacing_min, result.pieces), (f64::INFINITY, 1));
}

#[test]
fn refuses_what_cannot_be_measured() {
    let x0 = [[0.0, 1.0].as_slice(), &[0.0, 0.0]];
    let new = |body: &[u32], dp: &[f64], support| Reference::new(x0, body, dp, support).map(|_| ());
    assert_eq!(new(&[0; 2], &[1.0, 0.0], 2.6), Err(DisorderError::Spacing { particle: 1, value: 0.0 }));
    assert!(matches!(new(&[0; 3], &[1.0; 2], 2.6), Err(DisorderError::Length { found: 3, expected: 2, .. })));
    assert!(matches!(new(&[0; 2], &[1.0; 1], 2.6), Err(DisorderError::Length { found: 1, .. })));
    assert_eq!(new(&[0; 2], &[1.0; 2], -1.0), Err(DisorderError::Search(SearchError::Radius(-1.0))));
    let mut reference = Reference::new(x0, &[0; 2], &[1.0; 2], 2.6).unwrap();
    let lost = reference.measure([&[0.0, 1.0], &[f64::NAN, 0.0]]).unwrap_err();
    assert!(matches!(lost, DisorderError::Search(SearchError::Position { particle: 0, axis: 1, .. })));
    assert!(matches!(reference.measure([&[0.0], &[0.0]]), Err(DisorderError::Length { .. })));
    assert!(matches!(reference.zigzag_field(x0, &mut [0.0; 5]), Err(DisorderError::Length { .. })));
}
