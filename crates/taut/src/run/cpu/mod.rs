//! Threads times lanes. Particles are cut into fixed chunks, chunks go to threads, and inside a chunk neighbours or particles go
//! through the lanes of a SIMD register. Chunks and the order of every sum do not depend on the number of threads, so the
//! result is bitwise the same for any.
//!
//! Parallel loops use the rayon pool they are called from: a simulation enters one pool for its whole run.

mod homes;
mod kit;
mod list;
mod places;
mod slots;
mod stencil;
mod store;
mod walk;

pub use kit::{Double, InstructionSet, Precision, Single};

use super::{Among, Numbers, Relist, Run};
use crate::field::{Quantity, Record};
use crate::neighbours::{CellGrid, Lattice, SearchError};
use crate::particles::saved::Values;
use crate::particles::{Lines, Particles};
use crate::pass::{Now, PairSum, Reduce, Update};
use homes::Homes;

use list::PairList;
use places::{Fetching, PairPlaces, Shared};
use rayon::prelude::*;
use slots::Slots;
use std::marker::PhantomData;
use std::sync::atomic::AtomicU64;
use stencil::Stencil;
use store::Store;
use walk::{Chunk, MOST_PAIRS, Then, Updating, Walk};

/// Particles that one thread takes at a time.
const CHUNK: usize = 128;

/// A run on the processor's cores.
#[derive(Debug)]
pub struct Cpu<const D: usize, P: Precision = Double> {
    store: Store<D, P>,
    set: InstructionSet,
    grid: CellGrid<D>,
    slots: Slots<D>,
    list: PairList<P::E, D>,
    stencil: Option<Stencil<D>>,
    homes: Homes,
    bodies: Vec<u32>,
    records: Lines<P::E>,
    partial: Vec<f64>,
}

impl<const D: usize> Cpu<D> {
    /// A run in double precision with the best instruction set of this machine.
    #[must_use]
    pub fn new(particles: Particles<D>) -> Self {
        Self::with(particles, InstructionSet::best())
    }
}

impl<const D: usize> Cpu<D, Single> {
    /// A run in single precision with the best instruction set of this machine.
    #[must_use]
    pub fn single(particles: Particles<D>) -> Self {
        Self::with(particles, InstructionSet::best())
    }
}

impl<const D: usize, P: Precision> Cpu<D, P> {
    /// A run with a chosen instruction set (which the machine must have).
    #[must_use]
    pub fn with(particles: Particles<D>, set: InstructionSet) -> Self {
        Self {
            store: Store::new(particles),
            set,
            grid: CellGrid::new(),
            slots: Slots::default(),
            list: PairList::default(),
            stencil: None,
            homes: Homes::default(),
            bodies: Vec::new(),
            records: Lines::default(),
            partial: Vec::new(),
        }
    }

    fn len(&self) -> usize {
        self.store.particles().len()
    }

    /// Runs `walk` over `0..len` in chunks, in parallel, with the chosen lanes.
    fn cut(&self, walk: &(impl Walk<P::E> + Sync), len: usize, size: usize) {
        let set = self.set;
        (0..len.div_ceil(size)).into_par_iter().for_each(|c| {
            let chunk = Chunk { index: c, first: c * size, end: len.min((c + 1) * size) };
            match set {
                InstructionSet::Plain => walk::base::<_, P::Plain>(walk, &chunk),
                #[cfg(target_arch = "aarch64")]
                InstructionSet::Neon => walk::base::<_, P::Neon>(walk, &chunk),
                // SAFETY: this variant is only chosen where the machine has AVX2 and FMA.
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => unsafe { walk::avx2::<_, P::Avx2>(walk, &chunk) },
                // SAFETY: this variant is only chosen where the machine has AVX-512.
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx512 => unsafe { walk::avx512::<_, P::Avx512>(walk, &chunk) },
            }
        });
    }

    fn one_body(&self) -> bool {
        self.bodies.iter().all(|&b| b == self.bodies[0])
    }

