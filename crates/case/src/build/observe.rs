//! Probes and disorder.

use super::apart::Apart;
use super::bodies::{Group, checked, padded, vector};
use super::gap::Gap;
use crate::{Case, CaseError, Fill, Quantity, Spot};
use geometry::Shape;
use taut::diagnostics::MaterialPoint;
use taut::diagnostics::disorder::{Disorder, DisorderError, Reference};
use taut::field;
use taut::simulation::{Point, Simulation, Snapshot, Solver};

/// Where a probe reads.
pub enum ProbePoint {
    /// Of particles.
    Motion(Followed),
    /// The force of a boundary, by its number.
    Force(usize),
    /// The moment of that force.
    Moment(usize),
    /// What contact does to a body.
    Contact(Touched),
    /// How near a body is to others.
    Gap(Apart),
}

/// What contact does to a body.
#[derive(Clone, Copy)]
pub struct Touched {
    /// Number of the body.
    body: u32,
    /// Number of the body that does it; `None` for all.
    by: Option<u32>,
    /// Whether it is the moment that is asked for.
    moment: bool,
}

impl Touched {
    /// The force or moment, as it was in the middle of the last step.
    #[must_use]
    pub fn value(&self, simulation: &Simulation) -> [f64; 3] {
        let met = simulation.contact().map(|contact| contact.met(self.body, self.by)).unwrap_or_default();
        if self.moment { met.moment } else { met.force }
    }
}

/// Particles that a probe follows: weights of particles of one solver, by id.
pub struct Followed {
    solver: usize,
    point: MaterialPoint,
    at: [f64; 3],
    quantity: Quantity,
}

impl Followed {
    /// The value now.
    #[must_use]
    pub fn value(&self, solvers: &[Box<dyn Solver>]) -> [f64; 3] {
        let solver = &solvers[self.solver];
        let mean = |field| self.point.value(|id| solver.read(field, solver.stored(id)));
        match self.quantity {
            Quantity::Velocity => mean(field::Quantity::Velocity),
            Quantity::Position => {
                let u = mean(field::Quantity::Displacement);
                std::array::from_fn(|i| self.at[i] + u[i])
            }
            Quantity::VonMises => [self.stress(solver.as_ref()), 0.0, 0.0],
            _ => mean(field::Quantity::Displacement),
        }
    }

    /// Whether its value is one that bodies have only when they were [looked at](taut::simulation::Simulation::look).
    #[must_use]
    pub fn is_looked_at(&self) -> bool {
        self.quantity == Quantity::VonMises
    }

    /// The largest von Mises stress of the particles, Pa.
    fn stress(&self, solver: &dyn Solver) -> f64 {
        let mut most = 0.0;
        for &(id, _) in &self.point.weights {
            solver.show(id..id + 1, &mut |seen| most = seen.state.cauchy.von_mises().max(most));
        }
        most
    }
}

