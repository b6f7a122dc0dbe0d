//! What brings bodies to rest.

use super::bodies::Group;
use crate::Case;
use taut::simulation::{Damping, Increments, Splitting, Viscous};

/// The damping of a case.
pub fn damping<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Option<Box<dyn Damping>> {
    match case.damping? {
        crate::Damping::Viscous { rate } => Some(Box::new(Viscous { rate })),
        crate::Damping::Splitting { viscosity, probability, seed } => {
            let of = |group| viscosity.unwrap_or_else(|| usual(case, group));
            let viscosity = groups.iter().map(of).collect();
            Some(Box::new(Splitting { viscosity, probability, seed }))
        }
    }
}

/// sqrt(rho E) L / 4 with the longest side L of the particles, Pa s.
fn usual<const D: usize>(case: &Case, group: &Group<'_, D>) -> f64 {
    let side = |i: usize| {
        let x = group.points.iter().map(|p| p.x[i]);
        let low = x.clone().fold(f64::INFINITY, f64::min);
        x.fold(f64::NEG_INFINITY, f64::max) - low + case.spacing
    };
    let longest = (0..D).map(side).fold(0.0, f64::max);
    let of = |m: &crate::Material| (m.density * m.elastic.youngs_modulus).sqrt();
    0.25 * longest * case.material_of(group.bodies[0].1).map_or(0.0, of)
}

/// The increments of a quasi-static case.
pub fn increments(case: &Case) -> Option<Increments> {
    let s = case.quasi_static?;
    Some(Increments { end: case.time.end, count: s.increments, tolerance: s.tolerance, most: s.max_steps })
}
