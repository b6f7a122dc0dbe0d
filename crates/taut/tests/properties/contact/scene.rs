//! Two bodies that meet.

use crate::common::points::{Noise, block};
use crate::common::{Form, Setup};
use taut::contact::{Contact, Meeting, stiffness};
use taut::math::{Tensor, Vector};
use taut::simulation::{Motion, Point, Pose, Rigid, Simulation, Solver};

pub const DP: f64 = 0.002;

/// A body of a formulation, or a rigid one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Of(Form),
    Rigid,
}

/// All pairs of which one at least has no pairs with the other.
pub fn pairings() -> Vec<(Kind, Kind)> {
    use Form::{HourglassFree, NonHourglass, TotalNested, UpdatedNested};
    let of = Kind::Of;
    vec![
        (of(HourglassFree), of(HourglassFree)),
        (of(TotalNested), of(HourglassFree)),
        (of(HourglassFree), of(NonHourglass)),
        (of(UpdatedNested), of(TotalNested)),
        (of(HourglassFree), Kind::Rigid),
        (of(NonHourglass), Kind::Rigid),
    ]
}

/// Moves along a line at a constant speed.
pub struct Straight(pub Vector<f64, 3>);

impl Motion for Straight {
    fn pose(&self, t: f64) -> Pose {
        Pose { centre: Vector::zero(), rotation: Tensor::diagonal(1.0), displacement: self.0.times(t) }
    }
}

/// Speed of each of two bodies towards the other, over the sound speed.
pub const SPEED: f64 = 0.05;

/// Two blocks with disordered surfaces that meet askew: the first moves up, the second down and aside.
pub fn blocks<const D: usize>(disorder: f64) -> [Vec<Point<D>>; 2] {
    let c = Setup::new(DP).moduli.sound_speed();
    let mut noise = Noise(3);
    let mut block = |body: u32, rise: f64, v: Vector<f64, D>| {
        let mut n = [6; D];
        n[1] = 5;
        let mut points = block::<D>(n, DP);
        for p in &mut points {
            p.x = p.x.plus(disorder * DP, noise.vector());
            p.x[1] += rise;
            p.x[0] += 0.7 * rise / 5.0;
            (p.v, p.body) = (v, body);
        }
        points
    };
    let mut up = Vector::zero();
    up[1] = SPEED * c;
    let mut down = Vector::zero();
    (down[1], down[0]) = (-SPEED * c, 0.4 * SPEED * c);
    [block(0, 0.0, up), block(1, 5.3 * DP, down)]
}

pub fn solver<const D: usize>(kind: Kind, points: &[Point<D>]) -> Box<dyn Solver> {
    match kind {
        Kind::Of(form) => Setup::new(DP).body(form, points),
        Kind::Rigid => {
            let padded = |x: Vector<f64, D>| std::array::from_fn(|k| if k < D { x[k] } else { 0.0 });
            let motion = Straight(Vector(padded(points[0].v)));
            let placed = points.iter().map(|p| (padded(p.x), p.volume));
            Box::new(Rigid::new(D, points[0].body, placed, Box::new(motion)))
        }
    }
}

/// The contact of two bodies of one material, or of one with a rigid body.
pub fn meeting(kinds: (Kind, Kind), friction: f64) -> Meeting {
    let modulus = |kind| (kind != Kind::Rigid).then(|| Setup::new(DP).moduli.bulk);
    Meeting { bodies: [0, 1], stiffness: stiffness(modulus(kinds.0), modulus(kinds.1)), friction }
}

pub fn simulation<const D: usize>(
    kinds: (Kind, Kind),
    bodies: &[Vec<Point<D>>; 2],
    friction: f64,
) -> Simulation {
    let solvers = vec![solver(kinds.0, &bodies[0]), solver(kinds.1, &bodies[1])];
    let contact = Contact::new(&[meeting(kinds, friction)], DP, D);
    let mut simulation = Simulation::new(solvers, vec![]).touching(Some(contact));
    simulation.begin().expect("finite");
    simulation
}
