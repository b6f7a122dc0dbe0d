//! Boundaries and body forces: what is fixed once, and what changes with time.

use super::bodies::{Group, checked, padded, vector};
use crate::{Boundary, Case, CaseError, Constraint, FieldExpression, Gravity, VectorField};
use geometry::Shape;
use taut::field::Quantity;
use taut::pass::Now;
use taut::simulation::{Drive, Grip, Point, Solver};

/// A particle: its group, which is its solver, its index in the group, which is its id there, and its reference position.
type Member = (usize, usize, [f64; 3]);

/// Drives that wait for the solvers.
pub struct Driven {
    /// Of each group, of each particle, which boundary holds each axis.
    owners: Vec<Vec<[Option<usize>; 3]>>,
    motions: Vec<(Constraint, Vec<Member>)>,
    forces: Vec<(Member, Vec<VectorField>)>,
}

/// Marks prescribed components and constant forces in the points.
pub fn prescribe<const D: usize>(case: &Case, groups: &mut [Group<'_, D>]) -> Result<Driven, CaseError> {
    let mut motions = Vec::new();
    let mut owners: Vec<_> = groups.iter().map(|g| vec![[None; 3]; g.points.len()]).collect();
    for (index, boundary) in case.boundaries.iter().enumerate() {
        let members = hold(case, boundary, groups)?;
        own(case, index, &members, &mut owners);
        if boundary.constraint.is_led() {
            motions.push((boundary.constraint.clone(), members));
        }
    }
    Ok(Driven { owners, motions, forces: pull(case, groups)? })
}

/// Notes which axes a boundary holds. Where several do, the last that leads decides, as it does for the motion.
fn own(case: &Case, index: usize, members: &[Member], owners: &mut [Vec<[Option<usize>; 3]>]) {
    let constraint = &case.boundaries[index].constraint;
    let held = constraint.axes();
    for &(g, i, _) in members {
        for k in (0..case.dimension).filter(|&k| held[k]) {
            let owner = &mut owners[g][i][k];
            if constraint.is_led() || owner.is_none_or(|o| !case.boundaries[o].constraint.is_led()) {
                *owner = Some(index);
            }
        }
    }
}

/// The particles of a boundary, with the components it prescribes no longer free.
fn hold<const D: usize>(
    case: &Case,
    boundary: &Boundary,
    groups: &mut [Group<'_, D>],
) -> Result<Vec<Member>, CaseError> {
    let region = checked::<D>(case, &boundary.region, boundary.place)?;
    let except = boundary.except.as_ref().map(|e| checked::<D>(case, e, boundary.place)).transpose()?;
    let held = boundary.constraint.axes();
    let mut members = Vec::new();
    for (g, group) in groups.iter_mut().enumerate() {
        for (i, point) in group.points.iter_mut().enumerate() {
            let x = padded(point.x);
            let mine = boundary.body.is_none_or(|b| b as u32 == point.body);
            if mine && region.contains(x) && !except.as_ref().is_some_and(|e| e.contains(x)) {
                for k in (0..D).filter(|&k| held[k]) {
                    point.free[k] = 0.0;
                }
                members.push((g, i, x));
            }
        }
    }
    if let Some((field, x)) = nonsense(&boundary.constraint, &members) {
        let message = format!("`{}` is not a number at {x:?} m when the run starts", field.text());
        return Err(case.error_at(boundary.place, message, None));
    }
    if members.is_empty() {
        let help = "move or enlarge its region: particles stand in the middle of their cells, half a spacing inside of the faces of a body".to_string();
        return Err(case.error_at(boundary.place, "this boundary holds no particle", Some(help)));
    }
    Ok(members)
}

/// A prescribed value that is no number at the start, and where.
fn nonsense<'a>(constraint: &'a Constraint, members: &[Member]) -> Option<(&'a FieldExpression, [f64; 3])> {
    let (Constraint::Velocity(fields) | Constraint::Displacement(fields)) = constraint else { return None };
    fields.iter().flatten().find_map(|field| {
        members.iter().find(|(_, _, x)| !field.eval(*x, 0.0).is_finite()).map(|(_, _, x)| (field, *x))
    })
}

/// Constant body forces go into the points; the particles of those that change with time are handed back with
/// everything that pulls at them.
fn pull<const D: usize>(
    case: &Case,
    groups: &mut [Group<'_, D>],
) -> Result<Vec<(Member, Vec<VectorField>)>, CaseError> {
    let regions: Vec<Option<Shape>> =
        case.gravity.iter().map(|g| g.region.as_ref().map(super::shapes::shape)).collect();
    let acts = |gravity: &Gravity, region: &Option<Shape>, point: &Point<D>| {
        gravity.body.is_none_or(|b| b as u32 == point.body)
            && region.as_ref().is_none_or(|r| r.contains(padded(point.x)))
    };
    let mut forces = Vec::new();
    for (g, group) in groups.iter_mut().enumerate() {
        for (i, point) in group.points.iter_mut().enumerate() {
            let here: Vec<&VectorField> = case
                .gravity
                .iter()
                .zip(&regions)
                .filter(|(gravity, region)| acts(gravity, region, point))
                .map(|(gravity, _)| &gravity.acceleration)
                .collect();
            let x = padded(point.x);
            if here.iter().any(|field| field.depends_on_time()) {
                forces.push(((g, i, x), here.into_iter().cloned().collect()));
            } else {
                point.force = vector(total(here.into_iter(), x, 0.0));
            }
            if let Some(wrong) = absurd(&case.gravity, |(k, g)| acts(g, &regions[k], point), x) {
                let field = wrong.acceleration.components.iter().find(|f| !f.eval(x, 0.0).is_finite());
                let text = field.map_or("", FieldExpression::text);
                let message = format!("`{text}` is not a number at {x:?} m when the run starts");
                return Err(case.error_at(wrong.place, message, None));
            }
        }
    }
    Ok(forces)
}

/// A body force that acts here and is no number at the start.
fn absurd(gravity: &[Gravity], acts: impl Fn((usize, &Gravity)) -> bool, x: [f64; 3]) -> Option<&Gravity> {
    let mut here = gravity.iter().enumerate().filter(|&(k, g)| acts((k, g))).map(|(_, g)| g);
    here.find(|g| g.acceleration.eval(x, 0.0).iter().any(|a| !a.is_finite()))
}

fn total<'a>(fields: impl Iterator<Item = &'a VectorField>, x: [f64; 3], t: f64) -> [f64; 3] {
    fields.fold([0.0; 3], |sum, field| {
        let value = field.eval(x, t);
        std::array::from_fn(|k| sum[k] + value[k])
    })
}

impl Driven {
    /// Who is held by each boundary, by its number.
    pub fn grips(&self, case: &Case) -> Vec<Grip> {
        let mut grips = vec![Grip::default(); case.boundaries.len()];
        for (g, group) in self.owners.iter().enumerate() {
            for (i, owners) in group.iter().enumerate() {
                for (k, owner) in owners.iter().enumerate() {
                    // One entry for all axes of the same owner.
                    let Some(index) = owner.filter(|_| !owners[..k].contains(owner)) else { continue };
                    grips[index].hold(g, i as u32, owners.map(|other| other == *owner));
                }
            }
        }
        grips
    }

    /// Particles whose body force is set in every step.
    pub fn pulled(&self) -> std::collections::HashSet<(usize, usize)> {
        self.forces.iter().map(|&((g, i, _), _)| (g, i)).collect()
    }

    /// The drives.
    pub fn drives(self) -> Vec<Box<dyn Drive>> {
        let mut drives: Vec<Box<dyn Drive>> = Vec::new();
        for (constraint, members) in self.motions {
            match constraint {
                Constraint::Velocity(fields) => drives.push(Box::new(Moving { fields, members })),
                Constraint::Displacement(fields) => drives.push(Box::new(Placed { fields, members })),
                Constraint::Fixed | Constraint::Fix(_) => {}
            }
        }
        if !self.forces.is_empty() {
            drives.push(Box::new(Pulling { members: self.forces }));
        }
        drives
    }
}

/// Particles of prescribed velocity.
struct Moving {
    fields: [Option<FieldExpression>; 3],
    members: Vec<Member>,
}

impl Drive for Moving {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        prescribed(&self.fields, &self.members, solvers, |field, x| field.eval(x, now.t + now.dt));
    }
}

