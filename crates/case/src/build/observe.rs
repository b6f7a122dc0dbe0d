//! Probes and disorder.

use super::bodies::{Group, checked, padded, vector};
use super::gap::Gap;
use crate::{Case, CaseError, Quantity, Spot};
use geometry::Shape;
use taut::diagnostics::MaterialPoint;
use taut::diagnostics::disorder::{Disorder, DisorderError, Reference};
use taut::field;
use taut::simulation::{Point, Simulation, Snapshot, Solver};

/// Where a probe reads.
pub enum ProbePoint {
    /// Weights of particles of one solver, by id.
    Material {
        /// The solver.
        solver: usize,
        /// The weights.
        point: MaterialPoint,
        /// Their mean reference position, m.
        at: [f64; 3],
        /// What is read.
        quantity: Quantity,
    },
    /// What contact does to a body.
    Contact {
        /// Number of the body.
        body: u32,
        /// Number of the body that does it; `None` for all.
        by: Option<u32>,
        /// Whether it is the moment that is asked for.
        moment: bool,
    },
}

impl ProbePoint {
    /// The value now.
    #[must_use]
    pub fn value(&self, simulation: &Simulation) -> [f64; 3] {
        match self {
            Self::Material { solver, point, at, quantity } => {
                of_material(simulation.solvers()[*solver].as_ref(), (point, *at), *quantity)
            }
            Self::Contact { body, by, moment } => {
                let met = simulation.contact().map(|contact| contact.met(*body, *by)).unwrap_or_default();
                if *moment { met.moment } else { met.force }
            }
        }
    }
}

fn of_material(solver: &dyn Solver, (point, at): (&MaterialPoint, [f64; 3]), quantity: Quantity) -> [f64; 3] {
    let mean = |field| point.value(|id| solver.read(field, solver.stored(id)));
    match quantity {
        Quantity::Velocity => mean(field::Quantity::Velocity),
        Quantity::Position => {
            let u = mean(field::Quantity::Displacement);
            std::array::from_fn(|i| at[i] + u[i])
        }
        _ => mean(field::Quantity::Displacement),
    }
}

/// The probes of a case.
pub fn probes<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Result<Vec<ProbePoint>, CaseError> {
    let probe = |probe: &crate::Probe| {
        if let Spot::Contact { by } = probe.spot {
            let (body, by) = (probe.body as u32, by.map(|by| by as u32));
            let moment = probe.quantity == Quantity::ContactMoment;
            return Ok(ProbePoint::Contact { body, by, moment });
        }
        let spot = match &probe.spot {
            Spot::Point(_) | Spot::Contact { .. } => None,
            Spot::Region(region) => Some(checked::<D>(case, region, probe.place)?),
        };
        let found = groups.iter().enumerate().find_map(|(g, group)| {
            let mine = group.points.iter().enumerate().filter(|(_, p)| p.body as usize == probe.body);
            let mine: Vec<_> = mine.collect();
            let (point, at) = match (&probe.spot, &spot) {
                (Spot::Region(_), Some(region)) => mean(&mine, region)?,
                (Spot::Region(_) | Spot::Contact { .. }, _) => return None,
                (Spot::Point(at), _) => {
                    let stored = mine.iter().map(|(place, p)| (*place, p.x));
                    (MaterialPoint::new(stored, vector(*at), case.spacing)?, *at)
                }
            };
            Some((g, point, at))
        });
        let (solver, point, at) = found.ok_or_else(|| {
            let what = match probe.spot {
                Spot::Point(_) | Spot::Contact { .. } => "no particle within 2.6 spacings",
                Spot::Region(_) => "no particle is in its region",
            };
            let message = format!("probe `{}` is not in its body: {what}", probe.name);
            let name = case.bodies.get(probe.body).map_or("", |b| b.name.as_str());
            let help = format!("a probe is placed in the undeformed body `{name}`");
            case.error_at(probe.place, message, Some(help))
        })?;
        Ok(ProbePoint::Material { solver, point, at, quantity: probe.quantity })
    };
    case.probes.iter().map(probe).collect()
}

/// The particles of a region as one probe: their weights, and their mean reference position.
fn mean<const D: usize>(mine: &[(usize, &Point<D>)], region: &Shape) -> Option<(MaterialPoint, [f64; 3])> {
    let inside = || mine.iter().filter(|(_, p)| region.contains(padded(p.x)));
    let point = MaterialPoint::mean(inside().map(|(place, p)| (*place, p.volume)))?;
    let total: f64 = inside().map(|(_, p)| p.volume).sum();
    let at = inside().fold([0.0; 3], |sum: [f64; 3], (_, p)| {
        let x = padded(p.x);
        std::array::from_fn(|k| sum[k] + p.volume / total * x[k])
    });
    Some((point, at))
}

