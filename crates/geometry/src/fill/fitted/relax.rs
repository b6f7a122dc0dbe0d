//! Particles settle: they move down the slope of the energy sum_ab V_a V_b W_ab / 2 + sum_a V_a (integral of W over the outside).

use super::grid::{Grid, Outside};
use super::kernel::Kernel;
use super::lists::{CHUNK, Lists};
use super::wall::{Wall, Walls};
use crate::fill::Points;
use crate::point::{Point, add, dot, norm, scale, sub};
use rayon::prelude::*;

/// Steps after which it is given up.
const MOST_STEPS: usize = 2000;

/// At rest when the residual times the spacing is below this, as root mean square: a fifth of what a box full of lattice has, whose outside is
/// counted in cells of half a spacing.
const REST: f64 = 2e-3;

/// It is given up too when so many steps have not brought the residual down by a tenth.
const PATIENCE: usize = 300;

/// How far a particle may be from where its surroundings were looked at, in spacings: what is left out is of second order.
const VALID: f64 = 0.1;

/// By how much lists reach farther than the kernel, in spacings.
const SKIN: f64 = 0.3;

/// The farthest a particle moves in a step, in spacings.
const STRIDE: f64 = 0.1;

/// The largest share of the last step that is kept up.
const MOMENTUM: f64 = 0.95;

/// What particles settle in.
pub(super) struct Basin<'a> {
    pub(super) walls: &'a Walls<'a>,
    pub(super) grid: &'a Grid,
    pub(super) kernel: Kernel,
    pub(super) spacing: f64,
    /// Volume of a particle.
    pub(super) volume: f64,
}

/// What is around a particle, as it was at a place near by.
#[derive(Clone, Copy)]
pub(super) struct Around {
    x: Point,
    walls: [Wall; 3],
    outside: Outside,
    /// How far from there it is good.
    valid: f64,
}

/// A particle.
struct Grain {
    /// Where it was after the last step.
    before: Point,
    around: Around,
    /// The way down, divided by how stiff its neighbours hold it.
    step: Point,
    /// Residual sum_b V_b grad W + outside, without what the surface bears.
    residual: Point,
}

/// How the settling went.
pub(super) struct Settled {
    pub(super) x: Vec<Point>,
    pub(super) steps: usize,
    /// Root mean square of the residual times the spacing.
    pub(super) residual: f64,
    pub(super) at_rest: bool,
}

