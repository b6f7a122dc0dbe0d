//! `taut stability`: how long the steps of a case may be.

use super::{column, failed, tell};
use crate::Failure;
use crate::arguments::StudyOptions;
use crate::builtin::read;
use crate::say;
use case::study::stability::{Limits, computed, marched, table};
use case::{Case, March, Normalisation};
use output::{ResultDir, Table};
use std::path::PathBuf;

/// Smoothing lengths over the spacing (small-strain paper, Fig. 16).
const WIDTHS: [f64; 16] =
    [0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0, 1.1, 1.2, 1.4, 1.6, 2.0];
/// Factors of density and stiffness (Fig. 17).
const FACTORS: [f64; 7] = [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0];
/// Factors of the load (Fig. 15).
const LOADS: [f64; 7] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

/// Prints all limits side by side; for small strain draws how they depend on load, kernel and material.
pub fn stability(options: &StudyOptions) -> Result<(), Failure> {
    let case = read(&options.case)?;
    say::warnings(&case);
    let rows = computed(&case).map_err(failed)?;
    let guess = rows.iter().filter_map(|(_, limits)| limits.operator).fold(f64::INFINITY, f64::min);
    let found = if guess.is_finite() { marched(&case, guess).map_err(failed)? } else { None };
    say!("{}: {}", case.name, case.title);
    say!("{}", table(&rows, found).trim_end());
    if !case.bodies.iter().all(small) {
        return Ok(());
    }
    let folder = PathBuf::from("out").join(format!("{}-stability", case.name));
    let out = options.out.clone().unwrap_or(folder);
    let results = ResultDir::create(&out).map_err(|error| Failure::Input(error.to_string()))?;
    loads(&case, guess, &results)?;
    widths(&case, &results)?;
    materials(&case, &results)?;
    say!("loads, smoothing, density and stiffness, each .csv and .svg, in {}", out.display());
    Ok(())
}

fn small(body: &case::Body) -> bool {
    matches!(body.scheme.march, March::Small { .. })
}

/// The case with another normalisation.
fn with(case: &Case, normalisation: Normalisation) -> Case {
    let mut case = case.clone();
    for body in &mut case.bodies {
        if let March::Small { normalisation: given, .. } = &mut body.scheme.march {
            *given = normalisation;
        }
    }
    case
}

/// The shortest of a limit over all bodies, s.
fn shortest(case: &Case, limit: impl Fn(&Limits) -> Option<f64>) -> Result<f64, Failure> {
    let rows = computed(case).map_err(failed)?;
    Ok(rows.iter().filter_map(|(_, limits)| limit(limits)).fold(f64::INFINITY, f64::min))
}

/// Fig. 15: found by running, under multiples of the load.
fn loads(case: &Case, guess: f64, results: &ResultDir) -> Result<(), Failure> {
    if case.gravity.is_empty() && case.loads.is_empty() {
        return Ok(());
    }
    let mut columns = Vec::new();
    for (name, normalisation) in
        [("normalised", Normalisation::Adjoint), ("not normalised", Normalisation::None)]
    {
        let values = LOADS.iter().map(|&factor| {
            let case = case::study::stability::times(&with(case, normalisation), factor);
            Ok(marched(&case, guess).map_err(failed)?.unwrap_or(f64::NAN))
        });
        columns.push(column(name, "s", values.collect::<Result<_, Failure>>()?));
    }
    let table = Table { times: LOADS.to_vec(), columns };
    let title = format!("{}: critical step under loads", case.title);
    tell(results, "loads", (&title, ("load over that of the case", "1")), &table)
}

/// Fig. 16: 2/sqrt(lambda) and the formulas over the smoothing length.
fn widths(case: &Case, results: &ResultDir) -> Result<(), Failure> {
    let at = |width: f64, normalisation| {
        let mut case = with(case, normalisation);
        case.bodies.iter_mut().for_each(|body| body.scheme.smoothing = width);
        case
    };
    let over = |normalisation, limit: &dyn Fn(&Limits) -> Option<f64>| {
        WIDTHS.iter().map(|&w| shortest(&at(w, normalisation), limit)).collect::<Result<Vec<f64>, Failure>>()
    };
    let columns = vec![
        column("normalised", "s", over(Normalisation::Adjoint, &|l| l.operator)?),
        column("not normalised", "s", over(Normalisation::None, &|l| l.operator)?),
        column("lattice without edges", "s", over(Normalisation::None, &|l| l.lattice)?),
        column("next neighbours", "s", over(Normalisation::None, &|l| l.four_neighbours)?),
        column("Eq. 15", "s", over(Normalisation::None, &|l| l.paper)?),
    ];
    // Eq. (15) grows beyond everything: it would flatten the others.
    let highest = columns[2].values.iter().copied().fold(0.0, f64::max);
    let cut = |mut c: output::Column| {
        c.values.iter_mut().filter(|v| **v > 1.3 * highest).for_each(|v| *v = f64::NAN);
        c
    };
    let table = Table { times: WIDTHS.to_vec(), columns: columns.into_iter().map(cut).collect() };
    let title = format!("{}: critical step and kernel", case.title);
    tell(results, "smoothing", (&title, ("smoothing length over spacing", "1")), &table)
}

/// What is varied, and how a case changes by a factor of it.
type Change<'a> = (&'a str, &'a dyn Fn(&mut Case, f64));

/// Fig. 17: over density and stiffness.
fn materials(case: &Case, results: &ResultDir) -> Result<(), Failure> {
    let density = |case: &mut Case, factor: f64| case.materials.iter_mut().for_each(|m| m.density *= factor);
    let stiffness = |case: &mut Case, factor: f64| {
        for material in &mut case.materials {
            let e = &mut material.elastic;
            for modulus in [&mut e.youngs_modulus, &mut e.bulk_modulus, &mut e.shear_modulus] {
                *modulus *= factor;
            }
        }
    };
    let changes: [Change<'_>; 2] = [("density", &density), ("stiffness", &stiffness)];
    for (name, change) in changes {
        let over = |normalisation, limit: &dyn Fn(&Limits) -> Option<f64>| {
            let values = FACTORS.iter().map(|&factor| {
                let mut case = with(case, normalisation);
                change(&mut case, factor);
                shortest(&case, limit)
            });
            values.collect::<Result<Vec<f64>, Failure>>()
        };
        let columns = vec![
            column("normalised", "s", over(Normalisation::Adjoint, &|l| l.operator)?),
            column("not normalised", "s", over(Normalisation::None, &|l| l.operator)?),
            column("Eq. 15", "s", over(Normalisation::None, &|l| l.paper)?),
        ];
        let table = Table { times: FACTORS.to_vec(), columns };
        let title = format!("{}: critical step and {name}", case.title);
        tell(results, name, (&title, (&format!("{name} over that of the case"), "1")), &table)?;
    }
    Ok(())
}
