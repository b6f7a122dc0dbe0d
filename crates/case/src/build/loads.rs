//! `[[load]]`: which particles a load acts on, and with what share.

use super::bodies::{Group, checked, padded, vector};
use super::surface::{Face, Surface};
use crate::{Case, CaseError, Formulation, Load, LoadKind, Site};
use std::collections::{HashMap, HashSet};
use taut::field::Quantity;
use taut::math::{Tensor, Vector};
use taut::pass::Now;
use taut::simulation::{Drive, Point, Solver};

/// A particle: its group, which is its solver, and its index in the group, which is its id there.
type Member = (usize, usize);

/// What a load is for one particle.
struct Share {
    member: Member,
    /// Where its expressions are evaluated: the particle, or the middle of its face, m.
    x: [f64; 3],
    /// Acceleration by a unit of the load: share of the force over the mass, or area over mass (times the normal of the face).
    per_unit: f64,
    /// The particle on the surface whose deformation turns the face.
    turned_by: Member,
    /// Outer normal of the undeformed face; zero for what has none.
    normal: [f64; 3],
}

/// Puts loads that never change into the points, and makes a drive of the others. `rewritten` says whose body force other drives set in
/// every step, before this one.
pub fn loads<const D: usize>(
    case: &Case,
    groups: &mut [Group<'_, D>],
    rewritten: &HashSet<Member>,
) -> Result<Option<Box<dyn Drive>>, CaseError> {
    let mut loading = Loading { dimension: D, loads: Vec::new(), base: HashMap::new() };
    for load in &case.loads {
        let shares = shares(case, load, groups)?;
        if shares.is_empty() {
            return Err(nowhere(case, load));
        }
        if let Some((share, field)) = shares.iter().find_map(|s| Some((s, load.nonsense(s.x)?))) {
            let message =
                format!("`{}` is not a number at {:?} m when the run starts", field.text(), share.x);
            return Err(case.error_at(load.place, message, None));
        }
        loading.loads.push((load.clone(), shares));
    }
    let changing: HashSet<Member> = loading
        .loads
        .iter()
        .filter(|(l, _)| l.changes())
        .flat_map(|(_, s)| s.iter().map(|s| s.member))
        .collect();
    let varies = |member: &Member| changing.contains(member) || rewritten.contains(member);
    for (load, shares) in &mut loading.loads {
        for share in shares.iter().filter(|share| !varies(&share.member)) {
            let point = &mut groups[share.member.0].points[share.member.1];
            point.force = point.force + vector(share.dead(load, 0.0));
        }
        shares.retain(|share| varies(&share.member));
    }
    loading.loads.retain(|(_, shares)| !shares.is_empty());
    for member in loading.loads.iter().flat_map(|(_, shares)| shares.iter().map(|share| share.member)) {
        let own = padded(groups[member.0].points[member.1].force);
        loading.base.insert(member, (!rewritten.contains(&member)).then_some(own));
    }
    Ok((!loading.loads.is_empty()).then(|| Box::new(loading) as Box<dyn Drive>))
}

fn nowhere(case: &Case, load: &Load) -> CaseError {
    let (message, help) = match load.kind {
        LoadKind::Force(_) => ("no particle is where this force acts", "move or enlarge its region".to_string()),
        _ => (
            "no outer face of a particle is in the region of this load",
            "the middles of the faces lie half a spacing outside of the outermost particles: on the faces of a box".to_string(),
        ),
    };
    case.error_at(load.place, message, Some(help))
}

/// The particles of a load.
fn shares<const D: usize>(
    case: &Case,
    load: &Load,
    groups: &[Group<'_, D>],
) -> Result<Vec<Share>, CaseError> {
    match (&load.kind, &load.site) {
        (LoadKind::Force(_), Site::Point(at)) => Ok(around(case, load, groups, vector(*at))),
        (LoadKind::Force(_), Site::Region(region)) => {
            let region = checked::<D>(case, region, load.place)?;
            Ok(weighted(case, load, groups, |point| {
                if region.contains(padded(point.x)) { point.volume } else { 0.0 }
            }))
        }
        (_, Site::Region(region)) => {
            let region = checked::<D>(case, region, load.place)?;
            let surface = Surface::of(case, load, groups)?;
            Ok(surface.faces(&region).flat_map(|face| on_face(case, groups, face)).collect())
        }
        // The reader lets no load on faces stand on a point.
        (_, Site::Point(_)) => Ok(Vec::new()),
    }
}

/// A force around a point: by the weight of the kernel there.
fn around<const D: usize>(
    case: &Case,
    load: &Load,
    groups: &[Group<'_, D>],
    at: Vector<f64, D>,
) -> Vec<Share> {
    let smoothing = case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max);
    let kernel = super::solvers::kernel::<D>(case, smoothing * case.spacing);
    weighted(case, load, groups, |point| kernel.w((point.x - at).norm_squared().sqrt()) * point.volume)
}

/// A force over particles by weight; the shares add up to one.
fn weighted<const D: usize>(
    case: &Case,
    load: &Load,
    groups: &[Group<'_, D>],
    weight: impl Fn(&Point<D>) -> f64,
) -> Vec<Share> {
    let mut found = Vec::new();
    for (g, group) in groups.iter().enumerate() {
        for (i, point) in group.points.iter().enumerate() {
            let w = if load.body.is_none_or(|b| b as u32 == point.body) { weight(point) } else { 0.0 };
            if w > 0.0 {
                found.push(((g, i), padded(point.x), w, mass(case, point)));
            }
        }
    }
    let total: f64 = found.iter().map(|(_, _, w, _)| w).sum();
    let share =
        |(member, x, w, m)| Share { member, x, per_unit: w / total / m, turned_by: member, normal: [0.0; 3] };
    found.into_iter().map(share).collect()
}

fn mass<const D: usize>(case: &Case, point: &Point<D>) -> f64 {
    let body = &case.bodies[point.body as usize];
    case.material_of(body).map_or(f64::NAN, |m| m.density) * point.volume
}

/// The shares of a face. The stress of the forms whose force is adjoint to their corrected gradient (B in both) is in balance with loads on the face itself, half
/// a spacing outside of the particle: on the point extrapolated from the two outermost particles, 3/2 and -1/2. That of the others is in balance
/// with loads on the outermost particle.
fn on_face<const D: usize>(case: &Case, groups: &[Group<'_, D>], face: &Face) -> Vec<Share> {
    let area = case.spacing.powi(D as i32 - 1);
    let at = |member: Member| &groups[member.0].points[member.1];
    let formulation = case.bodies[at(face.member).body as usize].scheme.formulation;
    let adjoint = matches!(
        formulation,
        Formulation::TlNested | Formulation::TlGanzenmueller | Formulation::UlGeneralised
    );
    let parts = match face.behind.filter(|_| adjoint) {
        Some(behind) => vec![(face.member, 1.5), (behind, -0.5)],
        None => vec![(face.member, 1.0)],
    };
    let share = |(member, part): (Member, f64)| Share {
        member,
        x: face.middle,
        per_unit: part * area / mass(case, at(member)),
        turned_by: face.member,
        normal: face.normal,
    };
    parts.into_iter().map(share).collect()
}

impl Share {
    /// The acceleration by a load that keeps its direction.
    fn dead(&self, load: &Load, t: f64) -> [f64; 3] {
        let scale = self.per_unit * load.factor(t);
        match &load.kind {
            LoadKind::Force(field) | LoadKind::Traction(field) => field.eval(self.x, t).map(|c| c * scale),
            LoadKind::Pressure(_) => [0.0; 3],
        }
    }

    /// The acceleration by a pressure: -p J F^-T N dA / m (Nanson).
    fn following<const D: usize>(&self, load: &Load, (solver, t): (&dyn Solver, f64)) -> [f64; 3] {
        let LoadKind::Pressure(field) = &load.kind else { return [0.0; 3] };
        let place = solver.stored(self.turned_by.1);
        let f =
            Tensor::<f64, D>::from_fn(|i, j| solver.word(Quantity::DeformationGradient, i * D + j, place));
        let turned = f.cofactor().mul_vector(vector(self.normal));
        padded(turned.times(-field.eval(self.x, t) * load.factor(t) * self.per_unit))
    }
}

/// Loads that change. F stands at the middle of the step when it is read here, and so does the time.
struct Loading {
    dimension: usize,
    loads: Vec<(Load, Vec<Share>)>,
    /// The constant body force of every loaded particle; nothing where other drives set it.
    base: HashMap<Member, Option<[f64; 3]>>,
}

impl Drive for Loading {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], now: Now<f64>) {
        let t = now.t + 0.5 * now.dt;
        for (&(g, id), base) in &self.base {
            if let Some(base) = base {
                let place = solvers[g].stored(id);
                solvers[g].write(Quantity::BodyForce, place, *base);
            }
        }
        for (load, shares) in &self.loads {
            for share in shares {
                let solver = &mut solvers[share.member.0];
                let more = match (&load.kind, self.dimension) {
                    (LoadKind::Pressure(_), 2) => share.following::<2>(load, (solver.as_ref(), t)),
                    (LoadKind::Pressure(_), _) => share.following::<3>(load, (solver.as_ref(), t)),
                    _ => share.dead(load, t),
                };
                let place = solver.stored(share.member.1);
                let before = solver.read(Quantity::BodyForce, place);
                solver.write(Quantity::BodyForce, place, std::array::from_fn(|i| before[i] + more[i]));
            }
        }
    }

    fn pulls(&self, mark: &mut dyn FnMut(usize, u32)) {
        self.base.keys().for_each(|&(g, id)| mark(g, id as u32));
    }
}
