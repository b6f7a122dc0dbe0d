//! Threads times lanes. Particles are cut into fixed chunks, chunks go to threads, and inside a chunk the neighbours
//! of one particle go through the lanes of a SIMD register, four at a time. Chunks and the order of every sum do not
//! depend on the number of threads, so the result is bitwise the same for any.
//!
//! Parallel loops use the rayon pool they are called from: a simulation enters one pool for its whole run.

mod list;
mod places;
mod stencil;
mod walk;

use super::{Relist, Run};
use crate::field::{Quantity, Record};
use crate::neighbours::{Adjacency, Lattice, Search, SearchError};
use crate::particles::Particles;
use crate::pass::{Now, PairSum, Reduce, Update};
use list::PairBlocks;
use places::Places;
use rayon::prelude::*;
use stencil::Stencil;
use walk::{Chunk, Walk};

/// Particles that one thread takes at a time.
const CHUNK: usize = 128;

/// Blocks of a stencil that one thread takes at a time.
const BLOCKS: usize = 32;

/// The instruction set that the lanes use, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// Whatever the base instruction set of the machine offers.
    Plain,
    /// AVX2 with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    Avx2,
}

impl InstructionSet {
    /// The best of this machine.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        if crate::math::avx2_available() {
            return Self::Avx2;
        }
        Self::Plain
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2+fma",
        }
    }
}

/// A run on the processor's cores.
#[derive(Debug)]
pub struct Cpu<const D: usize> {
    particles: Particles<D>,
    set: InstructionSet,
    search: Search<D>,
    adjacency: Adjacency,
    blocks: PairBlocks<D>,
    stencil: Option<Stencil<D>>,
    bodies: Vec<u32>,
    records: Vec<f64>,
    partial: Vec<f64>,
}

impl<const D: usize> Cpu<D> {
    /// A run over these particles with the best instruction set of this machine.
    #[must_use]
    pub fn new(particles: Particles<D>) -> Self {
        Self::with(particles, InstructionSet::best())
    }

    /// A run with a chosen instruction set (which the machine must have).
    #[must_use]
    pub fn with(particles: Particles<D>, set: InstructionSet) -> Self {
        Self {
            particles,
            set,
            search: Search::new(),
            adjacency: Adjacency::default(),
            blocks: PairBlocks::default(),
            stencil: None,
            bodies: Vec::new(),
            records: Vec::new(),
            partial: Vec::new(),
        }
    }

    fn chunks(&self) -> usize {
        self.particles.len().div_ceil(CHUNK)
    }

    /// Runs `walk` over all particles.
    fn run(&self, walk: &(impl Walk + Sync)) {
        self.cut(walk, self.particles.len(), CHUNK);
    }

    /// Runs `walk` over `0..len` in chunks, in parallel, with the chosen lanes.
    fn cut(&self, walk: &(impl Walk + Sync), len: usize, size: usize) {
        let set = self.set;
        (0..len.div_ceil(size)).into_par_iter().for_each(|c| {
            let chunk = Chunk { index: c, first: c * size, end: len.min((c + 1) * size) };
            match set {
                InstructionSet::Plain => walk::plain(walk, &chunk),
                // SAFETY: this variant is only chosen where the machine has AVX2 and FMA.
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => unsafe { walk::avx2(walk, &chunk) },
            }
        });
    }

    /// The stencil of the particles, if they stand on a lattice, row by row, and all have the same volume.
    fn lattice(&self, how: &Relist) -> Result<Option<Stencil<D>>, SearchError> {
        let volume = self.particles.column(Quantity::Volume, 0);
        let equal = volume.iter().all(|v| (v / volume[0] - 1.0).abs() < 1e-12);
        let one = self.bodies.iter().all(|&b| b == self.bodies[0]);
        if how.positions != Quantity::ReferencePosition || !equal || !one {
            return Ok(None);
        }
        let spacing = volume.first().map_or(0.0, |v| v.powf(1.0 / D as f64));
        let lattice = Lattice::detect(self.particles.vector(how.positions), spacing)?;
        let stored = lattice.filter(|l| l.rows().iter().enumerate().all(|(i, &a)| i == a as usize));
        Ok(stored.map(|l| Stencil::new(&l, volume[0], &how.kernel)))
    }

