//! A factor over time, as a list or a table in a file.

use super::scope::Scope;
use crate::diagnostic::Diagnostic;
use crate::units::Dimension;
use crate::written::{Node, Value};
use output::limited::LONGEST_TEXT;

/// A number over time, linear between its points.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// (time, s; value), times ascending, at least one.
    points: Vec<[f64; 2]>,
}

impl History {
    /// The value at time `t`, s; before the first point that of the first, after the last that of the last.
    pub fn at(&self, t: f64) -> f64 {
        let next = self.points.partition_point(|&[time, _]| time <= t);
        match (next.checked_sub(1).map(|i| self.points[i]), self.points.get(next)) {
            (Some([t0, y0]), Some(&[t1, y1])) => y0 + (y1 - y0) * ((t - t0) / (t1 - t0)),
            (Some([_, y]), None) | (None, Some(&[_, y])) => y,
            (None, None) => 1.0,
        }
    }

    /// From points whose places are told by number.
    fn new(points: Vec<[f64; 2]>) -> Result<Self, (usize, String)> {
        for (i, pair) in points.windows(2).enumerate() {
            if pair[1][0] <= pair[0][0] {
                return Err((i + 1, format!("time {} s does not come after {} s", pair[1][0], pair[0][0])));
            }
        }
        Ok(Self { points })
    }
}

/// The history that a key gives.
pub(super) fn read(scope: &Scope, node: &Node) -> Result<History, Diagnostic> {
    match &node.value {
        Value::Text(name) => file(scope, node, name),
        Value::Array(rows) if !rows.is_empty() => list(scope, rows),
        _ => Err(Diagnostic::at(
            node.place,
            format!(
                "`history` has to be a list of [time, factor] or the name of a file, found {}",
                node.found()
            ),
        )
        .help("for example history = [[0, 0], [\"10 ms\", 1]], or history = \"ramp.csv\"")),
    }
}

fn list(scope: &Scope, rows: &[Node]) -> Result<History, Diagnostic> {
    let row = |row: &Node| match &row.value {
        Value::Array(pair) if pair.len() == 2 => Ok([
            scope.number(&pair[0], "a time of `history`", Dimension::TIME)?,
            scope.number(&pair[1], "a factor of `history`", Dimension::NUMBER)?,
        ]),
        _ => Err(Diagnostic::at(
            row.place,
            format!("`history` has to be made of pairs, found {}", row.found()),
        )
        .label("expected [time, factor]")),
    };
    let points = rows.iter().map(row).collect::<Result<Vec<_>, _>>()?;
    History::new(points).map_err(|(at, problem)| {
        Diagnostic::at(rows[at].place, format!("the times of `history` have to ascend: {problem}"))
    })
}

/// A table of two columns; lines that begin with `#`, empty ones, and a first line of names are passed over.
fn file(scope: &Scope, node: &Node, name: &str) -> Result<History, Diagnostic> {
    let path = scope.files.path(name);
    let wrong = |problem: String| Diagnostic::at(node.place, problem);
    let unread = |reason: String| wrong(format!("cannot read the history {}: {reason}", path.display()));
    let bytes = scope.files.read(name, LONGEST_TEXT).map_err(unread)?;
    let text = String::from_utf8(bytes).map_err(|error| unread(error.to_string()))?;
    let mut points = Vec::new();
    let mut lines = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let numbers: Option<Vec<f64>> = line
            .split([',', ';', '\t'])
            .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
            .collect();
        match numbers.as_deref() {
            Some(&[time, factor]) => {
                points.push([time, factor]);
                lines.push(index + 1);
            }
            None if points.is_empty() && index == 0 => {}
            _ => {
                let at =
                    format!("line {} of {} is not a time and a factor: `{line}`", index + 1, path.display());
                return Err(wrong(at).help("two numbers with a comma between them, the time in seconds"));
            }
        }
    }
    if points.is_empty() {
        return Err(wrong(format!("{} has no rows of a time and a factor", path.display())));
    }
    History::new(points).map_err(|(at, problem)| {
        wrong(format!("line {} of {}: {problem}; times have to ascend", lines[at], path.display()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_between_its_points_and_constant_outside() {
        let history = History::new(vec![[1.0, 0.0], [3.0, 4.0], [4.0, -1.0]]).expect("ascending");
        for (t, expected) in
            [(0.0, 0.0), (1.0, 0.0), (1.5, 1.0), (3.0, 4.0), (3.5, 1.5), (4.0, -1.0), (9.0, -1.0)]
        {
            assert_eq!(history.at(t), expected, "{t}");
        }
        assert_eq!(History::new(vec![[2.0, 7.0]]).expect("one").at(-1.0), 7.0);
        assert_eq!(History::new(vec![[1.0, 0.0], [1.0, 1.0]]).expect_err("twice").0, 1);
    }
}
