//! How long signed distances take: `cargo run --release -p taut-geometry --example distances [TRIANGLES [FILE]]`.
//! Without a file: a ball with waves of about so many triangles (100 000), whole and with a tenth of them missing, a stent, and a combination.

use geometry::{Mesh, Point, Shape, Stent};
use std::f64::consts::PI;
use std::time::Instant;

/// Points.
const POINTS: usize = 1_000_000;

/// A ball of radius 1 with waves, of about so many triangles.
fn waves(triangles: usize) -> (Vec<Point>, Vec<[u32; 3]>) {
    let n = ((triangles as f64 / 4.0).sqrt() as u32).max(3);
    let point = |i: u32, j: u32| {
        let (a, b) = (PI * f64::from(i) / f64::from(n), PI * f64::from(j) / f64::from(n));
        let r = 1.0 + 0.1 * (7.0 * a).sin() * (5.0 * b).sin();
        [r * a.sin() * b.cos(), r * a.sin() * b.sin(), r * a.cos()]
    };
    let points = (0..=n).flat_map(|i| (0..2 * n).map(move |j| point(i, j))).collect();
    let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
    let pair = |i: u32, j: u32| {
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    let faces = (0..n).flat_map(|i| (0..2 * n).flat_map(move |j| pair(i, j))).collect();
    (points, faces)
}

/// Distances of a lattice of points in the box of a shape, on so many threads.
fn time(shape: &Shape, threads: usize) {
    let (bounds, n) = (shape.bounds(), (POINTS as f64).cbrt().round() as usize);
    let x = |k: usize| -> Point {
        let place = [k % n, k / n % n, k / n / n];
        std::array::from_fn(|i| bounds.min[i] + bounds.extent()[i] * (place[i] as f64 + 0.5) / n as f64)
    };
    let clock = Instant::now();
    let part =
        |thread: usize| (thread..POINTS).step_by(threads).filter(|&k| shape.distance(x(k)) < 0.0).count();
    let inside: usize = std::thread::scope(|scope| {
        let work: Vec<_> = (0..threads).map(|thread| scope.spawn(move || part(thread))).collect();
        work.into_iter().map(|thread| thread.join().unwrap_or(0)).sum()
    });
    let (seconds, share) = (clock.elapsed().as_secs_f64(), inside as f64 / POINTS as f64);
    println!("  {threads} threads: {POINTS} points in {seconds:.2} s; {share:.4} of them inside");
}

fn show(what: &str, make: impl FnOnce() -> Result<Mesh, geometry::MeshError>) {
    let clock = Instant::now();
    let mesh = match make() {
        Ok(mesh) => mesh,
        Err(error) => return println!("{what}: {error}"),
    };
    println!("{what}: {} triangles, ready after {:.2} s", mesh.faces().len(), clock.elapsed().as_secs_f64());
    let report = mesh.report();
    println!("  inside by {}", if report.winding { "winding number" } else { "normals" });
    [1, 2].into_iter().for_each(|threads| time(&Shape::Mesh(mesh.clone()), threads));
}

/// Shapes that are drawn.
fn drawn() -> [(&'static str, Shape); 2] {
    let (length, diameter, thickness) = (0.02, 0.01, 1e-4);
    let stent = Stent { length, diameter, thickness, around: 8, along: 4, strut: 3e-4, bridge: 6e-4 };
    let cylinder = Shape::Cylinder { from: [0.5, 0.5, -1.0], to: [0.5, 0.5, 2.0], radius: 0.2 };
    let cut = Shape::Rotate { angle: 0.4, axis: [1.0, 2.0, 3.0], about: [0.5; 3], shape: Box::new(cylinder) };
    let (brick, ball) =
        (Shape::Box { min: [0.0; 3], max: [1.0; 3] }, Shape::Ball { center: [1.0; 3], radius: 0.4 });
    let both = Shape::Union(vec![brick, ball]);
    [
        ("a stent", Shape::Stent(stent)),
        ("a box and a ball, less a cylinder", Shape::Difference(Box::new(both), vec![cut])),
    ]
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let triangles = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(100_000);
    if let Some(file) = arguments.next() {
        return match std::fs::read(&file) {
            Ok(bytes) => show(&file, || Mesh::read(&bytes, &file, 1.0).map(|(mesh, _)| mesh)),
            Err(error) => println!("{file}: {error}"),
        };
    }
    let (points, faces) = waves(triangles);
    show("a ball with waves", || Mesh::new(points.clone(), faces.clone()));
    let holed: Vec<[u32; 3]> =
        faces.iter().enumerate().filter(|(k, _)| k % 10 != 0).map(|(_, f)| *f).collect();
    show("the same, every tenth triangle missing", || Mesh::new(points.clone(), holed));
    let shifted = points.iter().map(|x| [x[0] + 0.5, x[1], x[2]]);
    let both: Vec<Point> = points.iter().copied().chain(shifted).collect();
    let count = points.len() as u32;
    let second = faces.iter().map(|face| face.map(|corner| corner + count));
    let crossing = faces.iter().copied().chain(second).collect();
    show("two of them, which cross", || Mesh::new(both, crossing));
    for (what, shape) in drawn() {
        println!("{what}");
        [1, 2].into_iter().for_each(|threads| time(&shape, threads));
    }
}
