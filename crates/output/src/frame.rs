//! The particles at one time, as plain data.

use std::collections::HashSet;
use std::sync::Arc;

use crate::OutputError;

/// Numbers of an [`Array`], flattened: the components of a particle stand together.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Real numbers; files hold them in single precision.
    F64(Vec<f64>),
    /// Real numbers that files hold in double precision.
    Exact(Vec<f64>),
    /// Real numbers in single precision.
    F32(Vec<f32>),
    /// Whole numbers.
    I64(Vec<i64>),
    /// Real numbers that many frames share: worked on once, as long as it is the same `Arc`.
    Shared(Arc<Vec<f32>>),
    /// Whole numbers that many frames share, such as identities.
    Whole(Arc<Vec<i32>>),
}

impl Values {
    /// How many numbers there are: particles times components.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) | Self::Exact(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::Shared(values) => values.len(),
            Self::Whole(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them as `f64`.
    pub fn to_f64(&self) -> Vec<f64> {
        match self {
            Self::F64(values) | Self::Exact(values) => values.clone(),
            Self::F32(values) => values.iter().map(|&value| f64::from(value)).collect(),
            Self::I64(values) => values.iter().map(|&value| value as f64).collect(),
            Self::Shared(values) => values.iter().map(|&value| f64::from(value)).collect(),
            Self::Whole(values) => values.iter().map(|&value| f64::from(value)).collect(),
        }
    }
}

/// One quantity of all particles.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// As ParaView shows it: `Displacement`, `Velocity`, `Density`, `Pressure`, `VonMisesStress`,
    /// `CauchyStress`, `DeformationGradient`, `ParticleSpacing`, `ParticleId`, `Body`.
    pub name: String,
    /// SI unit, such as `m/s`; `1` for a pure number.
    pub unit: String,
    /// Numbers per particle: 1, 3 (vector) or 9 (tensor, row by row).
    pub components: usize,
    /// `components` numbers for each particle, in the order of the points.
    pub values: Values,
}

impl Array {
    /// One number per particle.
    pub fn scalar(name: &str, unit: &str, values: Values) -> Self {
        Self::with_components(name, unit, 1, values)
    }

    /// Three numbers per particle.
    pub fn vector(name: &str, unit: &str, values: Vec<[f64; 3]>) -> Self {
        Self::with_components(name, unit, 3, Values::F64(values.into_flattened()))
    }

    /// Nine numbers per particle, the tensor row by row.
    pub fn tensor(name: &str, unit: &str, values: Vec<[f64; 9]>) -> Self {
        Self::with_components(name, unit, 9, Values::F64(values.into_flattened()))
    }

    fn with_components(name: &str, unit: &str, components: usize, values: Values) -> Self {
        Self { name: name.to_string(), unit: unit.to_string(), components, values }
    }

    /// The numbers of one component as `f64`, or all of them collapsed to a magnitude (Euclidean norm of
    /// the components) when there are several.
    pub fn magnitudes(&self) -> Vec<f64> {
        let numbers = self.values.to_f64();
        if self.components <= 1 {
            return numbers;
        }
        let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        numbers.chunks(self.components).map(norm).collect()
    }
}

/// All particles at one time. Order of particles is free; `ParticleId` says who is who.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Time, s.
    pub time: f64,
    /// Steps done so far.
    pub step: u64,
    /// Present positions, m; the third coordinate is 0 in two dimensions.
    pub points: Vec<[f64; 3]>,
    /// Quantities of the particles.
    pub arrays: Vec<Array>,
}

impl Frame {
    /// The array of this name.
    pub fn array(&self, name: &str) -> Option<&Array> {
        self.arrays.iter().find(|array| array.name == name)
    }

    /// Checks that every array has its numbers for every particle and a name of its own.
    pub(crate) fn check(&self) -> Result<(), OutputError> {
        let fail = |problem: String| Err(OutputError::inconsistent(format!("frame {}", self.step), problem));
        if !self.time.is_finite() {
            return fail(format!("its time is {}", self.time));
        }
        let mut seen = HashSet::new();
        for array in &self.arrays {
            let expected = array.components * self.points.len();
            if array.components == 0 || array.values.len() != expected {
                let found = array.values.len();
                return fail(format!("{} has {found} numbers instead of {expected}", array.name));
            }
            if array.name.is_empty() || !seen.insert(&array.name) {
                return fail(format!("the name \"{}\" is empty or stands twice", array.name));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(arrays: Vec<Array>) -> Frame {
        Frame { time: 0.0, step: 7, points: vec![[0.0; 3]; 2], arrays }
    }

    #[test]
    fn wrong_lengths_and_double_names_are_refused() {
        let good = Array::vector("Velocity", "m/s", vec![[1.0, 2.0, 2.0], [0.0; 3]]);
        frame(vec![good.clone()]).check().unwrap();
        assert!(frame(vec![good.clone(), good]).check().is_err());
        let short = Array::scalar("Density", "kg/m^3", Values::F64(vec![1.0]));
        let error = frame(vec![short]).check().unwrap_err().to_string();
        assert!(error.contains("frame 7") && error.contains("Density"), "{error}");
    }

    #[test]
    fn a_vector_has_one_magnitude_per_particle() {
        let velocity = Array::vector("Velocity", "m/s", vec![[1.0, 2.0, 2.0], [0.0, -3.0, 4.0]]);
        assert_eq!(velocity.magnitudes(), [3.0, 5.0]);
        let id = Array::scalar("ParticleId", "1", Values::I64(vec![4, -2]));
        assert_eq!(id.magnitudes(), [4.0, -2.0]);
    }
}
