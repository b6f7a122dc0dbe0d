//! Case files: as written, then checked and in SI, then built; and the one time loop.
//!
//! [`Case::read`] turns a TOML file into a [`Case`], in which every number is in SI units, every name is
//! looked up and every expression compiled, or into a [`CaseError`] that says what is wrong, where, and how to
//! mend it.
//!
//! ```
//! use case::{Case, Overrides};
//!
//! let text = r#"
//! name = "block"
//! dimension = 2
//! spacing = "1 mm"
//! [material.rubber]
//! model = "neo-hookean"
//! density = "1.1 g/cm^3"
//! youngs_modulus = "17 MPa"
//! poisson_ratio = 0.45
//! [[body]]
//! name = "block"
//! material = "rubber"
//! shape = { box = { min = [0, 0], max = ["2 cm", "1 cm"] } }
//! [time]
//! end = "5 ms"
//! "#;
//! let case = Case::parse("block.toml", text, &Overrides::default())?;
//! assert_eq!((case.spacing, case.time.end), (0.001, 0.005));
//!
//! let wrong = Case::parse("block.toml", text, &Overrides::set(["time.ende=1"]));
//! assert!(wrong.is_err_and(|error| error.to_string().contains("did you mean `end`?")));
//! # Ok::<(), case::CaseError>(())
//! ```

pub mod build;
mod checked;
mod diagnostic;
mod explain;
mod expression;
pub mod keys;
pub mod run;
mod source;
pub mod study;
mod units;
mod written;

pub use checked::{
    Axis, Body, Boundary, Calibration, Case, Compared, Comparison, Constraint, Contact, Course, Curves,
    Damping, Elastic, Extremum, Family, Feature, FieldExpression, Fill, Formulation, Gravity, History,
    Initial, Kernel, Load, LoadKind, March, Material, Measure, MeasureKind, MeshFile, Model, Monitor,
    Normalisation, Plane, Probe, Quantity, Saved, Scheme, ShapeSpec, Site, Spot, Statics, Statistic,
    StepRule, Stepping, Time, Tool, Turn, VectorField,
};
pub use diagnostic::{CaseError, Diagnostic};
pub use explain::explain;
pub use expression::{Expression, ExpressionError, Names};
pub use source::{Overrides, Place, UsedFile};
pub use units::{Dimension, Quantity as UnitQuantity, UnitError};
