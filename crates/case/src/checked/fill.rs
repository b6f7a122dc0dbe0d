//! How particles fill bodies.

use std::path::Path;
use std::sync::Arc;

use super::scope::Scope;
use crate::diagnostic::Diagnostic;
use crate::keys::{Key, fill};
use crate::written::{Node, Section, Value};
use output::FrameFile;

/// Larger files are not read, bytes.
const LARGEST: u64 = 8 << 30;

/// How particles fill a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Fill {
    /// A square lattice: particles in the middle of cells, of which one has a corner at `origin` (m).
    Lattice {
        /// The corner.
        origin: [f64; 3],
    },
    /// Layers around the centre of a ring or ball.
    Concentric,
    /// Layers with as many particles each.
    Polar {
        /// How many.
        around: u32,
        /// How many layers; `None` for the wall over the spacing.
        rings: Option<u32>,
    },
    /// Fitted to the surface.
    Fitted,
    /// As they stand in a file.
    Saved(Arc<Saved>),
}

/// Particles of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Saved {
    /// The file, as the case calls it.
    pub file: String,
    /// The spacing they were made for, m.
    pub spacing: f64,
    /// Positions (m) and volumes (m^3; in 2D m^2).
    pub points: Vec<([f64; 3], f64)>,
}

/// The filling that a node describes; a lattice from the origin if there is none.
pub(super) fn read(scope: &Scope, node: Option<&Node>) -> Result<Fill, Diagnostic> {
    let Some(node) = node else { return Ok(Fill::Lattice { origin: [0.0; 3] }) };
    match &node.value {
        Value::Text(name) if name == fill::LATTICE => Ok(Fill::Lattice { origin: [0.0; 3] }),
        Value::Text(name) if name == fill::CONCENTRIC => Ok(Fill::Concentric),
        Value::Text(name) if name == fill::FITTED => Ok(Fill::Fitted),
        Value::Table(_) => {
            let table = Section::of(node, "`fill`")?;
            table.only_first(&[fill::LATTICE, fill::POLAR, fill::PARTICLES])?;
            match (table.get(fill::PARTICLES), table.get(fill::POLAR)) {
                (Some(file), _) => saved(scope, file),
                (None, Some(node)) => polar(scope, &Section::of(node, "the fill `polar`")?),
                (None, None) => lattice(scope, table.need(fill::LATTICE)?),
            }
        }
        _ => Err(Diagnostic::at(node.place, format!("unknown fill, found {}", node.found())).help(
            "write \"lattice\", \"concentric\", \"fitted\", { lattice = { origin = [..] } }, { polar = { around = 36 } } or { particles = \"FILE.vtp\" }",
        )),
    }
}

fn lattice(scope: &Scope, node: &Node) -> Result<Fill, Diagnostic> {
    let lattice = Section::of(node, "the fill `lattice`")?;
    lattice.only_first(&[fill::ORIGIN.name])?;
    let origin = scope.vector(lattice.need(fill::ORIGIN.name)?, &fill::ORIGIN)?;
    Ok(Fill::Lattice { origin })
}

/// As many particles in each layer: whole numbers, or expressions that give them.
fn polar(scope: &Scope, section: &Section<'_>) -> Result<Fill, Diagnostic> {
    section.only_first(&[fill::AROUND.name, fill::RINGS.name])?;
    let around = whole(scope, section.need(fill::AROUND.name)?, (&fill::AROUND, 3))?;
    let rings =
        section.get(fill::RINGS.name).map(|node| whole(scope, node, (&fill::RINGS, 1))).transpose()?;
    Ok(Fill::Polar { around, rings })
}

fn whole(scope: &Scope, node: &Node, (key, least): (&Key, u32)) -> Result<u32, Diagnostic> {
    let number = scope.of(node, key)?;
    if number.fract() == 0.0 && (f64::from(least)..=1e6).contains(&number) {
        return Ok(number as u32);
    }
    let message =
        format!("`{}` has to be a whole number from {least} to a million, found {number}", key.name);
    Err(Diagnostic::at(node.place, message))
}

fn saved(scope: &Scope, node: &Node) -> Result<Fill, Diagnostic> {
    let Value::Text(file) = &node.value else {
        let message = format!("`particles` has to be the name of a file, found {}", node.found());
        return Err(Diagnostic::at(node.place, message).help("`taut particles CASE -o FILE.vtp` writes one"));
    };
    let path = scope.files.path(file);
    let wrong = |problem: String| {
        Diagnostic::at(node.place, format!("cannot use the particles of {}: {problem}", path.display())).help(
            "`taut particles CASE -o FILE.vtp` writes such a file; its path is relative to the case file",
        )
    };
    let bytes = scope.files.read(file, LARGEST).map_err(wrong)?;
    let (spacing, points) = stored(&path, bytes).map_err(wrong)?;
    Ok(Fill::Saved(Arc::new(Saved { file: file.clone(), spacing, points })))
}

/// Positions, m, and volumes, m^3.
type Placed = Vec<([f64; 3], f64)>;

/// Spacing, positions and volumes of the particles of a file.
fn stored(path: &Path, bytes: Vec<u8>) -> Result<(f64, Placed), String> {
    let file = FrameFile::of(path, bytes).map_err(|error| error.to_string())?;
    let frame = file
        .frame(|name| ["Volume", "ParticleSpacing"].contains(&name))
        .map_err(|error| error.to_string())?;
    let column = |name: &str| {
        let array = frame.array(name).filter(|array| array.components == 1);
        array.map(|array| array.values.to_f64()).ok_or(format!("it has no {name}"))
    };
    let (volumes, spacings) = (column("Volume")?, column("ParticleSpacing")?);
    let good = |n: f64| n.is_finite() && n > 0.0;
    let spacing = *spacings.first().ok_or("it has no particles")?;
    let fine = |(x, v): &([f64; 3], f64)| x.iter().all(|c| c.is_finite()) && good(*v);
    let points: Vec<_> = frame.points.into_iter().zip(volumes).collect();
    match points.iter().position(|point| !fine(point)) {
        Some(at) => Err(format!("particle {at} has no place or no volume")),
        None if !good(spacing) => Err(format!("its spacing is {spacing} m")),
        None => Ok((spacing, points)),
    }
}
