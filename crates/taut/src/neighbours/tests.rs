//! The parallel search against the trivial one.

use super::sample::{lattice, on_threads, random, slices};
use super::{Adjacency, Search, SearchError, trivial_pairs};

/// Asserts that the search, on any number of threads and with buffers that held something else, gives the
/// trivial list; returns that list.
fn same_as_trivial<const D: usize>(columns: &[Vec<f64>; D], radius: f64, same: Option<&[u32]>) -> Adjacency {
    let x = slices(columns);
    let expected = trivial_pairs(x, radius, same).unwrap();
    for threads in 1..=3 {
        let list = on_threads(threads, || {
            let (mut search, mut list) = (Search::new(), Adjacency::default());
            search.pairs(slices(&random::<D>(400, 99)), 0.2, None, &mut list).unwrap();
            search.pairs(x, radius, same, &mut list).unwrap();
            list
        });
        assert_eq!(list, expected, "{threads} threads, radius {radius}");
    }
    expected
}

#[test]
fn random_sets() {
    for seed in 0..5 {
        for radius in [1e-3, 0.05, 0.3, 2.0] {
            same_as_trivial(&random::<2>(1500, seed), radius, None);
            same_as_trivial(&random::<3>(700, seed), radius, None);
        }
    }
}

#[test]
fn clustered_and_far_flung_sets() {
    let mut columns = random::<3>(1200, 7);
    for axis in 0..3 {
        for a in 0..1200 {
            // Powers crowd particles at the origin; every hundredth flies away, further and further.
            columns[axis][a] =
                columns[axis][a].powi(8) * if a % 100 == axis { 10_f64.powi(a as i32 / 60) } else { 1.0 };
        }
    }
    let list = same_as_trivial(&columns, 0.01, None);
    assert!(list.mean() > 20.0, "the set should be crowded: {}", list.mean());
}

#[test]
fn distances_of_exactly_the_radius_do_not_count() {
    // Multiples of 1/8 and their squares are exact: 3 x 3 around each, without the cross at distance 2.
    let list = same_as_trivial(&lattice([9, 9], 0.125), 0.25, None);
    assert_eq!(list.of(40), [30, 31, 32, 39, 41, 48, 49, 50]);
    let list = same_as_trivial(&lattice([5, 5, 5], 0.125), 0.125, None);
    assert!(list.id.is_empty());
    // Multiples of 0.1 are not exact: whatever rounding says, both searches must say the same, both ways.
    same_as_trivial(&lattice([30, 30], 0.1), 0.2, None);
    same_as_trivial(&lattice([11, 11, 11], 0.1), 0.3, None);
}

#[test]
fn rounding_of_cell_numbers_loses_no_pair() {
    // Particles on and a rounding below every multiple of the radius: a cell as wide as the radius would put
    // some that are closer than it two cells apart.
    for radius in [0.1, 0.3, 0.7] {
        let on = (0..1500).map(|k| f64::from(k) * radius);
        let x: Vec<f64> = on.flat_map(|x| [x.next_down(), x]).collect();
        same_as_trivial(&[x, vec![0.0; 3000]], radius, None);
    }
}

#[test]
fn collinear_flat_and_coincident_sets() {
    let line: Vec<f64> = (0..3000).map(|k| f64::from(k) * 0.1).collect();
    same_as_trivial(&[line.clone(), line.clone()], 0.5, None);
    same_as_trivial(&[line.clone(), vec![1.0; 3000], line.iter().map(|v| -v).collect()], 0.35, None);
    let list = same_as_trivial(&[vec![4.0; 50], vec![-3.0; 50], vec![0.0; 50]], 1e-9, None);
    assert_eq!(list.id.len(), 50 * 49);
}

#[test]
fn none_and_one() {
    let list = same_as_trivial::<2>(&[vec![], vec![]], 1.0, None);
    assert_eq!((list.particles(), list.mean()), (0, 0.0));
    let list = same_as_trivial(&[vec![5.0], vec![6.0], vec![7.0]], 1.0, None);
    assert_eq!((list.particles(), list.of(0).len()), (1, 0));
}

#[test]
fn only_pairs_of_the_same_tag() {
    let tag: Vec<u32> = (0..1500).map(|a| a % 3).collect();
    let list = same_as_trivial(&random::<2>(1500, 3), 0.1, Some(&tag));
    assert!(!list.id.is_empty());
    assert!((0..1500).all(|a| list.of(a).iter().all(|b| b % 3 == a as u32 % 3)));
}

#[test]
fn huge_offsets_and_extents() {
    let mut columns = random::<2>(500, 21);
    for value in &mut columns[0] {
        *value += 1e12;
    }
    same_as_trivial(&columns, 0.1, None);
    columns[1][17] = 1e30;
    columns[1][18] = -1e149;
    same_as_trivial(&columns, 0.1, None);
}

#[test]
fn refuses_tags_of_another_length() {
    let (mut search, mut list) = (Search::new(), Adjacency::default());
    let error = search.pairs([&[0.0; 3], &[0.0; 3]], 1.0, Some(&[0; 2]), &mut list).unwrap_err();
    assert_eq!(error, SearchError::Length { column: "the column of tags", found: 2, expected: 3 });
}
