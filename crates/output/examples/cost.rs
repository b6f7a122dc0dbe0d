//! What a frame costs, without the disk: `cargo run --release -p taut-output --example cost`

use std::sync::Arc;
use std::time::Instant;

use output::{Array, Frame, ResultDir, Series, Values};

/// Particles that swing, with all quantities of a run; every number has digits to spare, as in a run.
fn frame(n: usize, step: u64, lasting: &(Arc<Vec<f32>>, Arc<Vec<i32>>)) -> Frame {
    let real = |i: usize, k: usize| ((i * 7 + k) as f64 * 0.61 + step as f64).sin();
    let single =
        |count: usize| Values::F32((0..count * n).map(|i| real(i / count, i % count) as f32).collect());
    let several = |name: &str, unit: &str, components: usize| Array {
        name: name.to_string(),
        unit: unit.to_string(),
        components,
        values: single(components),
    };
    Frame {
        time: step as f64,
        step,
        points: (0..n).map(|i| std::array::from_fn(|k| real(i, k))).collect(),
        arrays: vec![
            several("Displacement", "m", 3),
            several("Velocity", "m/s", 3),
            several("Density", "kg/m^3", 1),
            several("Pressure", "Pa", 1),
            several("VonMisesStress", "Pa", 1),
            several("CauchyStress", "Pa", 9),
            several("DeformationGradient", "1", 9),
            Array::scalar("ParticleSpacing", "m", Values::Shared(Arc::clone(&lasting.0))),
            Array::scalar("ParticleId", "1", Values::Whole(Arc::clone(&lasting.1))),
            Array::scalar("Body", "1", Values::Whole(Arc::clone(&lasting.1))),
        ],
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n = 10_000;
    let lasting = (Arc::new(vec![0.1; n]), Arc::new((0..n as i32).collect()));
    let threads = std::thread::available_parallelism()?;
    println!("{n} particles, {threads} threads at work; best of 20");
    for (name, apart) in [("stored", 10), ("compressed", 1000)] {
        let scratch = tempfile::tempdir()?;
        let mut series = Series::create(&ResultDir::create(scratch.path())?)?;
        series.encode(&frame(n, 0, &lasting))?;
        let (mut best, mut bytes) = (f64::INFINITY, 0);
        for k in 1..=20 {
            let frame = frame(n, k * apart, &lasting);
            let clock = Instant::now();
            bytes = series.encode(&frame)?.len();
            best = best.min(clock.elapsed().as_secs_f64());
        }
        println!("{name}: {:.0} ns and {} bytes a particle", best / n as f64 * 1e9, bytes / n);
    }
    Ok(())
}
