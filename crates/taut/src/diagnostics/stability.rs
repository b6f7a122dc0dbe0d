//! Limits of stability of the small-strain form that need no particles: those of the paper, and that of a lattice without edges.

use crate::kernel::Kernel;
use crate::material::LinearElastic;
use std::f64::consts::PI;

/// A small-strain body on a lattice without edges, where the Shepard sum is 1.
#[derive(Clone, Copy, Debug)]
pub struct Interior {
    /// The material.
    pub material: LinearElastic,
    /// The kernel.
    pub kernel: Kernel,
    /// Spacing, m.
    pub spacing: f64,
    /// Dimension.
    pub dimension: usize,
}

impl Interior {
    /// c = (m W')^2 / rho^3 of the next neighbours, 1/(Pa s^2): SS below Eq. (A.9).
    fn neighbour(&self) -> f64 {
        let volume = self.spacing.powi(self.dimension as i32);
        (volume * self.kernel.dw(self.spacing)).powi(2) / self.material.moduli.density
    }

    /// The paper's condition, s (SS Eqs. 15, A.10): t^2 <= 1 / (c (2 gamma + 3 "G")), where "G" is twice the shear modulus. For a kernel that sees
    /// next neighbours only it is sufficient; for one that sees more it is not.
    #[must_use]
    pub fn paper(&self) -> f64 {
        let (gamma, g) = (self.material.coupling, 2.0 * self.material.moduli.shear);
        (self.neighbour() * (2.0 * gamma + 3.0 * g)).sqrt().recip()
    }

    /// What that analysis gives without its superfluous third term, s: t^2 <= 1 / (2 c (gamma + "G")) in the plane, necessary as well as sufficient for
    /// four neighbours. (The eigenvalues of the matrix of A.6, A.7 are -4 c (gamma + "G") s and -2 c "G" s with s = sin^2 K + sin^2 Q; in space
    /// s has three terms.)
    #[must_use]
    pub fn four_neighbours(&self) -> f64 {
        let largest = self.dimension as f64;
        (self.neighbour() * largest * self.material.longitudinal()).sqrt().recip()
    }

    /// Of the neighbours that there are, s: 2 / (c_L max |D(k)|) with D(k) = sum_b V grad W_b sin(k . x_b). Gradient and divergence of a wave are both
    /// multiplied by D, and the longitudinal wave is the stiffest.
    #[must_use]
    pub fn lattice(&self) -> f64 {
        let speed = (self.material.longitudinal() / self.material.moduli.density).sqrt();
        2.0 / (speed * self.steepest())
    }

    /// max |D(k)|, 1/m: on a grid of wave vectors, by the symmetry of the lattice in one corner of the zone, then refined around the best.
    fn steepest(&self) -> f64 {
        let stencil = self.stencil();
        let mut best = ([0.0; 3], 0.0);
        let axes = self.dimension;
        let mut search = |centre: [f64; 3], width: f64, n: usize| {
            let step = width / n as f64;
            for index in 0..(n + 1).pow(axes as u32) {
                let place = |axis: usize| index / (n + 1).pow(axis as u32) % (n + 1);
                let at = |axis: usize| centre[axis] + step * (place(axis) as f64 - 0.5 * n as f64);
                let k: [f64; 3] = std::array::from_fn(|axis| if axis < axes { at(axis) } else { 0.0 });
                let size = self.size(&stencil, k);
                if size > best.1 {
                    best = (k, size);
                }
            }
            best
        };
        let zone = PI / self.spacing;
        let mut found = search([0.5 * zone; 3], zone, 24);
        let mut width = zone / 12.0;
        for _ in 0..12 {
            found = search(found.0, width, 4);
            width *= 0.6;
        }
        found.1
    }

    /// Offsets of the neighbours, m, and V W'/r of each, 1/m^2.
    fn stencil(&self) -> Vec<([f64; 3], f64)> {
        let volume = self.spacing.powi(self.dimension as i32);
        let reach = (self.kernel.support() / self.spacing).ceil() as i32;
        let depth = if self.dimension == 3 { reach } else { 0 };
        let mut all = Vec::new();
        for x in -reach..=reach {
            for y in -reach..=reach {
                for z in -depth..=depth {
                    let offset = [x, y, z].map(|c| f64::from(c) * self.spacing);
                    let r = offset.iter().map(|c| c * c).sum::<f64>().sqrt();
                    if r > 0.0 && r < self.kernel.support() {
                        all.push((offset, volume * self.kernel.dw(r) / r));
                    }
                }
            }
        }
        all
    }

