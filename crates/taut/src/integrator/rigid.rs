//! Rigid bodies that move as they are told: no equation is solved for them.

use super::{Bounding, Criterion, Diverged, Held, Impulse, Solver};
use crate::field::Quantity;
use crate::formulation::State;
use crate::kernel::{Kernel, Shape};
use crate::math::{Tensor, Vector};
use crate::particles::saved::{Part, RestoreError, Shelf};
use crate::pass::Now;
use crate::run::{Among, Relist};

/// Where a rigid body is: x = centre + R (X - centre) + displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The point that rotation leaves where it is, m.
    pub centre: Vector<f64, 3>,
    /// R.
    pub rotation: Tensor<f64, 3>,
    /// How far the centre has moved, m.
    pub displacement: Vector<f64, 3>,
}

impl Pose {
    /// Where a point is that was at `x`, m.
    #[must_use]
    pub fn of(&self, x: Vector<f64, 3>) -> Vector<f64, 3> {
        let arm = x - self.centre;
        self.centre + self.rotation.mul_vector(arm) + self.displacement
    }
}

/// How a rigid body moves.
pub trait Motion: Send + Sync {
    /// The pose at a time, s.
    fn pose(&self, t: f64) -> Pose;
}

/// A rigid body. Its particles have no mass; between steps they are seen where they are, and touched where they are
/// half a step later, as those of total Lagrangian bodies.
pub struct Rigid {
    dimension: usize,
    body: u32,
    ids: Vec<u32>,
    x: Vec<Vector<f64, 3>>,
    volume: Vec<f64>,
    motion: Box<dyn Motion>,
    now: Pose,
    /// Half a step ahead.
    ahead: Pose,
    /// At the end of the step.
    next: Pose,
    /// Begin of the step, on the clock of the motion, and its length, s.
    step: Now<f64>,
    /// What passes of the motion in the step, s: as long as it, but where the motion has a clock of its own.
    passed: f64,
}

impl Rigid {
    /// The body of this number with particles at `points` (reference position, m, and volume, m^3).
    #[must_use]
    pub fn new(
        dimension: usize,
        body: u32,
        points: impl Iterator<Item = ([f64; 3], f64)>,
        motion: Box<dyn Motion>,
    ) -> Self {
        let (x, volume): (Vec<_>, Vec<_>) = points.map(|(x, volume)| (Vector(x), volume)).unzip();
        let start = motion.pose(0.0);
        let ids = (0..x.len() as u32).collect();
        Self {
            dimension,
            body,
            ids,
            x,
            volume,
            motion,
            now: start,
            ahead: start,
            next: start,
            step: Now { t: 0.0, dt: 0.0 },
            passed: 0.0,
        }
    }

    /// Takes the poses of a step: all that the body is depends on it.
    fn plan(&mut self, step: Now<f64>, passed: f64) {
        self.now = self.motion.pose(step.t);
        self.ahead = self.motion.pose(step.t + 0.5 * passed);
        self.next = self.motion.pose(step.t + passed);
        (self.step, self.passed) = (step, passed);
    }

    fn velocity(&self, place: usize) -> Vector<f64, 3> {
        let (x, dt) = (self.x[place], self.step.dt);
        if dt > 0.0 { (self.next.of(x) - self.now.of(x)).times(1.0 / dt) } else { Vector::zero() }
    }
}

impl Solver for Rigid {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn ids(&self) -> &[u32] {
        &self.ids
    }

    fn stored(&self, id: usize) -> usize {
        id
    }

    fn neighbours(&self) -> f64 {
        0.0
    }

    fn lists(&self) -> u64 {
        0
    }

    fn is_rigid(&self) -> bool {
        true
    }

    fn start(&mut self) -> Result<(), Diverged> {
        Ok(())
    }

    fn begin(&mut self, dt: f64) {
        self.plan(Now { t: 0.0, dt }, dt);
    }

    fn stable_step(&self) -> f64 {
        f64::INFINITY
    }

    fn advance(&mut self, _: Now<f64>) -> Result<(), Diverged> {
        Ok(())
    }

    fn finish(&mut self, now: Now<f64>, next: f64) -> Result<(), Diverged> {
        self.plan(Now { t: now.t + now.dt, dt: next }, next);
        Ok(())
    }

    fn follow(&mut self, now: Now<f64>, passed: f64) -> f64 {
        self.plan(now, passed);
        (0..self.x.len()).map(|place| self.velocity(place).norm_squared()).fold(0.0, f64::max).sqrt()
    }

    fn bounding(&self) -> Bounding {
        Bounding { criterion: Criterion::Wave, wave_speed: 0.0, speed: 0.0, acceleration: 0.0 }
    }

    fn at_bound(&self, _: &Bounding) -> Option<u32> {
        None
    }

    fn reach(&self) -> Relist {
        let spacing = self.volume.first().map_or(1.0, |v| v.powf(1.0 / self.dimension as f64));
        let kernel = Kernel::new(Shape::WendlandC2, spacing, self.dimension);
        Relist { positions: Quantity::ReferencePosition, kernel, among: Among::SameBody }
    }

    fn fields(&self) -> &'static [Quantity] {
        &[Quantity::ReferencePosition, Quantity::Displacement, Quantity::Velocity, Quantity::Body]
    }

    fn save(&self) -> Vec<Part<'_>> {
        vec![Part::numbers("step", &[self.step.t, self.step.dt, self.passed])]
    }

    fn restore(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        let [t, dt, passed] = shelf.numbers("step")?;
        self.plan(Now { t, dt }, passed);
        Ok(())
    }

    fn holding(&self, _: &mut Held, _: f64) -> Impulse {
        Impulse::default()
    }

    fn pulling(&self, _: &[u32], _: f64) -> Impulse {
        Impulse::default()
    }

    fn read(&self, field: Quantity, place: usize) -> [f64; 3] {
        let x = self.x[place];
        match field {
            Quantity::ReferencePosition => x.0,
            Quantity::Position => self.now.of(x).0,
            Quantity::Displacement => (self.now.of(x) - x).0,
            Quantity::Velocity => self.velocity(place).0,
            _ => [0.0; 3],
        }
    }

    fn word(&self, field: Quantity, word: usize, place: usize) -> f64 {
        match field {
            Quantity::Volume => self.volume[place],
            Quantity::Body => f64::from(self.body),
            _ => self.read(field, place).get(word).copied().unwrap_or(0.0),
        }
    }

    fn set_word(&mut self, _: Quantity, _: usize, _: (usize, f64)) {}

    fn configuration(&self, place: usize) -> [f64; 3] {
        self.ahead.of(self.x[place]).0
    }

    fn state(&self, _: usize) -> State {
        State {
            deformation: Some(self.now.rotation),
            gradient: None,
            density: 0.0,
            cauchy: Tensor::zero(),
            strain_energy: 0.0,
            booked_ahead: 0.0,
            couple: [0.0; 3],
        }
    }
}
