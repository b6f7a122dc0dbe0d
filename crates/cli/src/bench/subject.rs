//! What is measured: every formulation in two and three dimensions, and what its speed depends on.

use taut::integrator::Stepping;
use taut::simulation::{Calibration, Numbers, TotalForm, UpdatedForm};

/// A formulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Total Lagrangian.
    Total(TotalForm),
    /// Updated Lagrangian, with what makes the lists.
    Updated(UpdatedForm, Stepping),
}

/// How the particles stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// On a lattice.
    Lattice,
    /// On none: each is off its place by up to a tenth of the spacing along each axis.
    Irregular,
}

/// A body in slow motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Subject {
    /// Its formulation.
    pub form: Form,
    /// 2 or 3.
    pub dimension: usize,
    /// How its particles stand.
    pub arrangement: Arrangement,
    /// What its pair sums are computed with.
    pub numbers: Numbers,
}

const FORMS: [Form; 9] = [
    Form::Total(TotalForm::HourglassFree(Calibration::Paper)),
    Form::Total(TotalForm::Nested),
    Form::Total(TotalForm::Ganzenmueller(10.0)),
    Form::Updated(UpdatedForm::NonHourglass, Stepping::Dual),
    Form::Updated(UpdatedForm::NonHourglass, Stepping::Single),
    Form::Updated(UpdatedForm::Nested, Stepping::Dual),
    Form::Updated(UpdatedForm::Nested, Stepping::Single),
    Form::Updated(UpdatedForm::Generalised, Stepping::Dual),
    Form::Updated(UpdatedForm::UnwatchedNonHourglass, Stepping::Dual),
];

impl Subject {
    /// All of them. With single stepping the list is made anew all the time: how the particles stand makes no difference there.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for form in FORMS {
            for dimension in [2, 3] {
                for arrangement in [Arrangement::Lattice, Arrangement::Irregular] {
                    if matches!(form, Form::Updated(_, Stepping::Single))
                        && arrangement != Arrangement::Lattice
                    {
                        continue;
                    }
                    for numbers in [Numbers::Double, Numbers::Single] {
                        all.push(Self { form, dimension, arrangement, numbers });
                    }
                }
            }
        }
        all
    }

    /// Its name, from the general to the special.
    pub fn name(&self) -> String {
        let form = match self.form {
            Form::Total(TotalForm::HourglassFree(_)) => "tl-hourglass-free",
            Form::Total(TotalForm::Nested) => "tl-nested",
            Form::Total(TotalForm::Ganzenmueller(_)) => "tl-ganzenmueller",
            Form::Updated(form, stepping) => {
                return format!("{}/{}-steps/{}", updated(form), stepped(stepping), self.rest());
            }
        };
        format!("{form}/{}", self.rest())
    }

    /// What every name ends with.
    fn rest(&self) -> String {
        let arrangement = match self.arrangement {
            Arrangement::Lattice => "lattice",
            Arrangement::Irregular => "irregular",
        };
        format!("{}d/{arrangement}/{}", self.dimension, self.numbers.name())
    }

    /// Whether its lists last for several steps.
    pub fn is_dual(&self) -> bool {
        matches!(self.form, Form::Updated(_, Stepping::Dual))
    }
}

/// The name of an updated Lagrangian formulation.
const fn updated(form: UpdatedForm) -> &'static str {
    match form {
        UpdatedForm::NonHourglass => "ul-non-hourglass",
        UpdatedForm::UnwatchedNonHourglass => "ul-non-hourglass-unwatched",
        UpdatedForm::Nested => "ul-nested",
        UpdatedForm::ArtificialStress(_) => "ul-artificial-stress",
        UpdatedForm::CorrectedArtificialStress(_) => "ul-artificial-stress-corrected",
        UpdatedForm::Laplacian => "ul-laplacian",
        UpdatedForm::LowDissipation => "ul-low-dissipation",
        UpdatedForm::Generalised => "ul-generalised",
        UpdatedForm::GeneralisedNeoHookean => "ul-generalised-neo-hookean",
    }
}

/// A word for what makes the lists.
const fn stepped(stepping: Stepping) -> &'static str {
    match stepping {
        Stepping::Dual => "dual",
        Stepping::Single => "single",
    }
}

/// The subjects whose names contain every one of these words.
pub fn chosen(words: &[String]) -> Vec<Subject> {
    let wanted = |name: &str| words.iter().all(|word| name.contains(word.as_str()));
    Subject::all().into_iter().filter(|subject| wanted(&subject.name())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_unique_and_words_choose() {
        let names: BTreeSet<String> = Subject::all().iter().map(Subject::name).collect();
        assert_eq!(names.len(), 64);
        let words = |words: &[&str]| chosen(&words.iter().map(ToString::to_string).collect::<Vec<_>>()).len();
        assert_eq!((words(&[]), words(&["tl-", "3d"]), words(&["tl-", "ul-"])), (64, 12, 0));
        assert_eq!(words(&["ul-nested/dual-steps/2d/lattice/single"]), 1);
    }
}
