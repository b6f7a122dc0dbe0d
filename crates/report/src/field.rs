//! What gives the particles their colours: a quantity of the frame, or a component of one.

use output::{Array, Frame};

/// The numbers that a picture shows, one for each particle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shown {
    /// What it is called in the picture.
    pub(crate) name: String,
    /// SI unit.
    pub(crate) unit: String,
    /// The values.
    pub(crate) values: Vec<f64>,
}

/// Axes of a vector's components; of a tensor's two of them, row before column.
const AXES: [char; 3] = ['x', 'y', 'z'];

/// Splits `Velocity.x` into the quantity and its component.
pub fn split_field(field: &str) -> (&str, Option<&str>) {
    field.split_once('.').map_or((field, None), |(name, component)| (name, Some(component)))
}

/// The quantity `field` of a frame, `Pressure`, `Velocity` (its magnitude), `Velocity.x` or `CauchyStress.xy`; the error says what
/// there is instead.
pub(crate) fn shown(frame: &Frame, field: &str) -> Result<Shown, String> {
    let (name, component) = split_field(field);
    let array = frame.array(name).ok_or_else(|| format!("no {name} in this frame"))?;
    let values = match component {
        None => array.magnitudes(),
        Some(component) => {
            let index = index(array, component).ok_or_else(|| {
                format!("{name} has no component {component}: {}", components(array.components))
            })?;
            array.values.to_f64().iter().skip(index).step_by(array.components).copied().collect()
        }
    };
    let magnitude = component.is_none() && array.components > 1;
    let label = if magnitude { format!("|{name}|") } else { field.to_string() };
    Ok(Shown { name: label, unit: array.unit.clone(), values })
}

fn index(array: &Array, component: &str) -> Option<usize> {
    let mut index = 0;
    for letter in component.chars() {
        index = 3 * index + AXES.iter().position(|&axis| axis == letter)?;
    }
    let letters = component.len();
    (matches!((array.components, letters), (3, 1) | (9, 2))).then_some(index)
}

/// What may stand behind the dot.
pub fn components(count: usize) -> &'static str {
    match count {
        3 => "x, y, z",
        9 => "xx, xy, xz, yx, ... zz",
        _ => "it is one number",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use output::Values;

    #[test]
    fn quantities_magnitudes_and_components() {
        let tensor = std::array::from_fn(|k| k as f64);
        let frame = Frame {
            time: 0.0,
            step: 0,
            points: vec![[0.0; 3]],
            arrays: vec![
                Array::scalar("Pressure", "Pa", Values::F64(vec![-3.0])),
                Array::vector("Velocity", "m/s", vec![[1.0, -2.0, 2.0]]),
                Array::tensor("CauchyStress", "Pa", vec![tensor]),
            ],
        };
        for (field, name, value) in [
            ("Pressure", "Pressure", -3.0),
            ("Velocity", "|Velocity|", 3.0),
            ("Velocity.y", "Velocity.y", -2.0),
            ("CauchyStress.xz", "CauchyStress.xz", 2.0),
            ("CauchyStress.zy", "CauchyStress.zy", 7.0),
        ] {
            let shown = shown(&frame, field).unwrap();
            assert_eq!((shown.name.as_str(), &shown.values[..]), (name, &[value][..]));
        }
        for field in ["Nothing", "Pressure.x", "Velocity.xy", "Velocity.w", "CauchyStress.x", "Velocity."] {
            assert!(shown(&frame, field).is_err(), "{field}");
        }
    }
}
