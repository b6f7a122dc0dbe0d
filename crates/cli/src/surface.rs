//! `taut surface`.

use crate::Failure;
use crate::arguments::{ParticleOptions, SurfaceOptions};
use crate::particles::{case_of, free};
use case::build::surfaces;
use geometry::stl;

/// Writes the surface of the bodies of a case, or of a shape, as STL.
pub fn surface(options: &SurfaceOptions) -> Result<(), Failure> {
    let mut file = options.out.clone();
    if file.extension().is_none() {
        file.set_extension("stl");
    }
    if file.extension().is_none_or(|ending| ending != "stl") {
        let message = format!("a surface is written as .stl, and {} ends otherwise", file.display());
        return Err(Failure::Input(message));
    }
    free(&file)?;
    // A surface knows no spacing, and a case has to have one.
    let spacing = options.what.trim().starts_with('{').then(|| "1".to_string());
    let (what, set) = (options.what.clone(), options.set.clone());
    let case = case_of(&ParticleOptions { what, out: file.clone(), spacing, set })?;
    if case.dimension == 2 {
        return Err(Failure::Input("a shape of the plane has no surface of triangles".to_string()));
    }
    let mut triangles = Vec::new();
    for (name, surface) in surfaces(&case) {
        let Some(surface) = surface else {
            let message = format!(
                "the surface of `{name}` cannot be written: boxes, balls, hollow balls, cylinders, stents and meshes have triangles, polygons and combined shapes have none"
            );
            return Err(Failure::Input(message));
        };
        triangles.extend(surface);
    }
    output::write_atomically(&file, &stl(&triangles))
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    say!("{} triangles in {}, lengths in metres", triangles.len(), file.display());
    Ok(())
}
