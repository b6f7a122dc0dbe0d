//! `taut mesh`: what is in a file of triangles.

use crate::Failure;
use case::Case;
use geometry::Mesh;
use output::limited::read_bytes;
use std::path::Path;

/// Larger files are not read, bytes.
const LARGEST: u64 = 2 << 30;

/// Prints everything that is known about the mesh in a file.
pub fn mesh(file: &Path) -> Result<(), Failure> {
    let name = file.display().to_string();
    let bytes =
        read_bytes(file, LARGEST).map_err(|cause| Failure::Input(format!("cannot read {name}: {cause}")))?;
    let (mesh, format) = Mesh::read(&bytes, &name, 1.0)
        .map_err(|error| Failure::Input(format!("the mesh {name} cannot be used: {error}")))?;
    let report = mesh.report();
    say!("{name}: {}", format.name());
    report.lines("units").iter().for_each(|line| say!("  {line}"));
    report.doubts("units").iter().for_each(|doubt| say!("  warning: {doubt}"));
    Ok(())
}

/// The same of the meshes of a case; their doubts are warnings of the case.
pub fn of_case(case: &Case) {
    for read in &case.meshes {
        say!("  mesh {}: {}", read.file, read.format.name());
        read.mesh.report().lines("m").iter().for_each(|line| say!("    {line}"));
    }
}
