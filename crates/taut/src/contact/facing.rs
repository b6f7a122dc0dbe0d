//! Who faces whom: surface particles, each with the particles of one body that are near it.

use super::law::Law;
use super::meetings::Meetings;
use super::surface::Surfaces;
use crate::math::Vector;
use crate::neighbours::{Adjacency, Search, SearchError};
use std::ops::Range;

/// Lists hold pairs so many spacings beyond the reach of the law, so that they last until something has moved half of that.
const MARGIN: f64 = 0.5;

/// Particles of one body touch each other only if they were so many spacings apart in the undeformed body.
const APART: f64 = 3.0;

/// A surface particle and one body near it.
#[derive(Clone, Debug, Default)]
pub struct Facing {
    /// The particle.
    pub a: u32,
    /// The body.
    pub body: u32,
    /// Its pairs.
    pub pairs: Range<u32>,
}

/// A partner in contact.
#[derive(Clone, Copy, Debug)]
pub struct Partner {
    /// The other particle.
    pub b: u32,
    /// The facing of b that looks at the body of a.
    pub mirror: u32,
}

/// Which bodies touch, and the lists.
#[derive(Debug)]
pub struct Facings {
    /// All facings, in the order of particles.
    pub all: Vec<Facing>,
    /// The partners of all facings.
    pub partners: Vec<Partner>,
    /// Particles that have facings, in their order, and where their facings end in [`Facings::all`].
    pub owners: Vec<(u32, u32)>,
    /// Positions when the lists were made.
    listed: Vec<Vector<f64, 3>>,
    /// What particles may move until the lists are made anew, m.
    leeway: f64,
    chosen: Vec<u32>,
    columns: [Vec<f64>; 3],
    list: Adjacency,
    search: Finder,
    /// How often the lists were made.
    pub lists: u64,
}

#[derive(Debug)]
enum Finder {
    Plane(Search<2>),
    Space(Search<3>),
}

/// Smallest and largest coordinates, m.
type Bounds = (Vector<f64, 3>, Vector<f64, 3>);

impl Facings {
    /// Before the first list.
    pub fn new(dimension: usize) -> Self {
        let search = if dimension == 2 { Finder::Plane(Search::new()) } else { Finder::Space(Search::new()) };
        Self {
            all: Vec::new(),
            partners: Vec::new(),
            owners: Vec::new(),
            listed: Vec::new(),
            leeway: 0.0,
            chosen: Vec::new(),
            columns: std::array::from_fn(|_| Vec::new()),
            list: Adjacency::default(),
            search,
            lists: 0,
        }
    }

    /// Whether particles have moved so far that pairs may be missing.
    pub fn are_old(&self, x: &[Vector<f64, 3>]) -> bool {
        let far = self.leeway * self.leeway;
        // A position that is not a number counts as far, so that the search refuses it.
        let moved = |(x, was): (&Vector<f64, 3>, &Vector<f64, 3>)| (*x - *was).norm_squared();
        self.listed.len() != x.len()
            || x.iter().zip(&self.listed).map(moved).any(|moved| moved > far || moved.is_nan())
    }

    /// Makes the lists.
    ///
    /// # Errors
    /// If positions are not numbers.
    pub fn renew(&mut self, surfaces: &Surfaces, meetings: &Meetings, law: &Law) -> Result<(), SearchError> {
        let radius = law.support() + MARGIN * law.spacing;
        self.listed.clear();
        self.listed.extend_from_slice(&surfaces.x);
        let gap = self.choose(surfaces, meetings, radius);
        self.leeway = 0.5 * (MARGIN * law.spacing).max(gap - law.support());
        for (k, column) in self.columns.iter_mut().enumerate() {
            column.clear();
            column.extend(self.chosen.iter().map(|&a| surfaces.x[a as usize][k]));
        }
        let [x, y, z] = self.columns.each_ref().map(Vec::as_slice);
        let chosen = &self.chosen;
        let apart = (APART * law.spacing).powi(2);
        let pair = |a: usize, b: usize| {
            let (a, b) = (chosen[a] as usize, chosen[b] as usize);
            let (one, other) = (surfaces.body[a], surfaces.body[b]);
            let distant = || (surfaces.reference[a] - surfaces.reference[b]).norm_squared() > apart;
            meetings.of(one, other).is_some() && (one != other || distant())
        };
        match &mut self.search {
            Finder::Plane(search) => search.pairs_of([x, y], radius, pair, &mut self.list)?,
            Finder::Space(search) => search.pairs_of([x, y, z], radius, pair, &mut self.list)?,
        }
        self.sort(surfaces);
        self.lists += 1;
        Ok(())
    }

