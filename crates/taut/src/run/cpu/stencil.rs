//! Bodies born on a lattice: all particles share one stencil, so the list needs no pair data.
//!
//! ```text
//! particles, row after row along the long axis:   . . . a a+1 a+2 a+3 . . .   . . . b b+1 b+2 b+3 . . .
//!                                                       \_ one block _/             \_ a + delta _/
//! a block's program:   (delta, code, which lanes)  (delta, code, which lanes)  ...
//! the code book:       code -> grad W, W'/r, x, 1/r of one cell of the stencil
//! ```
//!
//! A block is as many consecutive particles of a row as there are lanes (fewer at its end). The neighbours of a block in one cell of the stencil are
//! consecutive too, so they are loaded without indices. Where some are missing, the entry says which lanes count, and
//! the weights of the others are zero; where all are missing there is no entry. Blocks whose neighbourhoods look alike share one
//! program: a few dozen in a box. Reason: no pair data to stream, no shuffles; the loop is bound by arithmetic.

use crate::kernel::Kernel;
use crate::math::{Element, Lanes, MOST_LANES, Vector};
use crate::neighbours::Lattice;
use crate::pass::Pair;
use std::collections::HashMap;
use std::ops::Range;

/// One cell of the stencil.
#[derive(Clone, Copy, Debug)]
struct Code<const D: usize> {
    grad_w: [f64; D],
    w: f64,
    x: [f64; D],
    over_r: f64,
}

/// Neighbours of a block in one cell of the stencil.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Entry {
    /// From the first particle of the block to the first of its neighbours.
    delta: i32,
    code: u16,
    mask: u16,
}

impl Entry {
    /// The first of the neighbours of a block. Where the first lanes do not count it may lie before the first particle, in the
    /// guard of the columns.
    #[inline(always)]
    pub fn of(&self, block: &Block) -> isize {
        block.first as isize + self.delta as isize
    }
}

/// Consecutive particles of a row.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// The first.
    pub first: u32,
    /// How many.
    pub active: u16,
    program: u32,
}

/// Lists of entries of a program. Of those whose lanes all count: one list for each weight (an entry stands in each that applies), one
/// for each whole pattern. Then one list of those whose lanes do not all count.
const LISTS: usize = 4 + 16 + 1;

type Lists = [Range<u32>; LISTS];

/// The stencil of a body.
#[derive(Debug)]
pub struct Stencil<const D: usize> {
    codes: Vec<Code<D>>,
    entries: Vec<Entry>,
    programs: Vec<Lists>,
    /// All blocks, in order.
    pub blocks: Vec<Block>,
    /// How far ahead of a particle its last neighbour is stored, at most.
    pub reach: usize,
    /// Most particles of a block.
    lanes: usize,
    pairs: u64,
}

impl<const D: usize> Stencil<D> {
    /// The stencil of particles stored row by row along the long axis of the lattice, all of the same volume.
    pub fn new(lattice: &Lattice<D>, volume: f64, kernel: &Kernel, lanes: usize) -> Self {
        let (codes, entries, programs) = (Vec::new(), Vec::new(), Vec::new());
        let mut new = Self { codes, entries, programs, blocks: Vec::new(), reach: 0, lanes, pairs: 0 };
        let offsets = new.book(lattice, volume, kernel);
        let rows = Rows::new(lattice);
        let mut known: HashMap<(usize, Vec<Entry>), u32> = HashMap::new();
        for (first, active) in rows.blocks(new.lanes) {
            let entries = rows.entries((first, active), &offsets);
            new.reach = entries.iter().map(|e| e.delta.max(0) as usize).fold(new.reach, usize::max);
            let program = match known.get(&(active, entries.clone())) {
                Some(&program) => program,
                None => {
                    let program = new.compile(&entries, active);
                    known.insert((active, entries), program);
                    program
                }
            };
            new.pairs += new.pairs_of(program);
            new.blocks.push(Block { first: first as u32, active: active as u16, program });
        }
        new
    }