    /// Makes the list of pairs.
    fn search(&mut self, how: &Relist) -> Result<(), SearchError> {
        let x = self.store.particles().vector(how.positions);
        self.grid.bin(x, how.kernel.support())?;
        let volume = self.store.particles().column(Quantity::Volume, 0);
        self.list.prepare((x, volume), &how.kernel);
        let mut chunks = std::mem::take(&mut self.list.chunks);
        let (list, pairs) = (&self.list, AtomicU64::new(0));
        self.slots.fill(self.grid.ids(), |a| list.place(a));
        let listing = walk::Listing {
            grid: &self.grid,
            x,
            volume,
            same: (how.among == Among::SameBody && !self.one_body()).then_some(self.bodies.as_slice()),
            kernel: &how.kernel,
            slots: &self.slots,
            list,
            chunks: Shared::new(&mut chunks),
            pairs: &pairs,
        };
        self.cut(&listing, self.len(), CHUNK);
        self.list.chunks = chunks;
        let found = pairs.into_inner();
        if found > MOST_PAIRS { Err(SearchError::TooMany { what: "pairs", found }) } else { Ok(()) }
    }

    /// The stencil of the particles, if they stand on a lattice, row by row, and all have the same volume.
    fn lattice(&self, how: &Relist) -> Result<Option<Stencil<D>>, SearchError> {
        let particles = self.store.particles();
        let volume = particles.column(Quantity::Volume, 0);
        let equal = || volume.iter().all(|v| (v / volume[0] - 1.0).abs() < 1e-12);
        if how.positions != Quantity::ReferencePosition || !self.one_body() || !equal() {
            return Ok(None);
        }
        let spacing = volume.first().map_or(0.0, |v| v.powf(1.0 / D as f64));
        let lattice = Lattice::detect(particles.vector(how.positions), spacing)?;
        let stored = lattice.filter(|l| l.rows().iter().enumerate().all(|(i, &a)| i == a as usize));
        Ok(stored.map(|l| Stencil::new(&l, volume[0], &how.kernel, self.set.lanes::<P>())))
    }

    /// The pair loop over packed records and a list.
    fn listed<S: PairSum<D>>(&mut self, sum: &S, then: Then<'_>, now: Now<f64>) {
        let mut own = self.store.pair_places::<S::Reads>();
        self.list.tails().for_each(|column| own.push(column));
        let (stride, len) = (walk::stride::<S::Reads, P::E, D>(), self.len());
        if self.records.len() < len * stride {
            self.records.resize(len * stride);
        }
        let mut rows = std::mem::take(&mut self.records);
        let records = Shared::new(&mut rows);
        self.cut(&walk::Packing::<S::Reads, _, D> { own, records, record: PhantomData }, len, CHUNK);
        self.records = rows;
        let (records, list) = (&self.records[..len * stride], &self.list);
        self.cut(&walk::Listed { sum, then, records, list, now }, len, CHUNK);
    }

    /// The pair loop over a stencil. What the sum reads of neighbours must not change under it: if an update of `writes` follows, the
    /// sum reads a copy.
    fn stencilled<S: PairSum<D>>(
        &mut self,
        stencil: &Stencil<D>,
        (sum, then, writes): (&S, Then<'_>, &[Quantity]),
        now: Now<f64>,
    ) {
        let mut own = self.store.pair_places::<S::Reads>();
        if S::Reads::FIELDS.iter().any(|field| writes.contains(field)) {
            own = self.copied(&own);
        }
        let mut homes = std::mem::take(&mut self.homes);
        let walk = walk::Stencilled { sum, then, own, stencil, homes: homes.of(stencil, &self.store), now };
        self.cut(&walk, stencil.blocks.len(), CHUNK / self.set.lanes::<P>());
        // A pass that writes what is given, such as B, changes homes.
        if writes.iter().any(|field| field.is_given()) {
            homes.forget();
        }
        self.homes = homes;
    }

    /// A copy of a record's columns.
    fn copied(&mut self, own: &PairPlaces<P::E>) -> PairPlaces<P::E> {
        let len = self.len();
        let stride = len + 48;
        let room = self.records.len().max(own.len() * stride + 32);
        self.records.resize(room);
        for k in 0..own.len() {
            // SAFETY: columns are `len` long and nobody writes them here.
            let column = unsafe { own.column(k, len) };
            self.records[16 + k * stride..16 + k * stride + len].copy_from_slice(column);
        }
        // SAFETY: the buffer was made for just these columns, with room before and after.
        unsafe { own.elsewhere(self.records.as_mut_ptr().add(16), stride) }
    }
}

impl<const D: usize, P: Precision> Run<D> for Cpu<D, P> {
    fn particles(&self) -> &Particles<D> {
        self.store.particles()
    }