    /// Chooses the particles that may have partners: those near the box around a body that theirs touches. Hands back the smallest
    /// gap between boxes, m; infinite if none touch.
    fn choose(&mut self, surfaces: &Surfaces, meetings: &Meetings, radius: f64) -> f64 {
        let boxes: Vec<Bounds> =
            surfaces.members.iter().map(|m| bounds(&surfaces.x[m.range.clone()])).collect();
        self.chosen.clear();
        let mut least = f64::INFINITY;
        for (one, member) in surfaces.members.iter().enumerate() {
            let touch = |other: usize| meetings.of(one as u32, other as u32).is_some();
            let others = || (0..boxes.len()).filter(|&other| touch(other));
            if touch(one) {
                least = 0.0;
                self.chosen.extend(member.range.clone().map(|a| a as u32));
                continue;
            }
            for other in others() {
                least = least.min(gap(&boxes[one], &boxes[other]));
            }
            let near = |&a: &usize| {
                let x = (surfaces.x[a], surfaces.x[a]);
                others().any(|other| gap(&x, &boxes[other]) < radius)
            };
            self.chosen.extend(member.range.clone().filter(near).map(|a| a as u32));
        }
        least
    }

    /// From neighbours to facings: partners of one body follow each other, since particles are stored body by body.
    fn sort(&mut self, surfaces: &Surfaces) {
        self.all.clear();
        self.owners.clear();
        self.partners.clear();
        for (k, &a) in self.chosen.iter().enumerate() {
            let first = self.all.len();
            for &b in self.list.of(k) {
                let b = self.chosen[b as usize];
                let body = surfaces.body[b as usize];
                let at = self.partners.len() as u32;
                self.partners.push(Partner { b, mirror: 0 });
                match self.all[first..].last_mut().filter(|facing| facing.body == body) {
                    Some(facing) => facing.pairs.end = at + 1,
                    None => self.all.push(Facing { a, body, pairs: at..at + 1 }),
                }
            }
            if self.all.len() > first {
                self.owners.push((a, self.all.len() as u32));
            }
        }
        for i in 0..self.all.len() {
            let Facing { a, ref pairs, .. } = self.all[i];
            for k in pairs.clone() {
                let b = self.partners[k as usize].b;
                self.partners[k as usize].mirror = self.facing(b, surfaces.body[a as usize]);
            }
        }
    }

    /// The facing of a particle that looks at a body. Pairs are in the list both ways round, so there is one.
    fn facing(&self, a: u32, body: u32) -> u32 {
        let own = self.owners.binary_search_by_key(&a, |owner| owner.0).unwrap_or(0);
        let first = if own == 0 { 0 } else { self.owners[own - 1].1 };
        let end = self.owners.get(own).map_or(first, |owner| owner.1);
        (first..end).find(|&f| self.all[f as usize].body == body).unwrap_or(first)
    }
}

fn bounds(x: &[Vector<f64, 3>]) -> Bounds {
    let (low, high) = (Vector([f64::INFINITY; 3]), Vector([f64::NEG_INFINITY; 3]));
    x.iter().fold((low, high), |(low, high), x| {
        (Vector::from_fn(|k| low[k].min(x[k])), Vector::from_fn(|k| high[k].max(x[k])))
    })
}

/// The distance of two boxes, m.
fn gap(one: &Bounds, other: &Bounds) -> f64 {
    let apart = |k: usize| (one.0[k] - other.1[k]).max(other.0[k] - one.1[k]).max(0.0);
    (0..3).map(|k| apart(k).powi(2)).sum::<f64>().sqrt()
}
