//! Position Verlet with dual-criteria time stepping for updated Lagrangian bodies (UL section 5).

mod options;

pub use options::{Stepping, UpdatedOptions};

use super::diverged::{Check, culprit, not_finite};
use super::limits::largest;
use super::outside::{self, Midway};
use super::spectrum::Stiffness;
use super::tangent::Tangent;
use super::{Bounding, Cause, Criterion, Diverged, Held, Impulse, Limits, Solver};
use crate::field::Quantity;
use crate::formulation::updated::refresh_volumes;
use crate::formulation::{Formulation, State};
use crate::math::Vector;
use crate::neighbours::storage_order;
use crate::particles::saved::{Part, RestoreError, Shelf, Values};
use crate::pass::Now;
use crate::run::{self, Among, Relist, Run};
use rayon::prelude::*;

/// Updated Lagrangian bodies in time.
#[derive(Debug)]
pub struct Updated<const D: usize, F, R> {
    formulation: F,
    run: R,
    options: UpdatedOptions,
    limits: Limits,
    /// Time left until the configuration is made anew.
    left: f64,
    rebuilds: u64,
    /// Whether what is only looked at is up to date, or cannot be: for want of a list.
    looked: bool,
    /// Whether every particle had neighbours enough in the first list.
    sociable: bool,
    order: Vec<u32>,
    /// Positions of the last list, from which it can be made again, m.
    listed: [Vec<f64>; D],
    /// Positions while a list is made ahead of them, m.
    present: [Vec<f64>; D],
}

/// After so many lists particles are put in order again. An elastic body keeps its order; bodies that slide along each other lose it
/// slowly, and a sort costs as much as two lists.
const LISTS_PER_SORT: u64 = 100;
/// Numbers that a thread copies at a time.
const COPIED: usize = 1 << 14;

impl<const D: usize, F: Formulation<D>, R: Run<D>> Updated<D, F, R> {
    /// Bodies whose particles carry the fields of `F` and are set up.
    pub fn new(formulation: F, run: R, options: UpdatedOptions) -> Self {
        Self {
            formulation,
            run,
            options,
            limits: Limits::default(),
            left: 0.0,
            rebuilds: 0,
            looked: true,
            sociable: false,
            order: Vec::new(),
            listed: std::array::from_fn(|_| Vec::new()),
            present: std::array::from_fn(|_| Vec::new()),
        }
    }

    /// The run, to look at.
    pub fn run(&self) -> &R {
        &self.run
    }

    /// The run, to change fields from outside.
    pub fn run_mut(&mut self) -> &mut R {
        self.looked = self.rebuilds == 0;
        &mut self.run
    }

    /// How often the configuration was made anew.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// Puts the particles in the order in which they are best stored now. Positions that are not numbers are found by the list.
    fn sort(&mut self) {
        let p = self.run.particles();
        let spacing = p.column(Quantity::Volume, 0).first().map_or(0.0, |v| v.powf(1.0 / D as f64));
        if storage_order(p.vector(Quantity::Position), spacing, &mut self.order).is_ok() {
            self.run.particles_mut().reorder(&self.order);
        }
    }

    /// Notes where particles are, and where they will be in `time`: that is where the list is made.
    fn look_ahead(&mut self, time: f64) {
        for axis in 0..D {
            let x = self.run.particles().column(Quantity::Position, axis);
            let v = self.run.numbers(Quantity::Velocity, axis);
            let (present, listed) = (&mut self.present[axis], &mut self.listed[axis]);
            present.resize(x.len(), 0.0);
            listed.resize(x.len(), 0.0);
            let copy = |(to, from): (&mut [f64], &[f64])| to.copy_from_slice(from);
            present.par_chunks_mut(COPIED).zip(x.par_chunks(COPIED)).for_each(copy);
            let there = |k: usize| x[k] + if time == 0.0 { 0.0 } else { time * v.at(k) };
            listed.par_iter_mut().enumerate().with_min_len(COPIED).for_each(|(k, x)| *x = there(k));
        }
    }

    /// Makes the list where particles will be in `time`, and what the formulation makes of it; they stay where they are.
    fn list(&mut self, time: f64) -> Result<(), Diverged> {
        self.look_ahead(time);
        place(&mut self.run, &self.listed);
        let listed = self.run.relist(&self.reach());
        if listed.is_ok() {
            self.formulation.relisted(&mut self.run);
        }
        place(&mut self.run, &self.present);
        if listed.is_err() {
            self.looked = true;
            self.diagnose()?;
            return Err(Diverged::unlisted());
        }
        self.count()
    }

    /// Makes the list again as it was at the positions in `listed`.
    fn list_again(&mut self) -> Result<(), RestoreError> {
        let now = self.run.particles().vector(Quantity::Position).map(<[f64]>::to_vec);
        place(&mut self.run, &self.listed);
        let listed = self.run.relist(&self.reach());
        place(&mut self.run, &now);
        listed.map_err(|_| RestoreError::Foreign("their neighbours cannot be listed"))
    }

