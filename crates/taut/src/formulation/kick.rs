//! The velocity half of a step, shared by all formulations.

use crate::math::{Real, Vector};
use crate::pass::Now;

/// What the kick needs of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Mover<S, const D: usize> {
    /// Velocity before.
    pub v: Vector<S, D>,
    /// Mass.
    pub m: S,
    /// Body force per mass.
    pub b: Vector<S, D>,
    /// 1 where free, 0 where prescribed.
    pub free: Vector<S, D>,
    /// Prescribed velocity.
    pub given: Vector<S, D>,
}

/// What it gives.
#[derive(Clone, Copy, Debug)]
pub struct Kicked<S, const D: usize> {
    /// Velocity after, constraints included.
    pub v: Vector<S, D>,
    /// Acceleration by all forces but those of constraints: of held particles too, where it says what holding them takes.
    pub a: Vector<S, D>,
    /// Mean of the velocities before and after.
    pub mean: Vector<S, D>,
    /// Work of body force and constraints during the step, J.
    pub external_work: S,
}

impl<S: Real, const D: usize> Mover<S, D> {
    /// Accelerates by the internal acceleration and the body force, then puts prescribed components in place. What the
    /// constraint added to the momentum, times the mean velocity, is its work.
    #[inline(always)]
    pub fn kick(&self, internal: Vector<S, D>, now: &Now<S>) -> Kicked<S, D> {
        let a = internal + self.b;
        let moved = self.v.plus(now.dt, a);
        let v = Vector::from_fn(|i| {
            let held = (S::one() - self.free[i]) * self.given[i];
            self.free[i].mul_add(moved[i], held)
        });
        let mean = (self.v + v).times(S::of(0.5));
        let push = (v - self.v).plus(-now.dt, internal);
        Kicked { v, a, mean, external_work: self.m * push.dot(mean) }
    }
}
