//! Values at a material point that need not be a particle.

use crate::math::{Tensor, Vector};

/// A material point as a weighted mean of particles. The weights reproduce linear fields, inside the body and beyond its
/// outermost particles: a tip or a corner is extrapolated, not read half a spacing further inside.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialPoint {
    /// Index and weight of the particles.
    pub weights: Vec<(usize, f64)>,
}

impl MaterialPoint {
    /// The point `at` (m) among particles at reference positions `x`, from those within 2.6 spacings. `None` if there is none.
    ///
    /// Weighted least squares with a linear basis; where the particles do not span all axes, a constant one.
    pub fn new<const D: usize>(
        x: impl Iterator<Item = (usize, Vector<f64, D>)>,
        at: Vector<f64, D>,
        spacing: f64,
    ) -> Option<Self> {
        let reach = 2.6 * spacing;
        let near: Vec<(usize, Vector<f64, D>, f64)> = x
            .map(|(i, x)| (i, (x - at).times(1.0 / reach)))
            .filter(|(_, d)| d.norm_squared() < 1.0)
            .map(|(i, d)| (i, d, (1.0 - d.norm_squared()).powi(4)))
            .collect();
        let total: f64 = near.iter().map(|n| n.2).sum();
        if near.is_empty() {
            return None;
        }
        let mean = near.iter().fold(Vector::zero(), |m, (_, d, w)| m + d.times(w / total));
        let spread = near.iter().fold(Tensor::zero(), |s: Tensor<f64, D>, (_, d, w)| {
            s + (*d - mean).outer(*d - mean).times(w / total)
        });
        // The least singular spread of a lattice neighbourhood is about 0.05 per axis.
        let regular = spread.det() > 1e-8;
        let slope = if regular { spread.inverse().mul_vector(-mean) } else { Vector::zero() };
        let weights = near.iter().map(|(i, d, w)| (*i, w / total * (1.0 + slope.dot(*d - mean)))).collect();
        Some(Self { weights })
    }

    /// The mean over particles, each with its weight (any positive numbers). `None` if there is none.
    #[must_use]
    pub fn mean(particles: impl Iterator<Item = (usize, f64)>) -> Option<Self> {
        let mut weights: Vec<(usize, f64)> = particles.collect();
        let total: f64 = weights.iter().map(|w| w.1).sum();
        weights.iter_mut().for_each(|w| w.1 /= total);
        (!weights.is_empty()).then_some(Self { weights })
    }

    /// The value of a vector field given by particle.
    pub fn value(&self, field: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
        self.weights.iter().fold([0.0; 3], |sum, &(i, w)| {
            let v = field(i);
            std::array::from_fn(|k| sum[k] + w * v[k])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_fields_are_extrapolated_exactly() {
        let lattice: Vec<Vector<f64, 2>> =
            (0..64).map(|k| Vector([f64::from(k % 8) + 0.5, f64::from(k / 8) + 0.5])).collect();
        for at in [[8.0, 4.0], [8.0, 8.0], [3.2, 4.9]] {
            let point =
                MaterialPoint::new(lattice.iter().copied().enumerate(), Vector(at), 1.0).expect("inside");
            let value = point.value(|i| [2.0 - 3.0 * lattice[i][0] + 0.7 * lattice[i][1], 1.0, 0.0]);
            assert!((value[0] - (2.0 - 3.0 * at[0] + 0.7 * at[1])).abs() < 1e-12, "rounding only");
            assert!((value[1] - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_mean_weighs_by_what_it_is_given() {
        let mean = MaterialPoint::mean([(0, 1.0), (1, 3.0)].into_iter()).expect("two particles");
        assert_eq!(mean.value(|i| [i as f64, 2.0, 0.0]), [0.75, 2.0, 0.0]);
        assert_eq!(MaterialPoint::mean(std::iter::empty()), None);
    }

    #[test]
    fn a_row_of_particles_still_gives_a_value_and_nothing_near_gives_none() {
        let row: Vec<Vector<f64, 2>> = (0..5).map(|k| Vector([f64::from(k), 0.0])).collect();
        let point = MaterialPoint::new(row.iter().copied().enumerate(), Vector([2.0, 0.3]), 1.0);
        assert!((point.expect("near").value(|_| [1.0; 3])[0] - 1.0).abs() < 1e-14);
        assert_eq!(MaterialPoint::new(row.into_iter().enumerate(), Vector([20.0, 0.0]), 1.0), None);
    }
}
