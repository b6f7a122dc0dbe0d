//! `[time]` and `[monitor]`.

use super::defaults;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::source::Place;
use crate::units::Dimension;
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
    /// Time between two measurements, s.
    pub interval: f64,
}

/// Both tables. (The keys `cfl` and `step` belong to the schemes.)
pub(crate) fn read(root: &Table, scope: &Scope, problems: &mut Problems) -> Option<(Time, Monitor)> {
    let time = time(root, scope, problems)?;
    let mut monitor = Monitor { zigzag: None, interval: time.output };
    let Some(node) = root.get("monitor") else { return Some((time, monitor)) };
    let section = problems.keep(Section::of(node, "[monitor]"))?;
    section.only(&["zigzag", "interval"], problems);
    if let Some(node) = section.get("zigzag") {
        monitor.zigzag = problems.keep(scope.positive(node, "`zigzag`", Dimension::NUMBER));
    }
    if let Some(node) = section.get("interval") {
        monitor.interval = problems.keep(scope.positive(node, "`interval`", Dimension::TIME))?;
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
    section.only(&["end", "output", "cfl", "step"], problems);
    let end = section.need("end").and_then(|node| scope.positive(node, "`end`", Dimension::TIME));
    let end = problems.keep(end);
    let output = section.get("output").map(|node| scope.positive(node, "`output`", Dimension::TIME));
    let output = problems.keep(output.transpose());
    let end = end?;
    Some(Time { end, output: output?.unwrap_or(end / defaults::FRAMES) })
}
