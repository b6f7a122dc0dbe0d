//! What kind of quantity a number is.

use std::fmt;

/// Exponents of kilogram, metre and second. (Angles are numbers.)
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of kg.
    pub mass: i8,
    /// Exponent of m.
    pub length: i8,
    /// Exponent of s.
    pub time: i8,
}

impl Dimension {
    /// A plain number, or an angle in radians.
    pub const NUMBER: Self = Self::new(0, 0, 0);
    /// m
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// s
    pub const TIME: Self = Self::new(0, 0, 1);
    /// kg/m^3
    pub const DENSITY: Self = Self::new(1, -3, 0);
    /// Pa
    pub const PRESSURE: Self = Self::new(1, -1, -2);
    /// m/s
    pub const SPEED: Self = Self::new(0, 1, -1);
    /// Pa s
    pub const VISCOSITY: Self = Self::new(1, -1, -1);
    /// m/s^2
    pub const ACCELERATION: Self = Self::new(0, 1, -2);

    /// N (per metre of depth in 2D)
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// N m (likewise)
    pub const MOMENT: Self = Self::new(1, 2, -2);

    /// From the exponents of kg, m and s.
    pub const fn new(mass: i8, length: i8, time: i8) -> Self {
        Self { mass, length, time }
    }

    /// This times `other` to the power `power`; `None` beyond exponents of 100.
    pub(super) fn times(self, other: Self, power: i32) -> Option<Self> {
        let add = |a: i8, b: i8| {
            let sum = i32::from(a) + i32::from(b) * power;
            i8::try_from(sum).ok().filter(|e| e.abs() <= 100)
        };
        Some(Self {
            mass: add(self.mass, other.mass)?,
            length: add(self.length, other.length)?,
            time: add(self.time, other.time)?,
        })
    }

    /// The unit in SI base units, `1` for a number.
    fn base_units(self) -> String {
        let parts = [("kg", self.mass), ("m", self.length), ("s", self.time)];
        let used: Vec<String> = parts
            .into_iter()
            .filter(|(_, power)| *power != 0)
            .map(|(unit, power)| if power == 1 { unit.to_string() } else { format!("{unit}^{power}") })
            .collect();
        if used.is_empty() { "1".to_string() } else { used.join(" ") }
    }

    /// The SI unit, for those that have a name; "no unit" for a number.
    pub(crate) fn unit(self) -> &'static str {
        NAMES.iter().find(|(dimension, ..)| *dimension == self).map_or("", |(_, _, unit)| unit)
    }

    /// "a pressure", "a length"; a dimension without a name of its own is "a quantity".
    pub(crate) fn name(self) -> &'static str {
        NAMES.iter().find(|(dimension, ..)| *dimension == self).map_or("a quantity", |(_, name, _)| name)
    }
}

const NAMES: &[(Dimension, &str, &str)] = &[
    (Dimension::NUMBER, "a plain number", "no unit"),
    (Dimension::LENGTH, "a length", "m"),
    (Dimension::TIME, "a time", "s"),
    (Dimension::DENSITY, "a density", "kg/m^3"),
    (Dimension::PRESSURE, "a pressure", "Pa"),
    (Dimension::SPEED, "a speed", "m/s"),
    (Dimension::ACCELERATION, "an acceleration", "m/s^2"),
    (Dimension::VISCOSITY, "a viscosity", "Pa s"),
    (Dimension::new(1, 0, 0), "a mass", "kg"),
    (Dimension::new(0, 2, 0), "an area", "m^2"),
    (Dimension::new(0, 3, 0), "a volume", "m^3"),
    (Dimension::new(0, 0, -1), "a frequency", "Hz"),
    (Dimension::FORCE, "a force", "N"),
    (Dimension::new(1, 2, -2), "an energy", "J"),
    (Dimension::new(1, 2, -3), "a power", "W"),
];

impl fmt::Display for Dimension {
    /// "a pressure (Pa)".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match NAMES.iter().find(|(dimension, ..)| dimension == self) {
            Some((_, name, unit)) => write!(f, "{name} ({unit})"),
            None => write!(f, "{} ({})", self.name(), self.base_units()),
        }
    }
}
