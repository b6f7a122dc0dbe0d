//! A step asks for no memory: not on any thread. A new list may, when it outgrows all earlier ones.
//!
//! Alone in its program, because it counts what the whole program allocates.

#[path = "properties/common/mod.rs"]
mod common;

use common::points::{block, stir};
use common::{Clock, Form, Setup};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, Ordering};
use taut::contact::{Contact, Meeting};
use taut::formulation::Formulation;
use taut::math::Vector;
use taut::simulation::Simulation;

/// The allocator of the system, counted.
struct Counting;

static CALLS: AtomicU64 = AtomicU64::new(0);

// SAFETY: every call is handed on to the system as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

const DP: f64 = 0.002;

/// Calls to the allocator, by any thread, while `work` runs.
fn calls(work: impl FnOnce()) -> u64 {
    let before = CALLS.load(Ordering::SeqCst);
    work();
    CALLS.load(Ordering::SeqCst) - before
}

/// The first steps wake the threads and size the buffers of all passes; then 50 steps.
fn total(form: Form) {
    let setup = Setup::new(DP);
    let mut points = block([16, 15, 14], DP);
    stir(&mut points, 0.05 * setup.moduli.sound_speed(), 12.0 * DP);
    let mut simulation = Simulation::start(vec![setup.body(form, &points)], vec![]).expect("finite");
    (0..5).for_each(|_| simulation.step().expect("stable"));
    let calls = calls(|| (0..50).for_each(|_| simulation.step().expect("stable")));
    assert_eq!(calls, 0, "{form:?}");
}

/// Dual stepping over at least eight lists. Steps that keep their list ask for nothing. The lists together ask at most once
/// for each buffer whose size follows the pairs or cells, because a buffer that grows takes a quarter more than it needs: neighbours,
/// two kinds of weights and squared distances of every 128 particles, and cells of the grid.
fn updated<F: Formulation<2>>(form: F) {
    let setup = Setup::new(DP);
    let mut points = block([71, 67], DP);
    stir(&mut points, 0.2 * setup.moduli.sound_speed(), 30.0 * DP);
    let buffers = 1 + 4 * points.len().div_ceil(128) as u64;
    let mut body = setup.updated(form, &points);
    let mut clock = Clock::start(&mut body).expect("finite");
    clock.steps(&mut body, 5);
    let first = body.rebuilds();
    let mut growth = 0;
    for step in 0..40 {
        let lists = body.rebuilds();
        let calls = calls(|| clock.steps(&mut body, 1));
        if body.rebuilds() > lists {
            growth += calls;
        } else {
            assert_eq!(calls, 0, "step {step} without a new list");
        }
    }
    assert!((8..35).contains(&(body.rebuilds() - first)), "{} lists", body.rebuilds() - first);
    assert!(growth <= buffers, "{growth} calls for {buffers} buffers");
}

/// Two bodies that rub against each other, one on top of the other. New lists may ask: at most once for each of their buffers. So does the guard's
/// look at energies, after 1, 2, 4, ... and every 256 steps, which are not among these.
fn contact() {
    let setup = Setup::new(DP);
    let bodies = [0, 1].map(|body: u32| {
        let mut points = block([40, 30], DP);
        for p in &mut points {
            p.body = body;
            p.x[1] += 30.2 * DP * f64::from(body);
            p.v = Vector([0.02, 0.02]).times(setup.moduli.sound_speed() * (1.0 - 2.0 * f64::from(body)));
        }
        setup.body(Form::HourglassFree, &points)
    });
    let meeting = Meeting { bodies: [0, 1], stiffness: setup.moduli.bulk, friction: 0.3 };
    let contact = Contact::new(&[meeting], DP, 2);
    let mut simulation = Simulation::new(bodies.into(), vec![]).touching(Some(contact));
    simulation.begin().expect("finite");
    (0..65).for_each(|_| simulation.step().expect("stable"));
    let lists = |simulation: &Simulation| simulation.contact().map_or(0, Contact::lists);
    let first = lists(&simulation);
    let mut growth = 0;
    for step in 0..60 {
        let before = lists(&simulation);
        let calls = calls(|| simulation.step().expect("stable"));
        if lists(&simulation) > before {
            growth += calls;
        } else {
            assert_eq!(calls, 0, "step {step} without a new list");
        }
    }
    assert!(simulation.totals().contact > 0.0 && lists(&simulation) > first, "they touch and move");
    // Facings, partners, owners, chosen particles and their columns, lists of neighbours and what is staged, forces, springs; boxes each time.
    assert!(growth < 20 + 2 * (lists(&simulation) - first), "{growth} calls");
}

/// One test, so that nothing else runs meanwhile; inside a pool of two threads, as a simulation runs.
#[test]
fn steps_ask_for_no_memory() {
    assert!(calls(|| drop(std::hint::black_box(vec![1, 2, 3]))) > 0, "the counter counts");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads");
    pool.install(|| {
        assert_eq!(rayon::current_num_threads(), 2);
        total(Form::HourglassFree);
        total(Form::TotalNested);
        contact();
        total(Form::Ganzenmueller);
        updated(Setup::new(DP).non_hourglass(2));
        updated(Setup::new(DP).updated_nested());
    });
}
