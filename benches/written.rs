//! Is the hourglass-free form slower than the nested one? It is cheaper than the nested form as the equations are written, with B on both sides of
//! every pair, and dearer than `tl-nested`, which has B in the stress, once a particle (TL Table 3).
//!
//! Run: `cargo bench -p taut --bench written`. Read: `thrpt` is particle-steps per second on one thread, on the column of Table 3 with 12 particles
//! across, as a lattice and with particles off it.

#[path = "../crates/taut/tests/properties/common/mod.rs"]
mod common;

use common::as_written::AsWritten;
use common::points::{block, disordered, stir};
use common::{Clock, Setup};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use taut::simulation::{Point, Solver};

const DP: f64 = 0.002;

fn measure(criterion: &mut Criterion, (name, mut points): (&str, Vec<Point<3>>)) {
    let setup = Setup::new(DP);
    stir(&mut points, 1e-4 * setup.moduli.sound_speed(), 30.0 * DP);
    let forms: [(&str, Box<dyn Solver>); 3] = [
        ("hourglass-free", Box::new(setup.total(setup.hourglass_free(3), &points))),
        ("nested", Box::new(setup.total(setup.total_nested(3), &points))),
        ("nested as written", Box::new(setup.total(AsWritten(setup.total_nested(3)), &points))),
    ];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(points.len() as u64));
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    for (form, mut body) in forms {
        let mut clock = pool.install(|| Clock::start(body.as_mut()).expect("finite"));
        group.bench_function(form, |b| {
            b.iter(|| pool.install(|| clock.step(body.as_mut()).expect("stable")));
        });
    }
    group.finish();
}

fn forms(criterion: &mut Criterion) {
    measure(criterion, ("lattice", block([12, 12, 73], DP)));
    measure(criterion, ("irregular", disordered([12, 12, 73], DP, 0.1)));
}

criterion_group!(benches, forms);
criterion_main!(benches);
