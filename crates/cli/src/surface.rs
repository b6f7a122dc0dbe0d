//! `taut surface`.

use crate::Failure;
use crate::arguments::ParticleOptions;
use crate::particles::{case_of, free};
use case::build::surfaces;
use geometry::stl;

/// Writes the surface of the bodies of a case, or of a shape, as STL.
pub fn surface(options: &ParticleOptions) -> Result<(), Failure> {
    let mut file = options.out.clone();
    if file.extension().is_none() {
        file.set_extension("stl");
    }
    if file.extension().is_none_or(|ending| ending != "stl") {
        let message = format!("a surface is written as .stl, and {} ends otherwise", file.display());
        return Err(Failure::Input(message));
    }
    free(&file)?;
    let mut triangles = Vec::new();
    for (name, surface) in surfaces(&case_of(options)?) {
        let Some(surface) = surface else {
            let message =
                format!("the surface of `{name}` cannot be written: only stents have triangles so far");
            return Err(Failure::Input(message));
        };
        triangles.extend(surface);
    }
    output::write_atomically(&file, &stl(&triangles))
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    say!("{} triangles in {}, lengths in metres", triangles.len(), file.display());
    Ok(())
}
