//! Bodies by name: the match over formulations, materials and dimensions. Compiled here, once.

use super::Solver;
use super::particles::{Point, spacing, total, updated};
use crate::formulation::Formulation;
use crate::formulation::small_strain::{Adjoint, Bare, Literal, Normalisation, SmallStrain};
use crate::formulation::total::{Ganzenmueller, HourglassFree, Nested};
use crate::formulation::updated::{
    self as updated_forms, ArtificialStress, CorrectedArtificialStress, Generalised, Hypoelastic, Laplacian,
    LowDissipation, NeoHookeanShear, NonHourglass, Repulsion, ShearLaw, Unwatched,
};
use crate::integrator::{TotalOptions, UpdatedOptions};
use crate::material::{
    Hyperelastic, LinearElastic, Moduli, NeoHookean, NeoHookeanLog, PairShear, SaintVenantKirchhoff,
};
use crate::run::Cpu;

/// Points of two or three dimensions.
#[derive(Clone, Copy, Debug)]
pub enum Points<'a> {
    /// In the plane.
    Two(&'a [Point<2>]),
    /// In space.
    Three(&'a [Point<3>]),
}

/// Points of a dimension that bodies may have.
pub trait InSpace: Sized {
    /// The points, with their dimension as a value.
    fn points(points: &[Self]) -> Points<'_>;
}

impl InSpace for Point<2> {
    fn points(points: &[Self]) -> Points<'_> {
        Points::Two(points)
    }
}

impl InSpace for Point<3> {
    fn points(points: &[Self]) -> Points<'_> {
        Points::Three(points)
    }
}

/// A hyperelastic material.
#[derive(Clone, Copy, Debug)]
pub enum Law {
    /// TL Eqs. (10)-(14).
    NeoHookean(NeoHookean),
    /// TL Eqs. (7), (8).
    NeoHookeanLog(NeoHookeanLog),
    /// TL Eq. (5).
    SaintVenantKirchhoff(SaintVenantKirchhoff),
}

impl Law {
    fn moduli(&self) -> Moduli {
        match self {
            Self::NeoHookean(m) => m.moduli(),
            Self::NeoHookeanLog(m) => m.moduli(),
            Self::SaintVenantKirchhoff(m) => m.moduli(),
        }
    }
}

/// A total Lagrangian formulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TotalForm {
    /// `tl-hourglass-free`.
    HourglassFree(Calibration),
    /// `tl-nested`.
    Nested,
    /// `tl-ganzenmueller` with this alpha.
    Ganzenmueller(f64),
}

/// What a total Lagrangian body is made of, and how it is solved.
#[derive(Clone, Copy, Debug)]
pub struct TotalModel {
    /// The formulation.
    pub form: TotalForm,
    /// The material.
    pub law: Law,
    /// Factor of the Kelvin-Voigt damping of TL Eq. (23); 1 in the paper, 0 for none.
    pub kelvin_voigt: f64,
}

/// The factors of the hourglass-free force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Calibration {
    /// zeta = 1.07, as in the paper.
    #[default]
    Paper,
    /// Such that the moduli are exact inside of a lattice.
    Lattice,
}

/// An updated Lagrangian formulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UpdatedForm {
    /// `ul-non-hourglass`.
    NonHourglass,
    /// `ul-nested`.
    Nested,
    /// `ul-artificial-stress`, of this strength.
    ArtificialStress(f64),
    /// `ul-artificial-stress-corrected`, of this strength.
    CorrectedArtificialStress(f64),
    /// `ul-laplacian`.
    Laplacian,
    /// `ul-generalised`.
    Generalised,
    /// `ul-generalised` with the shear stress of the neo-Hookean solid.
    GeneralisedNeoHookean,
    /// `ul-low-dissipation`.
    LowDissipation,
    /// `ul-non-hourglass` without a shear stress to be looked at.
    UnwatchedNonHourglass,
}

/// The numbers that pair sums are made of. What is integrated in time is in double precision always.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Numbers {
    /// `double`.
    #[default]
    Double,
    /// `single`: sums over neighbours, and what only they read, in single precision.
    Single,
}

impl Numbers {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Single => "single",
        }
    }
}

