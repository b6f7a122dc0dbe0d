//! How long does a new configuration take? The search alone, and the whole rebuild: search and kernel of every pair.
//!
//! Run: `cargo bench -p taut --bench neighbours`.
//! Read: `thrpt` is particles per second. Against `--bench step`: with dual stepping at ten acoustic steps per list, a rebuild may
//! take as long as one acoustic step if it is to cost a tenth of the run. Compare figures of one run only.

#[path = "../crates/taut/tests/properties/common/mod.rs"]
mod common;

use common::Setup;
use common::points::disordered;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use taut::field::Quantity;
use taut::neighbours::{Adjacency, Search, storage_order};
use taut::particles::Particles;
use taut::run::{Among, Cpu, Relist, Run};

const DP: f64 = 0.002;

/// Particles without symmetry, stored as in a run.
fn particles<const D: usize>(n: [usize; D]) -> Particles<D> {
    let points = disordered(n, DP, 0.2);
    let mut p = Particles::new(points.len());
    [Quantity::Position, Quantity::Volume, Quantity::Body].into_iter().for_each(|f| p.add(f));
    for (i, point) in points.iter().enumerate() {
        p.set_vector(Quantity::Position, i, point.x);
        p.column_mut(Quantity::Volume, 0)[i] = point.volume;
    }
    let mut order = Vec::new();
    storage_order(p.vector(Quantity::Position), DP, &mut order).expect("finite");
    p.reorder(&order);
    p
}

fn measure<const D: usize>(criterion: &mut Criterion, n: [usize; D], threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let (p, kernel) = (particles(n), Setup::new(DP).updated_kernel(D));
    let mut group = criterion.benchmark_group(format!("neighbours/{D}D/{threads} threads"));
    group.throughput(Throughput::Elements(p.len() as u64));
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    let (mut search, mut list) = (Search::new(), Adjacency::default());
    let x = p.vector(Quantity::Position);
    group.bench_function("search", |b| {
        b.iter(|| pool.install(|| search.pairs(x, kernel.support(), None, &mut list).expect("finite")));
    });
    let mut run = Cpu::new(p.clone());
    let how = Relist { positions: Quantity::Position, kernel, among: Among::All };
    group.bench_function("rebuild", |b| b.iter(|| pool.install(|| run.relist(&how).expect("finite"))));
    group.finish();
}

/// 15,000 particles in the plane, 13,824 in space.
fn rebuilds(criterion: &mut Criterion) {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut counts = vec![1, all];
    counts.dedup();
    for threads in counts {
        measure(criterion, [150, 100], threads);
        measure(criterion, [24, 24, 24], threads);
    }
}

criterion_group!(benches, rebuilds);
criterion_main!(benches);
