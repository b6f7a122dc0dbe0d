//! JSON has no NaN and no infinity: they are written as `null`, and `null` is read as NaN.
//!
//! For `#[serde(deserialize_with = "...")]`; writing needs nothing, since `serde_json` already writes
//! `null` for numbers that are not finite.

use serde::{Deserialize, Deserializer};

/// A number or `null`.
pub(crate) fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(or_nan(Option::deserialize(from)?))
}

/// A vector, any component of which may be `null`.
pub(crate) fn vector<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 3], D::Error> {
    Ok(<[Option<f64>; 3]>::deserialize(from)?.map(or_nan))
}

/// A list of (time, value), either of which may be `null`.
pub(crate) fn history<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<[f64; 2]>, D::Error> {
    let pairs = Vec::<[Option<f64>; 2]>::deserialize(from)?;
    Ok(pairs.into_iter().map(|pair| pair.map(or_nan)).collect())
}

/// A list of (time, kinetic, strain, total), any of which may be `null`.
pub(crate) fn energies<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<[f64; 4]>, D::Error> {
    let rows = Vec::<[Option<f64>; 4]>::deserialize(from)?;
    Ok(rows.into_iter().map(|row| row.map(or_nan)).collect())
}

fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}
