//! Polygons in the plane: distance, area, and whether they cross themselves.

use crate::bounds::Bounds;

type Corner = [f64; 2];

/// The signed distance from `x` to the polygon: to the nearest edge, negative where a ray from `x` meets
/// an odd number of edges.
pub(crate) fn distance(points: &[Corner], x: Corner) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut inside = false;
    for (a, b) in edges(points) {
        nearest = nearest.min(squared_distance(a, b, x));
        if (a[1] > x[1]) != (b[1] > x[1]) {
            let meets = a[0] + (x[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
            inside ^= x[0] < meets;
        }
    }
    if inside { -nearest.sqrt() } else { nearest.sqrt() }
}

/// The area, positive for corners in the positive sense. Taken about the first corner, so that a polygon far from
/// the origin keeps its digits.
pub(crate) fn area(points: &[Corner]) -> f64 {
    let Some(&first) = points.first() else { return 0.0 };
    edges(points).map(|(a, b)| 0.5 * orientation(first, a, b)).sum()
}

pub(crate) fn perimeter(points: &[Corner]) -> f64 {
    edges(points).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
}

pub(crate) fn bounds(points: &[Corner], height: [f64; 2]) -> Bounds {
    Bounds::around(points.iter().flat_map(|p| height.map(|z| [p[0], p[1], z])))
}

/// The numbers of two edges that meet elsewhere than at a common corner; edge i leaves corner i. An edge that
/// folds back upon the one before is found too, for the end of the shorter one lies on the longer one, where the
/// next edge begins. Edges are sorted by their left end, so that only those that overlap along x are compared.
pub(crate) fn crossing(points: &[Corner]) -> Option<(usize, usize)> {
    let edge: Vec<(Corner, Corner)> = edges(points).collect();
    let left = |i: usize| edge[i].0[0].min(edge[i].1[0]);
    let right = |i: usize| edge[i].0[0].max(edge[i].1[0]);
    let mut order: Vec<usize> = (0..edge.len()).collect();
    order.sort_by(|&i, &j| left(i).total_cmp(&left(j)));
    for (at, &i) in order.iter().enumerate() {
        for &j in order[at + 1..].iter().take_while(|&&j| left(j) <= right(i)) {
            let (first, second) = (i.min(j), i.max(j));
            let neighbours = second - first == 1 || second - first == edge.len() - 1;
            if !neighbours && meet(edge[first], edge[second]) {
                return Some((first, second));
            }
        }
    }
    None
}

fn edges(points: &[Corner]) -> impl Iterator<Item = (Corner, Corner)> + '_ {
    points.iter().zip(points.iter().cycle().skip(1)).map(|(&a, &b)| (a, b))
}

fn squared_distance(a: Corner, b: Corner, x: Corner) -> f64 {
    let (edge, to) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
    let t = (to[0] * edge[0] + to[1] * edge[1]) / (edge[0] * edge[0] + edge[1] * edge[1]);
    let t = t.clamp(0.0, 1.0);
    (to[0] - t * edge[0]).powi(2) + (to[1] - t * edge[1]).powi(2)
}

/// Twice the area of the triangle `a b c`: positive if c lies to the left of the way from a to b.
fn orientation(a: Corner, b: Corner, c: Corner) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether two segments share a point.
fn meet((a, b): (Corner, Corner), (c, d): (Corner, Corner)) -> bool {
    let of_cd = [orientation(a, b, c), orientation(a, b, d)];
    let of_ab = [orientation(c, d, a), orientation(c, d, b)];
    let apart = |o: [f64; 2]| (o[0] > 0.0 && o[1] < 0.0) || (o[0] < 0.0 && o[1] > 0.0);
    let within =
        |a: Corner, b: Corner, x: Corner| (0..2).all(|i| a[i].min(b[i]) <= x[i] && x[i] <= a[i].max(b[i]));
    (apart(of_cd) && apart(of_ab))
        || (of_cd[0] == 0.0 && within(a, b, c))
        || (of_cd[1] == 0.0 && within(a, b, d))
        || (of_ab[0] == 0.0 && within(c, d, a))
        || (of_ab[1] == 0.0 && within(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An L: a square of side 2 without its upper right quarter.
    const L: [Corner; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

    #[test]
    fn distance_by_hand() {
        assert_eq!(distance(&L, [0.5, 1.5]), -0.5);
        assert_eq!(distance(&L, [1.5, 1.25]), 0.25);
        assert_eq!(distance(&L, [0.75, 0.75]), -(0.125_f64.sqrt()));
        assert_eq!(distance(&L, [5.0, -4.0]), 5.0);
    }

    #[test]
    fn a_ray_through_a_corner_counts_once() {
        let kite = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
        assert!(distance(&kite, [-0.5, 0.0]) < 0.0);
        assert!(distance(&kite, [-1.5, 0.0]) > 0.0);
        assert!(distance(&kite, [-1.5, 1.0]) > 0.0);
    }

    #[test]
    fn area_has_the_sense_of_the_corners() {
        assert_eq!(area(&L), 3.0);
        let reversed: Vec<Corner> = L.iter().rev().copied().collect();
        assert_eq!(area(&reversed), -3.0);
        assert_eq!(perimeter(&L), 8.0);
        let far = L.map(|p| [p[0] + 1e8, p[1] - 1e8]);
        assert_eq!(area(&far), 3.0);
    }

    #[test]
    fn crossings_touches_and_folds_are_found() {
        assert_eq!(crossing(&L), None);
        assert_eq!(crossing(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]), None);
        let bow_tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(crossing(&bow_tie), Some((0, 2)));
        let touch = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert!(crossing(&touch).is_some());
        let spike = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [2.0, 1.0]];
        assert_eq!(crossing(&spike), Some((1, 3)));
        let spike_at_start = [[2.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        assert_eq!(crossing(&spike_at_start), Some((0, 2)));
    }
}
