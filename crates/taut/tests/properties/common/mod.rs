//! What the property tests share: a material, particles, bodies of every formulation, and a clock without drives.
#![allow(dead_code, reason = "every test binary uses its own share")]

pub mod as_written;
pub mod points;

use taut::field::Quantity;
use taut::formulation::small_strain::{Adjoint, SmallStrain};
use taut::formulation::{Formulation, total, updated};
use taut::integrator::{Diverged, Stepping, Total, TotalOptions, Updated, UpdatedOptions, WaveSpeed};
use taut::kernel::{Kernel, Shape};
use taut::material::{LinearElastic, Moduli, NeoHookean, Plane};
use taut::math::Tensor;
use taut::particles::Particles;
use taut::pass::Now;
use taut::run::{Cpu, Run};
use taut::simulation::{self, Point, Solver};

/// No time passes: a pass run at this moment shows what it computes and moves nothing.
pub const STILL: Now<f64> = Now { t: 0.0, dt: 0.0 };
/// A step of one second: a rate integrated over it is the rate itself.
pub const ONE: Now<f64> = Now { t: 0.0, dt: 1.0 };

/// What the weights of a pair are off where a list holds them: 1/r is rounded to single precision, 2^-24, and x_ab is up to 2^-29 of
/// the support off. Lattice-born total Lagrangian bodies have no list and no such rounding.
pub const SINGLE: f64 = 6e-8;

/// What a listed sum of x_ab W'/r V_b over a lattice leaves, times dp, where it cancels in the continuum (h = 1.3 dp, 2D): each component of
/// x_ab is up to one step of the fine grid off, up to 2^-29 of the support 2.6 dp, and sum |W'/r| V dp^2 = 1.35; two components.
pub const PLACED: f64 = 1.35 * 2.6 * 1.863e-9 * 1.42;

/// Which formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `tl-hourglass-free`.
    HourglassFree,
    /// `tl-nested`.
    TotalNested,
    /// `tl-ganzenmueller`.
    Ganzenmueller,
    /// `small-strain`.
    SmallStrain,
    /// `ul-non-hourglass`.
    NonHourglass,
    /// `ul-nested`.
    UpdatedNested,
    /// `ul-artificial-stress`.
    ArtificialStress,
    /// `ul-artificial-stress-corrected`.
    CorrectedArtificialStress,
    /// `ul-laplacian`.
    Laplacian,
    /// `ul-generalised`.
    Generalised,
    /// `ul-low-dissipation`.
    LowDissipation,
    /// `ul-non-hourglass` without a shear stress.
    Unwatched,
}

/// All of them.
pub const FORMS: [Form; 12] = [
    Form::HourglassFree,
    Form::TotalNested,
    Form::Ganzenmueller,
    Form::SmallStrain,
    Form::NonHourglass,
    Form::UpdatedNested,
    Form::ArtificialStress,
    Form::CorrectedArtificialStress,
    Form::Laplacian,
    Form::Generalised,
    Form::LowDissipation,
    Form::Unwatched,
];

/// The updated Lagrangian ones.
pub const UPDATED: [Form; 8] = [
    Form::NonHourglass,
    Form::UpdatedNested,
    Form::ArtificialStress,
    Form::CorrectedArtificialStress,
    Form::Laplacian,
    Form::Generalised,
    Form::LowDissipation,
    Form::Unwatched,
];

/// Those that know large strains, so that turns are none and too fast is too fast.
pub const FINITE: [Form; 11] = [
    Form::HourglassFree,
    Form::TotalNested,
    Form::Ganzenmueller,
    Form::NonHourglass,
    Form::UpdatedNested,
    Form::ArtificialStress,
    Form::CorrectedArtificialStress,
    Form::Laplacian,
    Form::Generalised,
    Form::LowDissipation,
    Form::Unwatched,
];

/// What a body is made of and how it is stepped.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Particle spacing, m.
    pub dp: f64,
    /// Moduli of all bodies.
    pub moduli: Moduli,
    /// Meaning of 2D.
    pub plane: Plane,
    /// When updated Lagrangian lists are made anew.
    pub stepping: Stepping,
    /// Courant number of the total Lagrangian step; the updated one takes two thirds of it.
    pub cfl: f64,
}

impl Setup {
    /// Rubber of the plate benchmarks (rho 1000, E 2 MPa, nu 0.4) with spacing `dp`, in plane strain where 2D.
    pub fn new(dp: f64) -> Self {
        let moduli = Moduli::from_young(1000.0, 2e6, 0.4);
        Self { dp, moduli, plane: Plane::Strain, stepping: Stepping::Dual, cfl: 0.6 }
    }

    pub fn material(&self) -> NeoHookean {
        NeoHookean { moduli: self.moduli, plane: self.plane }
    }

    /// (K + G) / (rho0 dp): the acceleration that a strain of one makes over one spacing, m/s^2.
    pub fn acceleration(&self) -> f64 {
        (self.moduli.bulk + self.moduli.shear) / (self.moduli.density * self.dp)
    }

