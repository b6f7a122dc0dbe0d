//! Overlaps and forces: two gathers over the pairs of every facing.

use super::facing::{Facing, Facings};
use super::law::Law;
use super::surface::Surfaces;
use super::{Contact, Meetings};
use crate::math::Vector;
use rayon::prelude::*;

/// Facings handed to a thread at a time, at least.
pub const GRAIN: usize = 64;

/// How a particle presses on a body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pressing {
    /// p = k s (sigma - sigma_0)_+, Pa.
    pub pressure: f64,
    /// dp/dsigma, Pa; 0 where nothing is near.
    stiffness: f64,
    /// |dsigma/dx_a|, 1/m.
    own: f64,
    /// Sum of |dsigma/dx| over all that moves, a itself included, 1/m.
    all: f64,
}

/// What a body does to a particle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pushed {
    /// The force, N.
    pub force: Vector3,
    /// Sum of the magnitudes of the forces of all pairs, N.
    pub weight: f64,
    /// Sum of the second derivatives of the energy by the place of this particle and of all others, N/m.
    pub stiffness: f64,
}

/// A vector of zeros by default.
#[derive(Clone, Copy, Debug)]
pub struct Vector3(pub Vector<f64, 3>);

impl Default for Vector3 {
    fn default() -> Self {
        Self(Vector::zero())
    }
}

/// What the gathers read.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The law.
    pub law: &'a Law,
    /// Who meets whom.
    pub meetings: &'a Meetings,
    /// The particles.
    pub surfaces: &'a Surfaces,
    /// The pairs.
    pub facings: &'a Facings,
}

impl Scene<'_> {
    /// x_ab and |x_ab| of every pair of a facing that is within reach, with b and the facing of b. Particles at the same place have no
    /// direction to push each other.
    pub fn pairs<'s>(
        &'s self,
        facing: &'s Facing,
    ) -> impl Iterator<Item = (usize, usize, Vector<f64, 3>, f64)> + 's {
        let x = &self.surfaces.x;
        let own = x[facing.a as usize];
        let partners = &self.facings.partners[facing.pairs.start as usize..facing.pairs.end as usize];
        partners.iter().filter_map(move |partner| {
            let apart = own - x[partner.b as usize];
            let r = apart.norm_squared().sqrt();
            (0.0 < r && r < self.law.support()).then_some((
                partner.b as usize,
                partner.mirror as usize,
                apart,
                r,
            ))
        })
    }

    /// k of a facing, Pa.
    pub fn stiffness(&self, facing: &Facing) -> f64 {
        let one = self.surfaces.body[facing.a as usize];
        self.meetings.of(one, facing.body).map_or(0.0, |meeting| meeting.stiffness)
    }

    /// Energy of the particle of a facing, J.
    pub fn energy(&self, facing: &Facing) -> f64 {
        let volume = &self.surfaces.volume;
        let overlap = self.pairs(facing).map(|(b, _, _, r)| volume[b] * self.law.w(r)).sum();
        volume[facing.a as usize] * self.stiffness(facing) * self.law.energy(overlap)
    }

    fn press(&self, facing: &Facing) -> Pressing {
        let (law, surfaces) = (self.law, self.surfaces);
        let (mut overlap, mut gradient, mut all) = (0.0, Vector::zero(), 0.0);
        for (b, _, apart, r) in self.pairs(facing) {
            let (volume, slope) = (surfaces.volume[b], law.slope(r));
            overlap += volume * law.w(r);
            gradient = gradient.plus(volume * slope / r, apart);
            all -= if surfaces.moves(b) { volume * slope } else { 0.0 };
        }
        if !law.is_near(overlap) {
            return Pressing::default();
        }
        let (k, own) = (self.stiffness(facing), gradient.norm_squared().sqrt());
        let moved = if surfaces.moves(facing.a as usize) { own } else { 0.0 };
        Pressing { pressure: k * law.pressure(overlap), stiffness: k * law.gain, own, all: all + moved }
    }

    /// |f_ab| = -V_a V_b (p_a + p_b) W' of a pair of a facing, N.
    pub fn squeeze(&self, a: usize, (b, r): (usize, f64), pressure: f64) -> f64 {
        -self.surfaces.volume[a] * self.surfaces.volume[b] * pressure * self.law.slope(r)
    }

    /// The force of a facing on its particle, and a bound of its stiffness: the row of the second derivatives of E = sum_r V_r psi(sigma_r),
    /// which are V_r psi'' grad sigma_r (x) grad sigma_r + V_r psi' grad grad sigma_r.
    fn push(&self, facing: &Facing, pressing: &[Pressing], mine: &Pressing) -> Pushed {
        let (law, surfaces) = (self.law, self.surfaces);
        let a = facing.a as usize;
        let mut pushed = Pushed::default();
        let mut stiffness = mine.stiffness * mine.own * mine.all;
        for (b, mirror, apart, r) in self.pairs(facing) {
            let other = &pressing[mirror];
            stiffness -= surfaces.volume[b] * law.slope(r) * other.stiffness * other.all;
            let pressure = mine.pressure + other.pressure;
            if pressure > 0.0 {
                let size = self.squeeze(a, (b, r), pressure);
                pushed.force.0 = pushed.force.0.plus(size / r, apart);
                pushed.weight += size;
                let movers = if surfaces.moves(b) { 2.0 } else { 1.0 };
                stiffness += movers * surfaces.volume[b] * pressure * law.curvature(r);
            }
        }
        let sticking = if pushed.weight > 0.0 { self.sticking_bound(facing) } else { 0.0 };
        pushed.stiffness = surfaces.volume[a].mul_add(stiffness, sticking);
        pushed
    }
}

impl Contact {
    /// What the gathers read.
    pub(super) fn scene(&self) -> Scene<'_> {
        Scene { law: &self.law, meetings: &self.meetings, surfaces: &self.surfaces, facings: &self.facings }
    }

    /// Overlaps of all facings.
    pub(super) fn press(&mut self) {
        let mut pressing = std::mem::take(&mut self.pressing);
        pressing.resize(self.facings.all.len(), Pressing::default());
        let scene = self.scene();
        let each = pressing.par_iter_mut().zip(&self.facings.all).with_min_len(GRAIN);
        each.for_each(|(pressing, facing)| *pressing = scene.press(facing));
        self.pressing = pressing;
    }

    /// Forces of all facings.
    pub(super) fn push(&mut self) {
        let mut pushed = std::mem::take(&mut self.pushed);
        pushed.resize(self.facings.all.len(), Pushed::default());
        let (scene, pressing) = (self.scene(), &self.pressing);
        let each = pushed.par_iter_mut().zip(&self.facings.all).zip(pressing).with_min_len(GRAIN);
        each.for_each(|((pushed, facing), mine)| *pushed = scene.push(facing, pressing, mine));
        self.pushed = pushed;
    }
}
