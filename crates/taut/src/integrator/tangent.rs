//! Bodies as a linear operator, by running their passes.

use super::spectrum::Stiffness;
use crate::field::Quantity;
use crate::formulation::Formulation;
use crate::pass::Now;
use crate::run::Run;

/// In so long a time (s, a power of two) that viscous stresses of a displacement are nothing against elastic ones.
const SLOWLY: f64 = (1_u64 << 40) as f64;

/// What bodies do against small displacements from where they are. What it changes of the particles it puts back when it is dropped.
pub struct Tangent<'a, const D: usize, F, R: Run<D>> {
    formulation: &'a F,
    run: &'a mut R,
    /// Every number that passes may change.
    kept: Vec<(Quantity, usize, Vec<f64>)>,
    /// A displacement that is small, m.
    small: f64,
}

impl<'a, const D: usize, F: Formulation<D>, R: Run<D>> Tangent<'a, D, F, R> {
    /// Of the particles of a run, whose displacements are small against `h`, m.
    pub fn new(formulation: &'a F, run: &'a mut R, h: f64) -> Self {
        let changing = |field: Quantity| !field.is_given() && field != Quantity::ReferencePosition;
        let words = run.particles().words().filter(|(field, _)| changing(*field));
        let column = |(field, word)| (field, word, all(run, field, word));
        let kept = words.map(column).collect();
        Self { formulation, run, kept, small: 1e-4 * h }
    }

    fn put_back(&mut self) {
        for (field, word, values) in &self.kept {
            for (place, value) in values.iter().enumerate() {
                self.run.set_word(*field, *word, (place, *value));
            }
        }
    }

    /// Accelerations by a displacement, added `times` over. It is reached slowly: rates are found, then everything that is integrated is taken along
    /// in one step, half of it before and half of it after the forces where a formulation has it so.
    fn respond(&mut self, u: &[f64], scale: f64, (a, times): (&mut [f64], f64)) {
        self.put_back();
        for (i, u) in u.iter().enumerate() {
            self.run.set_word(Quantity::Velocity, i % D, (i / D, u * (scale / SLOWLY)));
        }
        self.formulation.rates(self.run, Now { t: 0.0, dt: 0.0 });
        self.formulation.rates(self.run, Now { t: 0.0, dt: SLOWLY });
        self.formulation.accelerate(self.run, Now { t: 0.0, dt: SLOWLY });
        for (i, a) in a.iter_mut().enumerate() {
            let free = self.run.word(Quantity::Free, i % D, i / D);
            *a += times * free * self.run.word(Quantity::Acceleration, i % D, i / D);
        }
    }
}

fn all<const D: usize>(run: &impl Run<D>, field: Quantity, word: usize) -> Vec<f64> {
    (0..run.particles().len()).map(|place| run.word(field, word, place)).collect()
}

impl<const D: usize, F: Formulation<D>, R: Run<D>> Stiffness for Tangent<'_, D, F, R> {
    fn len(&self) -> usize {
        self.run.particles().len() * D
    }

    /// By a central difference, in which constant forces drop out; exact where the body is linear.
    fn apply(&mut self, u: &[f64], a: &mut [f64]) {
        let free = |i: usize| self.run.word(Quantity::Free, i % D, i / D);
        let u: Vec<f64> = u.iter().enumerate().map(|(i, u)| u * free(i)).collect();
        let most = u.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        a.fill(0.0);
        if most > 0.0 {
            let scale = (self.small / most).log2().floor().exp2();
            self.respond(&u, scale, (a, 0.5 / scale));
            self.respond(&u, -scale, (a, -0.5 / scale));
        }
    }

    fn weights(&self) -> Vec<f64> {
        (0..self.len()).map(|i| self.formulation.metric(self.run, i / D)).collect()
    }

    fn dimension(&self) -> usize {
        D
    }
}

impl<const D: usize, F, R: Run<D>> Drop for Tangent<'_, D, F, R> {
    fn drop(&mut self) {
        for (field, word, values) in &self.kept {
            for (place, value) in values.iter().enumerate() {
                self.run.set_word(*field, *word, (place, *value));
            }
        }
    }
}
