//! Reading "number unit".

use std::ops::Range;

use thiserror::Error;

use super::Dimension;
use super::unit::{COMMON, Unit, unit};
use crate::diagnostic::did_you_mean;

/// A number with a unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The value in SI units.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// The unit as written.
    pub unit: String,
}

/// A unit that is not known.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}")]
pub struct UnitError {
    /// The bytes of the text that are to blame.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub hint: String,
}

impl Quantity {
    /// Reads a text such as `17 MPa`, `0.1 mm/s`, `-9.81 m/s^2`; `None` when it has not the form
    /// number, unit (then it may be an expression).
    ///
    /// # Errors
    /// The form is right but a unit is unknown.
    pub fn parse(text: &str) -> Option<Result<Self, UnitError>> {
        let (number, after) = leading_number(text)?;
        let rest = &text[after..];
        let start = after + (rest.len() - rest.trim_start().len());
        let written = text[start..].trim_end();
        let factors = factors(written)?;
        Some(combine(&factors, start, written).map(|unit| Self {
            value: number * unit.times / unit.over,
            dimension: unit.dimension,
            unit: written.to_string(),
        }))
    }
}

/// One symbol with its power.
struct Factor<'a> {
    symbol: &'a str,
    span: Range<usize>,
    power: i32,
}

/// Splits `kg/m^3`, `N m`, `m*s^-2` into symbols and powers; `None` if it has another form.
fn factors(text: &str) -> Option<Vec<Factor<'_>>> {
    let mut found = Vec::new();
    let mut at = 0;
    let mut sign = 1;
    loop {
        at += blanks(&text[at..]);
        let length = symbol_length(&text[at..])?;
        let span = at..at + length;
        at = span.end;
        let (power, used) = power(&text[at..])?;
        at += used;
        found.push(Factor { symbol: &text[span.clone()], span, power: sign * power });
        let gap = blanks(&text[at..]);
        at += gap;
        let rest = &text[at..];
        match rest.chars().next() {
            None => return Some(found),
            Some(sign_of @ ('*' | '/' | '\u{b7}')) => {
                sign = if sign_of == '/' { -1 } else { 1 };
                at += sign_of.len_utf8();
            }
            Some(_) if gap > 0 => sign = 1,
            Some(_) => return None,
        }
    }
}

fn blanks(text: &str) -> usize {
    text.len() - text.trim_start_matches(' ').len()
}

/// Length of a symbol: letters with digits after them, `%`, or `1`.
fn symbol_length(text: &str) -> Option<usize> {
    let first = text.chars().next()?;
    if first == '%' || first == '1' {
        return Some(1);
    }
    if !first.is_alphabetic() {
        return None;
    }
    Some(text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len()))
}

/// The power after a symbol (1 if there is none) and the number of bytes it takes.
fn power(text: &str) -> Option<(i32, usize)> {
    let Some(rest) = text.strip_prefix('^') else { return Some((1, 0)) };
    let digits = rest.strip_prefix('-').unwrap_or(rest);
    let count = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    let used = rest.len() - digits.len() + count;
    let power: i32 = rest[..used].parse().ok().filter(|p: &i32| p.abs() <= 9)?;
    Some((power, 1 + used))
}

