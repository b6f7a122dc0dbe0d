//! `taut bench`: how fast this machine runs every formulation, and how far that is from what it can do.

mod body;
mod limits;
mod measure;
mod report;
mod subject;
mod table;

use crate::Failure;
use crate::arguments::BenchOptions;
use body::Size;
use limits::{Arrays, Limits};
use measure::{Living, Timing};
use output::manifest::{Machine, utc};
use report::{FORMAT, Report, Row};
use std::path::Path;
use std::time::SystemTime;
use subject::{Subject, chosen};
use table::Style;
use taut::run::InstructionSet;

/// Measures what the options name, prints the table, writes and compares files.
pub fn bench(options: &BenchOptions) -> Result<(), Failure> {
    let subjects = chosen(&options.filter);
    if subjects.is_empty() {
        return Err(unknown(&options.filter));
    }
    if let Some(path) = &options.json {
        is_free(path)?;
    }
    let earlier = options.compare.as_deref().map(Report::read).transpose()?;
    let report = measure(&subjects, options)?;
    let style = if options.markdown { Style::Markdown } else { Style::Plain };
    say!("{}\n", report.place());
    table::limits(&report.limits, style).iter().for_each(|line| say!("{line}"));
    say!("");
    if let Some(earlier) = &earlier {
        say!("compared with {}\n", earlier.place());
    }
    table::rows(&report, earlier.as_ref(), style).iter().for_each(|line| say!("{line}"));
    options.json.as_deref().map_or(Ok(()), |path| report.write(path))
}

fn unknown(words: &[String]) -> Failure {
    let names: Vec<String> = Subject::all().iter().map(Subject::name).collect();
    let wanted = words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(" and ");
    Failure::Input(format!("no body has {wanted} in its name\nbodies:\n  {}", names.join("\n  ")))
}

fn is_free(path: &Path) -> Result<(), Failure> {
    if path.exists() {
        return Err(Failure::Input(format!(
            "{} already exists and is not overwritten\nhint: give another name with --json",
            path.display()
        )));
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => Err(Failure::Input(format!("there is no folder {}", folder.display()))),
        None => Ok(()),
    }
}

/// A pool for each number of threads, the largest last.
fn pools(options: &BenchOptions) -> Result<Vec<rayon::ThreadPool>, Failure> {
    let mut threads: Vec<usize> = options.threads.iter().map(|&n| usize::from(n)).collect();
    if threads.is_empty() {
        threads = vec![1, std::thread::available_parallelism().map_or(1, usize::from)];
    }
    threads.sort_unstable();
    threads.dedup();
    let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build();
    let failed =
        |error| Failure::Run(format!("cannot start threads: {error}\nhint: try fewer with --threads"));
    threads.into_iter().map(pool).collect::<Result<_, _>>().map_err(failed)
}

fn measure(subjects: &[Subject], options: &BenchOptions) -> Result<Report, Failure> {
    let (size, seconds) = if options.quick { (Size::Quick, 0.15) } else { (Size::Full, 1.0) };
    let pools = pools(options)?;
    let started = utc(SystemTime::now());
    let mut arrays = Arrays::new(size);
    let mut limits = |pools: &[rayon::ThreadPool]| -> Vec<Limits> {
        pools.iter().map(|pool| pool.install(|| Limits::measure(&mut arrays))).collect()
    };
    let before = limits(&pools);
    let mut timed = Vec::new();
    for (k, subject) in subjects.iter().enumerate() {
        complain!("{:>3} of {}  {}", k + 1, subjects.len(), subject.name());
        timed.push(
            living(subject, (size, seconds), &pools)
                .map_err(|what| Failure::Run(format!("{}: {what}", subject.name())))?,
        );
    }
    let limits: Vec<Limits> = before.iter().zip(limits(&pools)).map(|(a, b)| a.or(&b)).collect();
    let rows = subjects.iter().zip(&timed).flat_map(|(subject, (living, timings))| {
        timings.iter().zip(&limits).map(|(timing, limits)| row(subject, living, (timing, limits)))
    });
    Ok(Report {
        format: FORMAT.to_string(),
        taut: env!("CARGO_PKG_VERSION").to_string(),
        started,
        quick: options.quick,
        processor: report::processor(),
        machine: Machine::here(InstructionSet::best().name()),
        rows: rows.collect(),
        limits,
    })
}

/// A body, and its timing in every pool.
fn living(
    subject: &Subject,
    (size, seconds): (Size, f64),
    pools: &[rayon::ThreadPool],
) -> Result<(Facts, Vec<Timing>), String> {
    let most = pools.last().map(|pool| pool.install(|| Living::start(subject, size)));
    let mut living = match most {
        Some(living) => living?,
        None => Living::start(subject, size)?,
    };
    let timings = pools.iter().map(|pool| pool.install(|| living.time(seconds))).collect::<Result<_, _>>()?;
    Ok((Facts { particles: living.particles, neighbours: living.neighbours, bytes: living.bytes }, timings))
}

/// What is known of a body when it is gone.
struct Facts {
    particles: usize,
    neighbours: f64,
    bytes: Option<f64>,
}

fn row(subject: &Subject, body: &Facts, (timing, limits): (&Timing, &Limits)) -> Row {
    let speed = body.particles as f64 / timing.best;
    let flops = body::count(subject).with_neighbours(body.neighbours);
    let dual = subject.is_dual();
    Row {
        name: subject.name(),
        threads: limits.threads,
        particles: body.particles,
        neighbours: body.neighbours,
        particle_steps_per_second: speed,
        median_particle_steps_per_second: body.particles as f64 / timing.median,
        pairs_per_second: speed * body.neighbours,
        bytes_per_particle: body.bytes,
        flops_per_particle_step: flops,
        of_flops: speed * flops / limits.flops(subject.numbers),
        of_triad: body.bytes.map(|bytes| speed * bytes / limits.triad_bytes),
        steps_per_list: dual.then_some(timing.steps_per_list),
        relist_share: timing.relist_share,
    }
}
