//! Position Verlet for a total Lagrangian body (TL section 3.4).

mod relaxing;

use super::diverged::{Check, culprit, not_finite};
use super::limits::largest;
use super::outside::{self, Midway};
use super::relax::{self, Relax};
use super::spectrum::{Stiffness, highest};
use super::tangent::Tangent;
use super::{Bounding, Cause, Criterion, Diverged, Held, Impulse, Limits, Solver};
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::particles::saved::{Part, RestoreError, Shelf};
use crate::pass::Now;
use crate::run::{self, Among, Relist, Run, Sweeper};

/// Steps of the search for the largest eigenvalue.
const LANCZOS: usize = 40;

/// Which wave speed the time step uses.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum WaveSpeed {
    /// The longitudinal wave of the stretched material, seen in the reference metric. The default: Eq. (33) is not sufficient for
    /// large stretch.
    #[default]
    Stretch,
    /// sqrt(K/rho0), as in TL Eq. (33).
    Paper,
    /// That of a body whose operator does not change: the step is the Courant number times 2/sqrt(lambda), where lambda is the largest
    /// eigenvalue of the operator.
    Operator,
    /// The same, with a given step, s.
    Given(f64),
}

/// Settings of the integrator.
#[derive(Clone, Copy, Debug)]
pub struct TotalOptions {
    /// The kernel.
    pub kernel: Kernel,
    /// Courant number; 0.6 in the paper.
    pub cfl: f64,
    /// Which wave speed.
    pub wave_speed: WaveSpeed,
    /// sqrt(K/rho0), m/s.
    pub bulk_speed: f64,
}

/// A total Lagrangian body in time.
///
/// Two sweeps a step: the end of one step and the beginning of the next are one update, so that between steps F and u
/// stand half a step ahead of velocity; output takes that half step back.
#[derive(Debug)]
pub struct Total<const D: usize, F, R> {
    formulation: F,
    run: R,
    options: TotalOptions,
    limits: Limits,
    ahead: f64,
    /// The step of a body whose operator does not change, s.
    steady: Option<f64>,
    /// Squared wave speed at rest, m^2/s^2.
    at_rest: f64,
    /// Squared wave speed from which on particles are heavier; infinite for never.
    heavier_from: f64,
    /// Pairs one after the other, once they are wanted.
    sweeper: Option<Sweeper>,
}

impl<const D: usize, F: Formulation<D>, R: Run<D>> Total<D, F, R> {
    /// A body whose particles carry the fields of `F` and are set up.
    pub fn new(formulation: F, run: R, options: TotalOptions) -> Self {
        let limits = Limits::default();
        Self {
            formulation,
            run,
            options,
            limits,
            ahead: 0.0,
            steady: None,
            at_rest: 0.0,
            heavier_from: f64::INFINITY,
            sweeper: None,
        }
    }

    /// The run, to look at.
    pub fn run(&self) -> &R {
        &self.run
    }

    /// The run, to change fields from outside.
    pub fn run_mut(&mut self) -> &mut R {
        &mut self.run
    }

    fn check(&mut self) -> Result<(), Diverged> {
        self.limits = Limits::with_waves(&mut self.run);
        // A linear body has no speed that is too fast.
        let bound = if self.is_steady() { f64::INFINITY } else { 10.0 * self.options.bulk_speed };
        if self.limits.finite && self.limits.speed < bound {
            return Ok(());
        }
        let inverted = |_: usize, x: f64| (x == f64::INFINITY).then_some(0.0);
        // The largest component of a vector is at least its length over sqrt(D).
        let component = bound / (D as f64).sqrt();
        let fast = |_: usize, x: f64| (x.abs() >= component).then_some(component);
        let check = |field, cause, beyond| Check { field, cause, beyond };
        let found = culprit(
            &self.run,
            &[
                check(Quantity::WaveSpeedSquared, Cause::Inverted, &inverted),
                check(Quantity::Velocity, Cause::NotFinite, &not_finite),
                check(Quantity::Acceleration, Cause::NotFinite, &not_finite),
                check(Quantity::WaveSpeedSquared, Cause::NotFinite, &not_finite),
                check(Quantity::Velocity, Cause::Speed, &fast),
            ],
        );
        match found {
            Some(mut diverged) if diverged.cause == Cause::Inverted => {
                diverged.field = "det F";
                diverged.value = self.determinant(diverged.particle);
                Err(diverged)
            }
            Some(diverged) => Err(diverged),
            None => Ok(()),
        }
    }

