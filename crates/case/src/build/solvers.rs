//! The match over formulations and materials.

use super::bodies::Group;
use crate::{
    Body, Calibration, Case, CaseError, Formulation, Kernel, March, Material, Model, Normalisation, Plane,
    StepRule, Stepping,
};
use taut::diagnostics::stability::Interior;
use taut::formulation::updated::Hypoelastic;
use taut::integrator::{self, TotalOptions, UpdatedOptions, WaveSpeed};
use taut::kernel;
use taut::material::{self, LinearElastic, Moduli, NeoHookean, NeoHookeanLog, SaintVenantKirchhoff};
use taut::simulation::{
    self, EdgeForm, InSpace, Law, Numbers, Point, Solver, TotalForm, TotalModel, UpdatedForm,
    small_strain_body, total_body, updated_bodies,
};

/// The plane as the material sees it.
pub fn plane(case: &Case) -> material::Plane {
    match case.plane {
        Some(Plane::Papers) => material::Plane::Papers,
        _ => material::Plane::Strain,
    }
}

/// The elastic moduli of a material of the case.
pub fn moduli(material: &Material) -> Moduli {
    let e = &material.elastic;
    Moduli { density: material.density, bulk: e.bulk_modulus, shear: e.shear_modulus }
}

/// The kernel of a smoothing length.
pub fn kernel<const D: usize>(case: &Case, h: f64) -> kernel::Kernel {
    let shape = match case.kernel {
        Kernel::WendlandC2 => kernel::Shape::WendlandC2,
        Kernel::CubicSpline => kernel::Shape::CubicSpline,
        Kernel::Gaussian => kernel::Shape::Gaussian,
    };
    kernel::Kernel::new(shape, h, D)
}

/// Moduli of all bodies, by index.
fn all_moduli(case: &Case) -> Result<Vec<Moduli>, CaseError> {
    case.bodies
        .iter()
        .map(|body| {
            let unknown = || case.error_at(body.place, format!("unknown material `{}`", body.material), None);
            case.material_of(body).map(moduli).ok_or_else(unknown)
        })
        .collect()
}

/// The solver of a group.
pub fn solver<const D: usize>(
    case: &Case,
    group: &Group<'_, D>,
    numbers: Numbers,
) -> Result<Box<dyn Solver>, CaseError>
where
    Point<D>: InSpace,
{
    let all = all_moduli(case)?;
    let (index, body) = group.bodies[0];
    let scheme = &body.scheme;
    let kernel = kernel::<D>(case, scheme.smoothing * case.spacing);
    let points = Point::points(&group.points);
    match scheme.march {
        March::Total { step, calibration, alpha, kelvin_voigt } => {
            let options = TotalOptions {
                kernel,
                cfl: scheme.cfl,
                wave_speed: if step == StepRule::Paper { WaveSpeed::Paper } else { WaveSpeed::Stretch },
                bulk_speed: all[index].sound_speed(),
            };
            let form = total_form(scheme.formulation, calibration, alpha);
            let law = law(case, body, all[index]);
            let model = TotalModel { form, law, kelvin_voigt };
            total_body(points, model, options, numbers).ok_or_else(|| unfit(case, body))
        }
        March::Small { normalisation, dt } => {
            let options = TotalOptions {
                kernel,
                cfl: scheme.cfl,
                wave_speed: dt.map_or(WaveSpeed::Operator, WaveSpeed::Given),
                bulk_speed: all[index].sound_speed(),
            };
            let formed = (edge(normalisation), hooke(case, all[index]));
            Ok(small_strain_body(points, formed, options, numbers))
        }
        March::Updated { stepping, reference_speed, artificial_stress } => {
            let mine = group.bodies.iter().map(|&(i, _)| all[i].sound_speed());
            let options = UpdatedOptions {
                kernel,
                cfl: scheme.cfl,
                advection_cfl: 0.2,
                stepping: match stepping {
                    Stepping::Dual => integrator::Stepping::Dual,
                    Stepping::Single => integrator::Stepping::Single,
                },
                ahead: 0.0,
                reference_speed,
                bulk_speed: mine.fold(0.0, f64::max),
                shear_speed: 0.0,
            };
            let form = updated_form(case, body, artificial_stress);
            let stress = Hypoelastic { plane: plane(case) };
            let moduli = |body: u32| all[body as usize];
            Ok(updated_bodies(points, (form, stress, &moduli), options, numbers))
        }
    }
}

