//! What is doubtful about a case once its particles are there.

use super::bodies::{Group, padded};
use super::shapes;
use crate::{Case, Constraint, Fill, ShapeSpec};
use geometry::Mesh;
use taut::neighbours::{Adjacency, Search};
use taut::simulation::Point;

/// Fewer particles than this across a part do not bend as a solid does.
const LEAST_ACROSS: usize = 4;

/// Beyond this share of the wave speed impacts are no longer those of a nearly incompressible solid, and particles may pass
/// into each other.
const FAST: f64 = 0.3;

/// All doubts.
pub fn warnings<const D: usize>(
    case: &Case,
    (groups, tools): (&[Group<'_, D>], &[Vec<Point<D>>]),
    across: &[usize],
) -> Vec<String> {
    let mut warnings = Vec::new();
    warnings.extend(thin(case, across));
    warnings.extend(slender(case));
    warnings.extend(lost::<D>(case));
    warnings.extend(overlap(case, (groups, tools)));
    warnings.extend(fast(case, groups));
    warnings
}

fn thin(case: &Case, across: &[usize]) -> Vec<String> {
    let thin = case.bodies.iter().zip(across).filter(|(_, across)| **across < LEAST_ACROSS);
    thin.map(|(body, across)| {
        format!(
            "body `{}` has {across} particles across its thinnest part: at least {LEAST_ACROSS} are needed; choose a smaller spacing",
            body.name
        )
    })
    .collect()
}

/// Meshes that are somewhere thinner than a particle.
fn slender(case: &Case) -> Vec<String> {
    let bodies = case.bodies.iter().map(|body| (&body.name, &body.shape));
    let all = bodies.chain(case.tools.iter().map(|tool| (&tool.name, &tool.shape)));
    let mut warnings = Vec::new();
    for (name, shape) in all {
        each_mesh(shape, 1.0, &mut |file, mesh, scale| {
            let Some(thin) = mesh.thinnest().filter(|thin| thin.thickness * scale < case.spacing) else {
                return;
            };
            let (thickness, at) = (thin.thickness * scale, thin.at);
            warnings.push(format!(
                "`{name}` is thinner than a particle: the mesh {file} is {thickness:.4e} m thick at ({:.4e}, {:.4e}, {:.4e}) m of the file, and the spacing is {:.4e} m; what is that thin has no particles or a single layer",
                at[0], at[1], at[2], case.spacing
            ));
        });
    }
    warnings
}

/// Every mesh in a shape, with its file and by how much it is scaled.
fn each_mesh(shape: &ShapeSpec, scale: f64, tell: &mut impl FnMut(&str, &Mesh, f64)) {
    match shape {
        ShapeSpec::Mesh { file, mesh } => tell(file, mesh, scale),
        ShapeSpec::Union(parts) | ShapeSpec::Intersection(parts) | ShapeSpec::Difference(parts) => {
            parts.iter().for_each(|part| each_mesh(part, scale, tell));
        }
        ShapeSpec::Translate { shape, .. } | ShapeSpec::Rotate { shape, .. } => each_mesh(shape, scale, tell),
        ShapeSpec::Scale { factor, shape, .. } => each_mesh(shape, scale * factor, tell),
        _ => {}
    }
}

fn overlap<const D: usize>(
    case: &Case,
    (groups, tools): (&[Group<'_, D>], &[Vec<Point<D>>]),
) -> Option<String> {
    let points: Vec<_> = groups.iter().flat_map(|g| &g.points).chain(tools.iter().flatten()).collect();
    let columns: [Vec<f64>; D] = std::array::from_fn(|i| points.iter().map(|p| p.x[i]).collect());
    let mut list = Adjacency::default();
    let x = std::array::from_fn(|i| columns[i].as_slice());
    Search::<D>::new().pairs(x, 0.5 * case.spacing, None, &mut list).ok()?;
    let meets = |a: usize| list.of(a).iter().any(|&b| points[b as usize].body != points[a].body);
    let count = (0..points.len()).filter(|&a| meets(a)).count();
    (count > 0).then(|| {
        format!(
            "{count} particles of different bodies are closer than half a spacing: the bodies overlap at the start"
        )
    })
}

/// Bodies that start faster, or are driven faster at the start, than a fair share of their wave speed.
fn fast<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Vec<String> {
    let mut speeds = vec![0.0_f64; case.bodies.len()];
    for point in groups.iter().flat_map(|g| &g.points) {
        let x = padded(point.x);
        let mut speed = point.v.norm_squared().sqrt();
        for boundary in &case.boundaries {
            let Constraint::Velocity(fields) = &boundary.constraint else { continue };
            let mine = boundary.body.is_none_or(|b| b as u32 == point.body);
            if mine && shapes::shape(&boundary.region).contains(x) {
                let driven = fields.iter().flatten().map(|f| f.eval(x, 0.0).powi(2)).sum::<f64>().sqrt();
                speed = speed.max(driven);
            }
        }
        let fastest = &mut speeds[point.body as usize];
        *fastest = fastest.max(speed);
    }
    let told = case.bodies.iter().zip(speeds).filter_map(|(body, speed)| {
        let c = case.material_of(body)?.wave_speed();
        (speed > FAST * c).then(|| {
            format!(
                "body `{}` moves at {speed:.4} m/s at the start, {:.2} of its wave speed {c:.4} m/s: beyond {FAST} results are doubtful",
                body.name,
                speed / c
            )
        })
    });
    told.collect()
}

/// Parts of shapes that the lattice does not see: members of unions without a particle, holes that hold none.
fn lost<const D: usize>(case: &Case) -> Vec<String> {
    let mut warnings = Vec::new();
    for body in &case.bodies {
        let Fill::Lattice { origin } = body.fill else { continue };
        let empty = |shape: &geometry::Shape| {
            let fill = geometry::Fill::Lattice { origin };
            let filled = geometry::fill(shape, &fill, case.spacing, shapes::dimension::<D>());
            matches!(filled, Err(geometry::FillError::Empty { .. }))
        };
        let mut count = [0, 0];
        look(&body.shape, &empty, &mut count);
        for (count, what) in
            count.into_iter().zip(["part of its shape holds no particle", "hole takes no particle away"])
        {
            if count > 0 {
                warnings.push(format!(
                    "body `{}` loses features on the lattice: {count} {what}; choose a smaller spacing",
                    body.name
                ));
            }
        }
    }
    warnings
}

/// Counts the parts of unions and the holes that are lost.
fn look(shape: &ShapeSpec, empty: &impl Fn(&geometry::Shape) -> bool, count: &mut [usize; 2]) {
    match shape {
        ShapeSpec::Union(parts) => {
            count[0] += parts.iter().filter(|part| empty(&shapes::shape(part))).count();
            parts.iter().for_each(|part| look(part, empty, count));
        }
        ShapeSpec::Difference(parts) => {
            let mut parts = parts.iter();
            let Some(solid) = parts.next() else { return };
            let solid_shape = shapes::shape(solid);
            for hole in parts {
                let both = geometry::Shape::Intersection(vec![solid_shape.clone(), shapes::shape(hole)]);
                count[1] += usize::from(empty(&both));
            }
            look(solid, empty, count);
        }
        _ => {}
    }
}