    fn is_steady(&self) -> bool {
        matches!(self.options.wave_speed, WaveSpeed::Operator | WaveSpeed::Given(_))
    }

    /// 2/sqrt(lambda) of the operator, s; the time of a wave over a smoothing length where nothing is free to vibrate.
    fn critical(&mut self) -> f64 {
        let alone = self.options.kernel.h() / self.limits.wave_speed;
        let lambda = highest(&mut self.tangent(), LANCZOS);
        if lambda > 0.0 { 2.0 / lambda.sqrt() } else { alone }
    }

    /// What the body does against small displacements from where it is.
    pub fn tangent(&mut self) -> Tangent<'_, D, F, R> {
        Tangent::new(&self.formulation, &mut self.run, self.options.kernel.h())
    }

    fn wave_speed(&self) -> f64 {
        match self.options.wave_speed {
            WaveSpeed::Stretch if self.heavier_from.is_finite() => self.at_rest.sqrt(),
            WaveSpeed::Stretch | WaveSpeed::Operator | WaveSpeed::Given(_) => self.limits.wave_speed,
            WaveSpeed::Paper => self.options.bulk_speed,
        }
    }

    /// The two criteria of TL Eq. (33), before the Courant number: h/(c + |v|) and sqrt(h/|a|).
    fn steps(&self) -> [f64; 2] {
        let h = self.options.kernel.h();
        [h / (self.wave_speed() + self.limits.speed), (h / self.limits.acceleration).sqrt()]
    }

    /// Between `advance` and `finish` displacements stand midway in the step.
    fn midway(&self) -> Midway<'_, D> {
        let field = |field| outside::columns(&self.run, field);
        Midway { base: field(Quantity::ReferencePosition), way: field(Quantity::Displacement), share: 1.0 }
    }

    fn determinant(&self, id: u32) -> f64 {
        let p = self.run.particles();
        let place = p.ids().iter().position(|&i| i == id).unwrap_or(0);
        let f = crate::math::Tensor::<f64, D>::from_fn(|i, j| {
            self.run.word(Quantity::DeformationGradient, i * D + j, place)
        });
        f.det()
    }
}

