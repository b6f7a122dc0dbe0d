//! The functions that expressions know.

/// How many arguments a function takes and what it does with them.
#[derive(Debug, Clone, Copy)]
pub(super) enum Function {
    /// One argument.
    One(fn(f64) -> f64),
    /// Two arguments.
    Two(fn(f64, f64) -> f64),
    /// Two arguments or more, taken from the left.
    Many(fn(f64, f64) -> f64),
    /// `if(condition, then, else)`.
    If,
}

const FUNCTIONS: &[(&str, Function)] = &[
    ("sin", Function::One(f64::sin)),
    ("cos", Function::One(f64::cos)),
    ("tan", Function::One(f64::tan)),
    ("asin", Function::One(f64::asin)),
    ("acos", Function::One(f64::acos)),
    ("atan", Function::One(f64::atan)),
    ("atan2", Function::Two(f64::atan2)),
    ("sinh", Function::One(f64::sinh)),
    ("cosh", Function::One(f64::cosh)),
    ("tanh", Function::One(f64::tanh)),
    ("exp", Function::One(f64::exp)),
    ("ln", Function::One(f64::ln)),
    ("log10", Function::One(f64::log10)),
    ("sqrt", Function::One(f64::sqrt)),
    ("abs", Function::One(f64::abs)),
    ("min", Function::Many(f64::min)),
    ("max", Function::Many(f64::max)),
    ("floor", Function::One(f64::floor)),
    ("ceil", Function::One(f64::ceil)),
    ("round", Function::One(f64::round)),
    ("sign", Function::One(sign)),
    ("hypot", Function::Two(f64::hypot)),
    ("mod", Function::Two(modulo)),
    ("if", Function::If),
];

/// -1, 0 or 1.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// What is left of `a` after whole multiples of `b`, with the sign of `b`.
fn modulo(a: f64, b: f64) -> f64 {
    a - b * (a / b).floor()
}

/// The function of this name.
pub(super) fn function(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(n, _)| *n == name).map(|(_, function)| *function)
}

/// All names of functions.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|(name, _)| *name)
}

/// Whether a name means something already in every expression: a function, a coordinate, the time, pi.
pub(crate) fn is_reserved(name: &str) -> bool {
    ["x", "y", "z", "t", "pi"].contains(&name) || function(name).is_some()
}
