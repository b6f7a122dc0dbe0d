//! Tools, and who touches whom.

use super::bodies::{filled, padded};
use super::solvers;
use crate::{Case, CaseError, Course, Family, Tool};
use taut::contact::{Contact, Meeting, PairPenalty, stiffness};
use taut::math::{Tensor, Vector};
use taut::simulation::{Motion, Point, Pose, Rigid, Solver};

/// Pieces of time over which a velocity that changes is integrated, of the time between two frames.
const PIECES: f64 = 64.0;

/// The particles of all tools, in the order of the file.
pub fn tools<const D: usize>(case: &Case) -> Result<Vec<Vec<Point<D>>>, CaseError> {
    let fill = |(k, tool): (usize, &Tool)| {
        let points = filled::<D>(case, (&tool.shape, &tool.fill), (&tool.name, tool.place))?;
        let body = (case.bodies.len() + k) as u32;
        Ok(points.into_iter().map(|(x, volume)| Point { body, ..Point::at(x, volume) }).collect())
    };
    case.tools.iter().enumerate().map(fill).collect()
}

/// A tool as a solver that solves nothing.
pub fn rigid<const D: usize>(case: &Case, tool: &Tool, points: &[Point<D>]) -> Box<dyn Solver> {
    let body = points.first().map_or(0, |point| point.body);
    let motion = Told { tool: tool.clone(), piece: case.time.output / PIECES };
    let points = points.iter().map(|point| (padded(point.x), point.volume));
    Box::new(Rigid::new(D, body, points, Box::new(motion)))
}

/// The motion that a case gives to a tool.
struct Told {
    tool: Tool,
    /// Length of a piece of time, s.
    piece: f64,
}

impl Motion for Told {
    fn pose(&self, t: f64) -> Pose {
        let displacement = match &self.tool.course {
            Course::Displacement(field) => {
                Vector(field.eval([0.0; 3], t)) - Vector(field.eval([0.0; 3], 0.0))
            }
            Course::Velocity(field) if !field.depends_on_time() => Vector(field.eval([0.0; 3], 0.0)).times(t),
            Course::Velocity(field) => self.travelled(|t| Vector(field.eval([0.0; 3], t)), t),
        };
        let turn = self.tool.turn.as_ref();
        let centre = Vector(turn.map_or([0.0; 3], |turn| turn.about));
        let rotation = turn.map_or(Tensor::diagonal(1.0), |turn| {
            rotation(turn.axis, turn.angle.eval([0.0; 3], t) - turn.angle.eval([0.0; 3], 0.0))
        });
        Pose { centre, rotation, displacement }
    }
}

impl Told {
    /// The integral of a velocity from 0 to `t`: three points of Gauss in each piece, always the same pieces.
    fn travelled(&self, velocity: impl Fn(f64) -> Vector<f64, 3>, t: f64) -> Vector<f64, 3> {
        let node = 0.6_f64.sqrt();
        let over = |from: f64, to: f64| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let ends = velocity(middle - half * node) + velocity(middle + half * node);
            ends.times(5.0 / 9.0).plus(8.0 / 9.0, velocity(middle)).times(half)
        };
        let whole = (t / self.piece).floor();
        let full = (0..whole as u64).fold(Vector::zero(), |sum: Vector<f64, 3>, k| {
            sum + over(k as f64 * self.piece, (k + 1) as f64 * self.piece)
        });
        full + over(whole * self.piece, t)
    }
}

/// The rotation by an angle about an axis of length 1 (Rodrigues).
fn rotation(axis: [f64; 3], angle: f64) -> Tensor<f64, 3> {
    let (s, c) = angle.sin_cos();
    Tensor::from_fn(|i, j| {
        let unit = if i == j { c } else { 0.0 };
        let across = if i == j { 0.0 } else { axis[3 - i - j] * if (i + 1) % 3 == j { -s } else { s } };
        unit + (1.0 - c) * axis[i] * axis[j] + across
    })
}

/// Contact of all that does not touch by its own pairs; `None` if nothing is to touch.
pub fn contact(case: &Case) -> Option<Contact> {
    let bodies = case.bodies.len();
    let modulus = |i: usize| {
        let material = case.bodies.get(i).and_then(|body| case.material_of(body));
        material.map(|material| solvers::moduli(material).bulk)
    };
    let updated =
        |i: usize| case.bodies.get(i).is_some_and(|b| b.scheme.formulation.family() == Family::Updated);
    let meets = |one: usize, other: usize| {
        let said = case.contacts.iter().find(|c| c.bodies == [one, other]);
        let by_itself = one != other && one < bodies && !(updated(one) && updated(other));
        said.map_or(by_itself.then_some(0.0), |c| c.friction)
    };
    let mut meetings = Vec::new();
    for (one, other) in (0..bodies + case.tools.len()).flat_map(|i| (0..=i).map(move |j| (j, i))) {
        if let Some(friction) = meets(one, other) {
            let stiffness = stiffness(modulus(one), modulus(other));
            meetings.push(Meeting { bodies: [one as u32, other as u32], stiffness, friction });
        }
    }
    let pushed = |c: &crate::Contact| {
        c.penalty.map(|[strength, reach]| PairPenalty { bodies: c.bodies.map(|b| b as u32), strength, reach })
    };
    let penalties: Vec<PairPenalty> = case.contacts.iter().filter_map(pushed).collect();
    let touch = !meetings.is_empty() || !penalties.is_empty();
    touch.then(|| {
        Contact::new(&meetings, case.spacing, case.dimension).with_penalties(&penalties, case.spacing)
    })
}
