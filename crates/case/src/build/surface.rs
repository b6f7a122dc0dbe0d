//! The surface of bodies on a lattice: faces of particles that have no neighbour there.

use super::bodies::{Group, padded};
use crate::{Case, CaseError, Fill, Load, LoadKind, March};
use geometry::Shape;
use std::collections::HashMap;

/// An outer face of a particle.
pub struct Face {
    /// The particle: its group and its index there.
    pub member: (usize, usize),
    /// The one behind it, if there is one.
    pub behind: Option<(usize, usize)>,
    /// Middle of the undeformed face, m.
    pub middle: [f64; 3],
    /// Outer normal of the undeformed face.
    pub normal: [f64; 3],
}

/// The outer faces of the bodies that a load may act on.
pub struct Surface(Vec<Face>);

impl Surface {
    /// Of the bodies of a load.
    ///
    /// # Errors
    /// A body that has no such faces, or whose formulation does not know how they turn.
    pub fn of<const D: usize>(case: &Case, load: &Load, groups: &[Group<'_, D>]) -> Result<Self, CaseError> {
        let mut faces = Vec::new();
        for (index, body) in case.bodies.iter().enumerate().filter(|&(i, _)| load.body.is_none_or(|b| b == i))
        {
            let Fill::Lattice { origin } = body.fill else {
                let message = format!(
                    "`{}` needs a body on a lattice, and `{}` is filled otherwise",
                    load.kind.name(),
                    body.name
                );
                let help = "use fill = \"lattice\", or a force with a region".to_string();
                return Err(case.error_at(load.place, message, Some(help)));
            };
            let unturned = !matches!(body.scheme.march, March::Total { .. });
            if matches!(load.kind, LoadKind::Pressure(_)) && unturned {
                let name = body.scheme.formulation.name();
                let message =
                    format!("`pressure` needs a total Lagrangian body, and `{}` uses {name}", body.name);
                let help = "use tl-hourglass-free, or a traction, which keeps its direction".to_string();
                return Err(case.error_at(load.place, message, Some(help)));
            }
            outer(groups, index as u32, (origin, case.spacing), &mut faces);
        }
        Ok(Self(faces))
    }

    /// The faces whose middle is in a region.
    pub fn faces(&self, region: &Shape) -> impl Iterator<Item = &Face> {
        self.0.iter().filter(move |face| region.contains(face.middle))
    }
}

/// The outer faces of a body.
fn outer<const D: usize>(
    groups: &[Group<'_, D>],
    body: u32,
    (origin, spacing): ([f64; 3], f64),
    faces: &mut Vec<Face>,
) {
    let cell = |x: [f64; 3]| -> [i64; 3] {
        std::array::from_fn(|i| if i < D { ((x[i] - origin[i]) / spacing - 0.5).round() as i64 } else { 0 })
    };
    let mine = || {
        let all = groups
            .iter()
            .enumerate()
            .flat_map(|(g, group)| group.points.iter().enumerate().map(move |(i, p)| ((g, i), p)));
        all.filter(|(_, point)| point.body == body)
    };
    let taken: HashMap<[i64; 3], (usize, usize)> =
        mine().map(|(m, point)| (cell(padded(point.x)), m)).collect();
    for (member, point) in mine() {
        let (x, here) = (padded(point.x), cell(padded(point.x)));
        for (axis, side) in (0..D).flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let mut next = here;
            next[axis] += side;
            if taken.contains_key(&next) {
                continue;
            }
            let (mut middle, mut normal) = (x, [0.0; 3]);
            normal[axis] = side as f64;
            middle[axis] += 0.5 * side as f64 * spacing;
            next[axis] -= 2 * side;
            faces.push(Face { member, behind: taken.get(&next).copied(), middle, normal });
        }
    }
}
