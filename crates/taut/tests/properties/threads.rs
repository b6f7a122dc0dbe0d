//! The number of threads does not show: every bit of every field is the same.

use crate::common::points::{block, stir};
use crate::common::{Clock, Setup};
use taut::field::Quantity;
use taut::formulation::Formulation;
use taut::particles::Particles;
use taut::run::Run;

const DP: f64 = 0.002;

/// Every number of every field and the ids, as bits.
fn bits<const D: usize>(p: &Particles<D>, fields: &[Quantity]) -> Vec<u64> {
    let columns = fields.iter().flat_map(|&f| (0..f.rank().words(D)).map(move |w| p.column(f, w)));
    let ids = p.ids().iter().map(|&id| u64::from(id));
    columns.flatten().map(|x| x.to_bits()).chain(ids).collect()
}

/// What `work` gives on pools of 1, 2 and 3 threads (more than this machine may have: then they take turns).
fn same_on_any_pool(work: impl Fn() -> Vec<u64> + Sync) {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            assert_eq!(rayon::current_num_threads(), threads);
            work()
        })
    };
    let one = on(1);
    assert!(one.iter().any(|&b| b != 0));
    for threads in [2, 3] {
        let other = on(threads);
        let differing = one.iter().zip(&other).filter(|(a, b)| a != b).count();
        assert!(
            one.len() == other.len() && differing == 0,
            "{differing} numbers differ on {threads} threads"
        );
    }
}

/// 21141 particles: 165 full chunks and one that ends in a group of one.
fn total<F: Formulation<3> + Copy>(form: F) {
    let setup = Setup::new(DP);
    let mut points = block([29, 27, 27], DP);
    stir(&mut points, 0.05 * setup.moduli.sound_speed(), 20.0 * DP);
    same_on_any_pool(|| {
        let mut body = setup.total(form, &points);
        Clock::start(&mut body).expect("finite").steps(&mut body, 4);
        bits(body.run().particles(), F::FIELDS)
    });
}

/// 20989 particles, fast enough for several new lists.
fn updated<F: Formulation<2> + Copy>(form: F) {
    let setup = Setup::new(DP);
    let mut points = block([151, 139], DP);
    stir(&mut points, 0.2 * setup.moduli.sound_speed(), 60.0 * DP);
    same_on_any_pool(|| {
        let mut body = setup.updated(form, &points);
        Clock::start(&mut body).expect("finite").steps(&mut body, 10);
        assert!(body.rebuilds() >= 3, "lists are made in the window: {}", body.rebuilds());
        bits(body.run().particles(), F::FIELDS)
    });
}

#[test]
fn hourglass_free_in_space() {
    total(Setup::new(DP).hourglass_free(3));
}

#[test]
fn total_nested_in_space() {
    total(Setup::new(DP).total_nested(3));
}

#[test]
fn ganzenmueller_in_space() {
    total(Setup::new(DP).ganzenmueller(3));
}

#[test]
fn non_hourglass_in_the_plane() {
    updated(Setup::new(DP).non_hourglass(2));
}

#[test]
fn updated_nested_in_the_plane() {
    updated(Setup::new(DP).updated_nested());
}

#[test]
fn artificial_stress_in_the_plane() {
    updated(Setup::new(DP).artificial_stress(2));
}

#[test]
fn corrected_artificial_stress_in_the_plane() {
    updated(Setup::new(DP).corrected_artificial_stress(2));
}

#[test]
fn generalised_in_the_plane() {
    updated(Setup::new(DP).generalised());
    updated(Setup::new(DP).generalised_rubber());
}

#[test]
fn laplacian_in_the_plane() {
    updated(Setup::new(DP).laplacian());
}
