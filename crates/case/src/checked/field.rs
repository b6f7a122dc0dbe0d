//! Numbers and vectors that depend on place and time.

use crate::expression::Expression;

/// A number that depends on the reference position and the time, parameters already put in.
#[derive(Debug, Clone)]
pub struct FieldExpression {
    expression: Expression,
    depends_on_time: bool,
    factor: f64,
}

impl FieldExpression {
    /// Takes an expression of the variables x, y, z, t (in this order).
    pub(crate) fn new(expression: Expression) -> Self {
        let depends_on_time = expression.uses(3);
        Self { expression, depends_on_time, factor: 1.0 }
    }

    /// The value at reference position `x` (m; the third is ignored in 2D) and time `t` (s), in SI units.
    /// NaN or infinite where the expression is (a root of a negative number, a division by zero).
    pub fn eval(&self, x: [f64; 3], t: f64) -> f64 {
        self.factor * self.expression.eval(&[x[0], x[1], x[2], t])
    }

    /// Whether the value may change with time.
    pub fn depends_on_time(&self) -> bool {
        self.depends_on_time
    }

    /// The first variable of place that it uses.
    pub(crate) fn place_variable(&self) -> Option<&'static str> {
        ["x", "y", "z"].into_iter().enumerate().find(|(i, _)| self.expression.uses(*i)).map(|(_, name)| name)
    }

    /// The value, if it is the same everywhere and always.
    pub fn as_constant(&self) -> Option<f64> {
        self.expression.as_constant().map(|value| self.factor * value)
    }

    /// So many times the value.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self { factor: factor * self.factor, ..self.clone() }
    }

    /// The text it was written as.
    pub fn text(&self) -> &str {
        self.expression.text()
    }
}

/// A vector of fields; the third component is 0 in 2D.
#[derive(Debug, Clone)]
pub struct VectorField {
    /// One per axis.
    pub components: [FieldExpression; 3],
}

impl Default for VectorField {
    /// Zero everywhere.
    fn default() -> Self {
        Self { components: std::array::from_fn(|_| FieldExpression::new(Expression::constant(0.0))) }
    }
}

impl VectorField {
    /// The vector at reference position `x` (m) and time `t` (s), in SI units.
    pub fn eval(&self, x: [f64; 3], t: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.components[i].eval(x, t))
    }

    /// So many times the vector.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self { components: self.components.each_ref().map(|component| component.times(factor)) }
    }

    /// Whether the vector may change with time.
    pub fn depends_on_time(&self) -> bool {
        self.components.iter().any(FieldExpression::depends_on_time)
    }
}
