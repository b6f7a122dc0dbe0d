//! The particles near the surfaces of bodies, in one row for all solvers.

use super::law::Law;
use crate::field::Quantity;
use crate::integrator::Solver;
use crate::math::Vector;
use crate::neighbours::{Adjacency, Search, SearchError};
use std::ops::Range;

/// |sum_b V_b W' e| times the spacing, from which on a particle is at the surface: a flat face has 0.47, an inner corner 0.13, disorder
/// inside of a body less than 0.1.
const BARE: f64 = 0.12;

/// Particles so many spacings below those at the surface belong to it: as far as they feel others across it.
const DEPTH: f64 = 2.1;

/// A body that may touch.
#[derive(Clone, Debug)]
pub struct Member {
    /// Which solver advances it.
    pub solver: usize,
    /// Its particles in the row.
    pub range: Range<usize>,
}

/// All surface particles.
#[derive(Clone, Debug, Default)]
pub struct Surfaces {
    /// The bodies, by the number that their particles carry.
    pub members: Vec<Member>,
    /// Ids in the solver.
    pub ids: Vec<u32>,
    /// Number of the body.
    pub body: Vec<u32>,
    /// Volume at rest, m^3 (in 2D m^2).
    pub volume: Vec<f64>,
    /// 1/mass by axis; 0 for what does not move freely.
    pub lightness: Vec<Vector<f64, 3>>,
    /// Reference positions, m.
    pub reference: Vec<Vector<f64, 3>>,
    /// Positions that forces are functions of, m.
    pub x: Vec<Vector<f64, 3>>,
    /// Velocities, m/s.
    pub v: Vec<Vector<f64, 3>>,
}

impl Surfaces {
    /// The surface particles of all bodies.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn of(solvers: &[Box<dyn Solver>], law: &Law, dimension: usize) -> Result<Self, SearchError> {
        let mut found: Vec<(u32, usize, u32)> = Vec::new();
        for (s, solver) in solvers.iter().enumerate() {
            let shown = match dimension {
                2 => Skin::<2>::of(solver.as_ref(), law)?,
                _ => Skin::<3>::of(solver.as_ref(), law)?,
            };
            found.extend(shown.into_iter().map(|(body, id)| (body, s, id)));
        }
        found.sort_unstable();
        let mut surfaces = Self::default();
        for (body, s, id) in found {
            surfaces.push(body, s, (id, solvers[s].as_ref()));
        }
        surfaces.locate(solvers);
        Ok(surfaces)
    }

    fn push(&mut self, body: u32, solver: usize, (id, particles): (u32, &dyn Solver)) {
        let place = particles.stored(id as usize);
        let (mass, at) = (particles.scalar(Quantity::Mass, place), self.ids.len());
        while self.members.len() <= body as usize {
            self.members.push(Member { solver, range: at..at });
        }
        let start = self.members[body as usize].range.start;
        self.members[body as usize] = Member { solver, range: start..at + 1 };
        let free = particles.read(Quantity::Free, place);
        self.ids.push(id);
        self.body.push(body);
        self.volume.push(particles.rest_volume(place));
        self.lightness.push(Vector(free.map(|f| if mass > 0.0 { f / mass } else { 0.0 })));
        self.reference.push(Vector(particles.read(Quantity::ReferencePosition, place)));
        self.x.push(Vector::zero());
        self.v.push(Vector::zero());
    }

    /// Fetches positions.
    pub fn locate(&mut self, solvers: &[Box<dyn Solver>]) {
        for member in &self.members {
            let range = member.range.clone();
            solvers[member.solver].locate(&self.ids[range.clone()], &mut self.x[range]);
        }
    }

    /// Whether a particle can be moved.
    pub fn moves(&self, a: usize) -> bool {
        self.lightness[a].norm_squared() > 0.0
    }
}

/// The search for the surface of one solver's bodies.
struct Skin<const D: usize>;

impl<const D: usize> Skin<D> {
    /// Body and id of every particle at or near a surface.
    fn of(solver: &dyn Solver, law: &Law) -> Result<Vec<(u32, u32)>, SearchError> {
        let n = solver.len();
        let x: Vec<[f64; 3]> = (0..n).map(|p| solver.read(Quantity::ReferencePosition, p)).collect();
        let body: Vec<u32> = (0..n).map(|p| solver.scalar(Quantity::Body, p) as u32).collect();
        let columns: [Vec<f64>; D] = std::array::from_fn(|k| x.iter().map(|x| x[k]).collect());
        let columns: [&[f64]; D] = std::array::from_fn(|k| columns[k].as_slice());
        let mut list = Adjacency::default();
        Search::<D>::new().pairs(columns, law.support(), Some(&body), &mut list)?;
        let apart = |a: usize, b: u32| Vector(x[a]) - Vector(x[b as usize]);
        let bare = |a: usize| {
            let sum = list.of(a).iter().fold(Vector::zero(), |sum: Vector<f64, 3>, &b| {
                let (e, volume) = (apart(a, b), solver.rest_volume(b as usize));
                let r = e.norm_squared().sqrt();
                sum.plus(volume * law.slope(r) / r, e)
            });
            sum.norm_squared().sqrt() * law.spacing > BARE
        };
        let bare: Vec<bool> = (0..n).map(bare).collect();
        let close = |a: usize, b: u32| apart(a, b).norm_squared() < (DEPTH * law.spacing).powi(2);
        let near = |&a: &usize| bare[a] || list.of(a).iter().any(|&b| bare[b as usize] && close(a, b));
        Ok((0..n).filter(near).map(|p| (body[p], solver.ids()[p])).collect())
    }
}
