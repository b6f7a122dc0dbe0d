//! Impulses from outside: what constraints and body forces give to the particles in a step.

use crate::field::Quantity;
use crate::run::{Numbers, Run};

/// An impulse and its moment about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Impulse {
    /// N s.
    pub linear: [f64; 3],
    /// N m s.
    pub angular: [f64; 3],
}

/// a x b.
#[must_use]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

impl Impulse {
    /// Adds an impulse that acts at a point, m.
    #[inline]
    pub fn push(&mut self, at: [f64; 3], impulse: [f64; 3]) {
        let moment = cross(at, impulse);
        for i in 0..3 {
            self.linear[i] += impulse[i];
            self.angular[i] += moment[i];
        }
    }

    /// This many times it.
    #[must_use]
    pub fn times(self, s: f64) -> Self {
        Self { linear: self.linear.map(|x| s * x), angular: self.angular.map(|x| s * x) }
    }
}

impl std::ops::AddAssign for Impulse {
    fn add_assign(&mut self, other: Self) {
        for i in 0..3 {
            self.linear[i] += other.linear[i];
            self.angular[i] += other.angular[i];
        }
    }
}

impl std::ops::Sub for Impulse {
    type Output = Self;
    fn sub(mut self, other: Self) -> Self {
        self += other.times(-1.0);
        self
    }
}

/// Components of particles of one solver that one constraint holds.
#[derive(Clone, Debug, Default)]
pub struct Held {
    /// The particles, by id.
    pub ids: Vec<u32>,
    /// Which components of each.
    pub axes: Vec<[bool; 3]>,
    /// Their velocities after the last step, m/s.
    pub before: Vec<[f64; 3]>,
}

/// Where particles are in the middle of a step, when the forces act: `base` + `share` times `way`.
pub(super) struct Midway<'a, const D: usize> {
    pub base: [Numbers<'a>; D],
    pub way: [Numbers<'a>; D],
    pub share: f64,
}

impl<const D: usize> Midway<'_, D> {
    #[inline(always)]
    fn at(&self, place: usize) -> [f64; 3] {
        let mut x = [0.0; 3];
        for i in 0..D {
            x[i] = self.share.mul_add(self.way[i].at(place), self.base[i].at(place));
        }
        x
    }
}

/// The columns of a vector field.
pub(super) fn columns<const D: usize>(run: &impl Run<D>, field: Quantity) -> [Numbers<'_>; D] {
    std::array::from_fn(|i| run.numbers(field, i))
}

/// What holding these particles took in a step: m (v' - v - dt a) for every held component, where a is the acceleration by all
/// other forces. In position Verlet forces act midway, and x x m v changes by exactly the moment of the impulse there.
pub(super) fn holding<const D: usize>(
    run: &impl Run<D>,
    (x, dt): (&Midway<'_, D>, f64),
    held: &mut Held,
) -> Impulse {
    let (v, a) = (columns(run, Quantity::Velocity), columns(run, Quantity::Acceleration));
    let mass = run.numbers(Quantity::Mass, 0);
    let mut sum = Impulse::default();
    for ((&id, axes), before) in held.ids.iter().zip(&held.axes).zip(&mut held.before) {
        let place = run.particles().stored(id as usize);
        let mut impulse = [0.0; 3];
        for i in (0..D).filter(|&i| axes[i]) {
            let now = v[i].at(place);
            impulse[i] = mass.at(place) * (-dt).mul_add(a[i].at(place), now - before[i]);
            before[i] = now;
        }
        sum.push(x.at(place), impulse);
    }
    sum
}

/// What body forces gave to these particles in a step: m b dt, held or not.
pub(super) fn pulling<const D: usize>(
    run: &impl Run<D>,
    (x, dt): (&Midway<'_, D>, f64),
    ids: &[u32],
) -> Impulse {
    let (b, mass) = (columns(run, Quantity::BodyForce), run.numbers(Quantity::Mass, 0));
    let mut sum = Impulse::default();
    for &id in ids {
        let place = run.particles().stored(id as usize);
        let mut impulse = [0.0; 3];
        for i in 0..D {
            impulse[i] = mass.at(place) * dt * b[i].at(place);
        }
        sum.push(x.at(place), impulse);
    }
    sum
}
