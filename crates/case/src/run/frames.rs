//! Snapshots as frames for files and pictures.

use output::{Array, Frame, Values};
use taut::field::Quantity;
use taut::simulation::Snapshot;

/// Makes a frame; `deformation` holds the deformation gradients, row by row.
pub fn frame(snapshot: &Snapshot, deformation: &[[f64; 9]], spacing: f64, step: u64) -> Frame {
    let n = snapshot.body.len();
    let pressure = snapshot.cauchy.iter().map(|s| -(s[0] + s[4] + s[8]) / 3.0).collect();
    let scalar = |q: Quantity, values: Vec<f64>| Array::scalar(q.name(), q.unit(), Values::F64(values));
    let arrays = vec![
        Array::vector("Displacement", "m", snapshot.displacement.clone()),
        Array::vector("Velocity", "m/s", snapshot.velocity.clone()),
        scalar(Quantity::Density, snapshot.density.clone()),
        scalar(Quantity::Pressure, pressure),
        scalar(Quantity::VonMisesStress, snapshot.von_mises.clone()),
        Array::tensor("CauchyStress", "Pa", snapshot.cauchy.clone()),
        Array::tensor("DeformationGradient", "1", deformation.to_vec()),
        scalar(Quantity::ParticleSpacing, vec![spacing; n]),
        Array::scalar("ParticleId", "1", Values::I64((0..n as i64).collect())),
        Array::scalar("Body", "1", Values::I64(snapshot.body.iter().map(|&b| i64::from(b)).collect())),
    ];
    Frame { time: snapshot.time, step, points: snapshot.positions().collect(), arrays }
}
