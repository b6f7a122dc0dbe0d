//! The elastic constants of an isotropic material, from any two of the four.

use super::scope::Scope;
use crate::diagnostic::Diagnostic;
use crate::keys::{self, material::ELASTIC};
use crate::written::{Node, Section};

/// Four constants, two of them independent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// E, Pa.
    pub youngs_modulus: f64,
    /// nu, between -1 and 0.5 (exclusive).
    pub poisson_ratio: f64,
    /// K, Pa; of three dimensions, in 2D as well.
    pub bulk_modulus: f64,
    /// G, Pa.
    pub shear_modulus: f64,
}

impl Elastic {
    /// From the two constants that a material gives.
    pub(super) fn read(section: &Section<'_>, scope: &Scope) -> Result<Self, Diagnostic> {
        let given: Vec<(usize, &Node)> =
            ELASTIC.iter().enumerate().filter_map(|(i, key)| Some((i, section.get(key.name)?))).collect();
        let [(i, first), (j, second)] = given.as_slice() else {
            return Err(wrong_count(section, &given));
        };
        let a = constant(scope, *i, first)?;
        let b = constant(scope, *j, second)?;
        let elastic = Self::from_two((*i, a), (*j, b));
        elastic.check(second)?;
        Ok(elastic)
    }

    /// From constants number `i < j` (in the order of the keys).
    fn from_two((i, a): (usize, f64), (j, b): (usize, f64)) -> Self {
        let (e, nu) = match (i, j) {
            (0, 1) => (a, b),
            (0, 2) => (a, (3.0 * b - a) / (6.0 * b)),
            (0, 3) => (a, a / (2.0 * b) - 1.0),
            (1, 2) => (3.0 * b * (1.0 - 2.0 * a), a),
            (1, 3) => (2.0 * b * (1.0 + a), a),
            _ => (9.0 * a * b / (3.0 * a + b), (3.0 * a - 2.0 * b) / (2.0 * (3.0 * a + b))),
        };
        let mut constants = [e, nu, e / (3.0 * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu))];
        constants[i] = a;
        constants[j] = b;
        let [youngs_modulus, poisson_ratio, bulk_modulus, shear_modulus] = constants;
        Self { youngs_modulus, poisson_ratio, bulk_modulus, shear_modulus }
    }

    /// Refuses what no stable, compressible solid has.
    fn check(&self, node: &Node) -> Result<(), Diagnostic> {
        let nu = self.poisson_ratio;
        let all = [self.youngs_modulus, self.bulk_modulus, self.shear_modulus];
        if nu > -1.0 && nu < 0.5 && all.iter().all(|c| c.is_finite() && *c > 0.0) {
            return Ok(());
        }
        let message = format!("the Poisson ratio has to lie between -1 and 0.5, found {nu}");
        Err(Diagnostic::at(node.place, message).help(
            "0.5 itself is an incompressible solid, whose bulk modulus and sound speed are infinite: take 0.49 or 0.499",
        ))
    }
}

fn constant(scope: &Scope, number: usize, node: &Node) -> Result<f64, Diagnostic> {
    let value = scope.of(node, &ELASTIC[number])?;
    if number == 1 {
        let sane =
            Elastic { youngs_modulus: 1.0, poisson_ratio: value, bulk_modulus: 1.0, shear_modulus: 1.0 };
        sane.check(node)?;
    }
    Ok(value)
}

fn wrong_count(section: &Section<'_>, given: &[(usize, &Node)]) -> Diagnostic {
    let names: Vec<&str> = given.iter().map(|(i, _)| ELASTIC[*i].name).collect();
    let found = if names.is_empty() { "none".to_string() } else { names.join(", ") };
    let place = if given.len() > 2 { given[given.len() - 1].1.place } else { section.place };
    Diagnostic::at(place, format!("{} needs exactly two elastic constants, found {found}", section.title))
        .help(format!("give two of {}", keys::names(&ELASTIC).join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_two_constants_give_the_same_four() {
        let (e, nu): (f64, f64) = (17e6, 0.45);
        let four = [e, nu, e / (3.0 * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu))];
        for i in 0..4 {
            for j in i + 1..4 {
                let from = Elastic::from_two((i, four[i]), (j, four[j]));
                let got = [from.youngs_modulus, from.poisson_ratio, from.bulk_modulus, from.shear_modulus];
                for k in 0..4 {
                    // A handful of roundings; 1 - 2 nu loses one digit at nu = 0.45.
                    assert!((got[k] / four[k] - 1.0).abs() < 1e-13, "{i} {j} {k}: {got:?}");
                }
                assert_eq!((got[i], got[j]), (four[i], four[j]));
            }
        }
    }
}