/// The product of the factors; `start` is where the unit begins in the whole text.
fn combine(factors: &[Factor<'_>], start: usize, written: &str) -> Result<Unit, UnitError> {
    let mut product = Unit { times: 1.0, over: 1.0, dimension: Dimension::NUMBER };
    for factor in factors {
        let span = start + factor.span.start..start + factor.span.end;
        let base = unit(factor.symbol).ok_or_else(|| UnitError {
            span: span.clone(),
            message: format!("unknown unit `{}`", factor.symbol),
            hint: format!(
                "{}; powers are written m/s^2, and a product in an expression needs `*`",
                did_you_mean(factor.symbol, COMMON.iter().copied())
            ),
        })?;
        product.dimension =
            product.dimension.times(base.dimension, factor.power).ok_or_else(|| UnitError {
                span,
                message: format!("the powers in the unit `{written}` are too high"),
                hint: "SI units of mechanics have small powers".to_string(),
            })?;
        let (up, down) = if factor.power < 0 { (base.over, base.times) } else { (base.times, base.over) };
        product.times *= up.powi(factor.power.abs());
        product.over *= down.powi(factor.power.abs());
    }
    Ok(product)
}

/// The number that a text begins with and where it ends; `None` if nothing follows it.
fn leading_number(text: &str) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let mut at = text.len() - text.trim_start().len();
    let start = at;
    at += usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mantissa = at;
    while matches!(bytes.get(at), Some(b'0'..=b'9' | b'.')) {
        at += 1;
    }
    if at == mantissa {
        return None;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let digits = at + 1 + usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        let end = digits + bytes[digits.min(bytes.len())..].iter().take_while(|b| b.is_ascii_digit()).count();
        at = if end > digits { end } else { at };
    }
    let number = text[start..at].parse().ok()?;
    (!text[at..].trim().is_empty()).then_some((number, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Quantity {
        Quantity::parse(text).expect("a quantity").expect("a known unit")
    }

    #[test]
    fn units_have_their_si_value_and_dimension() {
        let length = Dimension::LENGTH;
        let rows = [
            ("17 MPa", 17e6, Dimension::PRESSURE),
            ("17MPa", 17e6, Dimension::PRESSURE),
            ("30 mm", 0.03, length),
            ("5 um", 5e-6, length),
            ("5 \u{b5}m", 5e-6, length),
            ("2 km", 2000.0, length),
            ("1.5 cm", 0.015, length),
            ("3 min", 180.0, Dimension::TIME),
            ("2 h", 7200.0, Dimension::TIME),
            ("4 us", 4e-6, Dimension::TIME),
            ("3 g", 0.003, Dimension::new(1, 0, 0)),
            ("3 kg", 3.0, Dimension::new(1, 0, 0)),
            ("3 t", 3000.0, Dimension::new(1, 0, 0)),
            ("2 kN", 2000.0, Dimension::new(1, 1, -2)),
            ("1 GPa", 1e9, Dimension::PRESSURE),
            ("1 N/mm^2", 1e6, Dimension::PRESSURE),
            ("1 N mm^-2", 1e6, Dimension::PRESSURE),
            ("7.8 g/cm^3", 7800.0, Dimension::DENSITY),
            ("7.8e3 kg/m^3", 7800.0, Dimension::DENSITY),
            ("-9.81 m/s^2", -9.81, Dimension::ACCELERATION),
            ("0.1 mm/s", 0.0001, Dimension::SPEED),
            ("5 1/s", 5.0, Dimension::new(0, 0, -1)),
            ("2 kHz", 2000.0, Dimension::new(0, 0, -1)),
            ("180 deg", std::f64::consts::PI, Dimension::NUMBER),
            ("1 rad", 1.0, Dimension::NUMBER),
            ("40 %", 0.4, Dimension::NUMBER),
            ("2 N*m", 2.0, Dimension::new(1, 2, -2)),
            ("2 J", 2.0, Dimension::new(1, 2, -2)),
        ];
        for (text, value, dimension) in rows {
            let quantity = read(text);
            // Two roundings (a product and a quotient) of a correctly rounded number.
            assert!(
                (quantity.value - value).abs() <= 2.0 * f64::EPSILON * value.abs(),
                "{text}: {quantity:?}"
            );
            assert_eq!(quantity.dimension, dimension, "{text}");
        }
    }

    #[test]
    fn decimal_prefixes_give_the_number_one_would_type() {
        for (text, value) in [("30 mm", 0.03), ("0.2 mm", 0.0002), ("17 MPa", 17e6), ("5 ms", 0.005)] {
            assert_eq!(read(text).value, value, "{text}");
        }
    }

    #[test]
    fn other_forms_are_left_to_the_expressions() {
        for text in ["3", "2*pi", "1/2", "L", "-x", "2 + 3 m", "", "  ", ".", "2 m +", "3e5", "2^3", "2 m^99"]
        {
            assert!(Quantity::parse(text).is_none(), "{text}");
        }
    }

    #[test]
    fn an_unknown_unit_is_named_with_its_place_and_neighbour() {
        let error = Quantity::parse("17 MPaa").expect("a quantity").expect_err("unknown unit");
        assert_eq!((error.span, error.message.as_str()), (3..7, "unknown unit `MPaa`"));
        assert!(error.hint.contains("`MPa`"), "{}", error.hint);
        assert!(
            Quantity::parse("2 m^9*m^9*m^9*m^9*m^9*m^9*m^9*m^9*m^9*m^9*m^9*m^9").is_some_and(|r| r.is_err())
        );
    }

    #[test]
    fn dimensions_are_named() {
        assert_eq!(Dimension::PRESSURE.to_string(), "a pressure (Pa)");
        assert_eq!(Dimension::new(1, 0, -2).to_string(), "a quantity (kg s^-2)");
    }
}
