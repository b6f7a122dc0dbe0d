//! The bodies that are measured, and how many operations their formulations have.

use super::subject::{Arrangement, Form, Subject};
use std::f64::consts::TAU;
use taut::formulation::{total, updated};
use taut::integrator::{TotalOptions, UpdatedOptions, WaveSpeed};
use taut::kernel::{Kernel, Shape};
use taut::machine::{Operations, operations};
use taut::material::{Moduli, NeoHookean, Plane};
use taut::math::Vector;
use taut::simulation::{
    InSpace, Law, Point, Solver, TotalForm, TotalModel, UpdatedForm, total_body, updated_bodies,
};

/// Particle spacing, m.
const DP: f64 = 0.002;

/// How large the bodies are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// The largest column of TL Table 3, and a strip of 30 000 particles.
    Full,
    /// 13 824 particles in space, 15 000 in the plane.
    Quick,
}

/// Rubber: rho 1000 kg/m^3, E 2 MPa, nu 0.4.
fn moduli() -> Moduli {
    Moduli::from_young(1000.0, 2e6, 0.4)
}

/// A body, ready to start; `None` if the formulation cannot carry rubber.
pub fn body(subject: &Subject, size: Size) -> Option<Box<dyn Solver>> {
    match (subject.dimension, size) {
        (2, Size::Full) => made(subject, [300, 100]),
        (2, Size::Quick) => made(subject, [150, 100]),
        (_, Size::Full) => made(subject, [144, 24, 24]),
        (_, Size::Quick) => made(subject, [24, 24, 24]),
    }
}

fn made<const D: usize>(subject: &Subject, n: [usize; D]) -> Option<Box<dyn Solver>>
where
    Point<D>: InSpace,
{
    let points = points(n, subject.arrangement);
    let m = moduli();
    let kernel = |ratio: f64| Kernel::new(Shape::WendlandC2, ratio * DP, D);
    let bulk_speed = m.sound_speed();
    match subject.form {
        Form::Total(form) => {
            let law = Law::NeoHookean(NeoHookean { moduli: m, plane: Plane::Strain });
            let options =
                TotalOptions { kernel: kernel(1.15), cfl: 0.6, wave_speed: WaveSpeed::Stretch, bulk_speed };
            let model = TotalModel { form, law, kelvin_voigt: 1.0 };
            total_body(Point::points(&points), model, options, subject.numbers)
        }
        Form::Updated(form, stepping) => {
            let options = UpdatedOptions {
                kernel: kernel(1.3),
                cfl: 0.4,
                advection_cfl: 0.2,
                stepping,
                ahead: 0.0,
                // As a body that moves with a twentieth of the speed of sound: what the papers' plates do.
                reference_speed: 0.05 * bulk_speed,
                bulk_speed,
                shear_speed: 0.0,
            };
            let stress = updated::Hypoelastic { plane: Plane::Strain };
            Some(updated_bodies(Point::points(&points), (form, stress, &|_| m), options, subject.numbers))
        }
    }
}

/// A block of `n` particles along each axis in slow motion: nothing breaks however long it is watched.
fn points<const D: usize>(n: [usize; D], arrangement: Arrangement) -> Vec<Point<D>> {
    let speed = 1e-4 * moduli().sound_speed();
    let mut noise = Noise(7);
    let at = |mut k: usize| {
        let mut x = Vector::zero();
        for axis in (0..D).rev() {
            x[axis] = ((k % n[axis]) as f64 + 0.5) * DP;
            k /= n[axis];
        }
        if arrangement == Arrangement::Irregular {
            (0..D).for_each(|axis| x[axis] += 0.1 * DP * noise.next());
        }
        let wave = (TAU * (x[0] + 2.0 * x[1]) / (30.0 * DP)).sin();
        let v = Vector::from_fn(|i| speed * (0.4 * wave + 0.3 - 0.2 * i as f64));
        Point { v, ..Point::at(x, DP.powi(D as i32)) }
    };
    (0..n.iter().product()).map(at).collect()
}

/// Numbers between -1 and 1 that look random and are always the same (a linear congruence modulo 2^64).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The operations of a step of the formulation of a subject.
pub fn count(subject: &Subject) -> Operations {
    match subject.dimension {
        2 => counted::<2>(subject.form),
        _ => counted::<3>(subject.form),
    }
}

fn counted<const D: usize>(form: Form) -> Operations {
    let material = NeoHookean { moduli: moduli(), plane: Plane::Strain };
    let stress = updated::Hypoelastic { plane: Plane::Strain };
    match form {
        Form::Total(TotalForm::HourglassFree(_)) => operations::<D>(&total::HourglassFree::new(material, DP)),
        Form::Total(TotalForm::Nested) => operations::<D>(&total::Nested::new(material, DP)),
        Form::Total(TotalForm::Ganzenmueller(alpha)) => {
            let kernel = Kernel::new(Shape::WendlandC2, DP, D);
            operations::<D>(&total::Ganzenmueller::new(material, kernel, alpha))
        }
        Form::Updated(UpdatedForm::NonHourglass, _) => {
            operations::<D>(&updated::NonHourglass::new(stress, D))
        }
        Form::Updated(UpdatedForm::Nested, _) => operations::<D>(&updated::Nested { stress }),
        Form::Updated(UpdatedForm::ArtificialStress(_), _) => {
            let kernel = Kernel::new(Shape::WendlandC2, 1.3 * DP, D);
            operations::<D>(&updated::ArtificialStress::new(stress, kernel, DP))
        }
        Form::Updated(UpdatedForm::CorrectedArtificialStress(_), _) => {
            let kernel = Kernel::new(Shape::WendlandC2, 1.3 * DP, D);
            operations::<D>(&updated::CorrectedArtificialStress::new(stress, kernel, DP))
        }
        Form::Updated(UpdatedForm::Generalised, _) => operations::<D>(&updated::Generalised::new(stress, 1)),
        Form::Updated(UpdatedForm::GeneralisedNeoHookean, _) => {
            let stress = updated::NeoHookeanShear { plane: Plane::Strain };
            operations::<D>(&updated::Generalised::new(stress, 1))
        }
        Form::Updated(UpdatedForm::LowDissipation, _) => {
            operations::<D>(&updated::LowDissipation::new(stress, D))
        }
        Form::Updated(UpdatedForm::UnwatchedNonHourglass, _) => {
            operations::<D>(&updated::NonHourglass::new(updated::Unwatched, D))
        }
        Form::Updated(UpdatedForm::Laplacian, _) => operations::<D>(&updated::Laplacian { stress }),
    }
}
