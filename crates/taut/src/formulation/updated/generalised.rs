//! The generalised non-hourglass formulation, `ul-generalised` (Zhang, Wu, Lourenco and Hu 2025), for elastic solids.

use super::accumulated::{AlongPairs, HalfLaplacian};
use super::integrated::Rates;
use super::kick::{Kick, Push};
use super::motion::{Drift, MomentSum};
use super::pressure::damp;
use super::shear_law::{Increment, ShearLaw};
use super::{FIELDS, ShearTensor, joined, same_body};
use crate::correction::Invert;
use crate::field::{Of, Quantity};
use crate::formulation::{Formulation, State};
use crate::material::Moduli;
use crate::math::{Real, Tensor, Vector};
use crate::pass::{Fold, Now, Pair, PairSum, Reduce, Update};
use crate::run::Run;

/// The nested form, and A, a shear acceleration that is accumulated from what the gradients of velocity do not tell of the difference of
/// velocities in a pair:
///
/// dA/dt = w x A + (M/rho) sum_b \[(v_ab - (L_a + L_b)/2 . x_ab) . e / r\] grad W V_b inside the body.
///
/// M = K + 4/3 G, which is ours: the published xi G, with xi = 4, is as stiff where nu is 1/3. What gradients do not tell are rows that part or close up, and
/// that is resisted by the bulk modulus too: where K is 50 G and a plate is stretched over its clamp, 4 G and 16 G let it tear.
///
/// It vanishes for every linear field, so that moduli are those of the nested part: exact, since strain and force are both corrected by B. What is carried (s, by its
/// law, and A) turns with the particle, A by (1 - w dt/2)^-1 (1 + w dt/2), a rotation (Hughes and Winget 1980), so that a rigid motion leaves
/// no stress, however long it lasts. Between two lists everything is referred to the positions of the list by F, the deformation since then, which is ours: the
/// published form takes gradients of the list for present ones, and a spin swells it a little with every list.
///
/// Turning A particle by particle leaves a small resultant, which is given back to its body in equal shares of mass (ours as well): momentum is exact.
#[derive(Clone, Copy, Debug)]
pub struct Generalised<L> {
    /// The shear stress.
    pub stress: L,
    /// How many bodies there are.
    pub bodies: u32,
}

impl<L: ShearLaw> Generalised<L> {
    /// With this law.
    #[must_use]
    pub const fn new(stress: L, bodies: u32) -> Self {
        Self { stress, bodies }
    }

    /// sqrt(M (1 + 3 / (2 (d + 2))) / rho0), m/s: the wave of the nested part and that of the control, which is half as much as UL Eq. (19)
    /// with zeta G = M. Long waves have the first, short ones the second.
    #[must_use]
    pub fn shear_speed(&self, moduli: &Moduli, dimension: usize) -> f64 {
        let control = 1.5 / (dimension as f64 + 2.0);
        (longitudinal(moduli.bulk, moduli.shear) * (1.0 + control) / moduli.density).sqrt()
    }
}

/// K + 4/3 G, Pa.
#[inline(always)]
fn longitudinal<S: Real>(bulk: S, shear: S) -> S {
    shear.mul_add(S::of(4.0 / 3.0), bulk)
}

record! {
    /// What turns and deforms with a particle.
    Carried { f: DeformationGradient, s: ShearStress, axial: AxialShearStress, shear: ShearAcceleration }
    /// The same, with what the next half of a step makes of it.
    Carrying {
        f: DeformationGradient, s: ShearStress, axial: AxialShearStress, shear: ShearAcceleration,
        rate: DeformationRate, g: ShearModulus, p: Pressure, correction: Correction,
        density: Density, rest: RestDensity,
    }
    /// Carried by half a step, with the stress that is handed to neighbours.
    Stressed {
        f: DeformationGradient, s: ShearStress, axial: AxialShearStress, shear: ShearAcceleration, q: NominalStress,
    }
    /// What the force needs.
    Pressed { x: Position, v: Velocity, p: Pressure, z: Impedance, q: NominalStress, body: Body }
    /// What the rates need.
    Flow { v: Velocity, p: Pressure, body: Body }
    /// A particle before.
    Before {
        f: DeformationGradient, s: ShearStress, axial: AxialShearStress, shear: ShearAcceleration,
        density: Density, g: ShearModulus, correction: Correction,
    }
    /// A particle after.
    After {
        f: DeformationGradient, s: ShearStress, axial: AxialShearStress, shear: ShearAcceleration,
        density: Density, density_rate: DensityRate, rate: DeformationRate,
    }
    /// What the control needs.
    Bent { v: Velocity, l: DeformationRate, body: Body }
    /// The sum of the control.
    Control { g: ControlForce }
    /// A particle whose A grows.
    Growing { m: Mass, volume: Volume, g: ShearModulus, c0: SoundSpeed, rest: RestDensity, shear: ShearAcceleration }
    /// Its A.
    Grown { shear: ShearAcceleration }
    /// What a new list refers to.
    Referred { f: DeformationGradient, rate: DeformationRate }
    /// A share of a resultant.
    Share { m: Mass, shear: ShearAcceleration, body: Body }
}

