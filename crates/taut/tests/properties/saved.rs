//! A state taken off and put back into new solvers goes on bit by bit: for every formulation, in the plane and in space, on a lattice
//! and off it, in both precisions, on another number of threads.

use crate::common::points::{block, disordered, stir};
use crate::common::{FORMS, Form, Setup, UPDATED};
use std::collections::BTreeMap;
use taut::field::Quantity;
use taut::formulation::updated::Hypoelastic;
use taut::material::LinearElastic;
use taut::particles::saved::{Part, RestoreError, Shelf, Values};
use taut::pass::Now;
use taut::simulation::{
    Calibration, Drive, EdgeForm, InSpace, Law, Numbers, Point, Simulation, Solver, TotalForm, TotalModel,
    UpdatedForm, small_strain_body, total_body, updated_bodies,
};

const DP: f64 = 0.002;
/// Parts by name, as a file would hold them.
type Kept = BTreeMap<String, Values<'static>>;

/// Pulls at the first particle, harder with every step: a drive that remembers.
struct Pull(f64);

impl Drive for Pull {
    fn apply(&mut self, solvers: &mut [Box<dyn Solver>], _: Now<f64>) {
        self.0 += 1.0;
        let place = solvers[0].stored(0);
        solvers[0].write(Quantity::BodyForce, place, [100.0 * self.0, 0.0, 0.0]);
    }

    fn save(&self) -> Vec<Part<'_>> {
        vec![Part::numbers("pulls", &[self.0])]
    }

    fn restore(&mut self, shelf: &mut Shelf<'_>) -> Result<(), RestoreError> {
        [self.0] = shelf.numbers("pulls")?;
        Ok(())
    }
}

fn solver<const D: usize>(form: Form, points: &[Point<D>], numbers: Numbers) -> Box<dyn Solver>
where
    Point<D>: InSpace,
{
    let setup = Setup::new(DP);
    let stress = Hypoelastic { plane: setup.plane };
    let total = |form| {
        let law = Law::NeoHookean(setup.material());
        total_body(
            Point::points(points),
            TotalModel { form, law, kelvin_voigt: 1.0 },
            setup.total_options(D),
            numbers,
        )
        .expect("they fit")
    };
    let updated = |form| {
        let moduli = |_: u32| setup.moduli;
        updated_bodies(Point::points(points), (form, stress, &moduli), setup.updated_options(D), numbers)
    };
    match form {
        Form::HourglassFree => total(TotalForm::HourglassFree(Calibration::Paper)),
        Form::TotalNested => total(TotalForm::Nested),
        Form::Ganzenmueller => total(TotalForm::Ganzenmueller(10.0)),
        Form::SmallStrain => {
            let material = LinearElastic::solid(setup.moduli);
            let formed = (EdgeForm::Adjoint, material);
            small_strain_body(Point::points(points), formed, setup.small_options(D), numbers)
        }
        Form::NonHourglass => updated(UpdatedForm::NonHourglass),
        Form::UpdatedNested => updated(UpdatedForm::Nested),
        Form::ArtificialStress => updated(UpdatedForm::ArtificialStress(0.3)),
        Form::CorrectedArtificialStress => updated(UpdatedForm::CorrectedArtificialStress(0.3)),
        Form::Laplacian => updated(UpdatedForm::Laplacian),
        Form::Generalised => updated(UpdatedForm::Generalised),
        Form::LowDissipation => updated(UpdatedForm::LowDissipation),
        Form::Unwatched => updated(UpdatedForm::UnwatchedNonHourglass),
    }
}

fn drives() -> Vec<Box<dyn Drive>> {
    vec![Box::new(Pull(0.0))]
}

fn kept(simulation: &Simulation) -> Kept {
    let own = |values: Values<'_>| match values {
        Values::Double(v) => Values::Double(v.into_owned().into()),
        Values::Single(v) => Values::Single(v.into_owned().into()),
        Values::Whole(v) => Values::Whole(v.into_owned().into()),
    };
    simulation.save().into_iter().map(|part| (part.name, own(part.values))).collect()
}

/// The bits of a part.
fn bits(values: &Values<'_>) -> Vec<u64> {
    match values {
        Values::Double(v) => v.iter().map(|x| x.to_bits()).collect(),
        Values::Single(v) => v.iter().map(|x| u64::from(x.to_bits())).collect(),
        Values::Whole(v) => v.iter().map(|&x| u64::from(x)).collect(),
    }
}

fn resumed(kept: &Kept, solvers: Vec<Box<dyn Solver>>) -> Result<Simulation, RestoreError> {
    let mut source = |name: &str, _: usize| kept.get(name).cloned().ok_or_else(|| "not there".to_string());
    let mut simulation = Simulation::new(solvers, drives());
    simulation.resume(&mut Shelf::new(&mut source)).map(|()| simulation)
}

fn steps(simulation: &mut Simulation, n: usize, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| (0..n).for_each(|_| simulation.step().expect("stable")));
}

