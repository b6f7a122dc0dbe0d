//! Triangles that share their corners.

use super::{MAX_TRIANGLES, MeshError};
use crate::point::{Point, dot, norm, scale, sub};
use std::collections::HashMap;

/// Coordinates beyond this are not used: their sixth powers would overflow.
const FARTHEST: f64 = 1e30;

/// Points, and triangles of three of them each.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Surface {
    pub points: Vec<Point>,
    pub faces: Vec<[u32; 3]>,
}

impl Surface {
    /// Adds a triangle with corners of its own.
    pub fn push(&mut self, corners: [Point; 3]) -> Result<(), MeshError> {
        let first = self.points.len() as u32;
        self.points.extend(corners);
        self.push_face([first, first + 1, first + 2])
    }

    /// Adds a triangle of points that are there.
    pub fn push_face(&mut self, face: [u32; 3]) -> Result<(), MeshError> {
        if self.faces.len() >= MAX_TRIANGLES {
            return Err(MeshError::TooMany);
        }
        self.faces.push(face);
        Ok(())
    }

    pub fn corners(&self, face: [u32; 3]) -> [Point; 3] {
        face.map(|corner| self.points[corner as usize])
    }

    /// The area of all triangles.
    pub fn area(&self) -> f64 {
        self.faces.iter().map(|&face| 0.5 * norm(area_vector(self.corners(face)))).sum()
    }

    /// Refuses corners that are no numbers, or too far away.
    pub fn check(&self) -> Result<(), MeshError> {
        if self.faces.is_empty() {
            return Err(MeshError::Empty);
        }
        for (index, &face) in self.faces.iter().enumerate() {
            for corner in self.corners(face) {
                let triangle = index + 1;
                if corner.iter().any(|x| !x.is_finite()) {
                    return Err(MeshError::NotFinite { triangle, corner });
                }
                if corner.iter().any(|x| x.abs() > FARTHEST) {
                    return Err(MeshError::TooFar { triangle, corner });
                }
            }
        }
        Ok(())
    }

    /// Makes one point of all that have the same coordinates; points that no triangle uses go. In the order of their
    /// coordinates.
    pub fn weld(&mut self) {
        let mut order: Vec<u32> = self.faces.as_flattened().to_vec();
        order.sort_unstable();
        order.dedup();
        // +0 and -0 are the same place.
        let at = |i: u32| self.points[i as usize].map(|x| x + 0.0);
        let ascending = |a: Point, b: Point| {
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
        };
        order.sort_unstable_by(|&i, &j| ascending(at(i), at(j)));
        let mut new = vec![0; self.points.len()];
        let mut points: Vec<Point> = Vec::new();
        for &i in &order {
            let x = at(i);
            if points.last() != Some(&x) {
                points.push(x);
            }
            new[i as usize] = points.len() as u32 - 1;
        }
        self.points = points;
        for face in &mut self.faces {
            *face = face.map(|corner| new[corner as usize]);
        }
    }

    /// Takes away points that no triangle uses; the others stay in their order.
    pub fn compact(&mut self) {
        let mut new = vec![u32::MAX; self.points.len()];
        self.faces.as_flattened().iter().for_each(|&corner| new[corner as usize] = 0);
        let used = new.iter_mut().filter(|place| **place == 0);
        (0..).zip(used).for_each(|(count, place)| *place = count);
        let mut used = new.iter().map(|&place| place != u32::MAX);
        self.points.retain(|_| used.next().unwrap_or(false));
        for face in &mut self.faces {
            *face = face.map(|corner| new[corner as usize]);
        }
    }

    /// Makes one point of those of `loose` that are no further apart than single precision can tell at the size of the
    /// mesh; how many went.
    pub fn weld_close(&mut self, loose: &[u32]) -> usize {
        let largest = self.points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let near = 4.0 * f64::from(f32::EPSILON) * largest;
        if near == 0.0 {
            return 0;
        }
        let cell = |x: Point| x.map(|c| (c / near).floor() as i64);
        let mut kept: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        let mut new: Vec<u32> = (0..self.points.len() as u32).collect();
        let mut gone = 0;
        for &i in loose {
            let x = self.points[i as usize];
            let home = cell(x);
            let close = |&&j: &&u32| {
                let way = sub(self.points[j as usize], x);
                dot(way, way) <= near * near
            };
            let around = (0..27).map(|k| [home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1]);
            let partner = around.filter_map(|c| kept.get(&c)?.iter().find(close)).min().copied();
            match partner {
                Some(partner) => {
                    new[i as usize] = partner;
                    gone += 1;
                }
                None => kept.entry(home).or_default().push(i),
            }
        }
        for face in &mut self.faces {
            *face = face.map(|corner| new[corner as usize]);
        }
        gone
    }
}

/// Twice the area of a triangle, along its normal.
pub(crate) fn area_vector([a, b, c]: [Point; 3]) -> Point {
    cross(sub(b, a), sub(c, a))
}

pub(crate) fn cross(u: Point, v: Point) -> Point {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The middle of points; of none the origin.
pub(crate) fn middle(points: &[Point]) -> Point {
    let sum = points.iter().fold([0.0; 3], |s: Point, x| std::array::from_fn(|i| s[i] + x[i]));
    scale(sum, 1.0 / points.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_at_one_place_become_one_point() {
        let mut surface = Surface::default();
        surface.push([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
        surface.push([[1.0, -0.0, 0.0], [-0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]).unwrap();
        surface.weld();
        assert_eq!(surface.points.len(), 4);
        assert_eq!(surface.faces[0][0], surface.faces[1][1]);
        assert_eq!(surface.faces[0][1], surface.faces[1][0]);
    }

    #[test]
    fn what_single_precision_cannot_tell_is_one_point() {
        let gap = 1.0 + 2.0 * f64::from(f32::EPSILON);
        let mut surface = Surface::default();
        surface.push([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
        surface.push([[gap, 0.0, 0.0], [0.0; 3], [0.0, -1.0, 0.0]]).unwrap();
        surface.weld();
        assert_eq!(surface.weld_close(&[0, 1, 2, 3, 4]), 1);
        assert_eq!(surface.faces[0][1], surface.faces[1][0]);
        assert_eq!(surface.weld_close(&[0, 1]), 0);
    }
}
