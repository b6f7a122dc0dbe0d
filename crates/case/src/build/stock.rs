//! The particles of bodies and tools, with how good they are.

use super::bodies::{filled, padded};
use super::shapes;
use crate::{Case, CaseError, Fill, Place, ShapeSpec};
use geometry::{Fit, Points, Quality};

/// The particles of a body or tool.
#[derive(Debug)]
pub struct Stock {
    /// Its name.
    pub name: String,
    /// Its particles.
    pub points: Points,
    /// Distance of each from the surface, negative inside, m.
    pub distance: Vec<f64>,
    /// How good they are.
    pub quality: Quality,
    /// For those that were fitted now: how good a lattice is, the steps that it took, and whether they came to rest.
    pub fitted: Option<(Quality, usize, bool)>,
}

/// Fills all bodies and tools of a case, in the order of the file.
///
/// # Errors
/// A body that cannot be filled.
pub fn particles(case: &Case) -> Result<Vec<Stock>, CaseError> {
    let bodies = case.bodies.iter().map(|b| (&b.shape, &b.fill, b.name.as_str(), b.place));
    let tools = case.tools.iter().map(|t| (&t.shape, &t.fill, t.name.as_str(), t.place));
    bodies.chain(tools).map(|part| stock(case, part)).collect()
}

fn stock(
    case: &Case,
    (spec, fill, name, place): (&ShapeSpec, &Fill, &str, Place),
) -> Result<Stock, CaseError> {
    let shape = shapes::shape(spec);
    let dimension = if case.dimension == 2 { shapes::dimension::<2>() } else { shapes::dimension::<3>() };
    let refused = |error| case.error_at(place, format!("body `{name}` cannot be filled: {error}"), None);
    let (points, quality, fitted) = if *fill == Fill::Fitted {
        let Fit { points, quality, lattice, steps, at_rest } =
            geometry::fit(&shape, case.spacing, dimension).map_err(refused)?;
        (points, quality, Some((lattice, steps, at_rest)))
    } else {
        let points = if case.dimension == 2 {
            columns(filled::<2>(case, (spec, fill), (name, place))?.into_iter().map(|(x, v)| (padded(x), v)))
        } else {
            columns(filled::<3>(case, (spec, fill), (name, place))?.into_iter().map(|(x, v)| (padded(x), v)))
        };
        let quality = Quality::measure(&shape, &points, case.spacing, dimension).map_err(refused)?;
        (points, quality, None)
    };
    let distance = points.x.iter().map(|&x| shape.distance(x)).collect();
    Ok(Stock { name: name.to_string(), points, distance, quality, fitted })
}

fn columns(points: impl Iterator<Item = ([f64; 3], f64)>) -> Points {
    let (x, volume) = points.unzip();
    Points { x, volume }
}

/// The surfaces of the bodies, in triangles (see [`geometry::Shape::surface`]), with their names.
#[must_use]
pub fn surfaces(case: &Case) -> Vec<(String, Option<Vec<[geometry::Point; 3]>>)> {
    case.bodies.iter().map(|body| (body.name.clone(), shapes::shape(&body.shape).surface())).collect()
}