/// A total Lagrangian body; `None` if the formulation cannot carry the material.
#[must_use]
pub fn total_body(
    points: Points<'_>,
    model: TotalModel,
    options: TotalOptions,
    numbers: Numbers,
) -> Option<Box<dyn Solver>> {
    let TotalModel { form, law, kelvin_voigt } = model;
    let body = TotalBody { points, moduli: law.moduli(), kelvin_voigt, options, numbers };
    match law {
        Law::NeoHookean(m) => body.free(form, m).or_else(|| body.nested(form, m)),
        Law::NeoHookeanLog(m) => body.free(form, m).or_else(|| body.nested(form, m)),
        Law::SaintVenantKirchhoff(m) => body.nested(form, m),
    }
}

/// A controlled form for these particles.
fn among<M: Hyperelastic, const D: usize>(form: Ganzenmueller<M>, points: &[Point<D>]) -> Ganzenmueller<M> {
    let columns: [Vec<f64>; D] = std::array::from_fn(|i| points.iter().map(|p| p.x[i]).collect());
    let volume: Vec<f64> = points.iter().map(|p| p.volume).collect();
    form.among(columns.each_ref().map(Vec::as_slice), &volume)
}

struct TotalBody<'a> {
    points: Points<'a>,
    moduli: Moduli,
    kelvin_voigt: f64,
    options: TotalOptions,
    numbers: Numbers,
}

impl TotalBody<'_> {
    /// In the hourglass-free form, if that is wanted.
    fn free<M: PairShear>(&self, form: TotalForm, material: M) -> Option<Box<dyn Solver>> {
        let TotalForm::HourglassFree(calibration) = form else { return None };
        let kernel = &self.options.kernel;
        let free = match calibration {
            Calibration::Paper => HourglassFree::new(material, kernel.h()),
            Calibration::Lattice => match self.points {
                Points::Two(p) => HourglassFree::calibrated::<2>(material, kernel, spacing(p)),
                Points::Three(p) => HourglassFree::calibrated::<3>(material, kernel, spacing(p)),
            },
        };
        Some(self.with(HourglassFree { solid: free.solid.damped(self.kelvin_voigt), ..free }))
    }

    /// In one of the nested forms, if one is wanted.
    fn nested<M: Hyperelastic>(&self, form: TotalForm, material: M) -> Option<Box<dyn Solver>> {
        let kernel = self.options.kernel;
        match form {
            TotalForm::HourglassFree(_) => None,
            TotalForm::Nested => {
                let nested = Nested::new(material, kernel.h());
                Some(self.with(Nested { solid: nested.solid.damped(self.kelvin_voigt) }))
            }
            TotalForm::Ganzenmueller(alpha) => {
                let controlled = Ganzenmueller::new(material, kernel, alpha);
                let solid = controlled.solid.damped(self.kelvin_voigt);
                let controlled = Ganzenmueller { solid, ..controlled };
                Some(self.with(match self.points {
                    Points::Two(points) => among(controlled, points),
                    Points::Three(points) => among(controlled, points),
                }))
            }
        }
    }

    fn with<F: Formulation<2> + Formulation<3> + 'static>(&self, formulation: F) -> Box<dyn Solver> {
        match self.points {
            Points::Two(points) => self.of::<2, F>(points, formulation),
            Points::Three(points) => self.of::<3, F>(points, formulation),
        }
    }

    fn of<const D: usize, F: Formulation<D> + 'static>(
        &self,
        points: &[Point<D>],
        formulation: F,
    ) -> Box<dyn Solver> {
        let formed = (formulation, self.moduli);
        match self.numbers {
            Numbers::Double => Box::new(total(points, formed, self.options, Cpu::new)),
            Numbers::Single => Box::new(total(points, formed, self.options, Cpu::single)),
        }
    }
}

/// How a small-strain body meets the edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeForm {
    /// As [`Bare`].
    None,
    /// As [`Literal`].
    Literal,
    /// As [`Adjoint`].
    #[default]
    Adjoint,
}

/// A small-strain body.
#[must_use]
pub fn small_strain_body(
    points: Points<'_>,
    (edge, material): (EdgeForm, LinearElastic),
    options: TotalOptions,
    numbers: Numbers,
) -> Box<dyn Solver> {
    fn with<N: Normalisation>(body: &TotalBody<'_>, material: LinearElastic) -> Box<dyn Solver> {
        body.with(SmallStrain::<N>::new(material, body.options.kernel))
    }
    let body = TotalBody { points, moduli: material.moduli, kelvin_voigt: 0.0, options, numbers };
    match edge {
        EdgeForm::None => with::<Bare>(&body, material),
        EdgeForm::Literal => with::<Literal>(&body, material),
        EdgeForm::Adjoint => with::<Adjoint>(&body, material),
    }
}

