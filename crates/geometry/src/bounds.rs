//! Boxes along the axes that enclose shapes.

use crate::point::{Point, sub};

/// A box along the axes, from `min` to `max`, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: Point,
    /// The corner with the largest coordinates.
    pub max: Point,
}

impl Bounds {
    /// The smallest box that holds all `points`; upside down, from +infinity to -infinity, when there are none.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Self {
        let nothing = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
        points.into_iter().fold(nothing, |b, x| b.join(&Self { min: x, max: x }))
    }

    /// The lengths of the edges in metres.
    pub fn extent(&self) -> Point {
        sub(self.max, self.min)
    }

    /// Whether `x` lies inside or on a face.
    pub fn contains(&self, x: Point) -> bool {
        (0..3).all(|i| self.min[i] <= x[i] && x[i] <= self.max[i])
    }

    /// The smallest box that holds both.
    pub fn join(&self, other: &Self) -> Self {
        Self { min: pair(self.min, other.min, f64::min), max: pair(self.max, other.max, f64::max) }
    }

    /// What both share; without extent along an axis along which they are apart.
    pub fn meet(&self, other: &Self) -> Self {
        let min = pair(self.min, other.min, f64::max);
        let max = pair(self.max, other.max, f64::min);
        Self { min, max: pair(min, max, f64::max) }
    }

    pub(crate) fn corners(&self) -> [Point; 8] {
        let pick = |corner: usize, axis: usize| {
            if (corner >> axis) & 1 == 0 { self.min[axis] } else { self.max[axis] }
        };
        std::array::from_fn(|corner| std::array::from_fn(|axis| pick(corner, axis)))
    }

    pub(crate) fn grown(&self, by: f64) -> Self {
        Self { min: self.min.map(|x| x - by), max: self.max.map(|x| x + by) }
    }
}

fn pair(a: Point, b: Point, pick: fn(f64, f64) -> f64) -> Point {
    std::array::from_fn(|i| pick(a[i], b[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn join_holds_both_and_meet_is_what_they_share() {
        let a = Bounds { min: [0.0; 3], max: [2.0; 3] };
        let b = Bounds { min: [1.0, 1.0, 5.0], max: [3.0, 3.0, 6.0] };
        assert_eq!(a.join(&b), Bounds { min: [0.0; 3], max: [3.0, 3.0, 6.0] });
        assert_eq!(a.meet(&b), Bounds { min: [1.0, 1.0, 5.0], max: [2.0, 2.0, 5.0] });
    }

    #[test]
    fn the_corners_span_the_box() {
        let a = Bounds { min: [0.0, 1.0, 2.0], max: [3.0, 4.0, 5.0] };
        assert_eq!(Bounds::around(a.corners()), a);
        assert!(a.contains([0.0, 4.0, 3.0]) && !a.contains([0.0, 4.1, 3.0]));
        assert_eq!(a.extent(), [3.0; 3]);
    }
}
