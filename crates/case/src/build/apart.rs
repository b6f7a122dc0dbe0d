//! How near particles of one body are to those of others, for a probe.

use taut::field::Quantity;
use taut::simulation::Solver;

/// A body, and others.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// Number of the body.
    pub body: u32,
    /// Number of the other; `None` for all others.
    pub by: Option<u32>,
}

/// A bounding box: smallest and largest coordinates, m.
type Bounds = [[f64; 2]; 3];

impl Apart {
    /// The smallest distance between a particle of the body and one of the others, m; infinite if there is none. Only the particles whose distance from
    /// the box around the others is smaller than what was found before are compared one by one.
    #[must_use]
    pub fn value(&self, solvers: &[Box<dyn Solver>]) -> f64 {
        let other = |body: u32| self.by.map_or(body != self.body, |by| body == by);
        let mut bounds: Bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for x in places(solvers, other) {
            for (range, x) in bounds.iter_mut().zip(x) {
                *range = [range[0].min(x), range[1].max(x)];
            }
        }
        let mut least = f64::INFINITY;
        for a in places(solvers, |body| body == self.body) {
            if beyond(a, &bounds) < least {
                least = places(solvers, other).map(|b| square(a, b)).fold(least, f64::min);
            }
        }
        least.sqrt()
    }
}

/// Where the particles of some bodies are now, m.
fn places<'a>(
    solvers: &'a [Box<dyn Solver>],
    wanted: impl Fn(u32) -> bool + Copy + 'a,
) -> impl Iterator<Item = [f64; 3]> + 'a {
    solvers.iter().flat_map(move |solver| {
        let mine = move |place: &usize| wanted(solver.scalar(Quantity::Body, *place) as u32);
        (0..solver.len()).filter(mine).map(move |place| {
            let u = solver.read(Quantity::Displacement, place);
            let x = solver.read(Quantity::ReferencePosition, place);
            std::array::from_fn(|k| x[k] + u[k])
        })
    })
}

fn square(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum()
}

/// The square of the distance from a box.
fn beyond(x: [f64; 3], bounds: &Bounds) -> f64 {
    x.iter().zip(bounds).map(|(x, b)| (b[0] - x).max(x - b[1]).max(0.0).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::build;
    use crate::{Case, Overrides};
    use taut::simulation::Numbers;

    /// Of the falling annulus, the block below it and the wall: the same as that of all pairs, and what the geometry of the case says.
    #[test]
    fn the_nearest_are_found() {
        let text = include_str!("../../../../cases/lk-collision.toml");
        let case = Case::parse("case.toml", text, &Overrides::default()).expect("a case");
        let built = build(&case, Numbers::Double).expect("particles");
        let every = |a: u32, b: u32| {
            let pairs = places(&built.solvers, move |body| body == a)
                .flat_map(|x| places(&built.solvers, move |body| body == b).map(move |y| square(x, y)));
            pairs.fold(f64::INFINITY, f64::min).sqrt()
        };
        for (body, by) in [(0, 1), (1, 0), (1, 2), (0, 2)] {
            let found = Apart { body, by: Some(by) }.value(&built.solvers);
            assert_eq!(found, every(body, by), "{body} and {by}");
        }
        // Half a spacing (25 um) above the lower side of the block, at 1.35e-4 - 1.25e-4 m, to the wall at -1e-4 m, half a spacing aside.
        let to_wall = Apart { body: 1, by: Some(2) }.value(&built.solvers);
        assert!((to_wall - 1.225e-4_f64.hypot(1.25e-5)).abs() < 1e-12, "{to_wall:e}");
        let nearest = Apart { body: 1, by: None }.value(&built.solvers);
        assert_eq!(nearest, to_wall.min(every(1, 0)), "of all others");
        assert_eq!(
            Apart { body: 0, by: Some(7) }.value(&built.solvers),
            f64::INFINITY,
            "there is no such body"
        );
    }
}
