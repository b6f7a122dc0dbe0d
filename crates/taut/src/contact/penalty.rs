//! Contact by a penalty on pairs of particles, of the form of Lennard and Jones (SS Eq. 12).

use super::books::Met;
use crate::field::Quantity;
use crate::integrator::Solver;
use crate::math::Vector;

/// n_1 and n_2 of the paper.
const POWERS: (i32, i32) = (6, 4);
/// |sum of unit vectors to the neighbours|, from which on a particle is on the boundary: a straight edge has 2 and more, the second row nothing.
const BARE: f64 = 1.2;
/// Neighbours for that are so many spacings away: those of a square and its diagonals.
const AROUND: f64 = 1.6;

/// Two bodies that push each other by pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairPenalty {
    /// Their numbers.
    pub bodies: [u32; 2],
    /// p of SS Eq. (12): force times distance, N m (in 2D per metre of depth).
    pub strength: f64,
    /// Distance from which on particles push, m: k h_i + k h_j.
    pub reach: f64,
}

impl PairPenalty {
    /// p (l^6 - l^4) x/r^2 on the one at `x` (m) from the other, with l = reach/r; nothing from `reach` on.
    #[must_use]
    pub fn force(&self, x: Vector<f64, 3>) -> Vector<f64, 3> {
        let r2 = x.norm_squared();
        let l2 = self.reach * self.reach / r2;
        if l2 <= 1.0 {
            return Vector::zero();
        }
        x.times(self.strength * (l2.powi(POWERS.0 / 2) - l2.powi(POWERS.1 / 2)) / r2)
    }

    /// The energy of it: p [(l^6 - 1)/6 - (l^4 - 1)/4], J.
    #[must_use]
    pub fn energy(&self, x: Vector<f64, 3>) -> f64 {
        let l2 = self.reach * self.reach / x.norm_squared();
        if l2 <= 1.0 {
            return 0.0;
        }
        let part = |n: i32| (l2.powi(n / 2) - 1.0) / f64::from(n);
        self.strength * (part(POWERS.0) - part(POWERS.1))
    }

    /// The largest stiffness of a pair, N/m: of the slope of the force along the line.
    fn stiffness(&self, r2: f64) -> f64 {
        let l2 = self.reach * self.reach / r2;
        let (a, b) = (f64::from(POWERS.0), f64::from(POWERS.1));
        self.strength * ((a + 1.0) * l2.powi(POWERS.0 / 2) - (b + 1.0) * l2.powi(POWERS.1 / 2)).abs() / r2
    }
}

/// The boundary of a body.
#[derive(Clone, Debug, Default)]
struct Rim {
    solver: usize,
    ids: Vec<u32>,
    /// 1/mass by axis; 0 for what does not move freely.
    lightness: Vec<Vector<f64, 3>>,
    x: Vec<Vector<f64, 3>>,
    force: Vec<Vector<f64, 3>>,
    stiffness: Vec<f64>,
}

/// All pairs of bodies that push each other by pairs of particles.
#[derive(Clone, Debug, Default)]
pub struct Penalties {
    /// The pairs of bodies.
    pub all: Vec<PairPenalty>,
    spacing: f64,
    rims: Vec<Rim>,
    kicks: Vec<(u32, Vector<f64, 3>)>,
    /// The square of the fastest vibration, 1/s^2.
    pub fastest: f64,
}

impl Penalties {
    /// For particles about `spacing` (m) apart.
    #[must_use]
    pub fn new(all: &[PairPenalty], spacing: f64) -> Self {
        Self { all: all.to_vec(), spacing, ..Self::default() }
    }

    /// Finds the boundaries.
    pub fn begin(&mut self, solvers: &[Box<dyn Solver>]) {
        if self.all.is_empty() {
            return;
        }
        let bodies = self.all.iter().flat_map(|p| p.bodies).max().map_or(0, |last| last as usize + 1);
        self.rims = vec![Rim::default(); bodies];
        for (s, solver) in solvers.iter().enumerate() {
            for id in bare(solver.as_ref(), self.spacing) {
                let place = solver.stored(id as usize);
                let body = solver.scalar(Quantity::Body, place) as usize;
                if let Some(rim) = self.rims.get_mut(body) {
                    rim.solver = s;
                    rim.push(solver.as_ref(), (id, place));
                }
            }
        }
        self.relocate(solvers);
    }

