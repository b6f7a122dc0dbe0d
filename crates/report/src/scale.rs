//! Numbers as people read them: a suitable prefix of the unit, few digits.

/// How numbers of one axis are shown: divided by `divisor`, with `unit` behind.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// What a number is divided by.
    pub(crate) divisor: f64,
    /// The unit that is left, such as `MPa`; empty for a pure number.
    pub(crate) unit: String,
}

/// Units that take a prefix.
const PREFIXED: [&str; 8] = ["Pa", "m", "m/s", "N", "J", "W", "Hz", "s"];
const PREFIXES: [(i32, &str); 9] =
    [(-12, "p"), (-9, "n"), (-6, "\u{b5}"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T")];

impl Scale {
    /// For numbers up to `largest` (in absolute value) with this SI unit.
    pub(crate) fn new(largest: f64, unit: &str) -> Self {
        let thousands = if largest.is_finite() && largest != 0.0 {
            // A hair above, so that 1000 counts as 1 k in spite of rounding.
            ((largest.abs().log10() + 1e-9) / 3.0).floor() as i32
        } else {
            0
        };
        let exponent = if unit == "s" { 3 * thousands.min(0) } else { 3 * thousands };
        let prefix = PREFIXES.iter().find(|(power, _)| *power == exponent).map(|(_, prefix)| *prefix);
        let unit = unit.replace("^2", "\u{b2}").replace("^3", "\u{b3}");
        match prefix {
            Some(prefix) if PREFIXED.contains(&unit.as_str()) => {
                Self { divisor: 10f64.powi(exponent), unit: format!("{prefix}{unit}") }
            }
            _ => Self::with_power(exponent, &unit),
        }
    }

    /// A power of ten before the unit, where the numbers would be unreadable without.
    fn with_power(exponent: i32, unit: &str) -> Self {
        let unit = if unit == "1" { "" } else { unit };
        if (-3..=3).contains(&exponent) {
            return Self { divisor: 1.0, unit: unit.to_string() };
        }
        // Beyond 1e300 the power itself leaves the range of f64.
        let exponent = exponent.clamp(-300, 300);
        Self { divisor: 10f64.powi(exponent), unit: format!("10^{exponent} {unit}").trim_end().to_string() }
    }

    /// The unit in brackets, or nothing.
    pub(crate) fn brackets(&self) -> String {
        if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) }
    }

    /// `value` with as many decimals as tell values apart that differ by `step`.
    pub(crate) fn label(&self, value: f64, step: f64) -> String {
        let step = (step / self.divisor).abs();
        let decimals = if step > 0.0 && step.is_finite() { (1.0 - step.log10()).ceil() } else { 3.0 };
        let text = format!("{:.*}", decimals.clamp(0.0, 6.0) as usize, value / self.divisor);
        let zero = text.starts_with('-') && text[1..].chars().all(|c| matches!(c, '0' | '.'));
        if zero { text[1..].to_string() } else { text }
    }
}

/// One quantity for a line of text, such as `12.5 ms`: up to four digits.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    let scale = Scale::new(value, unit);
    let shown = value / scale.divisor;
    let whole = shown.abs().max(1.0).log10().floor() as i32 + 1;
    let decimals = (4 - whole).clamp(0, 3) as usize;
    let text = format!("{shown:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text} {}", scale.unit).trim_end().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_and_powers() {
        for (largest, unit, expected, divisor) in [
            (1.7e7, "Pa", "MPa", 1e6),
            (1000.0, "Pa", "kPa", 1e3),
            (0.05, "m", "mm", 1e-3),
            (2e-6, "s", "\u{b5}s", 1e-6),
            (5000.0, "s", "s", 1.0),
            (1200.0, "kg/m^3", "kg/m\u{b3}", 1.0),
            (1.2e7, "kg/m^3", "10^6 kg/m\u{b3}", 1e6),
            (0.3, "1", "", 1.0),
            (0.0, "Pa", "Pa", 1.0),
            (f64::NAN, "m", "m", 1.0),
        ] {
            let scale = Scale::new(largest, unit);
            assert_eq!(scale.unit, expected);
            assert!((scale.divisor / divisor - 1.0).abs() < 1e-12, "{largest} {unit}: powers of ten round");
        }
    }

    #[test]
    fn labels_tell_ticks_apart() {
        let scale = Scale::new(2e6, "Pa");
        assert_eq!(scale.label(1.25e6, 0.25e6), "1.25");
        assert_eq!(scale.label(-1e-9, 0.25e6), "0.00");
        assert_eq!(scale.label(2e6, 0.0), "2.000");
        assert_eq!(Scale::new(f64::MAX, "m").label(f64::INFINITY, f64::NAN), "inf");
        Scale::new(f64::MIN_POSITIVE, "1").label(f64::MIN_POSITIVE, f64::MIN_POSITIVE);
    }

    #[test]
    fn quantities_are_short() {
        assert_eq!(quantity(0.0125, "s"), "12.5 ms");
        assert_eq!(quantity(0.0, "s"), "0 s");
        assert_eq!(quantity(1234.56, "s"), "1235 s");
        assert_eq!(quantity(0.1 + 0.2, "m"), "300 mm");
        assert_eq!(quantity(f64::NAN, "s"), "NaN s");
    }
}