/// Particles of prescribed displacement: the velocity that takes them there within the step.
struct Placed {
    fields: [Option<FieldExpression>; 3],
    members: Vec<Member>,
}

impl Drive for Placed {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        prescribed(&self.fields, &self.members, solvers, |field, x| {
            (field.eval(x, now.t + now.dt) - field.eval(x, now.t)) / now.dt
        });
    }
}

fn prescribed(
    fields: &[Option<FieldExpression>; 3],
    members: &[Member],
    solvers: &mut [Box<dyn Solver>],
    velocity: impl Fn(&FieldExpression, [f64; 3]) -> f64,
) {
    for &(g, id, x) in members {
        let place = solvers[g].stored(id);
        let mut v = solvers[g].read(Quantity::PrescribedVelocity, place);
        for (v, field) in v.iter_mut().zip(fields) {
            if let Some(field) = field {
                *v = velocity(field, x);
            }
        }
        solvers[g].write(Quantity::PrescribedVelocity, place, v);
    }
}

/// Body forces that change with time.
struct Pulling {
    members: Vec<(Member, Vec<VectorField>)>,
}

impl Drive for Pulling {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        for ((g, id, x), fields) in &self.members {
            let force = total(fields.iter(), *x, now.t + 0.5 * now.dt);
            let place = solvers[*g].stored(*id);
            solvers[*g].write(Quantity::BodyForce, place, force);
        }
    }

    fn pulls(&self, mark: &mut dyn FnMut(usize, u32)) {
        self.members.iter().for_each(|((g, id, _), _)| mark(*g, *id as u32));
    }
}
