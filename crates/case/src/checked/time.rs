//! `[time]` and `[monitor]`.

use super::defaults;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{monitor as monitor_keys, time as keys};
use crate::source::Place;
use crate::written::{Section, Table};

/// How long, and how often something is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// End of the run, s.
    pub end: f64,
    /// Time between two frames, s.
    pub output: f64,
}

/// The watch over disorder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Monitor {
    /// Zigzag (root mean square over the spacing) beyond which the run warns; `None` for never.
    pub zigzag: Option<f64>,
    /// Time between two looks at energies, contact and disorder, s.
    pub interval: f64,
    /// Disorder is measured at a look so many steps, or so much time (s), after the last time.
    pub apart: (u64, f64),
}

/// Both tables. (The keys `cfl` and `step` belong to the schemes.)
pub(crate) fn read(root: &Table, scope: &Scope, problems: &mut Problems) -> Option<(Time, Monitor)> {
    let time = time(root, scope, problems)?;
    let apart = (defaults::DISORDER_STEPS, time.end / defaults::DISORDER_SAMPLES);
    let mut monitor = Monitor { zigzag: None, interval: time.output, apart };
    let Some(node) = root.get("monitor") else { return Some((time, monitor)) };
    let section = problems.keep(Section::of(node, "[monitor]"))?;
    section.only(monitor_keys::TABLE.keys, problems);
    monitor.zigzag = problems.keep(scope.get(&section, &monitor_keys::ZIGZAG)).flatten();
    if let Some(interval) = problems.keep(scope.get(&section, &monitor_keys::INTERVAL))? {
        (monitor.interval, monitor.apart) = (interval, (0, 0.0));
    }
    Some((time, monitor))
}

fn time(root: &Table, scope: &Scope, problems: &mut Problems) -> Option<Time> {
    let Some(node) = root.get("time") else {
        problems.0.push(
            Diagnostic::at(Place::START, "missing table `[time]` with `end`")
                .help("for example [time] with end = 0.01"),
        );
        return None;
    };
    let section = problems.keep(Section::of(node, "[time]"))?;
    section.only(keys::TABLE.keys, problems);
    let end = problems.keep(scope.need(&section, &keys::END));
    let output = problems.keep(scope.get(&section, &keys::OUTPUT));
    let end = end?;
    Some(Time { end, output: output?.unwrap_or(end / defaults::FRAMES) })
}