    /// The pair loop over packed records and a list.
    fn listed<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(&mut self, sum: &P, then: &U, now: Now<f64>) {
        let own =
            Places::of::<P::Reads, D>(&mut self.particles).with::<D>(Quantity::Volume, &mut self.particles);
        let stride = own.len().next_multiple_of(4);
        let len = self.particles.len();
        if self.records.len() < len * stride {
            self.records.resize(len * stride, 0.0);
        }
        self.records[..len * stride].par_chunks_mut(CHUNK * stride).enumerate().for_each(|(c, rows)| {
            for (i, row) in rows.chunks_exact_mut(stride).enumerate() {
                // SAFETY: the place is below `len`; nobody writes columns while they are packed.
                unsafe { own.gather(c * CHUNK + i, row) };
            }
        });
        let reads = Places::of::<U::Reads, D>(&mut self.particles);
        let writes = Places::of::<U::Writes, D>(&mut self.particles);
        let (records, blocks) = (&self.records[..len * stride], &self.blocks);
        self.run(&walk::Pairs { sum, then, reads, writes, records, stride, blocks, now });
    }

    /// The pair loop over a stencil. What the sum reads of neighbours must not change under it: if the update writes it, the sum
    /// reads a copy.
    fn stencilled<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(
        &mut self,
        stencil: &Stencil<D>,
        (sum, then): (&P, &U),
        now: Now<f64>,
    ) {
        let mut own = Places::of::<P::Reads, D>(&mut self.particles);
        let reads = Places::of::<U::Reads, D>(&mut self.particles);
        let writes = Places::of::<U::Writes, D>(&mut self.particles);
        if P::Reads::FIELDS.iter().any(|field| U::Writes::FIELDS.contains(field)) {
            own = self.copied(&own);
        }
        let walk = walk::Stencils { sum, then, own, reads, writes, stencil, now };
        self.cut(&walk, stencil.blocks.len(), BLOCKS);
    }

    /// A copy of a record's columns.
    fn copied(&mut self, own: &Places) -> Places {
        let len = self.particles.len();
        let stride = len + 48;
        self.records.resize(self.records.len().max(own.len() * stride + 16), 0.0);
        for k in 0..own.len() {
            // SAFETY: columns are `len` long and nobody writes them here.
            let column = unsafe { own.column(k, len) };
            self.records[8 + k * stride..8 + k * stride + len].copy_from_slice(column);
        }
        // SAFETY: the buffer was made for just these columns, with room before and after.
        unsafe { own.elsewhere(self.records.as_mut_ptr().add(8), stride) }
    }
}

impl<const D: usize> Run<D> for Cpu<D> {
    fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    fn particles_mut(&mut self) -> &mut Particles<D> {
        &mut self.particles
    }

    fn relist(&mut self, how: &Relist) -> Result<(), SearchError> {
        let x = self.particles.vector(how.positions);
        let radius = how.kernel.support();
        self.bodies.clear();
        self.bodies.extend(self.particles.column(Quantity::Body, 0).iter().map(|&b| b as u32));
        let same = (how.among == super::Among::SameBody).then_some(self.bodies.as_slice());
        self.search.pairs(x, radius, same, &mut self.adjacency)?;
        self.stencil = self.lattice(how)?;
        if self.stencil.is_none() {
            let x = self.particles.vector(how.positions);
            self.blocks.build(&self.adjacency, x, &how.kernel);
        }
        Ok(())
    }

    fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    fn pairs<P: PairSum<D>, U: Update<D, Sum = P::Adds>>(&mut self, sum: &P, then: &U, now: Now<f64>) {
        match self.stencil.take() {
            Some(stencil) => {
                self.stencilled(&stencil, (sum, then), now);
                self.stencil = Some(stencil);
            }
            None => self.listed(sum, then, now),
        }
    }

    fn each<U: Update<D, Sum = ()>>(&mut self, update: &U, now: Now<f64>) {
        let reads = Places::of::<U::Reads, D>(&mut self.particles);
        let writes = Places::of::<U::Writes, D>(&mut self.particles);
        self.run(&walk::Each::<U, D> { update, reads, writes, now });
    }

    fn reduce<R: Reduce<D, K>, const K: usize>(&mut self, reduce: &R) -> [f64; K] {
        let reads = Places::of::<R::Reads, D>(&mut self.particles);
        self.partial.resize(self.chunks() * K, 0.0);
        let partial = places::Shared::new(&mut self.partial);
        self.run(&walk::Fold::<R, D, K> { reduce, reads, partial });
        let mut out = R::FOLDS.map(crate::pass::Fold::start);
        for chunk in self.partial.chunks_exact(K) {
            for k in 0..K {
                out[k] = R::FOLDS[k].join(out[k], chunk[k]);
            }
        }
        out
    }
}
