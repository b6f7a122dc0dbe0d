//! Points of space and the few operations that shapes need.

/// A point or a vector, `[x, y, z]` in metres; in 2D z = 0.
pub type Point = [f64; 3];

/// Whether a shape lives in the plane z = 0 or in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// The plane z = 0; volumes are areas, in m^2.
    Two,
    /// Space; volumes in m^3.
    Three,
}

impl Dimension {
    /// The number of axes, 2 or 3.
    pub fn axes(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: Point, s: f64) -> Point {
    a.map(|x| s * x)
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// `a / |a|`, or `None` for a vector without a direction. Divides by the largest component first, so that no
/// finite vector overflows or vanishes when it is squared.
pub(crate) fn unit(a: Point) -> Option<Point> {
    let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let a = a.map(|x| x / largest);
    let length = norm(a);
    Some(a.map(|x| x / length))
}

/// A rotation by `angle` radians about the line through `about` along `axis`.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    pub(crate) angle: f64,
    pub(crate) axis: Point,
    pub(crate) about: Point,
}

impl Turn {
    /// Where the rotation takes `x` (Rodrigues' formula); `x` itself if the axis has no direction.
    pub(crate) fn apply(self, x: Point) -> Point {
        let Some(u) = unit(self.axis) else { return x };
        let v = sub(x, self.about);
        let (sin, cos) = self.angle.sin_cos();
        let across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let along = scale(u, dot(u, v) * (1.0 - cos));
        add(self.about, add(add(scale(v, cos), scale(across, sin)), along))
    }
}

/// `x` moved away from `about` by `factor`.
pub(crate) fn stretch(x: Point, about: Point, factor: f64) -> Point {
    add(about, scale(sub(x, about), factor))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn unit_survives_extreme_lengths() {
        for length in [1e-320, 1e-200, 1.0, 1e200] {
            assert_eq!(unit([0.0, -length, 0.0]), Some([0.0, -1.0, 0.0]));
        }
        assert_eq!(unit([0.0; 3]), None);
        assert_eq!(unit([f64::INFINITY, 0.0, 0.0]), None);
    }

    #[test]
    fn a_quarter_turn_follows_the_right_hand() {
        let turn = Turn { angle: FRAC_PI_2, axis: [0.0, 0.0, 2.0], about: [1.0, 0.0, 0.0] };
        let there = turn.apply([2.0, 0.0, 5.0]);
        // cos(pi/2) is 6e-17 in f64, and coordinates of 5 are rounded at 1e-15 a few times
        assert!(norm(sub(there, [1.0, 1.0, 5.0])) < 5e-15);
        assert!(norm(sub(Turn { angle: -turn.angle, ..turn }.apply(there), [2.0, 0.0, 5.0])) < 5e-15);
    }

    #[test]
    fn a_turn_about_z_keeps_the_plane_exactly() {
        let turn = Turn { angle: 0.7, axis: [0.0, 0.0, 1.0], about: [0.3, 0.1, 0.0] };
        assert_eq!(turn.apply([1.7, -2.9, 0.0])[2], 0.0);
    }
}