/// `N + M` steps, and `N` steps, a new simulation, `M` steps.
fn goes_on<const D: usize>(form: Form, points: &[Point<D>], numbers: Numbers)
where
    Point<D>: InSpace,
{
    let new = || vec![solver(form, points, numbers)];
    let what = format!("{form:?} {D}D {numbers:?}");
    let mut whole = Simulation::start(new(), drives()).expect("finite");
    // Not the moment of a new list: between two, in the updated forms.
    steps(&mut whole, 7, 1);
    let at_seven = kept(&whole);
    steps(&mut whole, 9, 1);
    let lists = whole.solvers()[0].lists();
    assert!(lists == 1 || lists >= 3, "{what}: lists are made in the window: {lists}");

    let mut second = resumed(&at_seven, new()).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(kept(&second) == at_seven, "{what}: what was put back can be taken off again");
    assert_eq!(second.solvers()[0].neighbours(), {
        let mut again = Simulation::start(new(), drives()).expect("finite");
        steps(&mut again, 7, 1);
        again.solvers()[0].neighbours()
    });
    steps(&mut second, 9, 3);
    let (one, other) = (kept(&whole), kept(&second));
    for (name, values) in &one {
        let differing = bits(values).iter().zip(bits(&other[name])).filter(|(a, b)| **a != *b).count();
        assert_eq!(differing, 0, "{what}: numbers of {name} that differ");
    }
    assert_eq!(one.len(), other.len());
    assert_eq!(whole.totals(), second.totals(), "{what}");
}

fn every_form<const D: usize>(n: [usize; D], numbers: Numbers)
where
    Point<D>: InSpace,
{
    for form in FORMS {
        let speed = if UPDATED.contains(&form) { 0.2 } else { 0.05 };
        for mut points in [block(n, DP), disordered(n, DP, 0.1)] {
            stir(&mut points, speed * Setup::new(DP).moduli.sound_speed(), 60.0 * DP);
            goes_on(form, &points, numbers);
        }
    }
}

#[test]
fn in_the_plane() {
    every_form([31, 29], Numbers::Double);
}

#[test]
fn in_space() {
    every_form([13, 11, 9], Numbers::Double);
}

#[test]
fn in_single_precision() {
    every_form([31, 29], Numbers::Single);
    every_form([13, 11, 9], Numbers::Single);
}

/// Particles that were sorted anew come back in their order, and the count of lists goes on.
#[test]
fn after_particles_were_sorted_anew() {
    let mut points: Vec<Point<2>> = block([12, 9], DP);
    let other =
        points.iter().map(|p| Point { x: p.x + taut::math::Vector([30.0 * DP, 20.0 * DP]), body: 1, ..*p });
    points.extend(other.collect::<Vec<_>>());
    let speed = 0.3 * Setup::new(DP).moduli.sound_speed();
    points.iter_mut().for_each(|p| p.v[0] = if p.body == 0 { speed } else { -speed });
    let new = || vec![solver(Form::NonHourglass, &points, Numbers::Double)];
    let mut whole = Simulation::start(new(), drives()).expect("finite");
    let before = whole.solvers()[0].ids().to_vec();
    while whole.solvers()[0].lists() < 120 {
        steps(&mut whole, 1, 1);
    }
    assert_ne!(before, whole.solvers()[0].ids(), "places have changed");
    let mut second = resumed(&kept(&whole), new()).expect("the same particles");
    assert_eq!(second.solvers()[0].lists(), 120);
    while whole.solvers()[0].lists() < 205 {
        steps(&mut whole, 1, 1);
        steps(&mut second, 1, 2);
    }
    assert!(kept(&whole) == kept(&second), "sorted again at the same list");
}

/// Whatever is wrong with a state is said, and nothing is made of it.
#[test]
fn what_does_not_fit_is_refused() {
    let points = block([8, 8], DP);
    let new = |numbers| vec![solver(Form::HourglassFree, &points, numbers)];
    let simulation = Simulation::start(new(Numbers::Double), drives()).expect("finite");
    let whole = kept(&simulation);
    let refused = |kept: &Kept, solvers| match resumed(kept, solvers) {
        Ok(_) => panic!("it should be refused"),
        Err(error) => error.to_string(),
    };
    for name in whole.keys() {
        let mut without = whole.clone();
        without.remove(name);
        assert!(refused(&without, new(Numbers::Double)).contains(name.as_str()), "{name} is missing");
        let mut short = whole.clone();
        short.insert(name.clone(), Values::Double(vec![0.0; 2].into()));
        let message = refused(&short, new(Numbers::Double));
        assert!(message.contains(name.as_str()) && message.contains("fit"), "{name}: {message}");
    }
    let moved: Vec<Point<2>> = block([8, 8], 1.1 * DP);
    let other = vec![solver(Form::HourglassFree, &moved, Numbers::Double)];
    assert!(refused(&whole, other).contains("born at other places"));
    let mut single = Simulation::start(new(Numbers::Single), drives()).expect("finite");
    steps(&mut single, 1, 1);
    assert!(refused(&kept(&single), new(Numbers::Double)).contains("another precision"));
}