impl<L: ShearLaw> Generalised<L> {
    /// What is carried, after `time` with the rate dF/dt: strain and spin from the middle of the way.
    #[inline(always)]
    fn carry<S: Real, const D: usize>(
        &self,
        from: Carried<S, D>,
        (rate, g): (Tensor<S, D>, S),
        time: S,
    ) -> Carried<S, D> {
        let change = rate.times(time);
        let gradient = change.mul(from.f.plus(S::of(0.5), change).inverse());
        let turn = gradient.antisymmetric().times(S::of(0.5)).rotation();
        let f = change.mul(from.f.inverse()).plus_diagonal(S::one());
        let before = ShearTensor { s: from.s, axial: from.axial };
        let ShearTensor { s, axial } = self.stress.carried(before, &Increment { gradient, turn, f }, g);
        Carried { f: from.f + change, s, axial, shear: turn.mul_vector(from.shear) }
    }
}

/// The first half of a step, and Q = J (s - p 1) F^-T B.
struct Carry<'a, L>(&'a Generalised<L>);

impl<L: ShearLaw, const D: usize> Update<D> for Carry<'_, L> {
    type Sum = ();
    type Reads = Carrying<f64, D>;
    type Writes = Stressed<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Carrying<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let from = Carried { f: a.f, s: a.s, axial: a.axial, shear: a.shear };
        let Carried { f, s, axial, shear } = self.0.carry(from, (a.rate, a.g), now.dt * S::of(0.5));
        let cauchy = self.0.stress.cauchy(ShearTensor { s, axial }, a.density / a.rest);
        let q = cauchy.s.plus_diagonal(-a.p).mul(f.cofactor()).mul(a.correction);
        Stressed { f, s, axial, shear, q }
    }
}

/// The force sum: (Q_a + Q_b) . grad W V_b inside a body, pressure between bodies, dissipation everywhere. Bodies push and do not pull: two rings
/// that part would hold on to each other with the tension of their surfaces.
struct Momentum;

impl<const D: usize> PairSum<D> for Momentum {
    type Reads = Pressed<f64, D>;
    type Adds = Push<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Push<S, D>,
        (a, b): (&Pressed<S, D>, &Pressed<S, D>),
        ab: &Pair<S, D, M>,
        now: &Now<S>,
    ) {
        let inside = same_body(a.body, b.body);
        let z = (a.z + b.z) * S::of(0.5);
        let half = now.dt * S::of(0.5);
        damp((&mut sum.f, &mut sum.power), (a.v - b.v, a.x - b.x, half), (z, ab));
        ab.gradient(&mut sum.f, (a.p + b.p).max(S::zero()) * (inside - S::one()));
        ab.dot(&mut sum.f, (a.q + b.q).times(inside));
    }
}

/// Compression by other bodies, and the gradient of velocity inside of the own one. Bodies that part with no pressure between them do not
/// expand each other, as they do not pull: what is stored in pressure is what forces have put in.
struct RateSum;

impl<const D: usize> PairSum<D> for RateSum {
    type Reads = Flow<f64, D>;
    type Adds = Rates<f64, D>;
    const DIRECTED: bool = false;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Rates<S, D>,
        (a, b): (&Flow<S, D>, &Flow<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let (v, inside) = (a.v - b.v, same_body(a.body, b.body));
        let approach = S::select(v.dot(ab.x).lt(S::zero()), S::one(), S::zero());
        let met = S::select(S::zero().lt(a.p + b.p), S::one(), approach);
        ab.divergence(&mut sum.compression, v.times((S::one() - inside) * met));
        ab.outer(&mut sum.l, v.times(-inside));
    }
}

/// New rates, and the second half of the step with them.
struct Follow<'a, L>(&'a Generalised<L>);

impl<L: ShearLaw, const D: usize> Update<D> for Follow<'_, L> {
    type Sum = Rates<f64, D>;
    type Reads = Before<f64, D>;
    type Writes = After<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Rates<S, D>, a: &Before<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let half = now.dt * S::of(0.5);
        let rate = sum.l.mul(a.correction);
        let from = Carried { f: a.f, s: a.s, axial: a.axial, shear: a.shear };
        let Carried { f, s, axial, shear } = self.0.carry(from, (rate, a.g), half);
        let compression = sum.compression - rate.mul(f.inverse()).trace();
        let density_rate = a.density * compression;
        let density = half.mul_add(density_rate, a.density);
        After { f, s, axial, shear, density, density_rate, rate }
    }
}

/// sum_b \[(v_ab - (L_a + L_b)/2 . x_ab) . e\] e w inside the body.
struct ControlSum;

impl<const D: usize> PairSum<D> for ControlSum {
    type Reads = Bent<f64, D>;
    type Adds = Control<f64, D>;
    const DIRECTED: bool = true;

