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

/// The columns of a vector field.
pub(super) fn columns<const D: usize>(run: &impl Run<D>, field: Quantity) -> [Numbers<'_>; D] {
    std::array::from_fn(|i| run.numbers(field, i))
}

/// One number of any particle. (Where all columns are in double precision, the choice is made once and not for every number.)
trait Column: Copy {
    fn number(self, place: usize) -> f64;
}

impl Column for &[f64] {
    #[inline(always)]
    fn number(self, place: usize) -> f64 {
        self[place]
    }
}

impl Column for Numbers<'_> {
    #[inline(always)]
    fn number(self, place: usize) -> f64 {
        self.at(place)
    }
}

/// What an impulse is made of (in plain products and sums, since a fused one is a call where the machine is not known to have it): mass, where particles are midway, and velocity and acceleration, or a body force.
struct Columns<C, const D: usize> {
    mass: C,
    base: [C; D],
    way: [C; D],
    share: f64,
    v: [C; D],
    a: [C; D],
}

impl<'a, const D: usize> Columns<Numbers<'a>, D> {
    fn of(run: &'a impl Run<D>, x: &Midway<'a, D>, [v, a]: [Quantity; 2]) -> Self {
        let (mass, v, a) = (run.numbers(Quantity::Mass, 0), columns(run, v), columns(run, a));
        Self { mass, base: x.base, way: x.way, share: x.share, v, a }
    }

    /// The same as slices, if all are in double precision.
    fn double(&self) -> Option<Columns<&'a [f64], D>> {
        let all = |columns: [Numbers<'a>; D]| {
            let mut slices: [&[f64]; D] = [&[]; D];
            for (slice, column) in slices.iter_mut().zip(columns) {
                *slice = column.double()?;
            }
            Some(slices)
        };
        Some(Columns {
            mass: self.mass.double()?,
            base: all(self.base)?,
            way: all(self.way)?,
            share: self.share,
            v: all(self.v)?,
            a: all(self.a)?,
        })
    }
}

impl<C: Column, const D: usize> Columns<C, D> {
    #[inline(always)]
    fn push(&self, sum: &mut Impulse, place: usize, impulse: [f64; D]) {
        let (mut x, mut all) = ([0.0; 3], [0.0; 3]);
        for i in 0..D {
            x[i] = self.base[i].number(place) + self.share * self.way[i].number(place);
            all[i] = impulse[i];
        }
        sum.push(x, all);
    }

    fn holding(&self, stored: impl Fn(usize) -> usize, held: &mut Held, dt: f64) -> Impulse {
        let mut sum = Impulse::default();
        for ((&id, axes), before) in held.ids.iter().zip(&held.axes).zip(&mut held.before) {
            let place = stored(id as usize);
            let (mut impulse, mass) = ([0.0; D], self.mass.number(place));
            for i in 0..D {
                let now = self.v[i].number(place);
                let gained = now - before[i] - dt * self.a[i].number(place);
                impulse[i] = if axes[i] { mass * gained } else { 0.0 };
                before[i] = now;
            }
            self.push(&mut sum, place, impulse);
        }
        sum
    }

    fn pulling(&self, stored: impl Fn(usize) -> usize, ids: &[u32], dt: f64) -> Impulse {
        let mut sum = Impulse::default();
        for &id in ids {
            let place = stored(id as usize);
            let push = self.mass.number(place) * dt;
            self.push(&mut sum, place, std::array::from_fn(|i| push * self.a[i].number(place)));
        }
        sum
    }
}

/// What holding these particles took in a step: m (v' - v - dt a) for every held component, where a is the acceleration by all
/// other forces. In position Verlet forces act midway, and x x m v changes by exactly the moment of the impulse there.
pub(super) fn holding<const D: usize>(
    run: &impl Run<D>,
    (x, dt): (&Midway<'_, D>, f64),
    held: &mut Held,
) -> Impulse {
    let stored = |id| run.particles().stored(id);
    let columns = Columns::of(run, x, [Quantity::Velocity, Quantity::Acceleration]);
    match columns.double() {
        Some(columns) => columns.holding(stored, held, dt),
        None => columns.holding(stored, held, dt),
    }
}

/// What body forces gave to these particles in a step: m b dt, held or not.
pub(super) fn pulling<const D: usize>(
    run: &impl Run<D>,
    (x, dt): (&Midway<'_, D>, f64),
    ids: &[u32],
) -> Impulse {
    let stored = |id| run.particles().stored(id);
    let columns = Columns::of(run, x, [Quantity::Velocity, Quantity::BodyForce]);
    match columns.double() {
        Some(columns) => columns.pulling(stored, ids, dt),
        None => columns.pulling(stored, ids, dt),
    }
}
