//! Draws made-up particles, to look at: `cargo run -p taut-report --example gallery -- DIRECTORY`

use std::f64::consts::{PI, TAU};
use std::path::Path;

use output::{Array, Column, Frame, Table, Values};
use report::{Picture, ReportError, View, picture, plot_probe, write_png};

/// A frame with the arrays that pictures use.
fn frame(time: f64, spacing: f64, particles: Vec<([f64; 3], f64)>) -> Frame {
    let (points, stress): (Vec<_>, Vec<_>) = particles.into_iter().unzip();
    let n = points.len();
    let arrays = vec![
        Array::scalar("VonMisesStress", "Pa", Values::F64(stress)),
        Array::scalar("ParticleSpacing", "m", Values::F64(vec![spacing; n])),
    ];
    Frame { time, step: 0, points, arrays }
}

/// A plate, clamped on its left, bent upwards.
fn bent_plate(length: f64, height: f64, layers: usize) -> Frame {
    let dp = height / layers as f64;
    let columns = (length / dp) as usize;
    let mut particles = Vec::new();
    for i in 0..columns {
        for j in 0..layers {
            let (s, y) = ((i as f64 + 0.5) * dp, (j as f64 + 0.5) * dp - 0.5 * height);
            let turn = 0.9 * s / length;
            let radius = length / 0.9;
            let point = [(radius - y) * turn.sin(), radius - (radius - y) * turn.cos(), 0.0];
            particles.push((point, 2e6 * (0.9 * y / length).abs() * (1.4 - s / length)));
        }
    }
    frame(0.254, dp, particles)
}

/// A square column, twisted about its axis.
fn twisted_column(width: f64, height: f64, layers: usize) -> Frame {
    let dp = width / layers as f64;
    let levels = (height / dp) as usize;
    let mut particles = Vec::new();
    for k in 0..levels {
        for (i, j) in (0..layers).flat_map(|i| (0..layers).map(move |j| (i, j))) {
            let at = |n: usize| (n as f64 + 0.5) * dp;
            let (x, y, z) = (at(i) - 0.5 * width, at(j) - 0.5 * width, at(k));
            let (sin, cos) = (1.5 * PI * z / height).sin_cos();
            let point = [cos * x - sin * y, sin * x + cos * y, z];
            particles.push((point, 17e6 * x.hypot(y) / width * (1.2 - z / height)));
        }
    }
    frame(0.1, dp, particles)
}

/// A damped swing of two components, and a gap.
fn swing() -> Table {
    let times: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 5e-5).collect();
    let y = times.iter().map(|t| 0.021 * (TAU * t / 0.254).sin() * (-0.3 * t).exp()).collect();
    let x = times
        .iter()
        .map(|t| if *t > 0.5 && *t < 0.55 { f64::NAN } else { -0.004 * (TAU * t / 0.127).sin().abs() });
    let column = |name: &str, values| Column { name: name.to_string(), unit: "m".to_string(), values };
    Table { columns: vec![column("x", x.collect()), column("y", y)], times }
}

fn draw(folder: &Path, name: &str, frame: &Frame, view: Option<View>) -> Result<(), ReportError> {
    let options = Picture { title: name.replace('-', " "), view, ..Picture::default() };
    write_png(&picture(frame, &options), &folder.join(format!("{name}.png")))
}

/// Ten particles, and a million: both have to be readable.
fn extremes() -> [(&'static str, Frame, Option<View>); 4] {
    let few = (0..10).map(|i| ([0.01 * f64::from(i), 0.001 * f64::from(i * i), 0.0], f64::from(i - 3) * 1e5));
    let few: Vec<_> = few.collect();
    [
        ("ten-discs", frame(0.0, 0.01, few.clone()), None),
        ("ten-balls", frame(0.0, 0.01, few), Some(View::default())),
        ("million-discs", bent_plate(0.2, 0.02, 316), None),
        ("million-balls", twisted_column(1.0, 6.0, 55), Some(View::default())),
    ]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let argument = std::env::args_os().nth(1).ok_or("the directory to draw into is missing")?;
    let folder = Path::new(&argument);
    std::fs::create_dir_all(folder)?;
    draw(folder, "bent-plate", &bent_plate(0.2, 0.02, 10), None)?;
    draw(folder, "fine-plate", &bent_plate(0.2, 0.02, 40), None)?;
    draw(folder, "twisted-column", &twisted_column(1.0, 6.0, 12), Some(View::default()))?;
    draw(folder, "fine-column", &twisted_column(1.0, 6.0, 30), Some(View::default()))?;
    draw(folder, "plate-in-space", &bent_plate(0.2, 0.02, 10), Some(View::default()))?;
    for (name, frame, view) in extremes() {
        let start = std::time::Instant::now();
        draw(folder, name, &frame, view)?;
        println!("{name}: {} particles in {:.2} s", frame.points.len(), start.elapsed().as_secs_f64());
    }
    plot_probe("Tip of the plate", &swing(), None, &folder.join("swing.svg"))?;
    Ok(())
}