/// What is observed of the arrangement of particles.
pub struct Observed {
    /// The measures of disorder.
    pub disorder: Disorder,
    /// Smallest distance between particles of two bodies, m, if it is below four smoothing lengths.
    pub gap: Option<f64>,
}

/// The measure of disorder of a case, in whatever dimension.
pub trait Watch: Send {
    /// Measures the positions of a snapshot, and the gap between bodies if it is wanted.
    ///
    /// # Errors
    /// If positions are not numbers.
    fn measure(&mut self, snapshot: &Snapshot, gap: bool) -> Result<Observed, DisorderError>;

    /// The deformation gradient of every particle, row by row: its own, or one by least squares for formulations that
    /// have none (the identity where positions are not numbers).
    fn deformation(&mut self, snapshot: &Snapshot, out: &mut Vec<[f64; 9]>);
}

/// The reference arrangement and room for positions.
struct Arrangement<const D: usize> {
    reference: Reference<D>,
    columns: [Vec<f64>; D],
    /// Particles of deformable bodies; those of tools follow, whose order is nobody's concern.
    deformable: usize,
    gap: Gap<D>,
    /// The time of the state that was measured last, s.
    measured: Option<f64>,
}

impl<const D: usize> Arrangement<D> {
    /// Deformation gradients by least squares, from the measurement of this state if there was one; none where
    /// positions are not numbers.
    fn fitted(&mut self, snapshot: &Snapshot) -> &[[[f64; D]; D]] {
        if self.measured == Some(snapshot.time) {
            return self.reference.last_deformation();
        }
        load(&mut self.columns, snapshot);
        let x: [&[f64]; D] = std::array::from_fn(|i| &self.columns[i][..self.deformable]);
        self.reference.deformation(x).unwrap_or_default()
    }
}

fn load<const D: usize>(columns: &mut [Vec<f64>; D], snapshot: &Snapshot) {
    for (i, column) in columns.iter_mut().enumerate() {
        column.clear();
        column.extend(snapshot.positions().map(|x| x[i]));
    }
}

impl<const D: usize> Watch for Arrangement<D> {
    fn deformation(&mut self, snapshot: &Snapshot, out: &mut Vec<[f64; 9]>) {
        out.clear();
        out.extend_from_slice(&snapshot.deformation);
        if out.iter().all(|f| *f != [0.0; 9]) {
            return;
        }
        let fitted = self.fitted(snapshot);
        let unit = |k: usize| if k.is_multiple_of(4) { 1.0 } else { 0.0 };
        for (i, out) in out.iter_mut().enumerate().filter(|(_, f)| **f == [0.0; 9]) {
            let component = |k: usize| match fitted.get(i) {
                Some(f) if k / 3 < D && k % 3 < D => f[k / 3][k % 3],
                _ => unit(k),
            };
            *out = std::array::from_fn(component);
        }
    }

    fn measure(&mut self, snapshot: &Snapshot, gap: bool) -> Result<Observed, DisorderError> {
        load(&mut self.columns, snapshot);
        let x: [&[f64]; D] = std::array::from_fn(|i| self.columns[i].as_slice());
        let disorder = self.reference.measure(x.map(|x| &x[..self.deformable]))?;
        self.measured = Some(snapshot.time);
        let gap = if gap { self.gap.smallest(x)? } else { None };
        Ok(Observed { disorder, gap })
    }
}

/// The measure of disorder of all deformable bodies, and the body of each particle.
pub fn disorder<const D: usize>(
    case: &Case,
    (groups, tools): (&[Group<'_, D>], &[Vec<Point<D>>]),
) -> Result<(Box<dyn Watch>, Vec<u32>), CaseError> {
    let points = || groups.iter().flat_map(|g| &g.points);
    let columns: [Vec<f64>; D] = std::array::from_fn(|i| points().map(|p| p.x[i]).collect());
    let mut body: Vec<u32> = points().map(|p| p.body).collect();
    let spacing = vec![case.spacing; body.len()];
    let support = 2.0 * case.bodies.iter().map(|b| b.scheme.smoothing).fold(0.0, f64::max) * case.spacing;
    let x: [&[f64]; D] = std::array::from_fn(|i| columns[i].as_slice());
    let reference = Reference::new(x, &body, &spacing, support)
        .map_err(|error| case.error_at(case.bodies[0].place, error.to_string(), None))?;
    let deformable = body.len();
    body.extend(tools.iter().flatten().map(|p| p.body));
    let gap = Gap::new(body.clone(), 2.0 * support);
    let arrangement = Arrangement { reference, columns, deformable, gap, measured: None };
    Ok((Box::new(arrangement), body))
}