    pub fn total_kernel(&self, dimension: usize) -> Kernel {
        Kernel::new(Shape::WendlandC2, 1.15 * self.dp, dimension)
    }

    pub fn updated_kernel(&self, dimension: usize) -> Kernel {
        Kernel::new(Shape::WendlandC2, 1.3 * self.dp, dimension)
    }

    pub fn total_options(&self, dimension: usize) -> TotalOptions {
        TotalOptions {
            kernel: self.total_kernel(dimension),
            cfl: self.cfl,
            wave_speed: WaveSpeed::Stretch,
            bulk_speed: self.moduli.sound_speed(),
        }
    }

    pub fn updated_options(&self, dimension: usize) -> UpdatedOptions {
        let (m, c0) = (self.moduli, self.moduli.sound_speed());
        let d = dimension as f64;
        let longitudinal = m.bulk + 3.0 * (0.7 * d + 2.1) * m.shear / (d + 2.0);
        UpdatedOptions {
            kernel: self.updated_kernel(dimension),
            cfl: self.cfl / 1.5,
            advection_cfl: 0.2,
            stepping: self.stepping,
            ahead: 0.0,
            reference_speed: 0.05 * c0,
            bulk_speed: c0,
            shear_speed: (longitudinal / m.density).sqrt(),
        }
    }

    pub fn hourglass_free(&self, dimension: usize) -> total::HourglassFree<NeoHookean> {
        total::HourglassFree::new(self.material(), self.total_kernel(dimension).h())
    }

    pub fn total_nested(&self, dimension: usize) -> total::Nested<NeoHookean> {
        total::Nested::new(self.material(), self.total_kernel(dimension).h())
    }

    pub fn ganzenmueller(&self, dimension: usize) -> total::Ganzenmueller<NeoHookean> {
        total::Ganzenmueller::new(self.material(), self.total_kernel(dimension), 10.0)
    }

    pub fn small_strain(&self, dimension: usize) -> SmallStrain<Adjoint> {
        SmallStrain::new(LinearElastic::solid(self.moduli), self.total_kernel(dimension))
    }

    pub fn small_options(&self, dimension: usize) -> TotalOptions {
        TotalOptions { wave_speed: WaveSpeed::Operator, cfl: 0.8, ..self.total_options(dimension) }
    }

    pub fn non_hourglass(&self, dimension: usize) -> updated::NonHourglass<updated::Hypoelastic> {
        updated::NonHourglass::new(updated::Hypoelastic { plane: self.plane }, dimension)
    }

    pub fn updated_nested(&self) -> updated::Nested {
        updated::Nested { stress: updated::Hypoelastic { plane: self.plane } }
    }

    pub fn artificial_stress(&self, dimension: usize) -> updated::ArtificialStress {
        let stress = updated::Hypoelastic { plane: self.plane };
        updated::ArtificialStress::new(stress, self.updated_kernel(dimension), self.dp)
    }

    pub fn corrected_artificial_stress(&self, dimension: usize) -> updated::CorrectedArtificialStress {
        let stress = updated::Hypoelastic { plane: self.plane };
        updated::CorrectedArtificialStress::new(stress, self.updated_kernel(dimension), self.dp)
    }

    pub fn unwatched(&self, dimension: usize) -> updated::NonHourglass<updated::Unwatched> {
        updated::NonHourglass::new(updated::Unwatched, dimension)
    }

    pub fn low_dissipation(&self, dimension: usize) -> updated::LowDissipation {
        updated::LowDissipation::new(updated::Hypoelastic { plane: self.plane }, dimension)
    }

    pub fn laplacian(&self) -> updated::Laplacian<updated::Hypoelastic> {
        updated::Laplacian { stress: updated::Hypoelastic { plane: self.plane } }
    }

    /// For up to two bodies.
    pub fn generalised(&self) -> updated::Generalised<updated::Hypoelastic> {
        updated::Generalised::new(updated::Hypoelastic { plane: self.plane }, 2)
    }

    /// The same of rubber.
    pub fn generalised_rubber(&self) -> updated::Generalised<updated::NeoHookeanShear> {
        updated::Generalised::new(updated::NeoHookeanShear { plane: self.plane }, 2)
    }

    /// A total Lagrangian body.
    pub fn total<const D: usize, F: Formulation<D>>(
        &self,
        formulation: F,
        points: &[Point<D>],
    ) -> Total<D, F, Cpu<D>> {
        simulation::total(points, (formulation, self.moduli), self.total_options(D), Cpu::new)
    }

    /// Updated Lagrangian bodies.
    pub fn updated<const D: usize, F: Formulation<D>>(
        &self,
        formulation: F,
        points: &[Point<D>],
    ) -> Updated<D, F, Cpu<D>> {
        let all = |_| self.moduli;
        simulation::updated(points, (formulation, &all), self.updated_options(D), Cpu::new)
    }