    fn particles_mut(&mut self) -> &mut Particles<D> {
        self.homes.forget();
        self.store.particles_mut()
    }

    fn word(&self, field: Quantity, word: usize, place: usize) -> f64 {
        self.store.word(field, word, place)
    }

    fn numbers(&self, field: Quantity, word: usize) -> Numbers<'_> {
        self.store.numbers(field, word)
    }

    fn set_word(&mut self, field: Quantity, word: usize, (place, value): (usize, f64)) {
        self.homes.changed(field);
        self.store.set_word(field, word, (place, value));
    }

    fn saved(&self, field: Quantity, word: usize) -> Values<'_> {
        self.store.saved(field, word)
    }

    fn put_back(&mut self, field: Quantity, word: usize, values: &Values<'_>) -> bool {
        self.homes.forget();
        self.store.put_back(field, word, values)
    }

    fn relist(&mut self, how: &Relist) -> Result<(), SearchError> {
        self.store.settle(Quantity::Volume);
        self.bodies.clear();
        if how.among == Among::SameBody || how.positions == Quantity::ReferencePosition {
            let bodies = self.store.particles().column(Quantity::Body, 0);
            self.bodies.extend(bodies.iter().map(|&b| b as u32));
        }
        self.stencil = self.lattice(how)?;
        self.homes.forget();
        if self.stencil.is_none() { self.search(how) } else { Ok(()) }
    }

    fn neighbours(&self) -> f64 {
        let pairs = self.stencil.as_ref().map_or_else(|| self.list.pairs(), Stencil::pairs);
        pairs as f64 / self.len().max(1) as f64
    }

    fn loneliest(&self) -> Option<(usize, usize)> {
        let listed = self.stencil.is_none();
        self.list.loneliest().filter(|_| listed)
    }

    fn pairs<S: PairSum<D>, U: Update<D, Sum = S::Adds>>(&mut self, sum: &S, then: &U, now: Now<f64>) {
        // Single copies that the sum reads must exist before the update learns where to write.
        let _ = self.store.pair_places::<S::Reads>();
        // Without a stencil every particle is at home where it is.
        let homes = self.stencil.as_ref().map(|_| &self.homes);
        let reads = self.store.places::<U::Reads>(|field| homes.is_some_and(|h| h.shares(field)));
        let writes = self.store.places::<U::Writes>(|_| false);
        let updating = Updating { then, reads: &reads, writes: &writes, now };
        let fetching = Fetching::of([&reads, &writes]);
        let after = Then::new::<P, U, D>(&updating, &fetching, self.set);
        match self.stencil.take() {
            Some(stencil) => {
                self.stencilled(&stencil, (sum, after, U::Writes::FIELDS), now);
                self.stencil = Some(stencil);
            }
            None => self.listed(sum, after, now),
        }
    }

    fn each<U: Update<D, Sum = ()>>(&mut self, update: &U, now: Now<f64>) {
        let (reads, writes) =
            (self.store.places::<U::Reads>(|_| false), self.store.places::<U::Writes>(|_| false));
        self.cut(&walk::Each::<U, D> { update, reads, writes, now }, self.len(), CHUNK);
    }

    fn reduce<R: Reduce<D, K>, const K: usize>(&mut self, reduce: &R) -> [f64; K] {
        let reads = self.store.places::<R::Reads>(|_| false);
        self.partial.resize(self.len().div_ceil(CHUNK) * K, 0.0);
        let partial = Shared::new(&mut self.partial);
        self.cut(&walk::Fold::<R, D, K> { reduce, reads, partial }, self.len(), CHUNK);
        let mut out = R::FOLDS.map(crate::pass::Fold::start);
        for chunk in self.partial.chunks_exact(K) {
            for k in 0..K {
                out[k] = R::FOLDS[k].join(out[k], chunk[k]);
            }
        }
        out
    }
}
