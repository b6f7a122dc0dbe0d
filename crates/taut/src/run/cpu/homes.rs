//! What many particles share is read at one place.
//!
//! ```text
//! blocks of a lattice-born body    0    1    2    3    4    5   ...
//! home                             0    1    1    3    1    1   ...   block 2 has the masses, supports, B ... of block 1
//! ```
//!
//! Fields that are given before a run, or from outside (masses, body forces, supports, and above all the correction matrix), are bit by bit the
//! same in most blocks of a lattice-born body. Updates read them at the first block that has the same, where they are in the first cache:
//! a sixth of the memory that a step moves is not moved. Fields that change from outside during the run (a prescribed motion) are
//! left out, once that has been seen.

use super::kit::Precision;
use super::stencil::{Block, Stencil};
use super::store::Store;
use crate::field::Quantity;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// The homes of blocks.
#[derive(Debug, Default)]
pub struct Homes {
    /// For every block the first particle of its home.
    home: Vec<u32>,
    stale: bool,
    /// Given fields that have changed during the run.
    lively: Vec<Quantity>,
}

impl Homes {
    /// None are known any more: anything may have changed.
    pub fn forget(&mut self) {
        self.stale = true;
    }

    /// A field changed from outside.
    pub fn changed(&mut self, field: Quantity) {
        if field.is_given() && !self.stale && !self.home.is_empty() && !self.lively.contains(&field) {
            self.lively.push(field);
            self.stale = true;
        }
    }

    /// Whether a field is read at home.
    pub fn shares(&self, field: Quantity) -> bool {
        field.is_given() && !self.lively.contains(&field)
    }

    /// The homes of the blocks of a stencil.
    pub fn of<const D: usize, P: Precision>(&mut self, stencil: &Stencil<D>, store: &Store<D, P>) -> &[u32] {
        if self.stale {
            self.find(stencil, store);
            self.stale = false;
        }
        &self.home
    }

    fn find<const D: usize, P: Precision>(&mut self, stencil: &Stencil<D>, store: &Store<D, P>) {
        let given = Quantity::ALL.iter().filter(|&&f| self.shares(f) && store.particles().has(f));
        let words: Vec<(Quantity, usize)> =
            given.flat_map(|&f| (0..f.rank().words(D)).map(move |word| (f, word))).collect();
        let bits = |block: &Block, l: usize| {
            let place = block.first as usize + l;
            words.iter().map(move |&(field, word)| store.word(field, word, place).to_bits())
        };
        let all =
            |block: &Block| (0..usize::from(block.active)).flat_map(|l| bits(block, l)).collect::<Vec<u64>>();
        let mut known: HashMap<u64, Vec<Block>> = HashMap::new();
        self.home.clear();
        for block in &stencil.blocks {
            let mine = all(block);
            let mut hasher = DefaultHasher::new();
            (block.active, &mine).hash(&mut hasher);
            let alike = known.entry(hasher.finish()).or_default();
            match alike.iter().find(|other| other.active == block.active && all(other) == mine) {
                Some(other) => self.home.push(other.first),
                None => {
                    self.home.push(block.first);
                    alike.push(*block);
                }
            }
        }
    }
}