    /// Pairs, each counted from both sides.
    pub fn pairs(&self) -> u64 {
        self.pairs
    }

    /// Pairs of one block.
    fn pairs_of(&self, program: u32) -> u64 {
        let lists = &self.programs[program as usize];
        // The whole patterns and the partial entries: each entry once.
        let entries = lists[4..].iter().flat_map(|l| &self.entries[l.start as usize..l.end as usize]);
        entries.map(|entry| u64::from(entry.mask.count_ones())).sum()
    }

    /// Fills the code book; the cells of the stencil in the order of their codes.
    fn book(&mut self, lattice: &Lattice<D>, volume: f64, kernel: &Kernel) -> Vec<[i32; D]> {
        let reach = (kernel.support() / lattice.spacing).ceil() as i32;
        let side = 2 * reach + 1;
        let mut offsets = Vec::new();
        for k in 0..side.pow(D as u32) {
            let cell: [i32; D] = std::array::from_fn(|i| k / side.pow(i as u32) % side - reach);
            // From a to b; e points the other way.
            let mut e = Vector::<f64, D>::zero();
            for i in 0..D {
                e = e - lattice.axes[i].times(f64::from(cell[i]));
            }
            let length = cell.iter().map(|&c| f64::from(c * c)).sum::<f64>().sqrt();
            let r = length * lattice.spacing;
            if length > 0.0 && r < kernel.support() {
                let e = e.times(1.0 / length);
                let slope = kernel.dw(r) * volume;
                let x = e.times(r);
                self.codes.push(Code { grad_w: e.times(slope).0, w: slope / r, x: x.0, over_r: 1.0 / r });
                offsets.push(cell);
            }
        }
        offsets
    }

    /// Sorts the entries of a program into its lists.
    fn compile(&mut self, entries: &[Entry], active: usize) -> u32 {
        let all = u16::MAX >> (16 - active);
        let pattern = |entry: &Entry| -> usize {
            let g = self.codes[usize::from(entry.code)].grad_w;
            8 | (0..D).filter(|&i| g[i] != 0.0).fold(0, |m, i| m | 1 << i)
        };
        let mut sorted = Vec::new();
        let lists = std::array::from_fn(|list| {
            let belongs = |entry: &&Entry| {
                let (m, full) = (pattern(entry), entry.mask == all);
                match list {
                    0..4 => full && m >> list & 1 == 1,
                    4..20 => full && m == list - 4,
                    _ => !full,
                }
            };
            let start = self.entries.len() + sorted.len();
            sorted.extend(entries.iter().filter(belongs));
            start as u32..(self.entries.len() + sorted.len()) as u32
        });
        self.entries.append(&mut sorted);
        self.programs.push(lists);
        (self.programs.len() - 1) as u32
    }

    /// The entries of a block for the weights `M` (one weight, or a whole pattern) that count in all lanes.
    #[inline(always)]
    pub fn full<const M: u8>(&self, block: &Block) -> &[Entry] {
        self.list(
            block,
            const { if M.is_power_of_two() { M.trailing_zeros() as usize } else { 4 + M as usize } },
        )
    }

    /// The entries of a block that count in some lanes only.
    #[inline(always)]
    pub fn partial(&self, block: &Block) -> &[Entry] {
        self.list(block, LISTS - 1)
    }

    #[inline(always)]
    fn list(&self, block: &Block, list: usize) -> &[Entry] {
        let range = &self.programs[block.program as usize][list];
        &self.entries[range.start as usize..range.end as usize]
    }

    /// The pair of an entry, in all lanes.
    #[inline(always)]
    pub fn pair<V: Lanes, const M: u8>(&self, entry: &Entry) -> Pair<V, D, M> {
        let code = &self.codes[usize::from(entry.code)];
        let splat = |x: [f64; D]| {
            let mut v = Vector::zero();
            for i in 0..D {
                v.0[i] = V::of(x[i]);
            }
            v
        };
        let (x, over_r) = (splat(code.x), V::of(code.over_r));
        Pair { grad_w: splat(code.grad_w), w: V::of(code.w), e: x.times(over_r), x, over_r }
    }