    fn rebuild(&mut self) -> Result<(), Diverged> {
        // Nothing has followed the motion before the first list.
        if self.rebuilds > 0 {
            self.formulation.relisting(&mut self.run);
        }
        if self.rebuilds % LISTS_PER_SORT == LISTS_PER_SORT - 1 {
            self.sort();
        }
        refresh_volumes(&mut self.run);
        let o = &self.options;
        let speed = self.limits.speed.max(o.reference_speed).max(f64::MIN_POSITIVE);
        self.left = match o.stepping {
            Stepping::Single => 0.0,
            Stepping::Dual => o.advection_cfl * o.kernel.h() / speed,
        };
        // A body that hardly moves lasts for ever, and goes nowhere.
        let ahead = o.ahead * self.left;
        self.list(if self.limits.speed > 0.0 { ahead } else { 0.0 })?;
        self.rebuilds += 1;
        Ok(())
    }

    /// The two criteria of the acoustic step (UL Eq. 22), before the Courant number. 0.6 with c_M where the paper has 0.4 with c0:
    /// the published step wherever that is stable (nu >= 0.3).
    fn steps(&self) -> [f64; 2] {
        let (o, h, v) = (&self.options, self.options.kernel.h(), self.limits.speed);
        let shear = if o.shear_speed > 0.0 { 1.5 * h / (o.shear_speed + v) } else { f64::INFINITY };
        [h / (o.bulk_speed + v), shear]
    }

    /// The end of a step less half of its way.
    fn midway(&self, dt: f64) -> Midway<'_, D> {
        let field = |field| outside::columns(&self.run, field);
        Midway { base: field(Quantity::Position), way: field(Quantity::Velocity), share: -0.5 * dt }
    }

    /// A particle that cannot form a gradient any more has left its body; one that never could has not.
    fn count(&mut self) -> Result<(), Diverged> {
        let Some((place, neighbours)) = self.run.loneliest() else { return Ok(()) };
        if self.rebuilds == 0 {
            self.sociable = neighbours >= D;
        }
        if neighbours >= D || !self.sociable {
            return Ok(());
        }
        Err(Diverged::of(
            &self.run,
            (place, Cause::Lost),
            ("number of neighbours", neighbours as f64, D as f64),
        ))
    }

    fn check(&mut self) -> Result<(), Diverged> {
        self.limits = Limits::of_motion(&mut self.run);
        if self.limits.finite && self.limits.speed < 10.0 * self.options.bulk_speed {
            return Ok(());
        }
        self.diagnose()
    }

    fn diagnose(&self) -> Result<(), Diverged> {
        let rest = |a| self.run.word(Quantity::RestDensity, 0, a);
        // The largest component of a vector is at least its length over sqrt(D).
        let component = 10.0 * self.options.bulk_speed / (D as f64).sqrt();
        let density = |a: usize, x: f64| match x / rest(a) {
            ratio if ratio >= 10.0 => Some(10.0 * rest(a)),
            ratio if ratio >= 0.1 => None,
            _ => Some(0.1 * rest(a)),
        };
        let far = |_: usize, x: f64| (x.is_nan() || x.abs() >= 1e150).then_some(f64::NAN);
        let fast = |_: usize, x: f64| (x.is_nan() || x.abs() >= component).then_some(component);
        let check = |field, cause, beyond| Check { field, cause, beyond };
        let found = culprit(
            &self.run,
            &[
                check(Quantity::Density, Cause::Density, &density),
                check(Quantity::Velocity, Cause::NotFinite, &not_finite),
                check(Quantity::Acceleration, Cause::NotFinite, &not_finite),
                check(Quantity::Position, Cause::NotFinite, &far),
                check(Quantity::Velocity, Cause::Speed, &fast),
            ],
        );
        found.map_or(Ok(()), Err)
    }
}

/// Puts the particles at `x` (m), and touches nothing else.
fn place<const D: usize>(run: &mut impl Run<D>, x: &[Vec<f64>; D]) {
    for (axis, x) in x.iter().enumerate() {
        // Positions are kept in double precision by every back-end.
        run.put_back(Quantity::Position, axis, &Values::Double(x.as_slice().into()));
    }
}

impl<const D: usize, F: Formulation<D>, R: Run<D>> Solver for Updated<D, F, R> {
    fn dimension(&self) -> usize {
        D
    }

    fn ids(&self) -> &[u32] {
        self.run.particles().ids()
    }

    fn stored(&self, id: usize) -> usize {
        self.run.particles().stored(id)
    }

    fn neighbours(&self) -> f64 {
        self.run.neighbours()
    }

    fn lists(&self) -> u64 {
        self.rebuilds
    }

