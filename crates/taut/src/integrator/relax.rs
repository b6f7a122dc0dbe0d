//! What brings a total Lagrangian body to rest: the exchange of the splitting damping, the stops of kinetic damping, scaled masses,
//! and how far it is from equilibrium.

use super::Impulse;
use crate::field::{Of, Quantity};
use crate::math::{Real, Vector};
use crate::pass::{Fold, Now, PairSweep, Reduce, Update};
use crate::run::Run;

/// A solver that can be brought to rest.
pub trait Relax {
    /// Damps velocities pair by pair as the viscosity (Pa s) would in `dt` (s), implicitly: stable for any. The impulse that the body has
    /// gained: from held particles, and a moment, since what a pair exchanges is not along its line.
    fn exchange(&mut self, viscosity: f64, dt: f64) -> Impulse;
    /// Takes all velocities of free components; what they held counts as dissipated.
    fn rest(&mut self);
    /// Takes this share of the velocities of free components, up to 1; it counts as dissipated. The impulse that the body has gained.
    fn slow(&mut self, taken: f64) -> Impulse;
    /// From now on stretched particles are as much heavier as they carry faster waves than at rest, so that they do not shorten the step.
    fn even_out(&mut self);
    /// Multiplies all prescribed velocities.
    fn pace(&mut self, factor: f64);
    /// How far it is from equilibrium.
    fn unrest(&mut self) -> Unrest;
    /// The longest stretch of the undeformed body along an axis, m.
    fn extent(&self) -> f64;
    /// Speed of waves at rest, m/s.
    fn wave_speed(&self) -> f64;
}

/// How far a body is from equilibrium: sums over its particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unrest {
    /// Sum of (m a)^2 / V over the free components, N^2/m^3.
    pub force: f64,
    /// Sum of V Q:Q, Pa^2 m^3, where Q is what particles hand over as stress.
    pub stress: f64,
    /// The energy that goes with it, V Q:Q / (2 rho0 c^2) with the wave speed at rest, J.
    pub elastic: f64,
    /// Kinetic energy of the free components, J.
    pub kinetic: f64,
    /// Largest speed of prescribed components, m/s.
    pub driven: f64,
}

record! {
    /// What an exchange needs to know.
    Heavy { m: Mass, volume: Volume, free: Free }
    /// What it changes.
    Moving { v: Velocity, dissipated: Dissipated, work: ExternalWork }
    /// A particle that comes to rest.
    Slow { v: Velocity, m: Mass, free: Free, c2: WaveSpeedSquared, dissipated: Dissipated }
    /// A particle at rest.
    Stopped { v: Velocity, dissipated: Dissipated }
    /// A particle just kicked.
    Kicked { v: Velocity, a: Acceleration, free: Free, c2: WaveSpeedSquared }
    /// Its velocity.
    Velocities { v: Velocity }
    /// Prescribed velocity.
    Driven { given: PrescribedVelocity }
    /// What equilibrium is judged by.
    Loaded {
        c2: WaveSpeedSquared,
        v: Velocity, a: Acceleration, m: Mass, volume: Volume, free: Free, given: PrescribedVelocity, q: NominalStress,
    }
}

/// Momentum exchanged as by the Laplacian 2 eta sum_b |W'|/r V_b (v_b - v_a), each pair by an implicit step of its own:
/// J = k v_ab / (1 + k (1/m_a + 1/m_b)), k = eta |W'|/r V_a V_b dt (methods of TL ref. 68). Held components have infinite mass; what they
/// give is work of the constraint.
pub struct Exchange {
    /// Viscosity times time, Pa s^2.
    pub eta_dt: f64,
}

impl<const D: usize> PairSweep<D> for Exchange {
    type Given = Heavy<f64, D>;
    type State = Moving<f64, D>;

    fn exchange(
        &self,
        (a, b): (&Heavy<f64, D>, &Heavy<f64, D>),
        (mut u, mut v): (Moving<f64, D>, Moving<f64, D>),
        w: f64,
    ) -> (Moving<f64, D>, Moving<f64, D>) {
        let k = -self.eta_dt * w * a.volume * b.volume;
        for i in 0..D {
            let (light_a, light_b) = (a.free[i] / a.m, b.free[i] / b.m);
            let apart = u.v[i] - v.v[i];
            let impulse = k * apart / (1.0 + k * (light_a + light_b));
            u.work -= (a.free[i] - 1.0) * impulse * u.v[i];
            v.work += (b.free[i] - 1.0) * impulse * v.v[i];
            u.v[i] -= impulse * light_a;
            v.v[i] += impulse * light_b;
            let lost = 0.25 * impulse * (apart + u.v[i] - v.v[i]);
            u.dissipated += lost;
            v.dissipated += lost;
        }
        (u, v)
    }
}

/// How much heavier a particle is than its mass says: mu = max(1, c^2/c_0^2) with the wave speed at rest; 1 for an infinite c_0.
#[derive(Clone, Copy)]
struct Scale {
    /// c_0^2, m^2/s^2.
    at_rest: f64,
}

impl Scale {
    #[inline(always)]
    fn of<S: Real>(self, c2: S) -> S {
        (c2 * S::of(1.0 / self.at_rest)).max(S::one())
    }
}

