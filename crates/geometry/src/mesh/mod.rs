//! Bodies whose surface is made of triangles.

mod build;
mod closest;
mod edges;
mod holes;
mod meets;
mod orient;
mod parts;
mod problem;
mod read;
mod report;
mod sign;
mod surface;
mod thin;
mod tree;
mod winding;

pub use build::Mended;
pub use holes::Hole;
pub use meets::Crossings;
pub use problem::MeshError;
pub use read::MeshFormat;
pub use report::MeshReport;
pub use thin::Thin;

use crate::bounds::Bounds;
use crate::point::{Point, dot, sub};
use sign::Normals;
use std::sync::{Arc, OnceLock};
use surface::{Surface, area_vector};
use tree::Tree;
use winding::Dipoles;

/// Most triangles of a mesh: about a gigabyte.
pub const MAX_TRIANGLES: usize = 5_000_000;

/// Most separate pieces of a mesh.
pub const MAX_COMPONENTS: usize = 10_000;

/// A body bounded by triangles, as it was mended: its copies share it.
#[derive(Clone)]
pub struct Mesh(Arc<Inner>);

struct Inner {
    surface: Surface,
    tree: Tree,
    side: Side,
    pieces: usize,
    mended: Mended,
    crossings: Crossings,
    thinnest: OnceLock<Option<Thin>>,
    parts: OnceLock<Vec<Mesh>>,
}

/// How it is found out on which side of the surface a point is.
enum Side {
    /// The normal of what is nearest: where the surface is closed and does not meet itself.
    Normals(Normals),
    /// The winding number.
    Winding(Dipoles),
}

impl Mesh {
    /// Reads a file: STL, binary or text, or OBJ. Its coordinates are multiplied by `unit`, so that they become metres; of its
    /// `name` the ending counts.
    ///
    /// # Errors
    /// A file that is no mesh, or whose triangles enclose nothing. What could be mended was: see [`Mesh::report`].
    pub fn read(bytes: &[u8], name: &str, unit: f64) -> Result<(Self, MeshFormat), MeshError> {
        let (mut surface, format) = read::surface(bytes, name)?;
        surface.check()?;
        surface.points.iter_mut().for_each(|x| *x = x.map(|c| c * unit));
        Ok((Self::of(surface)?, format))
    }

    /// A body from points, in metres, and triangles of three of them.
    ///
    /// # Errors
    /// As [`Mesh::read`]. A triangle of points that are not there counts as one whose corner is no number.
    pub fn new(points: Vec<Point>, faces: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if faces.len() > MAX_TRIANGLES {
            return Err(MeshError::TooMany);
        }
        let lost = faces.iter().position(|face| face.iter().any(|&corner| corner as usize >= points.len()));
        match lost {
            Some(index) => Err(MeshError::NotFinite { triangle: index + 1, corner: [f64::NAN; 3] }),
            None => Self::of(Surface { points, faces }),
        }
    }

    fn of(surface: Surface) -> Result<Self, MeshError> {
        let (surface, tree, pieces, mended) = build::build(surface)?;
        let crossings = meets::crossings(&surface, &tree);
        let clean = is_clean(&surface, &mended, &crossings);
        let side = if clean {
            Side::Normals(Normals::new(&surface, &tree))
        } else {
            Side::Winding(Dipoles::new(&tree))
        };
        Ok(Self(Arc::new(Inner {
            surface,
            tree,
            side,
            pieces,
            mended,
            crossings,
            thinnest: OnceLock::new(),
            parts: OnceLock::new(),
        })))
    }

    /// The signed distance from `x` to the surface, m, negative inside. Inside is what the pseudo-normal of the nearest point
    /// says, or, if the surface meets itself, has large or odd holes or triangles without area, a winding number above 1/2.
    pub fn distance(&self, x: Point) -> f64 {
        let Inner { tree, side, .. } = &*self.0;
        let Some(nearest) = tree.nearest(x) else { return f64::INFINITY };
        let inside = match side {
            Side::Normals(normals) => normals.behind(tree, &nearest, x),
            Side::Winding(dipoles) => dipoles.winding(tree, x) > 0.5,
        };
        let distance = nearest.squared.sqrt();
        if inside { -distance } else { distance }
    }

    /// The smallest box around it.
    pub fn bounds(&self) -> Bounds {
        self.0.tree.nodes[0].bounds
    }

    /// The volume, m^3. Where the surface crosses itself parts count as often as it goes around them.
    pub fn volume(&self) -> f64 {
        let from = self.bounds().min;
        let part = |corners: &[Point; 3]| dot(area_vector(*corners), sub(corners[0], from)) / 6.0;
        self.0.tree.corners.iter().map(part).sum()
    }

    /// The area of the surface, m^2, caps of holes included.
    pub fn area(&self) -> f64 {
        self.0.surface.area()
    }

    /// The points of the surface, m.
    pub fn points(&self) -> &[Point] {
        &self.0.surface.points
    }

    /// Its triangles, counter-clockwise from outside.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.0.surface.faces
    }

    /// The thinnest part of the body; `None` if no two parts of its surface look away from each other. Found when it is first
    /// asked for.
    pub fn thinnest(&self) -> Option<Thin> {
        *self.0.thinnest.get_or_init(|| thin::thinnest(&self.0.tree))
    }

    /// Whether its surface meets itself, so that some of it may lie inside.
    pub(crate) fn meets_itself(&self) -> bool {
        self.0.crossings.at.is_some() || self.0.crossings.tangled
    }

    /// Whether it meets itself only where closed pieces overlap: then it is what these unite, and is asked piece by piece where walls are.
    pub(crate) fn is_united(&self) -> bool {
        let Inner { pieces, mended, .. } = &*self.0;
        self.meets_itself() && *pieces > 1 && mended.crowded + mended.open == 0
    }

    /// The meshes that it unites: its pieces, if they overlap; else itself.
    pub(crate) fn parts(&self) -> &[Self] {
        self.0.parts.get_or_init(|| parts::parts(self))
    }

    /// What there is to say about it.
    pub fn report(&self) -> MeshReport {
        MeshReport::of(self)
    }
}

/// Whether pseudo-normals are right everywhere.
fn is_clean(surface: &Surface, mended: &Mended, crossings: &Crossings) -> bool {
    let flat = surface.faces.iter().any(|&face| area_vector(surface.corners(face)) == [0.0; 3]);
    let large = mended.large_holes(surface.area()) > 0;
    mended.crowded + mended.open + crossings.pairs == 0 && !(crossings.tangled || flat || large)
}

impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.surface == other.0.surface
    }
}

impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Mesh({} triangles, {:?})", self.faces().len(), self.bounds())
    }
}
