//! `taut particles`.

use crate::Failure;
use crate::arguments::{CaseOptions, ParticleOptions};
use crate::builtin::{colour, read};
use case::build::{Stock, particles as stocks};
use case::{Case, Overrides};
use geometry::Quality;
use output::{Array, Frame, Values, write_frame};
use report::{Picture, View, picture, write_png};
use std::path::{Path, PathBuf};

/// Makes the particles of a case or a shape, tells how good they are, and saves and draws them.
pub fn particles(options: &ParticleOptions) -> Result<(), Failure> {
    let (file, drawing) = places(options)?;
    let case = case_of(options)?;
    let stocks = stocks(&case).map_err(|error| Failure::Input(error.render(colour())))?;
    stocks.iter().for_each(|stock| tell(&case, stock));
    let frame = frame(&case, &stocks);
    write_frame(&file, &frame).map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    let view = (case.dimension == 3).then(View::default);
    let title = if case.title.is_empty() { case.name.clone() } else { case.title.clone() };
    let shown = Picture { title, field: "SurfaceDistance".to_string(), view, ..Picture::default() };
    write_png(&picture(&frame, &shown), &drawing)
        .map_err(|error| Failure::Run(format!("{error}\nhint: {}", error.hint())))?;
    say!("saved in {} (for ParaView too), drawn in {}", file.display(), drawing.display());
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    say!("to use them, with the case file beside them: fill = {{ particles = \"{name}\" }}");
    Ok(())
}

/// The files that will be written; neither may exist.
fn places(options: &ParticleOptions) -> Result<(PathBuf, PathBuf), Failure> {
    let mut file = options.out.clone();
    match file.extension().and_then(|ending| ending.to_str()) {
        None => drop(file.set_extension("vtp")),
        Some("vtp") => {}
        Some(other) => {
            let message = format!("particles are saved as .vtp, and {} ends in .{other}", file.display());
            return Err(Failure::Input(message));
        }
    }
    let drawing = file.with_extension("png");
    free(&file)?;
    free(&drawing)?;
    Ok((file, drawing))
}

/// Refuses a file that exists.
pub fn free(file: &Path) -> Result<(), Failure> {
    if file.exists() {
        return Err(Failure::Input(format!(
            "{} exists already, and nothing is overwritten: remove it or choose another name",
            file.display()
        )));
    }
    Ok(())
}

/// The case that is meant: a shape alone becomes one with one fitted body.
pub fn case_of(options: &ParticleOptions) -> Result<Case, Failure> {
    let text = options.what.trim();
    if !text.starts_with('{') {
        if options.spacing.is_some() {
            let message = "--spacing goes with a shape; a case has its own (--set spacing=...)";
            return Err(Failure::Input(message.to_string()));
        }
        let case = CaseOptions { case: options.what.clone(), set: options.set.clone(), formulation: None };
        return read(&case);
    }
    let Some(spacing) = &options.spacing else {
        return Err(Failure::Input("a shape needs --spacing, for instance --spacing \"1 mm\"".to_string()));
    };
    let spacing = if spacing.parse::<f64>().is_ok() { spacing.clone() } else { format!("{spacing:?}") };
    let overrides = Overrides { set: options.set.clone(), formulation: None };
    let parse = |dimension: usize| Case::parse("shape", &alone(text, &spacing, dimension), &overrides);
    // In space, or else in the plane.
    parse(3).or_else(|error| parse(2).map_err(|_| Failure::Input(error.render(colour()))))
}

/// A case of one shape. What is not its shape or spacing does not matter.
fn alone(shape: &str, spacing: &str, dimension: usize) -> String {
    format!(
        "name = \"particles\"\ndimension = {dimension}\nspacing = {spacing}\n\
         [material.any]\nmodel = \"neo-hookean\"\ndensity = 1000\nyoungs_modulus = 1e6\npoisson_ratio = 0.3\n\
         [[body]]\nname = \"shape\"\nmaterial = \"any\"\nfill = \"fitted\"\n\
         shape = {shape}\n\
         [time]\nend = 1\n"
    )
}

fn tell(case: &Case, stock: &Stock) {
    let Stock { name, points, quality, fitted, .. } = stock;
    let how = match fitted {
        Some((_, steps, true)) => format!(", at rest after {steps} steps"),
        Some((_, steps, false)) => format!(", as far as they came to rest in {steps} steps"),
        None => String::new(),
    };
    say!("{name}: {} particles, spacing {:.4e} m{how}", points.len(), case.spacing);
    let other = fitted.as_ref().map(|(lattice, ..)| lattice);
    if other.is_some() {
        say!("  {:48} {:>12} {:>12}", "", "fitted", "lattice");
    }
    let row = |what: &str, of: &dyn Fn(&Quality) -> String| {
        let beside = other.map(|lattice| format!(" {:>12}", of(lattice))).unwrap_or_default();
        say!("  {what:48} {:>12}{beside}", of(quality));
    };
    row("sum of V grad W inside, rms, times dp", &|q| short(q.interior));
    row("  the largest", &|q| short(q.interior_max));
    row("  everywhere, rms", &|q| short(q.residual));
    // The force on a particle is the sum of (Q_a + Q_b) V grad W.
    row("patch test: force inside over stress / dp, rms", &|q| {
        q.deep.map_or("-".to_string(), |deep| short(2.0 * deep))
    });
    row("off half a spacing from the surface, rms / dp", &|q| short(q.surface));
    row("  the largest", &|q| short(q.surface_max));
    row("smallest distance of two particles / dp", &|q| short(q.spacing_min));
    row("volume over that of the body, less 1", &|q| short(q.volume_error));
    if quality.thin > 0 {
        say!(
            "  {} particles have less than 0.45 spacings to the surface: walls are thinner than a particle there, or the filling has steps",
            quality.thin
        );
    }
}

/// Five digits behind the point, of what is not rounding.
fn short(value: f64) -> String {
    if value.abs() < 5e-6 { format!("{value:.0e}") } else { format!("{value:.5}") }
}

fn frame(case: &Case, stocks: &[Stock]) -> Frame {
    let all = |of: fn(&Stock) -> &[f64]| -> Vec<f64> { stocks.iter().flat_map(of).copied().collect() };
    let points: Vec<_> = stocks.iter().flat_map(|stock| stock.points.x.iter().copied()).collect();
    let body = stocks.iter().zip(0..).flat_map(|(stock, body)| vec![body; stock.points.len()]).collect();
    let unit = if case.dimension == 2 { "m^2" } else { "m^3" };
    let arrays = vec![
        Array::scalar("Volume", unit, Values::Exact(all(|stock| &stock.points.volume))),
        Array::scalar("ParticleSpacing", "m", Values::Exact(vec![case.spacing; points.len()])),
        Array::scalar("SurfaceDistance", "m", Values::F64(all(|stock| &stock.distance))),
        Array::scalar("ParticleId", "1", Values::I64((0..points.len() as i64).collect())),
        Array::scalar("Body", "1", Values::I64(body)),
    ];
    Frame { time: 0.0, step: 0, points, arrays }
}