/// The probes of a case.
pub fn probes<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Result<Vec<ProbePoint>, CaseError> {
    let probe = |probe: &crate::Probe| {
        if let Spot::Boundary(index) = probe.spot {
            return Ok(match probe.quantity {
                Quantity::Moment => ProbePoint::Moment(index),
                _ => ProbePoint::Force(index),
            });
        }
        if let Spot::Contact { by } = probe.spot {
            let (body, by) = (probe.body as u32, by.map(|by| by as u32));
            if probe.quantity == Quantity::Gap {
                return Ok(ProbePoint::Gap(Apart { body, by }));
            }
            let moment = probe.quantity == Quantity::ContactMoment;
            return Ok(ProbePoint::Contact(Touched { body, by, moment }));
        }
        let spot = match &probe.spot {
            Spot::Point(_) | Spot::Boundary(_) | Spot::Contact { .. } => None,
            Spot::Region(region) => Some(checked::<D>(case, region, probe.place)?),
        };
        let found = groups.iter().enumerate().find_map(|(g, group)| {
            let mine = group.points.iter().enumerate().filter(|(_, p)| p.body as usize == probe.body);
            let mine: Vec<_> = mine.collect();
            let (point, at) = match (&probe.spot, &spot) {
                (Spot::Region(_), Some(region)) => mean(&mine, region)?,
                (Spot::Region(_), None) | (Spot::Boundary(_) | Spot::Contact { .. }, _) => return None,
                (Spot::Point(at), _) => {
                    let stored = mine.iter().map(|(place, p)| (*place, p.x));
                    (MaterialPoint::new(stored, vector(*at), case.spacing)?, *at)
                }
            };
            Some((g, point, at))
        });
        let (solver, point, at) = found.ok_or_else(|| {
            let what = match probe.spot {
                Spot::Point(_) => "no particle within 2.6 spacings",
                Spot::Region(_) | Spot::Boundary(_) | Spot::Contact { .. } => "no particle is in its region",
            };
            let message = format!("probe `{}` is not in its body: {what}", probe.name);
            let name = case.bodies.get(probe.body).map_or("", |b| b.name.as_str());
            let help = format!("a probe is placed in the undeformed body `{name}`");
            case.error_at(probe.place, message, Some(help))
        })?;
        Ok(ProbePoint::Motion(Followed { solver, point, at, quantity: probe.quantity }))
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

/// The measure of disorder of a case, in whatever dimension.
pub trait Watch: Send {
    /// Measures the positions of a snapshot.
    ///
    /// # Errors
    /// If positions are not numbers.
    fn measure(&mut self, snapshot: &Snapshot) -> Result<Disorder, DisorderError>;

    /// Smallest distance between particles of two bodies, m, if it is below four smoothing lengths.
    ///
    /// # Errors
    /// If positions are not numbers.
    fn gap(&mut self, snapshot: &Snapshot) -> Result<Option<f64>, DisorderError>;

    /// The particle with the largest zigzag in the last measurement.
    fn most_zigzag(&self) -> Option<usize>;

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
    fn most_zigzag(&self) -> Option<usize> {
        self.reference.most_zigzag()
    }

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

    fn measure(&mut self, snapshot: &Snapshot) -> Result<Disorder, DisorderError> {
        load(&mut self.columns, snapshot);
        let x: [&[f64]; D] = std::array::from_fn(|i| self.columns[i].as_slice());
        let disorder = self.reference.measure(x.map(|x| &x[..self.deformable]))?;
        self.measured = Some(snapshot.time);
        Ok(disorder)
    }

    fn gap(&mut self, snapshot: &Snapshot) -> Result<Option<f64>, DisorderError> {
        load(&mut self.columns, snapshot);
        let x: [&[f64]; D] = std::array::from_fn(|i| self.columns[i].as_slice());
        Ok(self.gap.smallest(x)?)
    }
}

/// The spacing of the particles of each body, m: that of the case, or, in rings of as many particles each, that of a lattice with as many.
fn spacings<const D: usize>(case: &Case, groups: &[Group<'_, D>]) -> Vec<f64> {
    let mean = |index: usize| {
        let mine = || groups.iter().flat_map(|g| &g.points).filter(move |p| p.body as usize == index);
        (mine().map(|p| p.volume).sum::<f64>() / mine().count().max(1) as f64).powf(1.0 / D as f64)
    };
    let own = |(index, body): (usize, &crate::Body)| match body.fill {
        Fill::Polar { .. } => mean(index),
        _ => case.spacing,
    };
    case.bodies.iter().enumerate().map(own).collect()
}

/// The measure of disorder of all deformable bodies, and the body of each particle.
pub fn disorder<const D: usize>(
    case: &Case,
    (groups, tools): (&[Group<'_, D>], &[Vec<Point<D>>]),
) -> Result<(Box<dyn Watch>, Vec<u32>), CaseError> {
    let points = || groups.iter().flat_map(|g| &g.points);
    let columns: [Vec<f64>; D] = std::array::from_fn(|i| points().map(|p| p.x[i]).collect());
    let mut body: Vec<u32> = points().map(|p| p.body).collect();
    let own = spacings(case, groups);
    let spacing: Vec<f64> = body.iter().map(|&body| own[body as usize]).collect();
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
