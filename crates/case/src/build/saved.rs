//! Particles that were saved.

use super::bodies::vector;
use super::shapes;
use crate::{Case, CaseError, Place, Saved};
use geometry::Shape;
use taut::math::Vector;

/// How much the spacing of the case may differ from that of the file, and the volume of its particles from that of the shape: what is more
/// is another body. The volume is reckoned from probes, which know that of a thin body within some per cent.
const OFF: [f64; 2] = [1e-3, 0.25];

/// The particles of a file that lie in the shape.
pub fn filled<const D: usize>(
    case: &Case,
    (shape, saved): (&Shape, &Saved),
    (name, place): (&str, Place),
) -> Result<Vec<(Vector<f64, D>, f64)>, CaseError> {
    let wrong = |problem: String, help: &str| {
        let message = format!("the particles of {} do not fill body `{name}`: {problem}", saved.file);
        Err(case.error_at(place, message, Some(help.to_string())))
    };
    if (saved.spacing / case.spacing - 1.0).abs() > OFF[0] {
        let problem = format!("they are {} m apart, and the case has {} m", saved.spacing, case.spacing);
        return wrong(problem, "save them anew, or give the case their spacing");
    }
    let mine: Vec<_> = saved.points.iter().filter(|(x, _)| shape.contains(*x)).collect();
    let volume: f64 = mine.iter().map(|(_, volume)| volume).sum();
    let share = volume
        / (geometry::reckon(shape, case.spacing, shapes::dimension::<D>()) * case.spacing.powi(D as i32));
    if mine.is_empty() || (share - 1.0).abs() > OFF[1] {
        let problem = format!(
            "{} of {} lie in its shape and fill {:.0} % of it",
            mine.len(),
            saved.points.len(),
            100.0 * share
        );
        return wrong(problem, "was the file made for another shape, or before this one was moved?");
    }
    Ok(mine.into_iter().map(|&(x, volume)| (vector(x), volume)).collect())
}