/// Updated Lagrangian bodies, each with the moduli of its index. The acoustic step is that of the formulation.
pub fn updated_bodies(
    points: Points<'_>,
    (form, stress, moduli): (UpdatedForm, Hypoelastic, &dyn Fn(u32) -> Moduli),
    options: UpdatedOptions,
    numbers: Numbers,
) -> Box<dyn Solver> {
    match points {
        Points::Two(points) => updated_of::<2>(points, (form, stress, moduli), options, numbers),
        Points::Three(points) => updated_of::<3>(points, (form, stress, moduli), options, numbers),
    }
}

fn updated_of<const D: usize>(
    points: &[Point<D>],
    (form, stress, moduli): (UpdatedForm, Hypoelastic, &dyn Fn(u32) -> Moduli),
    options: UpdatedOptions,
    numbers: Numbers,
) -> Box<dyn Solver> {
    let body = UpdatedBodies { points, moduli, options, numbers };
    match form {
        UpdatedForm::NonHourglass => {
            let form = NonHourglass::new(stress, D);
            body.waved(&|m| form.shear_speed(m, D)).centred().with(form)
        }
        UpdatedForm::UnwatchedNonHourglass => {
            let form = NonHourglass::new(Unwatched, D);
            body.waved(&|m| form.shear_speed(m, D)).centred().with(form)
        }
        UpdatedForm::LowDissipation => {
            let form = LowDissipation::new(stress, D);
            body.waved(&|m| form.shear_speed(m, D)).with(form)
        }
        UpdatedForm::Laplacian => {
            let form = Laplacian { stress };
            body.waved(&|m| form.shear_speed(m)).with(form)
        }
        UpdatedForm::Generalised => body.generalised(stress),
        UpdatedForm::GeneralisedNeoHookean => body.generalised(NeoHookeanShear { plane: stress.plane }),
        UpdatedForm::Nested => body.with(updated_forms::Nested { stress }),
        UpdatedForm::ArtificialStress(strength) => {
            let repulsion = Repulsion::new(options.kernel, spacing(points)).of(strength);
            body.with(ArtificialStress { stress, repulsion })
        }
        UpdatedForm::CorrectedArtificialStress(strength) => {
            let repulsion = Repulsion::new(options.kernel, spacing(points)).of(strength);
            body.with(CorrectedArtificialStress { stress, repulsion })
        }
    }
}

struct UpdatedBodies<'a, const D: usize> {
    points: &'a [Point<D>],
    moduli: &'a dyn Fn(u32) -> Moduli,
    options: UpdatedOptions,
    numbers: Numbers,
}

impl<const D: usize> UpdatedBodies<'_, D> {
    /// The same with the wave that a shear force makes, m/s, in the bounds of the step.
    fn waved(self, speed: &dyn Fn(&Moduli) -> f64) -> Self {
        let speeds = self.points.iter().map(|p| speed(&(self.moduli)(p.body)));
        let shear_speed = speeds.fold(0.0, f64::max);
        Self { options: UpdatedOptions { shear_speed, ..self.options }, ..self }
    }

    /// The same with configurations in the middle of their time: without that the amplitude of a swing grows with dual stepping, by 0.3 per
    /// cent a period of the plate of UL section 6.1.
    fn centred(self) -> Self {
        Self { options: UpdatedOptions { ahead: 0.5, ..self.options }, ..self }
    }

    fn generalised<L: ShearLaw>(self, law: L) -> Box<dyn Solver> {
        let bodies = self.points.iter().map(|p| p.body + 1).max().unwrap_or(0);
        let form = Generalised::new(law, bodies);
        self.waved(&|m| form.shear_speed(m, D)).with(form)
    }

    fn with<F: Formulation<D> + 'static>(&self, formulation: F) -> Box<dyn Solver> {
        let formed = (formulation, self.moduli);
        match self.numbers {
            Numbers::Double => Box::new(updated(self.points, formed, self.options, Cpu::new)),
            Numbers::Single => Box::new(updated(self.points, formed, self.options, Cpu::single)),
        }
    }
}
