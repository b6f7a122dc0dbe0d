//! The case as checked: in SI units, complete, and free of contradictions.

mod body;
mod case;
mod choices;
mod compatible;
mod defaults;
mod elastic;
mod field;
mod forced;
mod head;
mod load;
mod material;
mod measure;
mod names;
mod parameters;
mod parts;
mod probe;
mod read;
mod scheme;
mod scope;
mod shape;
mod shape_reader;
mod shape_solids;
mod time;

pub use body::{Body, Fill};
pub use case::Case;
pub use choices::{Axis, Family, Formulation, Kernel, Plane, StepRule, Stepping};
pub use elastic::Elastic;
pub use field::{FieldExpression, VectorField};
pub use load::{Boundary, Constraint, Gravity, Initial};
pub use material::{Material, Model};
pub(crate) use measure::Measured;
pub use measure::{Extremum, Feature, Measure, MeasureKind};
pub use probe::{Probe, Quantity, Spot};
pub use scheme::{March, Scheme};
pub use shape::ShapeSpec;
pub use time::{Monitor, Time};
