//! Formulations: each is the list of its passes, in the order of its paper.

mod kick;
pub mod small_strain;
pub mod total;
pub mod undeformed;
pub mod updated;

use crate::field::Quantity;
use crate::math::Tensor;
use crate::pass::Now;
use crate::run::Run;

/// A discretisation of elasticity.
///
/// A step has two halves: [`Formulation::accelerate`] (forces, then velocities) and [`Formulation::rates`] (what follows
/// from the new velocities). When each is called with which time step is the business of the integrator.
pub trait Formulation<const D: usize>: Send + Sync {
    /// The fields it carries.
    const FIELDS: &'static [Quantity];

    /// Finishes what depends on the pair list, before a new one is made.
    fn relisting(&self, _: &mut impl Run<D>) {}

    /// Prepares what depends on the pair list; called after every new list.
    fn relisted(&self, run: &mut impl Run<D>);

    /// Accelerations and new velocities; `now.dt` is the step.
    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>);

    /// Rates that follow from velocities, and what is integrated from them.
    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>);

    /// What the particle stored at `place` weighs in the product in which the linear operator is symmetric, if it is: its mass, kg.
    fn metric(&self, run: &impl Run<D>, place: usize) -> f64 {
        run.word(Quantity::Mass, 0, place)
    }

    /// Brings up to date what is only looked at. It must not change the motion, nor what later looks see.
    fn look(&self, _: &mut impl Run<D>) {}

    /// Stress and energy of the particle stored at `place`, with `ahead` the time that fields are ahead of velocity.
    fn state(&self, run: &impl Run<D>, place: usize, ahead: f64) -> State;
}

/// The state of one particle, for output.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Deformation gradient, if the formulation has one.
    pub deformation: Option<Tensor<f64, 3>>,
    /// Gradient of the displacement, if the formulation is linear in that instead.
    pub gradient: Option<Tensor<f64, 3>>,
    /// Density, kg/m^3.
    pub density: f64,
    /// Cauchy stress, Pa.
    pub cauchy: Tensor<f64, 3>,
    /// Strain energy, J.
    pub strain_energy: f64,
    /// What the damper has been booked with beyond the present time, J, where fields run ahead of it.
    pub booked_ahead: f64,
    /// Moment, N m, of the pair forces that the stress of this particle makes: zero where a form keeps angular momentum, and where it is not told.
    pub couple: [f64; 3],
}