    #[inline(always)]
    fn add<S: Real, const M: u8>(
        &self,
        sum: &mut Control<S, D>,
        (a, b): (&Bent<S, D>, &Bent<S, D>),
        ab: &Pair<S, D, M>,
        _: &Now<S>,
    ) {
        let untold = (a.v - b.v).plus(S::of(-0.5), (a.l + b.l).mul_vector(ab.x));
        AlongPairs::add(&mut sum.g, (untold, same_body(a.body, b.body)), ab);
    }
}

/// A grows by dt M V/m times the sum.
struct Grow;

impl<const D: usize> Update<D> for Grow {
    type Sum = Control<f64, D>;
    type Reads = Growing<f64, D>;
    type Writes = Grown<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, sum: &Control<S, D>, a: &Growing<S, D>, now: &Now<S>) -> Of<Self::Writes, S, D> {
        let stiffness = longitudinal(a.rest * a.c0 * a.c0, a.g) * (a.volume / a.m);
        Grown { shear: a.shear.plus(now.dt * stiffness, sum.g) }
    }
}

/// F = 1 at a new list, and its rate the gradient of velocity there.
struct Refer;

impl<const D: usize> Update<D> for Refer {
    type Sum = ();
    type Reads = Referred<f64, D>;
    type Writes = Referred<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Referred<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        // At the very first there is no F yet, nor a rate.
        let known = S::of(0.5).lt(a.f.det());
        let gradient = a.rate.mul(a.f.inverse());
        let rate = Tensor::from_fn(|i, j| S::select(known, gradient[i][j], S::zero()));
        Referred { f: Tensor::diagonal(S::one()), rate }
    }
}

/// sum m A of a body, in three components, and its mass.
struct Resultant(u32);

impl<const D: usize> Reduce<D, 4> for Resultant {
    type Reads = Share<f64, D>;
    const FOLDS: [Fold; 4] = [Fold::Sum; 4];

    #[inline(always)]
    fn at<S: Real>(&self, a: &Of<Self::Reads, S, D>) -> [S; 4] {
        let m = a.m * same_body(a.body, S::of(f64::from(self.0)));
        let force = a.shear.times(m);
        [0, 1, 2, 3].map(|k| match k {
            3 => m,
            _ if k < D => force[k],
            _ => S::zero(),
        })
    }
}

/// Takes an acceleration from the particles of a body.
struct Settle(u32, [f64; 3]);

impl<const D: usize> Update<D> for Settle {
    type Sum = ();
    type Reads = Share<f64, D>;
    type Writes = Grown<f64, D>;

    #[inline(always)]
    fn at<S: Real>(&self, (): &(), a: &Share<S, D>, _: &Now<S>) -> Of<Self::Writes, S, D> {
        let mine = same_body(a.body, S::of(f64::from(self.0)));
        Grown { shear: a.shear.plus(-mine, Vector::from_fn(|k| S::of(self.1[k]))) }
    }
}

impl<L: ShearLaw, const D: usize> Formulation<D> for Generalised<L> {
    const FIELDS: &'static [Quantity] = &joined::<{ FIELDS.len() + 3 }>(
        FIELDS,
        &[Quantity::DeformationGradient, Quantity::DeformationRate, Quantity::NominalStress],
    );

    fn relisted(&self, run: &mut impl Run<D>) {
        let now = Now { t: 0.0, dt: 0.0 };
        run.each(&Refer, now);
        run.pairs(&MomentSum, &Invert, now);
    }

    fn accelerate(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.each(&Drift, now);
        run.each(&Carry(self), now);
        for body in 0..self.bodies {
            let [x, y, z, mass] = run.reduce(&Resultant(body));
            if mass > 0.0 {
                run.each(&Settle(body, [x, y, z].map(|force| force / mass)), now);
            }
        }
        run.pairs(&Momentum, &Kick, now);
    }

    fn rates(&self, run: &mut impl Run<D>, now: Now<f64>) {
        run.pairs(&RateSum, &Follow(self), now);
        run.pairs(&ControlSum, &Grow, now);
    }

    fn state(&self, run: &impl Run<D>, place: usize, _: f64) -> State {
        let word = |field, k| run.word(field, k, place);
        let s = Tensor::<f64, D>::from_fn(|i, j| word(Quantity::ShearStress, i * D + j));
        let carried = ShearTensor { s, axial: word(Quantity::AxialShearStress, 0) };
        let rest = word(Quantity::RestDensity, 0);
        let ratio = word(Quantity::Density, 0) / rest;
        let stored = self.stress.energy(carried, ratio, word(Quantity::ShearModulus, 0));
        let energy = stored * word(Quantity::Mass, 0) / rest + word(Quantity::ShearWork, 0);
        let cauchy = self.stress.cauchy(carried, ratio);
        super::state(run, place, (cauchy.s.lift(cauchy.axial), energy))
    }
}