    fn size(&self, stencil: &[([f64; 3], f64)], k: [f64; 3]) -> f64 {
        let mut sum = [0.0; 3];
        for (x, w) in stencil {
            let phase: f64 = x.iter().zip(&k).map(|(x, k)| x * k).sum();
            let part = w * phase.sin();
            (0..3).for_each(|i| sum[i] += part * x[i]);
        }
        sum.iter().map(|c| c * c).sum::<f64>().sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Shape;
    use crate::material::Moduli;

    /// The plate of the paper.
    fn plate(h: f64, plane_stress: bool) -> Interior {
        let moduli = Moduli::from_young(1000.0, 0.39, 0.3);
        let material =
            if plane_stress { LinearElastic::plane_stress(moduli) } else { LinearElastic::solid(moduli) };
        Interior {
            material,
            kernel: Kernel::new(Shape::Gaussian, h * 2.5e-5, 2),
            spacing: 2.5e-5,
            dimension: 2,
        }
    }

    /// SS Eqs. (15a) and (15b), written as they are printed: rho/|m W'| sqrt(rho (1 - mu)/((3 - mu) G)).
    #[test]
    fn equation_15_is_the_printed_one() {
        for h in [0.7, 1.0, 1.6] {
            let (rho, mu, g) = (1000.0, 0.3, 0.3);
            let slope = |i: &Interior| rho / (rho * i.spacing * i.spacing * i.kernel.dw(i.spacing)).abs();
            let (stress, strain) = (plate(h, true), plate(h, false));
            let printed = slope(&stress) * (rho * (1.0 - mu) / ((3.0 - mu) * g)).sqrt();
            assert!((stress.paper() / printed - 1.0).abs() < 1e-13);
            let printed = slope(&strain) * (rho * (1.0 - 2.0 * mu) / ((3.0 - 4.0 * mu) * g)).sqrt();
            assert!((strain.paper() / printed - 1.0).abs() < 1e-13);
        }
    }

    /// The bound of the paper is on the safe side of the exact one by sqrt((2 gamma + 3 G)/(2 gamma + 2 G)).
    #[test]
    fn the_paper_is_conservative_for_four_neighbours() {
        assert!((plate(0.7, true).four_neighbours() / plate(0.7, true).paper() - 1.1619).abs() < 1e-4);
        assert!((plate(0.7, false).four_neighbours() / plate(0.7, false).paper() - 1.1339).abs() < 1e-4);
    }

    /// With a narrow kernel the diagonal neighbours are nothing, and the general bound is that of four. At h = 0.4 they have e^-6.25 of the slope.
    #[test]
    fn a_narrow_kernel_has_four_neighbours() {
        let narrow = plate(0.4, true);
        assert!((narrow.lattice() / narrow.four_neighbours() - 1.0).abs() < 0.01);
    }

    /// A wide Gaussian is its transform, |D| = k exp(-k^2 h^2/4), whose maximum is sqrt(2/e)/h: 2/(c_L |D|) = 2.33 h/c_L.
    #[test]
    fn a_wide_kernel_is_its_transform() {
        let wide = plate(4.0, true);
        let speed = (wide.material.longitudinal() / 1000.0).sqrt();
        // The Gaussian is cut where it is e^-9, which changes slopes by parts of a thousand.
        assert!((wide.lattice() * speed / wide.kernel.h() - 2.0 / (2.0 / 1f64.exp()).sqrt()).abs() < 0.01);
    }

    /// The error matrix of the paper (A.5, with C for A in rows 2 and 4) has its largest eigenvalue on the unit circle up to the exact bound, and beyond it outside.
    #[test]
    fn the_error_matrix_agrees() {
        let (interior, zone) = (plate(0.7, true), PI / 2.5e-5);
        let (c, gamma, g) = (interior.neighbour(), interior.material.coupling, 0.3);
        let (k, q) = (0.5 * zone, 0.5 * zone);
        let d = interior.spacing;
        let a = |k: f64, q: f64| {
            c * (2.0 * (gamma + g) * (2.0 * k * d).cos() + g * (2.0 * q * d).cos() - 2.0 * gamma - 3.0 * g)
        };
        let b = c * (2.0 * gamma + g) * (((k + q) * d).cos() - ((k - q) * d).cos());
        // E is [1, t M; t, 1 + t^2 M] in blocks, so with mu an eigenvalue of M = [[A, B], [B, C]] that of E solves
        // (l - 1)^2 = l t^2 mu: on the unit circle as long as t^2 mu >= -4.
        let (a, c) = (a(k, q), a(q, k));
        let root = ((a - c).powi(2) + 4.0 * b * b).sqrt();
        let mu = 0.5 * (a + c - root);
        let radius = |t: f64| {
            let trace = 2.0 + t * t * mu;
            if trace.abs() <= 2.0 { 1.0 } else { 0.5 * (trace.abs() + (trace * trace - 4.0).sqrt()) }
        };
        let exact = interior.four_neighbours();
        assert_eq!(radius(0.9999 * exact), 1.0);
        assert!(radius(1.0001 * exact) > 1.0);
    }
}
