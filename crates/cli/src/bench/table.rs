//! The answer for people: limits and rows in columns, as plain text or as Markdown.

use super::limits::Limits;
use super::report::{Report, Row};

/// How columns are set apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// By spaces.
    Plain,
    /// By bars, as Markdown has it.
    Markdown,
}

/// 16 GiB, bytes.
const SIXTEEN_GIB: f64 = 17_179_869_184.0;

type Cells = Vec<String>;

/// The limits of the machine.
pub fn limits(limits: &[Limits], style: Style) -> Vec<String> {
    let head = ["threads", "double, GF/s", "single, GF/s", "triad, GB/s"].map(str::to_string).to_vec();
    let cells = limits.iter().map(|l| {
        let giga = |x: f64| format!("{:.1}", x / 1e9);
        vec![l.threads.to_string(), giga(l.double_flops), giga(l.single_flops), giga(l.triad_bytes)]
    });
    columns(&std::iter::once(head).chain(cells).collect::<Vec<_>>(), style)
}

/// The rows; with an earlier report, its ratio to every row.
pub fn rows(report: &Report, earlier: Option<&Report>, style: Style) -> Vec<String> {
    let mut head: Cells = [
        "body",
        "particles",
        "neighbours",
        "threads",
        "Mps/s",
        "per core",
        "Mpairs/s",
        "B/particle",
        "M in 16 GiB",
        "of FMA",
        "of triad",
        "steps/list",
        "relist",
    ]
    .map(str::to_string)
    .to_vec();
    if earlier.is_some() {
        head.push("to earlier".to_string());
    }
    let rows = report.rows.iter().map(|row| {
        let mut cells = cells(row);
        if let Some(earlier) = earlier {
            cells.push(ratio(row, earlier));
        }
        cells
    });
    columns(&std::iter::once(head).chain(rows).collect::<Vec<_>>(), style)
}

fn cells(row: &Row) -> Cells {
    let share = |x: f64| format!("{:.1} %", 100.0 * x);
    let maybe = |x: Option<f64>, show: &dyn Fn(f64) -> String| x.map_or("-".to_string(), show);
    let million = row.particle_steps_per_second / 1e6;
    vec![
        row.name.clone(),
        row.particles.to_string(),
        format!("{:.1}", row.neighbours),
        row.threads.to_string(),
        format!("{million:.2}"),
        format!("{:.2}", million / row.threads as f64),
        format!("{:.0}", row.pairs_per_second / 1e6),
        maybe(row.bytes_per_particle, &|x| format!("{x:.0}")),
        maybe(row.bytes_per_particle, &|x| format!("{:.1}", SIXTEEN_GIB / x / 1e6)),
        share(row.of_flops),
        maybe(row.of_triad, &share),
        maybe(row.steps_per_list, &|x| format!("{x:.1}")),
        maybe(row.relist_share, &share),
    ]
}

/// Speed over that of the earlier row of the same body on as many threads.
fn ratio(row: &Row, earlier: &Report) -> String {
    match earlier.row(&row.name, row.threads) {
        None => "no such row".to_string(),
        Some(old) if old.particles != row.particles => "other size".to_string(),
        Some(old) => format!("{:.3}", row.particle_steps_per_second / old.particle_steps_per_second),
    }
}

/// Cells in columns: the first to the left, numbers to the right.
fn columns(cells: &[Cells], style: Style) -> Vec<String> {
    let count = cells.first().map_or(0, Vec::len);
    let width = |k: usize| cells.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut lines = Vec::new();
    for (i, row) in cells.iter().enumerate() {
        let padded = row.iter().zip(&widths).enumerate().map(|(k, (cell, width))| match k {
            0 => format!("{cell:<width$}"),
            _ => format!("{cell:>width$}"),
        });
        let padded: Cells = padded.collect();
        match style {
            Style::Plain => lines.push(padded.join("  ").trim_end().to_string()),
            Style::Markdown => lines.push(format!("| {} |", padded.join(" | "))),
        }
        if i == 0 && style == Style::Markdown {
            let rule = widths.iter().enumerate().map(|(k, width)| match k {
                0 => "-".repeat(width + 2),
                _ => "-".repeat(width + 1) + ":",
            });
            lines.push(format!("|{}|", rule.collect::<Cells>().join("|")));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::report::FORMAT;
    use output::manifest::Machine;

    fn report(speed: f64, names: &[&str]) -> Report {
        let row = |name: &&str| Row {
            name: name.to_string(),
            threads: 2,
            particles: 1000,
            neighbours: 18.25,
            particle_steps_per_second: speed,
            median_particle_steps_per_second: speed,
            pairs_per_second: 18.25 * speed,
            bytes_per_particle: None,
            flops_per_particle_step: 1000.0,
            of_flops: 0.25,
            of_triad: None,
            steps_per_list: Some(10.0),
            relist_share: Some(0.095),
        };
        Report {
            format: FORMAT.into(),
            taut: "0".into(),
            started: "then".into(),
            quick: true,
            processor: None,
            machine: Machine::here("plain"),
            limits: Vec::new(),
            rows: names.iter().map(row).collect(),
        }
    }

    #[test]
    fn rows_are_aligned_and_compared() {
        let lines = rows(&report(3e6, &["a/2d", "bb"]), Some(&report(2e6, &["a/2d"])), Style::Plain);
        assert_eq!(lines.len(), 3);
        assert!(lines[1].starts_with("a/2d") && lines[1].ends_with("1.500"), "{}", lines[1]);
        assert!(lines[1].contains("3.00") && lines[1].contains("1.50") && lines[1].contains("25.0 %"));
        assert!(lines[1].contains("9.5 %") && lines[1].contains(" - "), "{}", lines[1]);
        assert!(lines[2].ends_with("no such row"), "{}", lines[2]);
        assert_eq!(lines[0].find("threads").map(|at| at + 7), lines[1].find(" 2 ").map(|at| at + 2));
    }

    #[test]
    fn markdown_has_a_rule_and_as_many_cells_everywhere() {
        let lines = rows(&report(3e6, &["a"]), None, Style::Markdown);
        assert_eq!(lines.len(), 3);
        let bars = lines.iter().map(|line| line.matches('|').count()).collect::<Vec<_>>();
        assert_eq!(bars, [14, 14, 14]);
        assert!(lines[1].starts_with("|--") && lines[1].ends_with(":|"));
    }
}
