//! Position Verlet for a total Lagrangian body (TL section 3.4).

use super::Solver;
use super::limits::{Cause, Diverged, Limits, culprit};
use crate::field::Quantity;
use crate::formulation::{Formulation, State};
use crate::kernel::Kernel;
use crate::pass::Now;
use crate::run::{Among, Relist, Run};

/// Which wave speed the time step uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WaveSpeed {
    /// The longitudinal wave of the stretched material, seen in the reference metric. The default: Eq. (33) is not sufficient for
    /// large stretch.
    #[default]
    Stretch,
    /// sqrt(K/rho0), as in TL Eq. (33).
    Paper,
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
}

impl<const D: usize, F: Formulation<D>, R: Run<D>> Total<D, F, R> {
    /// A body whose particles carry the fields of `F` and are set up.
    pub fn new(formulation: F, run: R, options: TotalOptions) -> Self {
        Self { formulation, run, options, limits: Limits::default(), ahead: 0.0 }
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
        let bound = 10.0 * self.options.bulk_speed;
        if self.limits.finite && self.limits.speed < bound {
            return Ok(());
        }
        let not_finite = |_: usize, x: f64| !x.is_finite();
        let fast = |_: usize, x: f64| x.is_nan() || x.abs() >= bound / (D as f64).sqrt();
        let found = culprit(
            &self.run,
            &[
                (Quantity::WaveSpeedSquared, Cause::Inverted, &|_, x| x == f64::INFINITY),
                (Quantity::Velocity, Cause::NotFinite, &not_finite),
                (Quantity::Acceleration, Cause::NotFinite, &not_finite),
                (Quantity::WaveSpeedSquared, Cause::NotFinite, &not_finite),
                (Quantity::Velocity, Cause::Speed, &fast),
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
        let relist = Relist {
            positions: Quantity::ReferencePosition,
            kernel: self.options.kernel,
            among: Among::SameBody,
        };
        if self.run.relist(&relist).is_err() {
            let wrong = |_: usize, x: f64| !x.is_finite();
            let found = culprit(&self.run, &[(Quantity::ReferencePosition, Cause::NotFinite, &wrong)]);
            return Err(found.unwrap_or_else(Diverged::unlisted));
        }
        for i in 0..D {
            self.run.particles_mut().column_mut(Quantity::DeformationGradient, i * D + i).fill(1.0);
        }
        self.formulation.relisted(&mut self.run);
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.0 });
        self.check()
    }

    fn begin(&mut self, dt: f64) {
        self.formulation.rates(&mut self.run, Now { t: 0.0, dt: 0.5 * dt });
        self.ahead = 0.5 * dt;
    }

    fn stable_step(&self) -> f64 {
        let h = self.options.kernel.h();
        let c = match self.options.wave_speed {
            WaveSpeed::Stretch => self.limits.wave_speed,
            WaveSpeed::Paper => self.options.bulk_speed,
        };
        self.options.cfl * (h / (c + self.limits.speed)).min((h / self.limits.acceleration).sqrt())
    }

    fn advance(&mut self, now: Now<f64>) -> Result<(), Diverged> {
        self.formulation.accelerate(&mut self.run, now);
        self.check()
    }

    fn finish(&mut self, now: Now<f64>, next: f64) -> Result<(), Diverged> {
        self.formulation.rates(&mut self.run, Now { t: now.t, dt: 0.5 * (now.dt + next) });
        self.ahead = 0.5 * next;
        Ok(())
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
