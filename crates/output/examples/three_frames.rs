//! Writes a small result directory, to look at in ParaView or to check with `tests/read_back.py`:
//! `cargo run -p taut-output --example three_frames -- DIRECTORY`

use output::{Array, Frame, ProbeTable, ResultDir, Series, Values};

/// A square of 40 x 40 particles that is sheared; every frame lists the particles in another order.
fn frame(index: u64) -> Frame {
    let time = 0.1 * index as f64;
    let ids: Vec<i64> = (0..1600).map(|i| (i * 7 + index as i64) % 1600).collect();
    let start = |id: i64| [(id % 40) as f64 * 0.01, (id / 40) as f64 * 0.01];
    let moved = |id: i64| [time * start(id)[1], 0.0, 0.0];
    let shear = [1.0, time, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let per_particle = |value: f64| Values::F64(vec![value; ids.len()]);
    Frame {
        time,
        step: 100 * index,
        points: ids.iter().map(|&id| [start(id)[0] + moved(id)[0], start(id)[1], 0.0]).collect(),
        arrays: vec![
            Array::vector("Displacement", "m", ids.iter().map(|&id| moved(id)).collect()),
            Array::vector("Velocity", "m/s", ids.iter().map(|&id| [start(id)[1], 0.0, 0.0]).collect()),
            Array::scalar("Density", "kg/m^3", per_particle(1000.0)),
            Array::scalar("Pressure", "Pa", per_particle(0.0)),
            Array::scalar("VonMisesStress", "Pa", per_particle(1e6 * time)),
            Array::tensor("CauchyStress", "Pa", ids.iter().map(|_| shear.map(|f| 1e6 * f)).collect()),
            Array::tensor("DeformationGradient", "1", ids.iter().map(|_| shear).collect()),
            Array::scalar("ParticleSpacing", "m", per_particle(0.01)),
            Array::scalar("ParticleId", "1", Values::I64(ids.clone())),
            Array::scalar("Body", "1", Values::I64(vec![0; ids.len()])),
        ],
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).ok_or("the directory to write is missing")?;
    let results = ResultDir::create(path.as_ref())?;
    let mut series = Series::create(&results)?;
    let mut probe = ProbeTable::create(&results, "corner", &[("x", "m"), ("y", "m")])?;
    for index in 0..3 {
        let frame = frame(index);
        series.write(&frame)?;
        probe.push(frame.time, &[0.39 * (1.0 + frame.time), 0.39])?;
        probe.flush()?;
    }
    Ok(())
}