    fn start(&mut self) -> Result<(), Diverged> {
        self.check()?;
        self.rebuild()?;
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.0 });
        self.looked = false;
        Ok(())
    }

    fn begin(&mut self, _: f64) {}

    fn stable_step(&self) -> f64 {
        let [bulk, shear] = self.steps();
        self.options.cfl * bulk.min(shear)
    }

    fn bounding(&self) -> Bounding {
        let (o, [bulk, shear]) = (&self.options, self.steps());
        let (criterion, wave_speed) = match shear < bulk {
            true => (Criterion::ShearWave, o.shear_speed),
            false => (Criterion::Wave, o.bulk_speed),
        };
        let Limits { speed, acceleration, .. } = self.limits;
        Bounding { criterion, wave_speed, speed, acceleration }
    }

    fn at_bound(&self, _: &Bounding) -> Option<u32> {
        largest(&self.run, Quantity::Velocity)
    }

    fn reach(&self) -> Relist {
        Relist { positions: Quantity::Position, kernel: self.options.kernel, among: Among::All }
    }

    fn fields(&self) -> &'static [Quantity] {
        F::FIELDS
    }

    fn stiffness(&mut self) -> Option<Box<dyn Stiffness + '_>> {
        let h = self.options.kernel.h();
        Some(Box::new(Tangent::new(&self.formulation, &mut self.run, h)))
    }

    fn advance(&mut self, now: Now<f64>) -> Result<(), Diverged> {
        if self.left <= 0.0 {
            self.rebuild()?;
        }
        self.formulation.accelerate(&mut self.run, now);
        self.formulation.rates(&mut self.run, now);
        self.looked = false;
        self.left -= now.dt;
        self.check()
    }

    fn finish(&mut self, _: Now<f64>, _: f64) -> Result<(), Diverged> {
        Ok(())
    }

    fn save(&self) -> Vec<Part<'_>> {
        let [speed, acceleration, wave_speed] = self.limits.saved();
        let mut parts = run::save(&self.run);
        let listed = self.listed.iter().enumerate();
        parts.extend(listed.map(|(axis, x)| Part::column(format!("ListedPosition-{axis}"), x)));
        let numbers = [self.left, self.rebuilds as f64, speed, acceleration, wave_speed];
        parts.push(Part::numbers("integrator", &numbers));
        parts
    }

    fn restore(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        run::restore(&mut self.run, shelf)?;
        let len = self.run.particles().len();
        for axis in 0..D {
            self.listed[axis] = shelf.doubles(&format!("ListedPosition-{axis}"), len)?.into_owned();
        }
        self.list_again()?;
        let [left, rebuilds, limits @ ..] = shelf.numbers::<5>("integrator")?;
        let rebuilds = shelf.count("integrator", rebuilds)?;
        (self.left, self.rebuilds, self.limits) = (left, rebuilds, Limits::restored(limits));
        self.looked = false;
        Ok(())
    }

    fn holding(&self, held: &mut Held, dt: f64) -> Impulse {
        outside::holding(&self.run, (&self.midway(dt), dt), held)
    }

    fn pulling(&self, ids: &[u32], dt: f64) -> Impulse {
        outside::pulling(&self.run, (&self.midway(dt), dt), ids)
    }

    fn read(&self, field: Quantity, place: usize) -> [f64; 3] {
        let word = |field, i| self.run.word(field, i, place);
        let mut out = [0.0; 3];
        for i in 0..D {
            out[i] = match field {
                Quantity::Displacement => word(Quantity::Position, i) - word(Quantity::ReferencePosition, i),
                _ => word(field, i),
            };
        }
        out
    }

    fn word(&self, field: Quantity, word: usize, place: usize) -> f64 {
        self.run.word(field, word, place)
    }

    fn set_word(&mut self, field: Quantity, word: usize, at: (usize, f64)) {
        self.run.set_word(field, word, at);
    }

    fn rest_volume(&self, place: usize) -> f64 {
        self.scalar(Quantity::Mass, place) / self.scalar(Quantity::RestDensity, place)
    }

    fn configuration(&self, place: usize) -> [f64; 3] {
        self.read(Quantity::Position, place)
    }

    fn correct(&mut self, place: usize, change: Vector<f64, 3>, dt: f64) {
        let mass = self.scalar(Quantity::Mass, place);
        let half = |force: [f64; 3]| 0.5 * dt * mass * Vector(force).dot(change);
        let work = half(self.read(Quantity::BodyForce, place));
        let stored = half(self.read(Quantity::ShearAcceleration, place));
        let external = self.scalar(Quantity::ExternalWork, place) - work;
        self.set_word(Quantity::ExternalWork, 0, (place, external));
        let shear = self.scalar(Quantity::ShearWork, place) + stored;
        self.set_word(Quantity::ShearWork, 0, (place, shear));
    }

    fn look(&mut self) {
        if !std::mem::replace(&mut self.looked, true) {
            self.formulation.look(&mut self.run);
        }
    }

    fn state(&self, place: usize) -> State {
        self.formulation.state(&self.run, place, 0.0)
    }
}
