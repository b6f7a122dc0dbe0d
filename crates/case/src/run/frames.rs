//! Snapshots as frames for files and pictures.

use crate::{Body, Case, Formulation};
use output::{Array, Frame, Values};
use std::sync::Arc;
use taut::field::Quantity;
use taut::simulation::Snapshot;

/// Makes frames. What never changes in a run is made once.
#[derive(Debug)]
pub struct Framer {
    spacing: f64,
    /// Whether there is a shear stress to be seen.
    sheared: bool,
    /// Whether there is a body with small strains.
    strain: bool,
    lasting: Lasting,
}

/// What all frames of a run have in common.
#[derive(Debug, Default)]
struct Lasting {
    spacing: Arc<Vec<f32>>,
    id: Arc<Vec<i32>>,
    body: Arc<Vec<i32>>,
}

impl Framer {
    /// For the particles of a case.
    pub fn new(case: &Case) -> Self {
        let small = |body: &Body| body.scheme.formulation == Formulation::SmallStrain;
        Self {
            spacing: case.spacing,
            sheared: case.shear_stress,
            strain: case.bodies.iter().any(small),
            lasting: Lasting::default(),
        }
    }

    /// Makes a frame; `deformation` holds the deformation gradients, row by row.
    pub fn frame(&mut self, snapshot: &Snapshot, deformation: &[[f64; 9]], step: u64) -> Frame {
        let n = snapshot.body.len();
        if self.lasting.body.len() != n {
            self.lasting = Lasting {
                spacing: Arc::new(vec![self.spacing as f32; n]),
                id: Arc::new((0..n as i32).collect()),
                body: Arc::new(snapshot.body.iter().map(|&body| body as i32).collect()),
            };
        }
        let pressure = |s: &[f64; 9]| (-(s[0] + s[4] + s[8]) / 3.0) as f32;
        let pressure = snapshot.cauchy.iter().map(pressure).collect();
        let whole =
            |name: &str, values: &Arc<Vec<i32>>| Array::scalar(name, "1", Values::Whole(Arc::clone(values)));
        let spacing = Values::Shared(Arc::clone(&self.lasting.spacing));
        let mut arrays = vec![
            several("Displacement", "m", &snapshot.displacement),
            several("Velocity", "m/s", &snapshot.velocity),
            of(Quantity::Density, Values::F32(single(&snapshot.density))),
            of(Quantity::Pressure, Values::F32(pressure)),
            of(Quantity::VonMisesStress, Values::F32(single(&snapshot.von_mises))),
            several("CauchyStress", "Pa", &snapshot.cauchy),
            several("DeformationGradient", "1", deformation),
            of(Quantity::ParticleSpacing, spacing),
            whole("ParticleId", &self.lasting.id),
            whole("Body", &self.lasting.body),
        ];
        if !self.sheared {
            let names = [Quantity::VonMisesStress.name(), Quantity::CauchyStress.name()];
            arrays.retain(|array| !names.contains(&array.name.as_str()));
        }
        if self.strain {
            let strain: Vec<[f64; 9]> = deformation.iter().map(small_strain).collect();
            arrays.push(several(Quantity::Strain.name(), Quantity::Strain.unit(), &strain));
        }
        Frame { time: snapshot.time, step, points: snapshot.positions().collect(), arrays }
    }
}

/// The symmetric part of the gradient of the displacement.
fn small_strain(f: &[f64; 9]) -> [f64; 9] {
    std::array::from_fn(|k| 0.5 * (f[k] + f[k % 3 * 3 + k / 3]) - f64::from(u8::from(k % 4 == 0)))
}

fn single(values: &[f64]) -> Vec<f32> {
    values.iter().map(|&value| value as f32).collect()
}

fn of(quantity: Quantity, values: Values) -> Array {
    Array::scalar(quantity.name(), quantity.unit(), values)
}

/// A vector or a tensor, row by row.
fn several<const N: usize>(name: &str, unit: &str, values: &[[f64; N]]) -> Array {
    let values = Values::F32(single(values.as_flattened()));
    Array { name: name.to_string(), unit: unit.to_string(), components: N, values }
}
