//! Which triangles share which edges.

/// One edge of one triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// The two points, the smaller number first.
    pub ends: [u32; 2],
    /// The triangle.
    pub face: u32,
    /// Which of its edges: from corner `side` to the next.
    pub side: u8,
    /// Whether the triangle runs from the first of `ends` to the second.
    pub forward: bool,
}

impl Side {
    /// The points in the direction of the triangle.
    pub fn way(&self) -> [u32; 2] {
        let [a, b] = self.ends;
        if self.forward { [a, b] } else { [b, a] }
    }
}

/// All edges of all triangles, those of the same two points beside each other.
pub(super) struct Edges(Vec<Side>);

impl Edges {
    pub fn of(faces: &[[u32; 3]]) -> Self {
        let mut sides = Vec::with_capacity(3 * faces.len());
        for (face, corners) in faces.iter().enumerate() {
            for side in 0..3 {
                let (a, b) = (corners[side], corners[(side + 1) % 3]);
                let ends = [a.min(b), a.max(b)];
                sides.push(Side { ends, face: face as u32, side: side as u8, forward: a < b });
            }
        }
        sides.sort_unstable();
        Self(sides)
    }

    /// The triangles at each edge.
    pub fn groups(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.ends == b.ends)
    }

    /// Edges with one triangle only.
    pub fn loose(&self) -> impl Iterator<Item = &Side> {
        self.groups().filter(|group| group.len() == 1).flatten()
    }

    /// Points of such edges, each once, ascending.
    pub fn loose_points(&self) -> Vec<u32> {
        let mut points: Vec<u32> = self.loose().flat_map(|side| side.ends).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    /// How many edges have more than two triangles, and how many do not have as many triangles in one direction as in the
    /// other.
    pub fn odd(&self) -> (usize, usize) {
        let mut odd = (0, 0);
        for group in self.groups() {
            let forward = group.iter().filter(|side| side.forward).count();
            odd.0 += usize::from(group.len() > 2);
            odd.1 += usize::from(2 * forward != group.len());
        }
        odd
    }
}

/// No neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// The neighbour of every triangle across each of its edges, where exactly two meet.
pub(super) fn neighbours(edges: &Edges, faces: usize) -> Vec<[u32; 3]> {
    let mut neighbours = vec![[NONE; 3]; faces];
    for group in edges.groups() {
        if let [a, b] = group {
            neighbours[a.face as usize][usize::from(a.side)] = b.face;
            neighbours[b.face as usize][usize::from(b.side)] = a.face;
        }
    }
    neighbours
}