/// v -= taken v where free.
struct Rest {
    scale: Scale,
    /// The share that is taken, up to 1.
    taken: f64,
}

impl<const D: usize> Update<D> for Rest {
    type Sum = ();
    type Reads = Slow<f64, D>;
    type Writes = Stopped<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Slow<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        let moving = Vector::from_fn(|i| a.v[i] * a.free[i] * S::of(self.taken));
        let lost = self.scale.of(a.c2) * a.m * (moving.dot(a.v) - moving.norm_squared() * S::of(0.5));
        Stopped { v: a.v - moving, dissipated: a.dissipated + lost }
    }
}

/// v -= dt a (1 - 1/mu): the kick of a mass that is mu times larger.
struct EvenOut(Scale);

impl<const D: usize> Update<D> for EvenOut {
    type Sum = ();
    type Reads = Kicked<f64, D>;
    type Writes = Velocities<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Kicked<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let back = now.dt * (S::one() / self.0.of(a.c2) - S::one());
        Velocities { v: Vector::from_fn(|i| (back * a.free[i]).mul_add(a.a[i], a.v[i])) }
    }
}

/// Prescribed velocities times a factor.
struct Pace(f64);

impl<const D: usize> Update<D> for Pace {
    type Sum = ();
    type Reads = Driven<f64, D>;
    type Writes = Driven<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Driven<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        Driven { given: a.given.times(S::of(self.0)) }
    }
}

/// The sums of [`Unrest`].
struct Judge {
    scale: Scale,
    /// Square of a stress that is none, Pa^2: without load, rounding is not to be judged by rounding.
    floor: f64,
}

impl<const D: usize> Reduce<D, 4> for Judge {
    type Reads = Loaded<f64, D>;
    const FOLDS: [Fold; 4] = [Fold::Sum, Fold::Sum, Fold::Sum, Fold::Max];

    #[inline(always)]
    fn at<S: Real>(&self, p: &Of<Self::Reads, S, D>) -> [S; 4] {
        let free = |x: Vector<S, D>| Vector::<S, D>::from_fn(|i| x[i] * p.free[i]);
        let held = Vector::<S, D>::from_fn(|i| p.given[i] * (S::one() - p.free[i]));
        let force = free(p.a).norm_squared() * p.m * p.m / p.volume;
        let kinetic = free(p.v).norm_squared() * p.m * self.scale.of(p.c2) * S::of(0.5);
        let stress = p.volume * (p.q.double_dot(p.q) + S::of(self.floor));
        [force, stress, kinetic, held.norm_squared()]
    }
}

/// Momentum and angular momentum, kg m/s and kg m^2/s, with displacements as they stand.
pub fn momentum<const D: usize>(run: &impl Run<D>) -> Impulse {
    let mut sum = Impulse::default();
    for place in 0..run.particles().len() {
        let vector = |field| std::array::from_fn(|i| if i < D { run.word(field, i, place) } else { 0.0 });
        let (x, u): ([f64; 3], [f64; 3]) =
            (vector(Quantity::ReferencePosition), vector(Quantity::Displacement));
        let m = run.word(Quantity::Mass, 0, place);
        sum.push(std::array::from_fn(|i| x[i] + u[i]), vector(Quantity::Velocity).map(|v: f64| m * v));
    }
    sum
}

/// All velocities of free components gone. `at_rest` is the squared wave speed of masses that are not scaled, here and below; infinite if
/// none is.
pub fn rest<const D: usize>(run: &mut impl Run<D>, at_rest: f64) {
    run.each(&Rest { scale: Scale { at_rest }, taken: 1.0 }, Now { t: 0.0, dt: 0.0 });
}

/// A share of all velocities of free components gone.
pub fn slow<const D: usize>(run: &mut impl Run<D>, taken: f64) {
    run.each(&Rest { scale: Scale { at_rest: f64::INFINITY }, taken }, Now { t: 0.0, dt: 0.0 });
}

/// The last kick of `dt` as that of scaled masses.
pub fn even_out<const D: usize>(run: &mut impl Run<D>, at_rest: f64, dt: f64) {
    run.each(&EvenOut(Scale { at_rest }), Now { t: 0.0, dt });
}

/// Prescribed velocities times a factor.
pub fn pace<const D: usize>(run: &mut impl Run<D>, factor: f64) {
    run.each(&Pace(factor), Now { t: 0.0, dt: 0.0 });
}

/// How far a body of this stiffness rho0 c^2 (Pa) at rest is from equilibrium.
pub fn unrest<const D: usize>(run: &mut impl Run<D>, at_rest: f64, stiffness: f64) -> Unrest {
    let judge = Judge { scale: Scale { at_rest }, floor: (1e-9 * stiffness).powi(2) };
    let [force, stress, kinetic, driven] = run.reduce(&judge);
    Unrest { force, stress, elastic: 0.5 * stress / stiffness, kinetic, driven: driven.max(0.0).sqrt() }
}

/// The longest stretch of the reference positions along an axis, m.
pub fn extent<const D: usize>(run: &impl Run<D>) -> f64 {
    let length = |column: &[f64]| {
        let low = column.iter().copied().fold(f64::INFINITY, f64::min);
        column.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
    };
    run.particles().vector(Quantity::ReferencePosition).into_iter().map(length).fold(0.0, f64::max)
}
