//! Particles: lattices, disordered blocks, rings, and which of them lie deep inside.

use std::f64::consts::TAU;
use taut::math::Vector;
use taut::simulation::Point;

/// Numbers between -1 and 1 that look random and are always the same (a linear congruence modulo 2^64).
pub struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector<const D: usize>(&mut self) -> Vector<f64, D> {
        let mut v = Vector::zero();
        for i in 0..D {
            v[i] = self.next();
        }
        v
    }
}

/// A block of `n` particles along each axis from the origin, cell-centred; the last axis runs fastest.
pub fn block<const D: usize>(n: [usize; D], dp: f64) -> Vec<Point<D>> {
    let volume = dp.powi(D as i32);
    let at = |mut k: usize| {
        let mut x = Vector::zero();
        for axis in (0..D).rev() {
            x[axis] = ((k % n[axis]) as f64 + 0.5) * dp;
            k /= n[axis];
        }
        Point::at(x, volume)
    };
    (0..n.iter().product()).map(at).collect()
}

/// The block with every particle displaced by up to `share` spacings along each axis, and volumes off by up to 20 per
/// cent: no symmetry is left.
pub fn disordered<const D: usize>(n: [usize; D], dp: f64, share: f64) -> Vec<Point<D>> {
    let mut noise = Noise(7);
    let mut points = block(n, dp);
    for p in &mut points {
        p.x = p.x.plus(share * dp, noise.vector());
        p.volume *= 1.0 + 0.2 * noise.next();
    }
    points
}

/// A ring of concentric layers about the origin, from radius 5 dp to 9 dp, with the volumes of the sectors: unequal, and on
/// no lattice.
pub fn ring(dp: f64) -> Vec<Point<2>> {
    let mut points = Vec::new();
    for layer in 0..4 {
        let r = (f64::from(layer) + 5.5) * dp;
        let n = (TAU * r / dp).round();
        for k in 0..n as usize {
            let (s, c) = (TAU * (k as f64 + 0.5 * f64::from(layer % 2)) / n).sin_cos();
            points.push(Point::at(Vector([r * c, r * s]), TAU * r * dp / n));
        }
    }
    points
}

/// Gives every particle a smooth velocity with a random part, up to about `speed`.
pub fn stir<const D: usize>(points: &mut [Point<D>], speed: f64, wavelength: f64) {
    let mut noise = Noise(11);
    for p in points {
        let wave = (TAU * (p.x[0] + 2.0 * p.x[1]) / wavelength).sin();
        p.v = Vector::from_fn(|i| speed * (0.4 * wave + 0.3 - 0.2 * i as f64))
            .plus(0.1 * speed, noise.vector());
    }
}

/// Whether the particle of a block lies at least `layers` layers below every surface.
pub fn deep<const D: usize>(x: Vector<f64, D>, n: [usize; D], (dp, layers): (f64, usize)) -> bool {
    (0..D).all(|i| {
        let k = (x[i] / dp).floor();
        k >= layers as f64 && k < (n[i] - layers) as f64
    })
}

/// The plate of the benchmarks (TL section 4.1, UL section 6.1) with `rows` particles over its height of 0.02 m, and its
/// spacing: a strip 0.2 m long, clamped between four layers of fixed particles, in its first mode with `tip` m/s at the end.
pub fn plate(rows: usize, tip: f64) -> (Vec<Point<2>>, f64) {
    let (l, height) = (0.2, 0.02);
    let dp = height / rows as f64;
    let (kl, k): (f64, f64) = (1.875, 1.875 / l);
    let mode = |x: f64| {
        (kl.sin() + kl.sinh()) * ((k * x).cos() - (k * x).cosh())
            - (kl.cos() + kl.cosh()) * ((k * x).sin() - (k * x).sinh())
    };
    let inside = (0.06 / dp).round() as i64 + 4;
    let half = rows as i64 / 2 + 4;
    let mut points = Vec::new();
    for (j, i) in (-half..half).flat_map(|j| (-inside..(l / dp).round() as i64).map(move |i| (j, i))) {
        let (x, y) = ((i as f64 + 0.5) * dp, (j as f64 + 0.5) * dp);
        let outside = y.abs() > 0.5 * height;
        let mut point = Point::at(Vector([x, y]), dp * dp);
        if x > 0.0 {
            point.v = Vector([0.0, tip * mode(x) / mode(l)]);
        } else if outside || x < -0.06 {
            point.free = Vector::zero();
        }
        if x < 0.0 || !outside {
            points.push(point);
        }
    }
    (points, dp)
}
