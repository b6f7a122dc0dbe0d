//! `[time]` and `[monitor]`.

use super::defaults;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Key, monitor as monitor_keys, time as keys};
use crate::source::Place;
use crate::written::{Node, Section, Table, Value};

/// How long, and how often something is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// End of the run, s.
    pub end: f64,
    /// Time between two frames, s.
    pub output: f64,
    /// A frame is written so many steps, or so much time (s), after the last one at the earliest.
    pub apart: (u64, f64),
}

/// The watch over disorder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Monitor {
    /// Zigzag (root mean square over the spacing) above which the run warns.
    pub zigzag: f64,
    /// Length of a bond over the spacing below which it does.
    pub bond_min: f64,
    /// Share of broken bonds above which it does.
    pub broken: f64,
    /// Whether it ends there.
    pub stop: bool,
    /// Time between two looks at energies, contact and disorder, s.
    pub interval: f64,
    /// Disorder is measured at a look so many steps, or so much time (s), after the last time.
    pub apart: (u64, f64),
}

/// Both tables. (The keys `cfl` and `step` belong to the schemes.)
pub(crate) fn read(root: &Table, scope: &Scope, problems: &mut Problems) -> Option<(Time, Monitor)> {
    let time = time(root, scope, problems)?;
    let mut monitor = Monitor {
        zigzag: defaults::ZIGZAG,
        bond_min: defaults::BOND_MIN,
        broken: defaults::BROKEN,
        stop: false,
        interval: time.output,
        apart: (defaults::DISORDER_STEPS, f64::INFINITY),
    };
    let Some(node) = root.get("monitor") else { return Some((time, monitor)) };
    let section = problems.keep(Section::of(node, "[monitor]"))?;
    section.only(monitor_keys::TABLE.keys, problems);
    let mut threshold = |key, default: &mut f64| {
        if let Some(Some(given)) = problems.keep(scope.get(&section, key)) {
            *default = given;
        }
    };
    threshold(&monitor_keys::ZIGZAG, &mut monitor.zigzag);
    threshold(&monitor_keys::BOND_MIN, &mut monitor.bond_min);
    threshold(&monitor_keys::BROKEN, &mut monitor.broken);
    if let Some(interval) = problems.keep(scope.get(&section, &monitor_keys::INTERVAL))? {
        (monitor.interval, monitor.apart) = (interval, (0, 0.0));
    }
    if let Some(node) = section.get(monitor_keys::STOP.name) {
        monitor.stop = problems.keep(flag(node, &monitor_keys::STOP)).unwrap_or_default();
    }
    Some((time, monitor))
}

/// `true` or `false`.
pub(super) fn flag(node: &Node, key: &Key) -> Result<bool, Diagnostic> {
    match node.value {
        Value::Bool(flag) => Ok(flag),
        _ => Err(Diagnostic::at(
            node.place,
            format!("`{}` has to be `true` or `false`, found {}", key.name, node.found()),
        )),
    }
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
    Some(match output? {
        Some(output) => Time { end, output, apart: (0, 0.0) },
        None => {
            let apart = (defaults::FRAME_STEPS, end / defaults::FEWEST_FRAMES);
            Time { end, output: end / defaults::FRAMES, apart }
        }
    })
}
