//! From where particles are seen, and which part of the world.

use output::Frame;

/// A parallel projection; `z` points up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Where the viewer stands around the `z` axis, degrees from the `x` axis towards `y`.
    pub azimuth: f64,
    /// How high the viewer stands, degrees above the `xy` plane.
    pub elevation: f64,
}

impl View {
    /// Straight down onto the `xy` plane, `x` to the right and `y` up.
    pub const PLANE: Self = Self { azimuth: -90.0, elevation: 90.0 };

    /// Picture axes in world coordinates: to the right, up, towards the viewer.
    pub(crate) fn axes(&self) -> [[f64; 3]; 3] {
        let (sin_a, cos_a) = self.azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation.to_radians().sin_cos();
        [[-sin_a, cos_a, 0.0], [-sin_e * cos_a, -sin_e * sin_a, cos_e], [cos_e * cos_a, cos_e * sin_a, sin_e]]
    }
}

impl Default for View {
    /// From the front, right and above.
    fn default() -> Self {
        Self { azimuth: -60.0, elevation: 22.0 }
    }
}

/// Right, up and towards the viewer: the components of `point` along the picture's axes.
pub(crate) fn project(axes: &[[f64; 3]; 3], point: [f64; 3]) -> [f64; 3] {
    axes.map(|axis| axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2])
}

/// The part of the picture plane that is shown, m, in the picture's own axes (right, up). In the plane
/// view these are `x` and `y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Lower left corner.
    pub min: [f64; 2],
    /// Upper right corner.
    pub max: [f64; 2],
}

/// Positions beyond this (m) are wreckage of a diverged run, and would overflow in what follows.
const FAR: f64 = 1e100;

impl Window {
    /// The window that shows all particles of `frame`, with a small margin. `view` is that of the
    /// picture; `None` is the plane view. Without particles it is the unit square.
    pub fn around(frame: &Frame, view: Option<View>) -> Self {
        let axes = view.unwrap_or(View::PLANE).axes();
        let mut window = Self { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };
        for &point in &frame.points {
            let p = project(&axes, point);
            if p.iter().all(|x| x.abs() < FAR) {
                window = window.union(Self { min: [p[0], p[1]], max: [p[0], p[1]] });
            }
        }
        if window.min[0] > window.max[0] {
            return Self { min: [-0.5; 2], max: [0.5; 2] };
        }
        window.padded(largest_spacing(frame))
    }

    /// The smallest window that shows what either shows: one window for all pictures of a run.
    pub fn union(self, other: Self) -> Self {
        let pick = |i: usize| (self.min[i].min(other.min[i]), self.max[i].max(other.max[i]));
        let (x, y) = (pick(0), pick(1));
        Self { min: [x.0, y.0], max: [x.1, y.1] }
    }

    pub(crate) fn size(&self) -> [f64; 2] {
        [self.max[0] - self.min[0], self.max[1] - self.min[1]]
    }

    pub(crate) fn centre(&self) -> [f64; 2] {
        [0.5 * (self.max[0] + self.min[0]), 0.5 * (self.max[1] + self.min[1])]
    }

    /// This window if it can be drawn; else (not a number, empty) the unit square.
    pub(crate) fn usable(self) -> Self {
        let sound = self.size().iter().all(|&side| side.is_finite() && side > 0.0);
        if sound { self } else { Self { min: [-0.5; 2], max: [0.5; 2] } }
    }

    /// With a margin for the radius of the particles and a little air.
    fn padded(self, spacing: f64) -> Self {
        let longest = self.size()[0].max(self.size()[1]);
        let pad = if longest > 0.0 {
            0.6 * spacing.min(longest) + 0.02 * longest
        } else if spacing > 0.0 {
            2.0 * spacing
        } else {
            1e-3 * self.min[0].abs().max(self.min[1].abs()).max(1.0)
        };
        Self { min: self.min.map(|x| x - pad), max: self.max.map(|x| x + pad) }
    }
}

/// The largest sensible `ParticleSpacing`, 0 if there is none.
fn largest_spacing(frame: &Frame) -> f64 {
    let spacings = frame.array("ParticleSpacing").map(|array| array.magnitudes()).unwrap_or_default();
    spacings.into_iter().filter(|s| s.abs() < FAR).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(points: Vec<[f64; 3]>) -> Frame {
        Frame { time: 0.0, step: 0, points, arrays: vec![] }
    }

    #[test]
    fn axes_are_right_handed_and_orthonormal() {
        for view in [View::default(), View::PLANE, View { azimuth: 200.0, elevation: -35.0 }] {
            let [r, u, c] = view.axes();
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let cross = [r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]];
            // Sines and cosines round to 1e-16 each.
            assert!((dot(cross, c) - 1.0).abs() < 1e-14 && dot(r, u).abs() < 1e-14);
        }
    }

    #[test]
    fn plane_view_shows_x_and_y_and_default_view_has_x_to_the_right_and_z_up() {
        let p = project(&View::PLANE.axes(), [3.0, 4.0, 5.0]);
        assert!((p[0] - 3.0).abs() < 1e-14 && (p[1] - 4.0).abs() < 1e-14 && (p[2] - 5.0).abs() < 1e-14);
        let axes = View::default().axes();
        assert!(project(&axes, [1.0, 0.0, 0.0])[0] > 0.5);
        assert!(project(&axes, [0.0, 0.0, 1.0])[1] > 0.5);
        // What is in front (smaller y) is nearer to the viewer.
        assert!(project(&axes, [0.0, -1.0, 0.0])[2] > 0.5);
    }

    #[test]
    fn windows_hold_the_particles_and_ignore_wreckage() {
        let all = frame(vec![[0.0, 1.0, 0.0], [2.0, 5.0, 0.0], [f64::NAN, 0.0, 0.0], [1e200, 0.0, 0.0]]);
        let window = Window::around(&all, None);
        assert!(window.min[0] < 0.0 && window.max[0] > 2.0 && window.max[0] < 2.5);
        assert!(window.min[1] < 1.0 && window.max[1] > 5.0);
    }

    #[test]
    fn every_window_can_be_drawn() {
        for points in [vec![], vec![[0.0; 3]], vec![[1e90, -1e90, 0.0]], vec![[f64::INFINITY; 3]]] {
            let window = Window::around(&frame(points), None);
            assert_eq!(window, window.usable());
        }
        let broken = Window { min: [f64::NAN; 2], max: [1.0; 2] };
        assert_eq!(broken.usable().size(), [1.0; 2]);
    }
}
