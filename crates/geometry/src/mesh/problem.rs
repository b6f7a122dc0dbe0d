//! Why a mesh cannot be used.

use crate::point::Point;

/// Why a file is no mesh, or a mesh encloses no body. Lengths in the unit of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The file is of no kind that is read.
    #[error("it is no STL and no OBJ file: it begins with {0}; save the mesh as .stl or .obj")]
    Unknown(String),
    /// The file has no triangles.
    #[error("it is empty: it holds no triangle")]
    Empty,
    /// The file ends too early.
    #[error("the file is cut off: it holds {found} of {promised}; save or copy it again")]
    Truncated {
        /// What is there.
        found: String,
        /// What it says is there.
        promised: String,
    },
    /// A binary file is longer than it says.
    #[error("the file says that it holds {triangles} triangles, and {more} bytes follow them; save it again")]
    TooLong {
        /// The number of triangles that its head tells.
        triangles: u32,
        /// Bytes behind them.
        more: usize,
    },
    /// A line that means nothing.
    #[error("line {line}: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// A coordinate is no number.
    #[error(
        "a corner of triangle {triangle} (counted from 1) is {corner:?}; every coordinate has to be a finite number"
    )]
    NotFinite {
        /// Counted from 1.
        triangle: usize,
        /// The corner.
        corner: Point,
    },
    /// A coordinate is so large that volumes overflow.
    #[error(
        "a corner of triangle {triangle} (counted from 1) is {corner:?}; coordinates beyond 1e30 are not used"
    )]
    TooFar {
        /// Counted from 1.
        triangle: usize,
        /// The corner.
        corner: Point,
    },
    /// More triangles than are taken on.
    #[error("it has more than {} triangles, the most that are read; make it coarser", super::MAX_TRIANGLES)]
    TooMany,
    /// More pieces than are taken on.
    #[error(
        "its {pieces} triangles hang together in {components} separate pieces, and at most {} are taken on; is it a cloud of triangles?",
        super::MAX_COMPONENTS
    )]
    Scattered {
        /// Triangles.
        pieces: usize,
        /// Pieces.
        components: usize,
    },
    /// A surface with one side only.
    #[error(
        "it has no inside: its triangles cannot be oriented alike (at {0} edges they contradict each other, as in a Moebius strip)"
    )]
    OneSided(usize),
    /// A surface around nothing.
    #[error(
        "it encloses no volume: its {triangles} triangles are flat sheets; a body needs a closed surface (thicken it first)"
    )]
    Flat {
        /// Triangles.
        triangles: usize,
    },
}