/// A material that a formulation cannot carry.
fn unfit(case: &Case, body: &Body) -> CaseError {
    let formulation = body.scheme.formulation.name();
    let message = format!("the material `{}` does not go with {formulation}", body.material);
    case.error_at(body.place, message, None)
}

/// An updated Lagrangian formulation, with this strength of artificial stress if it has one.
fn updated_form(case: &Case, body: &Body, strength: f64) -> UpdatedForm {
    let rubber = case.material_of(body).is_some_and(|material| material.model == Model::NeoHookean);
    match body.scheme.formulation {
        Formulation::UlNested => UpdatedForm::Nested,
        Formulation::UlArtificialStress => UpdatedForm::ArtificialStress(strength),
        Formulation::UlArtificialStressCorrected => UpdatedForm::CorrectedArtificialStress(strength),
        Formulation::UlLaplacian => UpdatedForm::Laplacian,
        Formulation::UlGeneralised if rubber => UpdatedForm::GeneralisedNeoHookean,
        Formulation::UlGeneralised => UpdatedForm::Generalised,
        Formulation::UlLowDissipation => UpdatedForm::LowDissipation,
        _ if !case.shear_stress => UpdatedForm::UnwatchedNonHourglass,
        _ => UpdatedForm::NonHourglass,
    }
}

/// A total Lagrangian formulation with its numbers.
fn total_form(formulation: Formulation, calibration: Calibration, alpha: f64) -> TotalForm {
    match (formulation, calibration) {
        (Formulation::TlNested, _) => TotalForm::Nested,
        (Formulation::TlGanzenmueller, _) => TotalForm::Ganzenmueller(alpha),
        (_, Calibration::Lattice) => TotalForm::HourglassFree(simulation::Calibration::Lattice),
        (_, Calibration::Paper) => TotalForm::HourglassFree(simulation::Calibration::Paper),
    }
}

/// What a small-strain body does at its edge.
fn edge(normalisation: Normalisation) -> EdgeForm {
    match normalisation {
        Normalisation::Adjoint => EdgeForm::Adjoint,
        Normalisation::Literal => EdgeForm::Literal,
        Normalisation::None => EdgeForm::None,
    }
}

/// The material of a small-strain body.
fn hooke(case: &Case, moduli: Moduli) -> LinearElastic {
    match case.plane {
        Some(Plane::Stress) => LinearElastic::plane_stress(moduli),
        _ => LinearElastic::solid(moduli),
    }
}

/// The inside of a small-strain body.
pub fn interior(case: &Case, body: &Body) -> Option<Interior> {
    let h = body.scheme.smoothing * case.spacing;
    let kernel = if case.dimension == 2 { kernel::<2>(case, h) } else { kernel::<3>(case, h) };
    let material = hooke(case, moduli(case.material_of(body)?));
    Some(Interior { material, kernel, spacing: case.spacing, dimension: case.dimension })
}

/// The material of a total Lagrangian body.
fn law(case: &Case, body: &Body, moduli: Moduli) -> Law {
    match case.material_of(body).map_or(Model::NeoHookean, |m| m.model) {
        Model::NeoHookeanLog => Law::NeoHookeanLog(NeoHookeanLog { moduli }),
        Model::SaintVenantKirchhoff => Law::SaintVenantKirchhoff(SaintVenantKirchhoff { moduli }),
        Model::NeoHookean | Model::LinearElastic => {
            Law::NeoHookean(NeoHookean { moduli, plane: plane(case) })
        }
    }
}
