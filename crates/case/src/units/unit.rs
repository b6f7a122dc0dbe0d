//! The table of units and prefixes.

use super::Dimension;

/// A scale to SI, as a fraction so that "30 mm" is the same number as 0.03.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    pub times: f64,
    pub over: f64,
    pub dimension: Dimension,
}

/// Symbol, factor to SI (times, over), dimension, whether it takes prefixes.
type Row = (&'static str, f64, f64, Dimension, bool);

const UNITS: &[Row] = &[
    ("m", 1.0, 1.0, Dimension::LENGTH, true),
    ("kg", 1.0, 1.0, Dimension::new(1, 0, 0), false),
    ("g", 1.0, 1e3, Dimension::new(1, 0, 0), true),
    ("t", 1e3, 1.0, Dimension::new(1, 0, 0), false),
    ("s", 1.0, 1.0, Dimension::TIME, true),
    ("min", 60.0, 1.0, Dimension::TIME, false),
    ("h", 3600.0, 1.0, Dimension::TIME, false),
    ("Hz", 1.0, 1.0, Dimension::new(0, 0, -1), true),
    ("N", 1.0, 1.0, Dimension::new(1, 1, -2), true),
    ("Pa", 1.0, 1.0, Dimension::PRESSURE, true),
    ("bar", 1e5, 1.0, Dimension::PRESSURE, true),
    ("J", 1.0, 1.0, Dimension::new(1, 2, -2), true),
    ("W", 1.0, 1.0, Dimension::new(1, 2, -3), true),
    ("rad", 1.0, 1.0, Dimension::NUMBER, true),
    ("deg", std::f64::consts::PI, 180.0, Dimension::NUMBER, false),
    ("%", 1.0, 100.0, Dimension::NUMBER, false),
    ("1", 1.0, 1.0, Dimension::NUMBER, false),
];

/// Prefix, factor (times, over).
const PREFIXES: &[(&str, f64, f64)] = &[
    ("n", 1.0, 1e9),
    ("u", 1.0, 1e6),
    ("\u{b5}", 1.0, 1e6),
    ("\u{3bc}", 1.0, 1e6),
    ("m", 1.0, 1e3),
    ("c", 1.0, 1e2),
    ("d", 1.0, 1e1),
    ("k", 1e3, 1.0),
    ("M", 1e6, 1.0),
    ("G", 1e9, 1.0),
    ("T", 1e12, 1.0),
];

/// The unit of a symbol, with or without prefix.
pub(super) fn unit(symbol: &str) -> Option<Unit> {
    if let Some(&(_, times, over, dimension, _)) = UNITS.iter().find(|row| row.0 == symbol) {
        return Some(Unit { times, over, dimension });
    }
    PREFIXES.iter().find_map(|&(prefix, up, down)| {
        let rest = symbol.strip_prefix(prefix)?;
        let &(_, times, over, dimension, _) = UNITS.iter().find(|row| row.4 && row.0 == rest)?;
        Some(Unit { times: times * up, over: over * down, dimension })
    })
}

/// Symbols to propose for a mistyped one: those in daily use in mechanics.
pub(super) const COMMON: &[&str] = &[
    "m", "mm", "um", "cm", "km", "s", "ms", "us", "min", "h", "kg", "g", "t", "N", "kN", "Pa", "kPa", "MPa",
    "GPa", "Hz", "kHz", "rad", "deg", "J", "kJ", "W", "%",
];