    /// The pair of an entry whose lanes do not all count.
    #[inline(always)]
    pub fn masked<V: Lanes, const M: u8>(&self, entry: &Entry) -> Pair<V, D, M> {
        let pair = self.pair::<V, M>(entry);
        let mut lanes = [V::E::default(); MOST_LANES];
        for (l, lane) in lanes.iter_mut().enumerate() {
            *lane = V::E::from_f64(f64::from(entry.mask >> l & 1));
        }
        // SAFETY: as many numbers as any type has lanes.
        let mask = unsafe { V::load(lanes.as_ptr()) };
        Pair { grad_w: pair.grad_w.times(mask), w: pair.w * mask, ..pair }
    }
}

/// Particles by row.
struct Rows<const D: usize> {
    /// Cells of the particles, with the long axis first.
    cells: Vec<[i32; D]>,
    /// Where each row starts and ends, by its place across the long axis.
    rows: HashMap<[i32; D], Range<usize>>,
    long: usize,
}

impl<const D: usize> Rows<D> {
    fn new(lattice: &Lattice<D>) -> Self {
        let long = lattice.long_axis();
        let mut rows: HashMap<[i32; D], Range<usize>> = HashMap::new();
        for (a, &cell) in lattice.cells.iter().enumerate() {
            let row = rows.entry(across(cell, long)).or_insert(a..a);
            row.end = a + 1;
        }
        Self { cells: lattice.cells.clone(), rows, long }
    }

    /// Runs of up to `lanes` particles without a gap.
    fn blocks(&self, lanes: usize) -> Vec<(usize, usize)> {
        let mut blocks = Vec::new();
        let mut first = 0;
        while first < self.cells.len() {
            let follows = |l: usize| {
                let mut cell = self.cells[first];
                cell[self.long] += l as i32;
                self.cells.get(first + l) == Some(&cell)
            };
            let active = (1..lanes).take_while(|&l| follows(l)).count() + 1;
            blocks.push((first, active));
            first += active;
        }
        blocks
    }

    /// The entries of a block: for each cell of the stencil, one for every distance at which neighbours are stored.
    fn entries(&self, (first, active): (usize, usize), offsets: &[[i32; D]]) -> Vec<Entry> {
        let mut entries: Vec<Entry> = Vec::new();
        for (code, offset) in offsets.iter().enumerate() {
            let start = entries.len();
            for lane in 0..active {
                let mut target = self.cells[first + lane];
                for i in 0..D {
                    target[i] += offset[i];
                }
                let Some(b) = self.find(target) else { continue };
                let delta = b as i32 - (first + lane) as i32;
                match entries[start..].iter_mut().find(|e| e.delta == delta) {
                    Some(entry) => entry.mask |= 1 << lane,
                    None => entries.push(Entry { delta, code: code as u16, mask: 1 << lane }),
                }
            }
        }
        entries
    }

    fn find(&self, cell: [i32; D]) -> Option<usize> {
        let row = self.rows.get(&across(cell, self.long))?.clone();
        let along = |a: usize| self.cells[a][self.long];
        // Without gaps the place is known; with gaps it is searched.
        let guess = row.start as i64 + i64::from(cell[self.long] - along(row.start));
        if guess >= row.start as i64 && guess < row.end as i64 && along(guess as usize) == cell[self.long] {
            return Some(guess as usize);
        }
        let found = self.cells[row.clone()].binary_search_by_key(&cell[self.long], |c| c[self.long]);
        found.ok().map(|i| row.start + i)
    }
}

/// The cell with the long axis left out.
fn across<const D: usize>(cell: [i32; D], long: usize) -> [i32; D] {
    std::array::from_fn(|i| if i == long { 0 } else { cell[i] })
}
