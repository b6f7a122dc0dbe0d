//! Coulomb friction: springs along the surface that slip at mu times the normal force.
//!
//! A spring holds a particle against the mean motion of the particles that press on it, weighted by how hard they press; they take its
//! force in the same shares, so momentum is kept. (Not angular momentum: the two sides are a spacing apart.) Bodies that stick therefore do not
//! creep: they move until the springs hold them, by less than mu p dp / (k/2) under a pressure p.

use super::Contact;
use super::facing::{Facing, Facings};
use super::force::{GRAIN, Pressing, Pushed, Scene, Vector3};
use crate::math::Vector;
use rayon::prelude::*;

/// Stiffness of sticking over that of the contact, for both sides together.
const STICKING: f64 = 0.5;

/// What sticks a particle to a body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spring {
    /// The particle.
    a: u32,
    /// The body.
    body: u32,
    /// How far the particle has been drawn along the surface since it stuck, m.
    stretch: Vector3,
    /// The force on it, N.
    pull: Vector3,
    /// Energy that slipping took in the last step, J.
    pub lost: f64,
}

/// The springs of all facings, in their order.
#[derive(Clone, Debug, Default)]
pub struct Springs {
    /// One for each facing; none without friction.
    pub all: Vec<Spring>,
    before: Vec<Spring>,
    /// What springs do to the particle of each facing, N: its own, and those of the others.
    pub drag: Vec<Vector3>,
}

impl Springs {
    /// Springs for new lists: a particle that still faces a body keeps its spring.
    pub fn follow(&mut self, facings: &Facings) {
        std::mem::swap(&mut self.all, &mut self.before);
        self.all.clear();
        let before = &self.before;
        self.all.extend(facings.all.iter().map(|&Facing { a, body, .. }| {
            let found = before.binary_search_by_key(&(a, body), |spring| (spring.a, spring.body));
            found.map_or(Spring { a, body, ..Spring::default() }, |at| before[at])
        }));
        self.drag.resize(facings.all.len(), Vector3::default());
    }
}

impl Spring {
    /// The numbers that it is when a run goes on.
    pub fn numbers(&self) -> [f64; 5] {
        let [x, y, z] = self.stretch.0.0;
        [f64::from(self.a), f64::from(self.body), x, y, z]
    }

    /// The spring of such numbers.
    pub fn of([a, body, x, y, z]: [f64; 5]) -> Self {
        Self { a: a as u32, body: body as u32, stretch: Vector3(Vector([x, y, z])), ..Self::default() }
    }
}

impl Scene<'_> {
    /// k_t of a facing, N/m, for its half of the sticking: the two sides hold on to each other.
    fn sticking(&self, facing: &Facing) -> f64 {
        let volume = self.surfaces.volume[facing.a as usize];
        0.5 * STICKING * self.stiffness(facing) * volume / (self.law.spacing * self.law.spacing)
    }

    /// Half of the coefficient of friction: both sides rub.
    fn rubbing(&self, facing: &Facing) -> f64 {
        let one = self.surfaces.body[facing.a as usize];
        self.meetings.of(one, facing.body).map_or(0.0, |meeting| 0.5 * meeting.friction)
    }

    /// What springs add at most to the row of the stiffness matrix, N/m: k_t (1 + 1) for the particle's own spring, and as much again for those
    /// of its partners, of whose shares it has about one in all.
    pub fn sticking_bound(&self, facing: &Facing) -> f64 {
        if self.rubbing(facing) > 0.0 { 4.0 * self.sticking(facing) } else { 0.0 }
    }

    /// The spring of a facing after a step of `dt`: drawn by the relative motion, kept along the surface, slipping at its limit.
    fn stick(
        &self,
        facing: &Facing,
        old: Spring,
        (pushed, pressure): (&Pushed, &dyn Fn(usize) -> f64),
        dt: f64,
    ) -> Spring {
        let (stiffness, normal) = (self.sticking(facing), pushed.force.0.norm_squared().sqrt());
        let energy = |stretch: Vector<f64, 3>| 0.5 * stiffness * stretch.norm_squared();
        if normal == 0.0 {
            return Spring {
                lost: energy(old.stretch.0),
                stretch: Vector3::default(),
                pull: Vector3::default(),
                ..old
            };
        }
        let (a, v) = (facing.a as usize, &self.surfaces.v);
        let others = self.pairs(facing).fold(Vector::zero(), |sum: Vector<f64, 3>, (b, mirror, _, r)| {
            sum.plus(self.squeeze(a, (b, r), pressure(mirror)) / pushed.weight, v[b])
        });
        let n = pushed.force.0.times(1.0 / normal);
        let drawn = old.stretch.0.plus(dt, v[a] - others);
        let drawn = drawn.plus(-n.dot(drawn), n);
        let (most, length) = (self.rubbing(facing) * normal / stiffness, drawn.norm_squared().sqrt());
        let held = if length > most { drawn.times(most / length) } else { drawn };
        let lost = stiffness * most.min(length) * (length - most).max(0.0);
        Spring { stretch: Vector3(held), pull: Vector3(held.times(-stiffness)), lost, ..old }
    }

    /// What springs do to the particle of a facing.
    fn drag(
        &self,
        facing: &Facing,
        own: &Spring,
        (springs, pushed): (&[Spring], &[Pushed]),
        pressure: &dyn Fn(usize) -> f64,
    ) -> Vector3 {
        let a = facing.a as usize;
        Vector3(self.pairs(facing).fold(own.pull.0, |sum, (b, mirror, _, r)| match pushed[mirror].weight {
            0.0 => sum,
            weight => sum.plus(-self.squeeze(a, (b, r), pressure(mirror)) / weight, springs[mirror].pull.0),
        }))
    }

    /// Energy of the spring of a facing, J.
    pub fn held(&self, facing: &Facing, spring: &Spring) -> f64 {
        0.5 * self.sticking(facing) * spring.stretch.0.norm_squared()
    }
}

impl Contact {
    /// Draws the springs by the motion of a step, and finds what they do.
    pub(super) fn rub(&mut self, dt: f64) {
        let mut springs = std::mem::take(&mut self.springs);
        let (scene, pressing, pushed) = (self.scene(), &self.pressing, &self.pushed);
        let sum = |mine: &Pressing, other: usize| mine.pressure + pressing[other].pressure;
        let own = || scene.facings.all.par_iter().zip(pressing);
        let drawn = springs.all.par_iter_mut().zip(own()).zip(pushed).with_min_len(GRAIN);
        drawn.for_each(|((spring, (facing, mine)), pushed)| {
            *spring = scene.stick(facing, *spring, (pushed, &|other| sum(mine, other)), dt);
        });
        let all = &springs.all;
        let dragged = springs.drag.par_iter_mut().zip(own()).zip(all).with_min_len(GRAIN);
        dragged.for_each(|((drag, (facing, mine)), own)| {
            *drag = scene.drag(facing, own, (all, pushed), &|other| sum(mine, other));
        });
        self.springs = springs;
    }
}