impl<const D: usize, F: Formulation<D>, R: Run<D>> Solver for Total<D, F, R> {
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
        1
    }

    fn start(&mut self) -> Result<(), Diverged> {
        if self.run.relist(&self.reach()).is_err() {
            let (field, cause) = (Quantity::ReferencePosition, Cause::NotFinite);
            let found = culprit(&self.run, &[Check { field, cause, beyond: &not_finite }]);
            return Err(found.unwrap_or_else(Diverged::unlisted));
        }
        for i in (0..D).filter(|_| F::FIELDS.contains(&Quantity::DeformationGradient)) {
            self.run.particles_mut().column_mut(Quantity::DeformationGradient, i * D + i).fill(1.0);
        }
        self.formulation.relisted(&mut self.run);
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.0 });
        self.check()?;
        self.at_rest = self.limits.wave_speed * self.limits.wave_speed;
        self.steady = match self.options.wave_speed {
            WaveSpeed::Operator => Some(self.options.cfl * self.critical()),
            WaveSpeed::Given(dt) => Some(dt),
            WaveSpeed::Stretch | WaveSpeed::Paper => None,
        };
        Ok(())
    }

    fn begin(&mut self, dt: f64) {
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.5 * dt });
        self.ahead = 0.5 * dt;
    }

    fn stable_step(&self) -> f64 {
        if let Some(dt) = self.steady {
            return dt;
        }
        let [wave, acceleration] = self.steps();
        self.options.cfl * wave.min(acceleration)
    }

    fn bounding(&self) -> Bounding {
        let [wave, acceleration] = self.steps();
        Bounding {
            criterion: match self.steady {
                Some(_) => Criterion::Operator,
                None if acceleration < wave => Criterion::Acceleration,
                None => Criterion::Wave,
            },
            wave_speed: self.wave_speed(),
            speed: self.limits.speed,
            acceleration: self.limits.acceleration,
        }
    }

    fn at_bound(&self, bounding: &Bounding) -> Option<u32> {
        if self.steady.is_some() {
            return None;
        }
        let waves = self.options.wave_speed == WaveSpeed::Stretch && bounding.wave_speed >= bounding.speed;
        let field = match bounding.criterion {
            Criterion::Acceleration => Quantity::Acceleration,
            _ if waves => Quantity::WaveSpeedSquared,
            _ => Quantity::Velocity,
        };
        largest(&self.run, field)
    }

    fn reach(&self) -> Relist {
        Relist { positions: Quantity::ReferencePosition, kernel: self.options.kernel, among: Among::SameBody }
    }

    fn fields(&self) -> &'static [Quantity] {
        F::FIELDS
    }

    fn displace(&mut self, u: &[f64]) {
        let still = |run: &mut R, v: &dyn Fn(usize) -> f64| {
            (0..u.len()).for_each(|i| run.set_word(Quantity::Velocity, i % D, (i / D, v(i))));
        };
        still(&mut self.run, &|i| u[i]);
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 1.0 });
        still(&mut self.run, &|_| 0.0);
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.0 });
    }

    fn stiffness(&mut self) -> Option<Box<dyn Stiffness + '_>> {
        Some(Box::new(self.tangent()))
    }

    fn advance(&mut self, now: Now<f64>) -> Result<(), Diverged> {
        self.formulation.accelerate(&mut self.run, now);
        if self.heavier_from.is_finite() {
            relax::even_out(&mut self.run, self.heavier_from, now.dt);
        }
        self.check()
    }

    fn finish(&mut self, now: Now<f64>, next: f64) -> Result<(), Diverged> {
        self.formulation.rates(&mut self.run, Now { t: now.t, dt: 0.5 * (now.dt + next) });
        self.ahead = 0.5 * next;
        Ok(())
    }

    fn save(&self) -> Vec<Part<'_>> {
        let [speed, acceleration, wave_speed] = self.limits.saved();
        let mut parts = run::save(&self.run);
        parts.push(Part::numbers("integrator", &[self.ahead, speed, acceleration, wave_speed]));
        parts
    }

    fn restore(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        // The list is that of the start: of the reference configuration, with the volumes of the set-up.
        let ids = self.run.particles().ids().to_vec();
        run::restore(&mut self.run, shelf)?;
        if ids != self.run.particles().ids() {
            return Err(RestoreError::Foreign("they were stored in another order"));
        }
        let [ahead, limits @ ..] = shelf.numbers::<4>("integrator")?;
        (self.ahead, self.limits) = (ahead, Limits::restored(limits));
        Ok(())
    }

    fn holding(&self, held: &mut Held, dt: f64) -> Impulse {
        outside::holding(&self.run, (&self.midway(), dt), held)
    }

    fn pulling(&self, ids: &[u32], dt: f64) -> Impulse {
        outside::pulling(&self.run, (&self.midway(), dt), ids)
    }

    fn relax(&mut self) -> Option<&mut dyn Relax> {
        Some(self)
    }

    fn read(&self, field: Quantity, place: usize) -> [f64; 3] {
        let word = |field, i| self.run.word(field, i, place);
        let mut out = [0.0; 3];
        for i in 0..D {
            out[i] = match field {
                Quantity::Displacement => word(field, i) - self.ahead * word(Quantity::Velocity, i),
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

    fn configuration(&self, place: usize) -> [f64; 3] {
        let word = |field, i| self.run.word(field, i, place);
        let at = |i| word(Quantity::ReferencePosition, i) + word(Quantity::Displacement, i);
        std::array::from_fn(|i| if i < D { at(i) } else { 0.0 })
    }

    fn state(&self, place: usize) -> State {
        self.formulation.state(&self.run, place, self.ahead)
    }
}