    /// Finds the forces of the present positions.
    pub fn relocate(&mut self, solvers: &[Box<dyn Solver>]) {
        for rim in self.rims.iter_mut().filter(|rim| !rim.ids.is_empty()) {
            solvers[rim.solver].locate(&rim.ids, &mut rim.x);
            rim.force.fill(Vector::zero());
            rim.stiffness.fill(0.0);
        }
        for penalty in &self.all {
            let [one, other] = penalty.bodies.map(|b| b as usize);
            let (low, high) = self.rims.split_at_mut(one.max(other));
            let (a, b) = (&mut low[one.min(other)], &mut high[0]);
            press(penalty, a, b);
        }
        self.fastest = self.rims.iter().map(Rim::fastest).fold(0.0, f64::max);
    }

    /// Changes velocities by the forces of a step of `dt`, s.
    pub fn kick(&mut self, solvers: &mut [Box<dyn Solver>], dt: f64) {
        let mut kicks = std::mem::take(&mut self.kicks);
        for rim in &self.rims {
            kicks.clear();
            let change = |i: usize| Vector::from_fn(|k| dt * rim.lightness[i][k] * rim.force[i][k]);
            let changes = (0..rim.ids.len()).map(|i| (rim.ids[i], change(i)));
            kicks.extend(changes.filter(|(_, change)| change.norm_squared() > 0.0));
            if !kicks.is_empty() {
                solvers[rim.solver].kick(&kicks, dt);
            }
        }
        self.kicks = kicks;
    }

    /// What one other body does to one, or all others do.
    pub(super) fn met(&self, met: &mut Met, body: u32, by: Option<u32>) {
        for penalty in &self.all {
            let [one, other] = penalty.bodies;
            let partner = if one == body { other } else { one };
            if (one != body && other != body) || by.is_some_and(|by| by != partner) {
                continue;
            }
            for a in &self.rims[body as usize].x {
                for b in &self.rims[partner as usize].x {
                    met.add(penalty.force(*a - *b), *a);
                }
            }
        }
    }

    /// What free components get from held ones in a step of `dt`, s, and the work of those that are led, J.
    pub fn passed(&self, solvers: &[Box<dyn Solver>], dt: f64, impulse: &mut Met) -> f64 {
        let mut work = 0.0;
        for rim in &self.rims {
            for (i, force) in rim.force.iter().enumerate().filter(|(_, f)| f.norm_squared() > 0.0) {
                let light = rim.lightness[i];
                impulse.add(Vector::from_fn(|k| if light[k] > 0.0 { dt * force[k] } else { 0.0 }), rim.x[i]);
                let solver = &solvers[rim.solver];
                let v = solver.read(Quantity::Velocity, solver.stored(rim.ids[i] as usize));
                work -= dt * (0..3).filter(|&k| light[k] == 0.0).map(|k| force[k] * v[k]).sum::<f64>();
            }
        }
        work
    }

    /// The energy held now, J.
    #[must_use]
    pub fn energy(&self, solvers: &[Box<dyn Solver>]) -> f64 {
        let now = |rim: &Rim| -> Vec<Vector<f64, 3>> {
            let at = |&id: &u32| {
                let (solver, place) = (&solvers[rim.solver], solvers[rim.solver].stored(id as usize));
                let (x, u) = (
                    solver.read(Quantity::ReferencePosition, place),
                    solver.read(Quantity::Displacement, place),
                );
                Vector(x) + Vector(u)
            };
            rim.ids.iter().map(at).collect()
        };
        let places: Vec<Vec<Vector<f64, 3>>> = self.rims.iter().map(now).collect();
        let mut energy = 0.0;
        for penalty in &self.all {
            let [one, other] = penalty.bodies.map(|b| b as usize);
            for a in &places[one] {
                energy += places[other].iter().map(|b| penalty.energy(*a - *b)).sum::<f64>();
            }
        }
        energy
    }

