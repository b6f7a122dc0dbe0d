//! Bodies as points, in the groups that one solver advances.

use super::{saved, shapes};
use crate::{Body, Case, CaseError, Family, Fill, Place, ShapeSpec};
use geometry::Shape;
use taut::math::Vector;
use taut::simulation::Point;

/// Points that share a solver: one total Lagrangian body, or all updated Lagrangian bodies.
pub struct Group<'a, const D: usize> {
    /// The bodies, with their index in the case.
    pub bodies: Vec<(usize, &'a Body)>,
    /// Their points.
    pub points: Vec<Point<D>>,
}

/// A vector of the dimension of the case.
pub fn vector<const D: usize>(x: [f64; 3]) -> Vector<f64, D> {
    Vector::from_fn(|i| x[i])
}

/// The other way round, with zeros.
pub fn padded<const D: usize>(x: Vector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|i| if i < D { x[i] } else { 0.0 })
}

/// A shape of the case, checked.
pub fn checked<const D: usize>(case: &Case, spec: &ShapeSpec, place: Place) -> Result<Shape, CaseError> {
    let shape = shapes::shape(spec);
    match shape.validate(shapes::dimension::<D>()) {
        Ok(()) => Ok(shape),
        Err(error) => Err(case.error_at(place, error.to_string(), None)),
    }
}

/// Fills all bodies and sorts them into groups, in the order of the file.
pub fn groups<const D: usize>(case: &Case) -> Result<Vec<Group<'_, D>>, CaseError> {
    let mut groups: Vec<Group<'_, D>> = Vec::new();
    for (index, body) in case.bodies.iter().enumerate() {
        let mut points = fill(case, index, body)?;
        let updated = body.scheme.formulation.family() == Family::Updated;
        let shared = groups
            .iter_mut()
            .find(|g| updated && g.bodies[0].1.scheme.formulation.family() == Family::Updated);
        match shared {
            Some(group) if group.bodies[0].1.scheme.formulation != body.scheme.formulation => {
                let message = format!(
                    "body `{}` uses {}, but updated Lagrangian bodies share their pairs and need one formulation",
                    body.name,
                    body.scheme.formulation.name()
                );
                let help =
                    format!("the bodies before it use {}", group.bodies[0].1.scheme.formulation.name());
                return Err(case.error_at(body.place, message, Some(help)));
            }
            Some(group) if model(case, group.bodies[0].1) != model(case, body) => {
                let message = format!(
                    "the material `{}` of body `{}` has another model, but updated Lagrangian bodies share their pairs and need one",
                    body.material, body.name
                );
                let first = group.bodies[0].1;
                let help =
                    format!("the bodies before it, such as `{}`, are {}", first.name, model(case, first));
                return Err(case.error_at(body.place, message, Some(help)));
            }
            Some(group) if group.bodies[0].1.scheme.smoothing != body.scheme.smoothing => {
                let message = format!(
                    "body `{}` has its own `smoothing`, but updated Lagrangian bodies share their pairs and need one",
                    body.name
                );
                return Err(case.error_at(body.place, message, None));
            }
            Some(group) => {
                group.bodies.push((index, body));
                group.points.append(&mut points);
            }
            None => groups.push(Group { bodies: vec![(index, body)], points }),
        }
    }
    Ok(groups)
}

/// The name of the model of a body's material.
fn model(case: &Case, body: &Body) -> &'static str {
    case.material_of(body).map_or("", |material| material.model.name())
}

/// Places and volumes of the particles of a shape.
pub fn filled<const D: usize>(
    case: &Case,
    (shape, fill): (&ShapeSpec, &Fill),
    (name, place): (&str, Place),
) -> Result<Vec<(Vector<f64, D>, f64)>, CaseError> {
    let shape = shapes::shape(shape);
    let fill = match fill {
        Fill::Lattice { origin } => geometry::Fill::Lattice { origin: *origin },
        Fill::Concentric => geometry::Fill::Concentric,
        Fill::Fitted => geometry::Fill::Fitted,
        Fill::Saved(saved) => return saved::filled(case, (&shape, saved), (name, place)),
        Fill::Polar { around, rings } => {
            geometry::Fill::Polar { around: *around as usize, rings: rings.map(|n| n as usize) }
        }
    };
    let filled = geometry::fill(&shape, &fill, case.spacing, shapes::dimension::<D>());
    let points = filled
        .map_err(|error| case.error_at(place, format!("body `{name}` cannot be filled: {error}"), None))?;
    Ok(points.x.iter().map(|&x| vector(x)).zip(points.volume).collect())
}

fn fill<const D: usize>(case: &Case, index: usize, body: &Body) -> Result<Vec<Point<D>>, CaseError> {
    let points = filled::<D>(case, (&body.shape, &body.fill), (&body.name, body.place))?;
    let mut out = Vec::with_capacity(points.len());
    for (at, volume) in points {
        let x = padded(at);
        let v = body.velocity.eval(x, 0.0);
        if let Some(bad) = v.iter().find(|c| !c.is_finite()) {
            let message = format!("the velocity of body `{}` is {bad} at {x:?} m", body.name);
            return Err(case.error_at(body.place, message, None));
        }
        out.push(Point { v: vector(v), body: index as u32, ..Point::at(at, volume) });
    }
    Ok(out)
}

/// Gives the particles of regions their own velocity at the start.
pub fn initial<const D: usize>(case: &Case, groups: &mut [Group<'_, D>]) -> Result<(), CaseError> {
    for initial in &case.initial {
        let region = checked::<D>(case, &initial.region, initial.place)?;
        let mut count = 0;
        for point in groups.iter_mut().flat_map(|g| &mut g.points) {
            let x = padded(point.x);
            if initial.body.is_none_or(|b| b as u32 == point.body) && region.contains(x) {
                point.v = vector(initial.velocity.eval(x, 0.0));
                if !point.v.norm_squared().is_finite() {
                    let message = format!("this velocity is not a number at {x:?} m");
                    return Err(case.error_at(initial.place, message, None));
                }
                count += 1;
            }
        }
        if count == 0 {
            return Err(case.error_at(initial.place, "no particle is in this region", None));
        }
    }
    Ok(())
}
