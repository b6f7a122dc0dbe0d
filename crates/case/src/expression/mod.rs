//! Expressions such as `0.06*sqrt(E/rho)*sin(pi*x/L)`: read once, evaluated many times.
//!
//! From loose to tight: comparisons (1 if true, else 0; not chained), `+ -`, `* /`, unary minus, `^`
//! (from the right). So `-2^2` is -4 and `2^3^2` is 512.

mod function;
mod parser;
mod program;
mod token;

use std::ops::Range;

use thiserror::Error;

pub(crate) use function::{is_reserved, names as function_names};
use program::Program;

/// A compiled expression.
#[derive(Debug, Clone)]
pub struct Expression {
    text: String,
    program: Program,
}

/// What an expression does not say right.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// The bytes of the text that are to blame.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub hint: Option<String>,
}

/// The names that an expression may use besides functions and `pi`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Names<'a> {
    /// Names whose values are given at each evaluation, in this order.
    pub variables: &'a [&'a str],
    /// Names with fixed values.
    pub constants: &'a [(String, f64)],
}

impl Expression {
    /// Compiles a text.
    ///
    /// # Errors
    /// Not an expression, an unknown name, or nested deeper than 64 levels.
    pub fn parse(text: &str, names: &Names<'_>) -> Result<Self, ExpressionError> {
        let program = parser::parse(text, names)?;
        Ok(Self { text: text.to_string(), program })
    }

    /// An expression that is a number.
    pub fn constant(value: f64) -> Self {
        Self { text: value.to_string(), program: Program::constant(value) }
    }

    /// The value, when the variables have the values `variables` (a missing one counts as NaN).
    /// Allocates nothing.
    pub fn eval(&self, variables: &[f64]) -> f64 {
        self.program.eval(variables)
    }

    /// Whether the value depends on the variable of this number.
    pub fn uses(&self, variable: usize) -> bool {
        self.program.variables().any(|v| v == variable)
    }

    /// The numbers of the variables it depends on (one may come twice).
    pub fn variables(&self) -> impl Iterator<Item = usize> {
        self.program.variables()
    }

    /// The value, if it depends on no variable.
    pub fn as_constant(&self) -> Option<f64> {
        self.program.as_constant()
    }

    /// The text it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests;
