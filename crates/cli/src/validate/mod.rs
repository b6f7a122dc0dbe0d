//! `taut validate`: runs published benchmarks and holds what comes out against the papers.

mod accept;
mod evidence;
mod path;
mod row;
mod table;

use crate::Failure;
use crate::arguments::{CaseOptions, ValidateOptions};
use crate::builtin;
use accept::{Accept, Run};
use case::run::{Checkpoints, RunError, Settings, Silent, run as run_case};
use evidence::Evidence;
use output::manifest::hash;
use output::summary::Status;
use output::{OutputError, Summary};
use row::Row;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Name of every benchmark and the text of its `accept.toml`.
const BENCHMARKS: &[(&str, &str)] = &[
    ("tl-plate", include_str!("../../../../validation/tl-plate/accept.toml")),
    ("tl-bending-column", include_str!("../../../../validation/tl-bending-column/accept.toml")),
    ("tl-twisting-column", include_str!("../../../../validation/tl-twisting-column/accept.toml")),
    ("tl-flag", include_str!("../../../../validation/tl-flag/accept.toml")),
    ("tl-punch", include_str!("../../../../validation/tl-punch/accept.toml")),
    ("tl-stent", include_str!("../../../../validation/tl-stent/accept.toml")),
    ("contact-hertz", include_str!("../../../../validation/contact-hertz/accept.toml")),
    ("contact-sphere", include_str!("../../../../validation/contact-sphere/accept.toml")),
    ("contact-bars", include_str!("../../../../validation/contact-bars/accept.toml")),
    ("contact-incline", include_str!("../../../../validation/contact-incline/accept.toml")),
    ("contact-fold", include_str!("../../../../validation/contact-fold/accept.toml")),
    ("tl-pull-2d", include_str!("../../../../validation/tl-pull-2d/accept.toml")),
    ("tl-pull-3d", include_str!("../../../../validation/tl-pull-3d/accept.toml")),
    ("lk-rectangle", include_str!("../../../../validation/lk-rectangle/accept.toml")),
    ("lk-formulations", include_str!("../../../../validation/lk-formulations/accept.toml")),
    ("lk-annulus", include_str!("../../../../validation/lk-annulus/accept.toml")),
    ("lk-stability", include_str!("../../../../validation/lk-stability/accept.toml")),
    ("lk-collision", include_str!("../../../../validation/lk-collision/accept.toml")),
    ("ul-plate-2d", include_str!("../../../../validation/ul-plate-2d/accept.toml")),
    ("ul-plate-3d", include_str!("../../../../validation/ul-plate-3d/accept.toml")),
    ("ul-rings", include_str!("../../../../validation/ul-rings/accept.toml")),
    ("ul-hollow-balls", include_str!("../../../../validation/ul-hollow-balls/accept.toml")),
    ("ul-ball-plate-2d", include_str!("../../../../validation/ul-ball-plate-2d/accept.toml")),
    ("ul-ball-plate-3d", include_str!("../../../../validation/ul-ball-plate-3d/accept.toml")),
];

/// Runs the benchmarks that the options name, all without a name, and tells which checks hold.
pub fn validate(options: &ValidateOptions) -> Result<(), Failure> {
    let benchmarks = chosen(&options.names)?;
    let mut rows = Vec::new();
    for (name, text) in benchmarks {
        let accept = Accept::parse(text)
            .map_err(|what| Failure::Run(format!("validation/{name}/accept.toml is wrong: {what}")))?;
        let judged = benchmark(name, &accept, options)?;
        if !options.json {
            table::lines(&judged).iter().for_each(|line| say!("{line}"));
        }
        rows.extend(judged);
    }
    if options.json {
        let text = serde_json::to_string_pretty(&rows).map_err(|error| Failure::Run(error.to_string()))?;
        say!("{text}");
    }
    match rows.iter().filter(|row| !row.holds).count() {
        0 => Ok(()),
        failed => Err(Failure::Run(format!("{failed} of {} checks fail", rows.len()))),
    }
}

fn chosen(names: &[String]) -> Result<Vec<&'static (&'static str, &'static str)>, Failure> {
    if names.is_empty() {
        return Ok(BENCHMARKS.iter().collect());
    }
    let find = |name: &String| {
        BENCHMARKS.iter().find(|(known, _)| known == name).ok_or_else(|| {
            let known: Vec<&str> = BENCHMARKS.iter().map(|(known, _)| *known).collect();
            Failure::Input(format!("there is no benchmark `{name}`\nbenchmarks: {}", known.join(", ")))
        })
    };
    names.iter().map(find).collect()
}

