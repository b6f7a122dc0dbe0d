//! The match over formulations and materials.

use super::bodies::Group;
use crate::{Case, CaseError, Formulation, Kernel, March, Material, Model, Plane, StepRule, Stepping};
use taut::formulation::{total, updated};
use taut::integrator::{self, TotalOptions, UpdatedOptions, WaveSpeed};
use taut::kernel;
use taut::material::{self, Moduli, NeoHookean, NeoHookeanLog, SaintVenantKirchhoff};
use taut::run::Cpu;
use taut::simulation::{self, Solver};

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

fn kernel<const D: usize>(case: &Case, h: f64) -> kernel::Kernel {
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
pub fn solver<const D: usize>(case: &Case, group: &Group<'_, D>) -> Result<Box<dyn Solver>, CaseError> {
    let all = all_moduli(case)?;
    let (index, body) = group.bodies[0];
    let scheme = &body.scheme;
    let h = scheme.smoothing * case.spacing;
    let model = case.material_of(body).map_or(Model::NeoHookean, |m| m.model);
    let refused = || {
        let message = format!("the model `{}` does not go with {}", model.name(), scheme.formulation.name());
        Err(case.error_at(body.place, message, None))
    };
    match scheme.march {
        March::Total { step } => {
            let options = TotalOptions {
                kernel: kernel::<D>(case, h),
                cfl: scheme.cfl,
                wave_speed: if step == StepRule::Paper { WaveSpeed::Paper } else { WaveSpeed::Stretch },
                bulk_speed: all[index].sound_speed(),
            };
            let total = TotalBody { group, moduli: all[index], plane: plane(case), h, options };
            total.solver(scheme.formulation, model).map_or_else(refused, Ok)
        }
        March::Updated { stepping, reference_speed } => {
            let mine: Vec<Moduli> = group.bodies.iter().map(|&(i, _)| all[i]).collect();
            let options = UpdatedOptions {
                kernel: kernel::<D>(case, h),
                cfl: scheme.cfl,
                advection_cfl: 0.2,
                stepping: match stepping {
                    Stepping::Dual => integrator::Stepping::Dual,
                    Stepping::Single => integrator::Stepping::Single,
                },
                reference_speed,
                bulk_speed: mine.iter().map(Moduli::sound_speed).fold(0.0, f64::max),
                shear_speed: 0.0,
            };
            let moduli = |body: u32| all[body as usize];
            updated_solver(scheme.formulation, group, (plane(case), &mine, &moduli), options)
                .map_or_else(refused, Ok)
        }
    }
}

/// A total Lagrangian body about to get a solver.
struct TotalBody<'a, const D: usize> {
    group: &'a Group<'a, D>,
    moduli: Moduli,
    plane: material::Plane,
    h: f64,
    options: TotalOptions,
}

impl<const D: usize> TotalBody<'_, D> {
    fn solver(&self, formulation: Formulation, model: Model) -> Option<Box<dyn Solver>> {
        let moduli = self.moduli;
        let neo_hookean = NeoHookean { moduli, plane: self.plane };
        let log = NeoHookeanLog { moduli };
        let svk = SaintVenantKirchhoff { moduli };
        Some(match (formulation, model) {
            (Formulation::TlHourglassFree, Model::NeoHookean) => {
                self.with(total::HourglassFree::new(neo_hookean, self.h))
            }
            (Formulation::TlHourglassFree, Model::NeoHookeanLog) => {
                self.with(total::HourglassFree::new(log, self.h))
            }
            (Formulation::TlNested, Model::NeoHookean) => self.with(total::Nested::new(neo_hookean, self.h)),
            (Formulation::TlNested, Model::NeoHookeanLog) => self.with(total::Nested::new(log, self.h)),
            (Formulation::TlNested, Model::SaintVenantKirchhoff) => {
                self.with(total::Nested::new(svk, self.h))
            }
            _ => return None,
        })
    }

    fn with<F: taut::formulation::Formulation<D> + 'static>(&self, formulation: F) -> Box<dyn Solver> {
        let formulation = (formulation, self.moduli);
        Box::new(simulation::total(&self.group.points, formulation, self.options, Cpu::new))
    }
}

fn updated_solver<const D: usize>(
    formulation: Formulation,
    group: &Group<'_, D>,
    (plane, mine, moduli): (material::Plane, &[Moduli], &dyn Fn(u32) -> Moduli),
    options: UpdatedOptions,
) -> Option<Box<dyn Solver>> {
    let stress = updated::Hypoelastic { plane };
    Some(match formulation {
        Formulation::UlNonHourglass => {
            let form = updated::NonHourglass::new(stress, D);
            let shear_speed = mine.iter().map(|m| form.shear_speed(m, D)).fold(0.0, f64::max);
            let options = UpdatedOptions { shear_speed, ..options };
            Box::new(simulation::updated(&group.points, (form, moduli), options, Cpu::new))
        }
        Formulation::UlNested => {
            let form = updated::Nested { stress };
            Box::new(simulation::updated(&group.points, (form, moduli), options, Cpu::new))
        }
        _ => return None,
    })
}
