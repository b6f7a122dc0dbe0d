//! From points to particles that carry the fields of a formulation.

use crate::field::Quantity;
use crate::formulation::Formulation;
use crate::integrator::{Total, TotalOptions, Updated, UpdatedOptions};
use crate::material::Moduli;
use crate::math::Vector;
use crate::neighbours::{Lattice, storage_order};
use crate::particles::Particles;
use crate::run::Run;

/// A particle before it belongs to a formulation.
#[derive(Clone, Copy, Debug)]
pub struct Point<const D: usize> {
    /// Reference position, m.
    pub x: Vector<f64, D>,
    /// Initial velocity, m/s.
    pub v: Vector<f64, D>,
    /// Volume, m^3 (in 2D m^2).
    pub volume: f64,
    /// Index of the body.
    pub body: u32,
    /// 1 for every free component, 0 for a prescribed one.
    pub free: Vector<f64, D>,
    /// Body force per mass, m/s^2.
    pub force: Vector<f64, D>,
}

impl<const D: usize> Point<D> {
    /// A free particle at rest.
    #[must_use]
    pub fn at(x: Vector<f64, D>, volume: f64) -> Self {
        let zero = Vector::zero();
        Self { x, v: zero, volume, body: 0, free: Vector([1.0; D]), force: zero }
    }
}

fn particles<const D: usize>(
    points: &[Point<D>],
    fields: &[Quantity],
    moduli: impl Fn(u32) -> Moduli,
) -> Particles<D> {
    let mut p = Particles::new(points.len());
    for &field in fields {
        p.add(field);
    }
    for (i, point) in points.iter().enumerate() {
        p.set_vector(Quantity::ReferencePosition, i, point.x);
        p.set_vector(Quantity::Velocity, i, Vector::from_fn(|k| point.v[k] * point.free[k]));
        p.set_vector(Quantity::Free, i, point.free);
        p.set_vector(Quantity::BodyForce, i, point.force);
        p.column_mut(Quantity::Volume, 0)[i] = point.volume;
        p.column_mut(Quantity::Body, 0)[i] = f64::from(point.body);
        p.column_mut(Quantity::Mass, 0)[i] = moduli(point.body).density * point.volume;
    }
    p
}

/// The spacing of points, roughly: of the first, if it were a square or cube, m.
pub(super) fn spacing<const D: usize>(points: &[Point<D>]) -> f64 {
    points.first().map_or(0.0, |p| p.volume.powf(1.0 / D as f64))
}

/// Puts particles in the order in which they are best stored; ids stay those of the points.
fn sort<const D: usize>(p: &mut Particles<D>, spacing: f64) {
    let mut order = Vec::new();
    // Positions that are not numbers are reported when the run starts.
    if storage_order(p.vector(Quantity::ReferencePosition), spacing, &mut order).is_ok() {
        p.reorder(&order);
    }
}

/// Puts particles that stand on a lattice in rows along its longest axis, others as [`sort`].
fn sort_rows<const D: usize>(p: &mut Particles<D>, spacing: f64) {
    match Lattice::detect(p.vector(Quantity::ReferencePosition), spacing) {
        Ok(Some(lattice)) => p.reorder(&lattice.rows()),
        _ => sort(p, spacing),
    }
}

/// A total Lagrangian body; ids count the points.
pub fn total<const D: usize, F: Formulation<D>, R: Run<D>>(
    points: &[Point<D>],
    (formulation, moduli): (F, Moduli),
    options: TotalOptions,
    run: impl FnOnce(Particles<D>) -> R,
) -> Total<D, F, R> {
    let mut p = particles(points, F::FIELDS, |_| moduli);
    sort_rows(&mut p, spacing(points));
    Total::new(formulation, run(p), options)
}

/// Updated Lagrangian bodies, each with the moduli of its index; ids count the points.
pub fn updated<const D: usize, F: Formulation<D>, R: Run<D>>(
    points: &[Point<D>],
    (formulation, moduli): (F, &dyn Fn(u32) -> Moduli),
    options: UpdatedOptions,
    run: impl FnOnce(Particles<D>) -> R,
) -> Updated<D, F, R> {
    let mut p = particles(points, F::FIELDS, moduli);
    for (i, point) in points.iter().enumerate() {
        let m = moduli(point.body);
        p.set_vector(Quantity::Position, i, point.x);
        if p.has(Quantity::FollowedPosition) {
            p.set_vector(Quantity::FollowedPosition, i, point.x);
        }
        p.column_mut(Quantity::Density, 0)[i] = m.density;
        p.column_mut(Quantity::RestDensity, 0)[i] = m.density;
        p.column_mut(Quantity::SoundSpeed, 0)[i] = m.sound_speed();
        p.column_mut(Quantity::Impedance, 0)[i] = m.density * m.sound_speed();
        p.column_mut(Quantity::ShearModulus, 0)[i] = m.shear;
    }
    sort(&mut p, spacing(points));
    Updated::new(formulation, run(p), options)
}
