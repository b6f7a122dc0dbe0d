//! The nearest shell of every particle in the reference arrangement.
//!
//! On a lattice: the 2 D neighbours one spacing away along the axes. Elsewhere: all of the same body within
//! 1.2 dp, provided that they and the wider neighbourhood surround the particle. The surface of a body has no
//! full shell and is left out of the zigzag.

use super::bonds::within;
use super::gradient::LeastSquares;
use crate::neighbours::Adjacency;

/// How far from the place one spacing away a lattice neighbour may be, in spacings.
const OFF_LATTICE: f64 = 1e-6;

/// A particle off the lattice is surrounded if [`LeastSquares::one_sided`] is below this. On a flat face of a
/// lattice that is 0.34 to 0.46 in 2D and 0.20 to 0.33 in 3D for supports of 1.6 to 3.9 dp, one layer
/// further inside at most 0.12, in a corner.
const SURROUNDED: f64 = 0.18;

/// The nearest shells of all particles; empty for a particle without a full one. `near` holds all of the same
/// body within 1.2 of the largest spacing.
pub(super) fn shells<const D: usize>(squares: &LeastSquares<D>, near: &Adjacency, dp: &[f64]) -> Adjacency {
    let mut shells = Adjacency { start: vec![0], id: Vec::new() };
    for i in 0..near.particles() {
        let before = shells.id.len();
        shells.id.extend(near.of(i).iter().filter(|&&j| on_axis(squares.step(i, j as usize), dp[i])));
        if shells.id.len() - before < 2 * D {
            shells.id.truncate(before);
            shells.id.extend(near.of(i).iter().filter(|&&j| within(squares, dp, i, j as usize)));
            if shells.id.len() - before < 2 * D || squares.one_sided(i) > SURROUNDED {
                shells.id.truncate(before);
            }
        }
        shells.start.push(shells.id.len() as u32);
    }
    shells
}

/// Whether `step` leads one spacing along an axis.
fn on_axis<const D: usize>(step: [f64; D], dp: f64) -> bool {
    (0..D).any(|axis| {
        (0..D).all(|k| (step[k].abs() - if k == axis { dp } else { 0.0 }).abs() <= OFF_LATTICE * dp)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::{sample, trivial_pairs};

    fn shells_of<const D: usize>(x0: &[Vec<f64>; D]) -> Adjacency {
        let x0 = sample::slices(x0);
        let squares = LeastSquares::new(x0, 2.6, trivial_pairs(x0, 2.6, None).unwrap());
        shells(&squares, &trivial_pairs(x0, 1.2, None).unwrap(), &vec![1.0; x0[0].len()])
    }

    #[test]
    fn lattice_interiors_have_the_axis_neighbours_and_faces_have_none() {
        let shells = shells_of(&sample::lattice([4, 4], 1.0));
        assert_eq!(shells.of(5), [1, 4, 6, 9]);
        assert_eq!((0..16).filter(|&i| !shells.of(i).is_empty()).collect::<Vec<_>>(), [5, 6, 9, 10]);
        let shells = shells_of(&sample::lattice([4, 4, 5], 1.0));
        let full = (0..80).filter(|&i| shells.of(i).len() == 6).count();
        assert_eq!((full, shells.id.len()), (2 * 2 * 3, 2 * 2 * 3 * 6));
    }

    #[test]
    fn a_turned_lattice_has_the_same_shells() {
        let [x, y, z] = sample::lattice([6, 6, 6], 1.0);
        let expected = shells_of(&[x.clone(), y.clone(), z.clone()]);
        let turned =
            |a: &[f64], b: &[f64], s: f64| a.iter().zip(b).map(|(a, b)| 0.8 * a + s * 0.6 * b).collect();
        let (x1, y1): (Vec<f64>, Vec<f64>) = (turned(&x, &y, -1.0), turned(&y, &x, 1.0));
        let (y2, z2) = (turned(&y1, &z, -1.0), turned(&z, &y1, 1.0));
        assert_eq!(shells_of(&[x1, y2, z2]), expected);
    }

    #[test]
    fn hexagons_have_six_and_their_edges_none() {
        // Rows sqrt(3)/2 apart, shifted by half: six neighbours at distance 1 inside.
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for k in 0..100 {
            x.push(f64::from(k % 10) + 0.5 * f64::from(k / 10 % 2));
            y.push(f64::from(k / 10) * 0.75_f64.sqrt());
        }
        let shells = shells_of(&[x, y]);
        for k in 0..100 {
            let inside = (1..9).contains(&(k % 10)) && (1..9).contains(&(k / 10));
            assert_eq!(shells.of(k).len(), if inside { 6 } else { 0 }, "particle {k}");
        }
    }
}