/// Makes the runs of one benchmark, each once, and judges its checks.
fn benchmark(name: &str, accept: &Accept, options: &ValidateOptions) -> Result<Vec<Row>, Failure> {
    let checks: Vec<_> =
        accept.checks.iter().filter(|check| options.full || !accept.is_full(check)).collect();
    let scratch = tempfile::tempdir()
        .map_err(|error| Failure::Run(format!("cannot make a temporary directory: {error}")))?;
    let out = options.out.as_ref().map_or(scratch.path().to_path_buf(), |out| out.join(name));
    let needed: BTreeSet<usize> = checks.iter().flat_map(|check| Accept::needs(check)).collect();
    let mut done = BTreeMap::new();
    say(options, name);
    for index in needed {
        let run = &accept.runs[index];
        let evidence = perform(&accept.case, run, &out.join(&run.name), options)?;
        say(options, &told(run, &evidence));
        done.insert(index, evidence);
    }
    Ok(checks.iter().map(|check| Row::new(name, (accept, check), |run| &done[&run])).collect())
}

/// Makes one run. One that diverges has left a summary, and that is evidence too.
fn perform(case: &str, run: &Run, out: &Path, how: &ValidateOptions) -> Result<Evidence, Failure> {
    let options =
        CaseOptions { case: case.to_string(), set: run.set.clone(), formulation: run.formulation.clone() };
    let mut case = builtin::read(&options)?;
    // Checks ask for the disorder at certain times: it is measured with every frame, though that takes longer.
    case.monitor.apart = (0, 0.0);
    let settings = Settings {
        out: out.to_path_buf(),
        threads: how.threads.map(usize::from),
        numbers: how.precision.into(),
        checkpoints: Checkpoints::default(),
    };
    let unreadable = |error: OutputError| Failure::Run(format!("{error}\nhint: {}", error.hint()));
    let summary = match run_case(&case, &settings, &mut Silent) {
        Ok(summary) => summary,
        Err(RunError::Diverged { .. }) => Summary::read(out).map_err(unreadable)?,
        Err(error) if error.is_input() => return Err(Failure::Input(error.to_string())),
        Err(error) => return Err(Failure::Run(error.to_string())),
    };
    let manifest = out.join("manifest.json");
    let bytes = std::fs::read(&manifest)
        .map_err(|error| Failure::Run(format!("cannot read {}: {error}", manifest.display())))?;
    Ok(Evidence {
        directory: out.to_path_buf(),
        summary,
        manifest: hash(&bytes),
        may_diverge: run.may_diverge,
    })
}

/// A run in a line.
fn told(run: &Run, evidence: &Evidence) -> String {
    let s = &evidence.summary;
    let settings = if run.set.is_empty() { "as the case is" } else { &run.set.join(", ") };
    let ended = if s.status == Status::Done { "" } else { ", diverged" };
    format!(
        "  run {}: {}, {settings}: {} particles, {} steps, {:.1} s{ended}",
        run.name, s.formulation, s.particles, s.steps, s.wall_seconds
    )
}

/// Says a line, but not into the JSON.
fn say(options: &ValidateOptions, line: &str) {
    if options.json {
        complain!("{line}");
    } else {
        say!("{line}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_accept_file_is_right_and_its_runs_are_cases() {
        for (name, text) in BENCHMARKS {
            let accept = Accept::parse(text).unwrap_or_else(|what| panic!("{name}: {what}"));
            let used: BTreeSet<usize> = accept.checks.iter().flat_map(Accept::needs).collect();
            assert_eq!(used.len(), accept.runs.len(), "{name}: a run that nobody looks at");
            for run in accept.runs {
                let (set, formulation) = (run.set, run.formulation);
                let options = CaseOptions { case: accept.case.clone(), set, formulation };
                assert!(builtin::read(&options).is_ok(), "{name}: {}", run.name);
            }
        }
    }

    #[test]
    fn unknown_benchmarks_are_wrong_input() {
        let wrong = chosen(&["ul-rings".to_string(), "ul-ring".to_string()]);
        assert!(matches!(wrong, Err(Failure::Input(message)) if message.contains("ul-plate-2d")));
        assert_eq!(chosen(&[]).map(|all| all.len()).ok(), Some(BENCHMARKS.len()));
    }
}
