//! The oracle: one thread, one number at a time, nothing fused, the obvious loops.

use super::{Among, Relist, Run};
use crate::field::{Quantity, Record, Sink, Source};
use crate::math::Vector;
use crate::neighbours::{Adjacency, SearchError, trivial_pairs};
use crate::particles::Particles;
use crate::pass::{ALL_WEIGHTS, Now, Pair, PairSum, Reduce, Update};

/// A serial run, for tests: slow and easy to read.
#[derive(Debug)]
pub struct Serial<const D: usize> {
    particles: Particles<D>,
    adjacency: Adjacency,
    pairs: Vec<Pair<f64, D, ALL_WEIGHTS>>,
}

/// One row of numbers, read or written by a record.
struct Row<'a>(&'a mut [f64]);

impl Source<f64> for Row<'_> {
    fn get(&self, k: usize) -> f64 {
        self.0[k]
    }
}

impl Sink<f64> for Row<'_> {
    fn put(&mut self, k: usize, x: f64) {
        self.0[k] = x;
    }
}

impl<const D: usize> Serial<D> {
    /// A run over these particles, without neighbours yet.
    #[must_use]
    pub fn new(particles: Particles<D>) -> Self {
        Self { particles, adjacency: Adjacency::default(), pairs: Vec::new() }
    }

    fn read<R: Record<D>>(&self, a: usize) -> R::Of<f64> {
        let mut row = vec![0.0; R::WORDS];
        self.particles.each_column::<R>(|k, column| row[k] = self.particles.nth(column)[a]);
        R::read(&Row(&mut row))
    }

    fn write<R: Record<D>>(&mut self, a: usize, record: R::Of<f64>) {
        let mut row = vec![0.0; R::WORDS];
        R::write(record, &mut Row(&mut row));
        let mut places = Vec::new();
        self.particles.each_column::<R>(|k, column| places.push((k, column)));
        for (k, column) in places {
            self.particles.nth_mut(column)[a] = row[k];
        }
    }
}

impl<const D: usize> Run<D> for Serial<D> {
    fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    fn particles_mut(&mut self) -> &mut Particles<D> {
        &mut self.particles
    }

    fn relist(&mut self, how: &Relist) -> Result<(), SearchError> {
        let p = &self.particles;
        let bodies: Vec<u32> = p.column(Quantity::Body, 0).iter().map(|&b| b as u32).collect();
        let same = (how.among == Among::SameBody).then_some(bodies.as_slice());
        self.adjacency = trivial_pairs(p.vector(how.positions), how.kernel.support(), same)?;
        self.pairs.clear();
        for a in 0..p.len() {
            for &b in self.adjacency.of(a) {
                let x_ab = p.vector_at(how.positions, a) - p.vector_at(how.positions, b as usize);
                let r = x_ab.norm_squared().sqrt();
                let slope = how.kernel.dw(r) * p.column(Quantity::Volume, 0)[b as usize];
                // Particles on top of each other have no direction and no force.
                let over_r = if r > 0.0 { 1.0 / r } else { 0.0 };
                let e: Vector<f64, D> = x_ab.times(over_r);
                self.pairs.push(Pair { grad_w: e.times(slope), w: slope * over_r, e, x: x_ab, over_r });
            }
        }
        Ok(())
    }

    fn neighbours(&self) -> f64 {
        self.adjacency.mean()
    }

    fn loneliest(&self) -> Option<(usize, usize)> {
        let counts = (0..self.particles.len()).map(|a| (a, self.adjacency.of(a).len()));
        counts.min_by_key(|&(_, count)| count)
    }

    fn pairs<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(&mut self, sum: &P, then: &U, now: Now<f64>) {
        let mut sums = Vec::with_capacity(self.particles.len());
        let mut at = 0;
        for a in 0..self.particles.len() {
            let own = self.read::<P::Reads>(a);
            let mut total = P::Adds::nought();
            for &b in self.adjacency.of(a) {
                let other = self.read::<P::Reads>(b as usize);
                sum.add(&mut total, (&own, &other), &self.pairs[at], &now);
                at += 1;
            }
            sums.push(total);
        }
        for (a, total) in sums.into_iter().enumerate() {
            let new = then.at(&total, &self.read::<U::Reads>(a), &now);
            self.write::<U::Writes>(a, new);
        }
    }

    fn each<U: Update<D, Sum = ()>>(&mut self, update: &U, now: Now<f64>) {
        for a in 0..self.particles.len() {
            let new = update.at(&(), &self.read::<U::Reads>(a), &now);
            self.write::<U::Writes>(a, new);
        }
    }

    fn reduce<R: Reduce<D, K>, const K: usize>(&mut self, reduce: &R) -> [f64; K] {
        let mut out = R::FOLDS.map(crate::pass::Fold::start);
        for a in 0..self.particles.len() {
            let values = reduce.at(&self.read::<R::Reads>(a));
            for k in 0..K {
                out[k] = R::FOLDS[k].join(out[k], values[k]);
            }
        }
        out
    }
}
