//! The list of neighbours of every particle, compressed.

/// Neighbours of every particle: those of `a` are `id[start[a]..start[a + 1]]`, in ascending order.
///
/// Holds both directions of every pair and never a particle itself. Two lists of the same pairs are equal.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Adjacency {
    /// Where the neighbours of each particle start in `id`; one entry per particle and one for the end.
    pub start: Vec<u32>,
    /// The neighbours of all particles, one particle after the other.
    pub id: Vec<u32>,
}

impl Adjacency {
    /// Number of particles.
    pub fn particles(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Neighbours of particle `a`, ascending. Panics if `a` is not below [`Adjacency::particles`].
    pub fn of(&self, a: usize) -> &[u32] {
        &self.id[self.start[a] as usize..self.start[a + 1] as usize]
    }

    /// Mean number of neighbours per particle; 0 without particles.
    pub fn mean(&self) -> f64 {
        self.id.len() as f64 / self.particles().max(1) as f64
    }
}
