//! Axes of charts.

use std::ops::Range;

use crate::scale::Scale;

/// One axis: its name with the unit, its range in that unit.
pub(crate) struct Axis {
    pub(crate) name: String,
    scale: Scale,
    pub(crate) range: Range<f64>,
}

impl Axis {
    /// Holds all `values` that can be drawn, with some air; never empty.
    pub(crate) fn new(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| drawable(*value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let scale = Scale::new(low.abs().max(high.abs()), unit);
        let (low, high) = (low / scale.divisor, high / scale.divisor);
        // Values that differ by rounding only count as constant, and still get an axis with a height.
        let constant = high - low <= 1e-12 * low.abs().max(high.abs());
        let air = if constant { 0.1 * high.abs().max(f64::MIN_POSITIVE.sqrt()) } else { 0.04 * (high - low) };
        let air = if constant && high == 0.0 { 1.0 } else { air };
        Self { name: format!("{name}{}", scale.brackets()), scale, range: low - air..high + air }
    }

    /// `value` in the unit of the axis.
    pub(crate) fn shown(&self, value: f64) -> f64 {
        value / self.scale.divisor
    }

    /// Where `value` lies between the ends of the axis, 0 to 1.
    pub(crate) fn part(&self, value: f64) -> f64 {
        (self.shown(value) - self.range.start) / (self.range.end - self.range.start)
    }

    /// The number at a tick, `shown` being in the unit of the axis.
    pub(crate) fn label(&self, shown: f64) -> String {
        let step = (self.range.end - self.range.start) / 10.0;
        Scale { divisor: 1.0, unit: String::new() }.label(shown, 5.0 * step)
    }
}

/// Numbers whose differences do not overflow.
pub(crate) fn drawable(value: f64) -> bool {
    value.abs() < 1e300
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_always_have_a_length() {
        for values in [vec![], vec![0.0], vec![5e-7; 3], vec![-3e12], vec![1.0, 1.0 + 1e-15], vec![f64::NAN]]
        {
            let axis = Axis::new("y", "m", values.iter().copied());
            assert!(axis.range.end > axis.range.start, "{values:?}: {:?}", axis.range);
            assert!(axis.range.end.is_finite() && axis.range.start.is_finite());
        }
    }
}
