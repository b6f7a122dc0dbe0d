//! How long is one step? Each formulation in 2D and 3D, on one thread and on all.
//!
//! Run: `cargo bench -p taut --bench step` (a name behind `--` selects, for instance `-- hourglass-free/3D`).
//! Read: `thrpt` is particle-steps per second (Melem/s = million particle-steps per second), divide by the number of threads
//! for the figure per core. A step is one Verlet step (tl-*) or one acoustic step (ul-*, its share of the new lists
//! included). Machines are noisy: compare figures of one run only.

#[path = "../crates/taut/tests/properties/common/mod.rs"]
mod common;

use common::points::{block, stir};
use common::{Clock, Form, Setup};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use taut::simulation::Point;

const DP: f64 = 0.002;

const FORMS: [(Form, &str); 5] = [
    (Form::HourglassFree, "tl-hourglass-free"),
    (Form::TotalNested, "tl-nested"),
    (Form::Ganzenmueller, "tl-ganzenmueller"),
    (Form::NonHourglass, "ul-non-hourglass"),
    (Form::UpdatedNested, "ul-nested"),
];

/// Slow motion: nothing breaks however long the measurement lasts; lists are made anew every ten steps or so.
fn quiet<const D: usize>(n: [usize; D]) -> Vec<Point<D>> {
    let mut points = block(n, DP);
    stir(&mut points, 1e-4 * Setup::new(DP).moduli.sound_speed(), 30.0 * DP);
    points
}

fn measure<const D: usize>(criterion: &mut Criterion, points: &[Point<D>], threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    for (form, name) in FORMS {
        let mut group = criterion.benchmark_group(format!("{name}/{D}D"));
        group.throughput(Throughput::Elements(points.len() as u64));
        group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
        let mut body = Setup::new(DP).body(form, points);
        let mut clock = pool.install(|| Clock::start(body.as_mut()).expect("finite"));
        group.bench_function(format!("{threads} threads"), |b| {
            b.iter(|| pool.install(|| clock.step(body.as_mut()).expect("stable")));
        });
        group.finish();
    }
}

/// 15,000 particles in the plane, 13,824 in space.
fn steps(criterion: &mut Criterion) {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut counts = vec![1, all];
    counts.dedup();
    for threads in counts {
        measure(criterion, &quiet([150, 100]), threads);
        measure(criterion, &quiet([24, 24, 24]), threads);
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