    /// The smallest distance of particles of two bodies over the reach of their penalty; infinite where there is none.
    #[must_use]
    pub fn closest(&self) -> f64 {
        let of = |penalty: &PairPenalty| {
            let [one, other] = penalty.bodies.map(|b| b as usize);
            let pairs = self.rims[one].x.iter().flat_map(|a| self.rims[other].x.iter().map(move |b| *a - *b));
            pairs.map(|x| x.norm_squared().sqrt()).fold(f64::INFINITY, f64::min) / penalty.reach
        };
        self.all.iter().map(of).fold(f64::INFINITY, f64::min)
    }
}

impl Rim {
    fn push(&mut self, solver: &dyn Solver, (id, place): (u32, usize)) {
        let (mass, free) = (solver.scalar(Quantity::Mass, place), solver.read(Quantity::Free, place));
        self.ids.push(id);
        self.lightness.push(Vector(free.map(|f| if mass > 0.0 { f / mass } else { 0.0 })));
        self.x.push(Vector::zero());
        self.force.push(Vector::zero());
        self.stiffness.push(0.0);
    }

    /// omega^2 <= 2 max_a sum_b k_ab/m_a (Gershgorin).
    fn fastest(&self) -> f64 {
        let of =
            |(k, light): (&f64, &Vector<f64, 3>)| 2.0 * k * light.0.iter().fold(0.0, |m: f64, l| m.max(*l));
        self.stiffness.iter().zip(&self.lightness).map(of).fold(0.0, f64::max)
    }
}

/// Forces of one pair of bodies, opposite on both.
fn press(penalty: &PairPenalty, a: &mut Rim, b: &mut Rim) {
    let reach = penalty.reach * penalty.reach;
    for i in 0..a.x.len() {
        for j in 0..b.x.len() {
            let x = a.x[i] - b.x[j];
            let r2 = x.norm_squared();
            if r2 < reach {
                let (force, stiffness) = (penalty.force(x), penalty.stiffness(r2));
                a.force[i] = a.force[i] + force;
                b.force[j] = b.force[j] - force;
                a.stiffness[i] += stiffness;
                b.stiffness[j] += stiffness;
            }
        }
    }
}

/// The particles, by id, whose neighbours are all on one side. A neighbour is what is nearest in its direction, so spacings that differ with the
/// direction do not matter.
fn bare(solver: &dyn Solver, spacing: f64) -> Vec<u32> {
    let x: Vec<Vector<f64, 3>> =
        (0..solver.len()).map(|p| Vector(solver.read(Quantity::ReferencePosition, p))).collect();
    let width = |p: usize| solver.rest_volume(p).powf(1.0 / solver.dimension() as f64).max(spacing);
    // A single row has no other side: it has 2 neighbours in the plane, 8 in space.
    let few = (1 << solver.dimension()) + 1;
    let open = |p: usize| {
        let reach = AROUND * width(p);
        let near = |d: &Vector<f64, 3>| d.norm_squared() > 0.0 && d.norm_squared() < reach * reach;
        let (mut sum, mut count) = (Vector::<f64, 3>::zero(), 0);
        for d in x.iter().map(|y| *y - x[p]).filter(near) {
            sum = sum + d.times(1.0 / d.norm_squared().sqrt());
            count += 1;
        }
        sum.norm_squared().sqrt() > BARE || count < few
    };
    (0..x.len()).filter(|&p| open(p)).map(|p| solver.ids()[p]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_is_the_slope_of_the_energy() {
        let penalty = PairPenalty { bodies: [0, 1], strength: 5e-8, reach: 8.5e-5 };
        for share in [0.5, 0.7, 0.9, 0.999] {
            let (r, e) = (share * penalty.reach, 1e-6 * penalty.reach);
            let at = |r: f64| Vector([0.6 * r, 0.8 * r, 0.0]);
            let slope = (penalty.energy(at(r + e)) - penalty.energy(at(r - e))) / (2.0 * e);
            let force = penalty.force(at(r));
            let along = 0.6 * force[0] + 0.8 * force[1];
            // Central difference: e^2 E'''/6, about 100 (e/r)^2 of E/r.
            assert!((along + slope).abs() < 1e-8 * (along.abs() + penalty.strength / r), "{share}");
            assert!(along >= 0.0, "it pushes");
        }
        assert_eq!(penalty.force(Vector([9e-5, 0.0, 0.0])), Vector::zero());
        assert_eq!(penalty.energy(Vector([9e-5, 0.0, 0.0])), 0.0);
    }
}
