//! Fields at the end of a run, held against formulas.

use crate::build::shape_of;
use crate::{Compared, Comparison, Statistic};
use output::summary::Measured;
use taut::integrator::cross;
use taut::simulation::Snapshot;

/// What a comparison gives.
pub fn measured(comparison: &Comparison, snapshot: &Snapshot, mass: &[f64]) -> Measured {
    let among = chosen(comparison, snapshot);
    if among.is_empty() {
        return Measured::missing("1", "no particle is in its region");
    }
    let found = found(comparison, (snapshot, mass), &among);
    let wanted = wanted(comparison, snapshot, &among);
    let size = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let largest = |of: &[[f64; 3]]| of.iter().map(size).fold(0.0, f64::max);
    let mean = |of: &[[f64; 3]]| of.iter().map(size).sum::<f64>() / of.len() as f64;
    let Some(wanted) = wanted else {
        let unit = if matches!(comparison.field, Compared::Displacement(_)) { "m" } else { "Pa" };
        return Measured::value(largest(&found), unit);
    };
    let apart: Vec<[f64; 3]> =
        found.iter().zip(&wanted).map(|(a, b)| std::array::from_fn(|k| a[k] - b[k])).collect();
    let squares = apart.iter().map(|v| size(v).powi(2)).sum::<f64>() / apart.len() as f64;
    let value = match comparison.statistic {
        Statistic::ErrorMax => largest(&apart) / largest(&wanted),
        Statistic::ErrorRms => squares.sqrt() / largest(&wanted),
        Statistic::Ratio => mean(&found) / mean(&wanted),
        Statistic::Largest => largest(&found),
    };
    Measured::value(value, "1")
}

/// The particles that are looked at.
fn chosen(comparison: &Comparison, snapshot: &Snapshot) -> Vec<usize> {
    let region = comparison.region.as_ref().map(shape_of);
    let mine = |i: &usize| {
        comparison.body.is_none_or(|b| b as u32 == snapshot.body[*i])
            && region.as_ref().is_none_or(|r| r.contains(snapshot.reference[*i]))
    };
    (0..snapshot.body.len()).filter(mine).collect()
}

/// What they have.
fn found(comparison: &Comparison, (snapshot, mass): (&Snapshot, &[f64]), among: &[usize]) -> Vec<[f64; 3]> {
    let (field, aligned) = (&comparison.field, comparison.aligned);
    match field {
        Compared::VonMises(_) => among.iter().map(|&i| [snapshot.von_mises[i], 0.0, 0.0]).collect(),
        Compared::Displacement(expected) => {
            let all: Vec<usize> = (0..snapshot.body.len()).collect();
            let expected = expected.as_ref().filter(|_| aligned);
            let rigid = expected.map(|expected| {
                let apart = |i: usize| {
                    let wanted = expected.eval(snapshot.reference[i], snapshot.time);
                    std::array::from_fn(|k| snapshot.displacement[i][k] - wanted[k])
                };
                Rigid::fitted(&all, apart, (snapshot, mass))
            });
            let moved = |i: usize| {
                let back = rigid.as_ref().map_or([0.0; 3], |rigid| rigid.at(snapshot.reference[i]));
                std::array::from_fn(|k| snapshot.displacement[i][k] - back[k])
            };
            among.iter().map(|&i| moved(i)).collect()
        }
    }
}

/// What they should have.
fn wanted(comparison: &Comparison, snapshot: &Snapshot, among: &[usize]) -> Option<Vec<[f64; 3]>> {
    let (x, t) = (&snapshot.reference, snapshot.time);
    match &comparison.field {
        Compared::Displacement(field) => {
            field.as_ref().map(|field| among.iter().map(|&i| field.eval(x[i], t)).collect())
        }
        Compared::VonMises(field) => {
            field.as_ref().map(|field| among.iter().map(|&i| [field.eval(x[i], t), 0.0, 0.0]).collect())
        }
    }
}

/// A translation and a small turn.
struct Rigid {
    centre: [f64; 3],
    shift: [f64; 3],
    turn: [f64; 3],
}

impl Rigid {
    /// The one with the momenta of a field of displacements: the best fit by mass. Turns in the plane are about z; in space about the axes one by one, which
    /// is right where the body's own axes are those of space.
    fn fitted(of: &[usize], u: impl Fn(usize) -> [f64; 3], (snapshot, mass): (&Snapshot, &[f64])) -> Self {
        let total: f64 = of.iter().map(|&i| mass[i]).sum();
        let mean = |f: &dyn Fn(usize) -> [f64; 3]| -> [f64; 3] {
            let sum = of.iter().fold([0.0; 3], |s: [f64; 3], &i| {
                let value = f(i);
                std::array::from_fn(|k| s[k] + mass[i] * value[k])
            });
            sum.map(|s| s / total)
        };
        let (centre, shift) = (mean(&|i| snapshot.reference[i]), mean(&|i| u(i)));
        let arm = |i: usize| -> [f64; 3] { std::array::from_fn(|k| snapshot.reference[i][k] - centre[k]) };
        let (mut spin, mut inertia) = ([0.0; 3], [0.0; 3]);
        for &i in of {
            let (r, moved) = (arm(i), u(i));
            let moment = cross(r, std::array::from_fn(|k| moved[k] - shift[k]));
            let square: f64 = r.iter().map(|c| c * c).sum();
            for k in 0..3 {
                spin[k] += mass[i] * moment[k];
                inertia[k] += mass[i] * (square - r[k] * r[k]);
            }
        }
        let turn = std::array::from_fn(|k| if inertia[k] > 0.0 { spin[k] / inertia[k] } else { 0.0 });
        Self { centre, shift, turn }
    }

    fn at(&self, x: [f64; 3]) -> [f64; 3] {
        let turned = cross(self.turn, std::array::from_fn(|k| x[k] - self.centre[k]));
        std::array::from_fn(|k| self.shift[k] + turned[k])
    }
}