impl Basin<'_> {
    /// Where a particle is allowed to be: half a spacing inside, or as deep as the wall is where it is thinner.
    pub(super) fn inside(&self, mut x: Point) -> (Point, Wall) {
        let mut wall = self.walls.at(x);
        for _ in 0..4 {
            let mut out = wall.distance + 0.5 * self.spacing;
            if out <= 1e-4 * self.spacing {
                break;
            }
            let mut deeper = None;
            // A full step may come out at the other side of a thin wall.
            for _ in 0..3 {
                let there = sub(x, scale(wall.normal, out));
                let then = self.walls.at(there);
                if then.distance < wall.distance {
                    deeper = Some((there, then));
                    break;
                }
                out *= 0.5;
            }
            let Some((there, then)) = deeper else { break };
            (x, wall) = (there, then);
        }
        (x, wall)
    }

    fn look(&self, x: Point) -> Around {
        let (x, wall) = self.inside(x);
        let free = self.walls.room(x) - self.kernel.reach();
        let near = free < VALID * self.spacing;
        let outside = if near { self.grid.outside(x, &self.kernel) } else { Outside::default() };
        Around { x, walls: self.walls.meeting(x, wall), outside, valid: free.max(VALID * self.spacing) }
    }

    /// How far a wall as it was seen lets a particle out too far.
    fn out(&self, around: &Around, wall: &Wall, x: Point) -> f64 {
        wall.distance + dot(wall.normal, sub(x, around.x)) + 0.5 * self.spacing
    }

    /// Back to half a spacing inside, by the surface as it was seen. Twice, for edges.
    fn held(&self, around: &Around, mut x: Point) -> Point {
        for wall in around.walls.iter().chain(&around.walls) {
            let out = self.out(around, wall, x);
            if out > 0.0 {
                x = sub(x, scale(wall.normal, out));
            }
        }
        x
    }

    /// What is left of a pull where walls bear the rest.
    fn borne(&self, around: &Around, x: Point, mut pull: Point) -> Point {
        for wall in around.walls.iter().chain(&around.walls) {
            let outward = dot(pull, wall.normal);
            if outward > 0.0 && self.out(around, wall, x) > -0.001 * self.spacing {
                pull = sub(pull, scale(wall.normal, outward));
            }
        }
        pull
    }

    /// Residual and stiffness of a particle.
    fn pull(&self, x: &[Point], i: usize, near: &[u32], around: &Around) -> (Point, f64) {
        let (mut slope, mut stiffness) = ([0.0; 3], 0.0);
        for &j in near {
            let to = sub(x[i], x[j as usize]);
            let [across, along] = self.kernel.slopes(norm(to));
            slope = add(slope, scale(to, across));
            stiffness += across.abs().max(along.abs());
        }
        let outside = around.outside.slope_at(sub(x[i], around.x));
        let residual = sub(scale(slope, -self.volume), outside);
        (residual, stiffness * self.volume + around.outside.stiffness)
    }

    /// The square of the residual of a particle, computed afresh.
    pub(super) fn residual(&self, points: &Points, i: usize, near: &[u32]) -> f64 {
        let x = points.x[i];
        let pulled = near.iter().fold([0.0; 3], |sum, &j| {
            let to = sub(x, points.x[j as usize]);
            let [across, _] = self.kernel.slopes(norm(to));
            add(sum, scale(to, points.volume[j as usize] * across))
        });
        let all = add(pulled, self.grid.outside(x, &self.kernel).slope);
        dot(all, all)
    }

    /// Residuals and steps of all particles at `x`; returns the root mean square of the residuals times the spacing.
    fn pulls(&self, x: &[Point], lists: &Lists, grains: &mut [Grain]) -> f64 {
        let chunk = |(number, part): (usize, &mut [Grain])| {
            let mut sum = 0.0;
            for (n, grain) in part.iter_mut().enumerate() {
                let i = number * CHUNK + n;
                let (mut residual, stiffness) = self.pull(x, i, lists.of(i), &grain.around);
                residual = self.borne(&grain.around, x[i], residual);
                grain.residual = residual;
                let step = scale(residual, 0.5 / stiffness.max(f64::MIN_POSITIVE));
                let long = norm(step) / (STRIDE * self.spacing);
                grain.step = scale(step, 1.0 / long.max(1.0));
                sum += dot(residual, residual);
            }
            sum
        };
        let sums: Vec<f64> = grains.par_chunks_mut(CHUNK).enumerate().map(chunk).collect();
        (sums.iter().sum::<f64>() / x.len().max(1) as f64).sqrt() * self.spacing
    }

    /// Looks again at what is around those that have come too far.
    fn refresh(&self, x: &mut [Point], grains: &mut [Grain]) {
        x.par_iter_mut().zip(grains).with_min_len(CHUNK).for_each(|(x, grain)| {
            if norm(sub(*x, grain.around.x)) > grain.around.valid {
                grain.around = self.look(*x);
                *x = grain.around.x;
            }
        });
    }

    /// One step, with momentum (Nesterov's): `x` becomes where the next residual is looked at.
    fn step(&self, x: &mut [Point], grains: &mut [Grain], momentum: f64) {
        x.par_iter_mut().zip(grains).with_min_len(CHUNK).for_each(|(x, grain)| {
            let now = self.held(&grain.around, add(*x, grain.step));
            let on = scale(sub(now, grain.before), momentum);
            let long = norm(on) / (STRIDE * self.spacing);
            *x = self.held(&grain.around, add(now, scale(on, 1.0 / long.max(1.0))));
            grain.before = now;
        });
    }

    /// Lets particles settle.
    pub(super) fn settle(&self, seeds: Vec<Point>) -> Settled {
        let fresh = |&x: &Point| {
            let around = self.look(x);
            Grain { before: around.x, around, step: [0.0; 3], residual: [0.0; 3] }
        };
        let mut grains: Vec<Grain> = seeds.par_iter().map(fresh).collect();
        let mut x: Vec<Point> = grains.iter().map(|grain| grain.before).collect();
        let skin = SKIN * self.spacing;
        let (mut listed, mut lists) = (x.clone(), Lists::new(&x, self.kernel.reach() + skin));
        let mut pace = 1.0_f64;
        let mut settled = Settled { x: Vec::new(), steps: 0, residual: f64::INFINITY, at_rest: x.is_empty() };
        let (mut best, mut since) = (f64::INFINITY, 0);
        while settled.steps < MOST_STEPS && settled.steps - since <= PATIENCE && !settled.at_rest {
            self.refresh(&mut x, &mut grains);
            if moved(&x, &listed) > 0.5 * skin {
                (listed, lists) = (x.clone(), Lists::new(&x, self.kernel.reach() + skin));
            }
            settled.residual = self.pulls(&x, &lists, &mut grains);
            settled.at_rest = settled.residual < REST;
            if settled.residual < 0.9 * best {
                (best, since) = (settled.residual, settled.steps);
            }
            if uphill(&x, &grains) {
                pace = 1.0;
            }
            let next = 0.5 * (1.0 + (1.0 + 4.0 * pace * pace).sqrt());
            let momentum = ((pace - 1.0) / next).min(MOMENTUM);
            pace = next;
            self.step(&mut x, &mut grains, momentum);
            settled.steps += 1;
        }
        settled.x = grains.par_iter().map(|grain| self.inside(grain.before).0).collect();
        settled
    }
}

/// The farthest way of a particle.
fn moved(x: &[Point], from: &[Point]) -> f64 {
    let ways = x.par_iter().zip(from).map(|(x, from)| dot(sub(*x, *from), sub(*x, *from)));
    ways.reduce(|| 0.0, f64::max).sqrt()
}

/// Whether the momentum carries particles up the slope.
fn uphill(x: &[Point], grains: &[Grain]) -> bool {
    let part = |(x, grains): (&[Point], &[Grain])| -> f64 {
        x.iter().zip(grains).map(|(x, grain)| dot(sub(*x, grain.before), grain.residual)).sum()
    };
    let sums: Vec<f64> = x.par_chunks(CHUNK).zip(grains.par_chunks(CHUNK)).map(part).collect();
    sums.iter().sum::<f64>() < 0.0
}