    /// Bodies of any formulation, run by `run`.
    pub fn body_on<const D: usize, R: Run<D> + 'static>(
        &self,
        form: Form,
        points: &[Point<D>],
        run: impl FnOnce(Particles<D>) -> R,
    ) -> Box<dyn Solver> {
        let (m, all) = (self.moduli, |_| self.moduli);
        let (t, u) = (self.total_options(D), self.updated_options(D));
        match form {
            Form::HourglassFree => Box::new(simulation::total(points, (self.hourglass_free(D), m), t, run)),
            Form::TotalNested => Box::new(simulation::total(points, (self.total_nested(D), m), t, run)),
            Form::Ganzenmueller => {
                let columns: [Vec<f64>; D] = std::array::from_fn(|i| points.iter().map(|p| p.x[i]).collect());
                let volume: Vec<f64> = points.iter().map(|p| p.volume).collect();
                let form = self.ganzenmueller(D).among(columns.each_ref().map(Vec::as_slice), &volume);
                Box::new(simulation::total(points, (form, m), t, run))
            }
            Form::SmallStrain => {
                let t = self.small_options(D);
                Box::new(simulation::total(points, (self.small_strain(D), m), t, run))
            }
            Form::NonHourglass => {
                Box::new(simulation::updated(points, (self.non_hourglass(D), &all), u, run))
            }
            Form::UpdatedNested => {
                Box::new(simulation::updated(points, (self.updated_nested(), &all), u, run))
            }
            Form::ArtificialStress => {
                Box::new(simulation::updated(points, (self.artificial_stress(D), &all), u, run))
            }
            Form::CorrectedArtificialStress => {
                Box::new(simulation::updated(points, (self.corrected_artificial_stress(D), &all), u, run))
            }
            Form::Generalised => Box::new(simulation::updated(points, (self.generalised(), &all), u, run)),
            Form::LowDissipation => {
                Box::new(simulation::updated(points, (self.low_dissipation(D), &all), u, run))
            }
            Form::Unwatched => Box::new(simulation::updated(points, (self.unwatched(D), &all), u, run)),
            Form::Laplacian => Box::new(simulation::updated(points, (self.laplacian(), &all), u, run)),
        }
    }

    /// Bodies of any formulation.
    pub fn body<const D: usize>(&self, form: Form, points: &[Point<D>]) -> Box<dyn Solver> {
        self.body_on(form, points, Cpu::new)
    }
}

/// The clock of a simulation for one solver, whose concrete type a test wants to keep.
pub struct Clock {
    /// Time, s.
    pub time: f64,
    /// The step that comes next, s.
    pub dt: f64,
}

impl Clock {
    pub fn start(solver: &mut (impl Solver + ?Sized)) -> Result<Self, Diverged> {
        solver.start()?;
        let dt = solver.stable_step();
        solver.begin(dt);
        Ok(Self { time: 0.0, dt })
    }

    pub fn step(&mut self, solver: &mut (impl Solver + ?Sized)) -> Result<(), Diverged> {
        let now = Now { t: self.time, dt: self.dt };
        solver.advance(now)?;
        let next = solver.stable_step();
        solver.finish(now, next)?;
        self.time += now.dt;
        self.dt = next;
        Ok(())
    }

    pub fn steps(&mut self, solver: &mut (impl Solver + ?Sized), n: usize) {
        for _ in 0..n {
            self.step(solver).expect("stable");
        }
    }
}

/// A vector field in the order of the points.
pub fn vectors(solver: &(impl Solver + ?Sized), field: Quantity) -> Vec<[f64; 3]> {
    let mut out = vec![[0.0; 3]; solver.len()];
    for (place, &id) in solver.ids().iter().enumerate() {
        out[id as usize] = solver.read(field, place);
    }
    out
}

/// Length of a vector.
pub fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The longest vector of a field.
pub fn largest(solver: &(impl Solver + ?Sized), field: Quantity) -> f64 {
    vectors(solver, field).into_iter().map(length).fold(0.0, f64::max)
}

/// A tensor field at one place.
pub fn tensor<const D: usize>(p: &Particles<D>, field: Quantity, place: usize) -> Tensor<f64, D> {
    Tensor::from_fn(|i, j| p.column(field, i * D + j)[place])
}

/// Frobenius norm.
pub fn size<const D: usize>(t: Tensor<f64, D>) -> f64 {
    t.double_dot(t).sqrt()
}

/// Sets a vector field from the reference position.
pub fn set<const D: usize>(
    p: &mut Particles<D>,
    field: Quantity,
    value: impl Fn(taut::math::Vector<f64, D>) -> taut::math::Vector<f64, D>,
) {
    for place in 0..p.len() {
        let x = p.vector_at(Quantity::ReferencePosition, place);
        p.set_vector(field, place, value(x));
    }
}
