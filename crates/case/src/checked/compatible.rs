//! Which formulation goes with which material.

use super::body::Body;
use super::choices::{Family, Formulation, Plane, Stepping};
use super::material::{Material, Model};
use super::scheme::March;
use crate::diagnostic::{Diagnostic, Problems};
use crate::source::Place;

/// Below this Poisson ratio `ul-non-hourglass` is too stiff in bending: by 3 per cent just below it, by 10 at 0.3,
/// by 29 at 0.1 (its pair force has no exact modulus in the plane).
const NEARLY_INCOMPRESSIBLE: f64 = 0.4;

/// Below this share of the paper's damping the hourglass-free form is not known to be stable: without any it blows up within half a period of
/// the plate, with a tenth it keeps 0.996 of its energy.
const LEAST_DAMPING: f64 = 0.1;

/// The models that a formulation can use.
fn models(formulation: Formulation) -> &'static [Model] {
    match formulation {
        Formulation::TlHourglassFree => &[Model::NeoHookean, Model::NeoHookeanLog],
        Formulation::TlNested | Formulation::TlGanzenmueller => {
            &[Model::NeoHookean, Model::NeoHookeanLog, Model::SaintVenantKirchhoff]
        }
        Formulation::UlGeneralised => &[Model::LinearElastic, Model::NeoHookean],
        Formulation::UlNonHourglass
        | Formulation::UlNested
        | Formulation::UlArtificialStress
        | Formulation::UlArtificialStressCorrected
        | Formulation::UlLowDissipation
        | Formulation::UlLaplacian
        | Formulation::SmallStrain => &[Model::LinearElastic],
    }
}

/// Refuses bodies whose material their formulation cannot use.
pub(super) fn check(bodies: &[Body], materials: &[Material], problems: &mut Problems) {
    for (body, material) in pairs(bodies, materials) {
        let formulation = body.scheme.formulation;
        let models = models(formulation);
        if models.contains(&material.model) {
            continue;
        }
        let (model, name) = (material.model.name(), formulation.name());
        let known: Vec<String> = models.iter().map(|model| format!("`{}`", model.name())).collect();
        let also = match material.model {
            Model::SaintVenantKirchhoff if formulation.family() == Family::Total => {
                "; its stress has no hourglass-free split: `tl-nested` and `tl-ganzenmueller` take it"
                    .to_string()
            }
            _ => {
                format!(" (on the command line: --set material.{}.model={})", material.name, models[0].name())
            }
        };
        let message = format!("the model `{model}` does not go with `{name}` of body `{}`", body.name);
        problems.0.push(
            Diagnostic::at(material.place, message)
                .help(format!("`{name}` takes {}{also}", known.join(" or "))),
        );
    }
}

/// Warnings about bodies; in the papers' plane the bias is the benchmarks' own, and in space plates of nu = 0.3 come out as published.
pub(super) fn warnings(bodies: &[Body], materials: &[Material], plane: Option<Plane>) -> Vec<Diagnostic> {
    let tuned = bodies.iter().find_map(|body| match body.scheme.march {
        March::Total { alpha, .. } if body.scheme.formulation == Formulation::TlGanzenmueller => {
            let message = format!(
                "`tl-ganzenmueller` has a number to be tuned, and results depend on it: alpha = {alpha}"
            );
            Some(
                Diagnostic::at(body.place, message)
                    .help("compare with another `alpha`, or use tl-hourglass-free, which has none"),
            )
        }
        _ => None,
    });
    let unstable = bodies.iter().find_map(|body| match body.scheme.march {
        March::Total { kelvin_voigt, .. }
            if body.scheme.formulation == Formulation::TlHourglassFree && kelvin_voigt < LEAST_DAMPING =>
        {
            let message = format!(
                "`tl-hourglass-free` with kelvin_voigt = {kelvin_voigt} will not stay stable: its operators of force and strain are not adjoint at surfaces"
            );
            Some(Diagnostic::at(body.place, message).help("a tenth of the damping of the paper is enough; tl-nested needs none"))
        }
        _ => None,
    });
    let stiff = pairs(bodies, materials)
        .filter(|(body, material)| {
            body.scheme.formulation == Formulation::UlNonHourglass
                && material.elastic.poisson_ratio < NEARLY_INCOMPRESSIBLE
                && plane == Some(Plane::Strain)
        })
        .map(|(body, material)| {
            let nu = material.elastic.poisson_ratio;
            let message = format!(
                "`ul-non-hourglass` is made for nearly incompressible solids: body `{}` with Poisson ratio {nu} will be too stiff",
                body.name
            );
            Diagnostic::at(body.place, message).help("above 0.4 the error is below 3 per cent; or use tl-hourglass-free")
        });
    tuned.into_iter().chain(unstable).chain(stiff).collect()
}

/// A warning about artificial stress that is frozen between two lists, at the place of `stepping`.
pub(super) fn frozen(bodies: &[Body], stepping: Place) -> Option<Diagnostic> {
    let frozen = |body: &&Body| {
        let dual = matches!(body.scheme.march, March::Updated { stepping: Stepping::Dual, .. });
        dual && body.scheme.formulation.has_artificial_stress()
    };
    let body = bodies.iter().find(frozen)?;
    let message = format!(
        "with dual stepping the artificial stress of body `{}` is frozen between two renewals: it grows with (W(r)/W(dp))^4, \
         and particles that come near each other in between are pushed apart too late, or too far",
        body.name
    );
    let form = body.scheme.formulation.name();
    Some(Diagnostic::at(stepping, message).help(format!(
        "`stepping = \"single\"`, the default of {form}; colliding rings blow up with dual stepping"
    )))
}

/// Refuses planes that a formulation does not have.
pub(super) fn planes(bodies: &[Body], (plane, place): (Option<Plane>, Place), problems: &mut Problems) {
    for body in bodies {
        let (small, name) =
            (body.scheme.formulation == Formulation::SmallStrain, body.scheme.formulation.name());
        let (word, help) = match plane {
            Some(Plane::Stress) if !small => {
                ("stress", "only small-strain has plane stress; the others take \"strain\" or \"papers\"")
            }
            Some(Plane::Papers) if small => ("papers", "small-strain takes \"strain\" or \"stress\""),
            _ => continue,
        };
        let message = format!("`plane = \"{word}\"` does not go with `{name}` of body `{}`", body.name);
        problems.0.push(Diagnostic::at(place, message).help(help));
    }
}

fn pairs<'a>(
    bodies: &'a [Body],
    materials: &'a [Material],
) -> impl Iterator<Item = (&'a Body, &'a Material)> {
    bodies.iter().filter_map(|body| Some((body, materials.iter().find(|m| m.name == body.material)?)))
}
