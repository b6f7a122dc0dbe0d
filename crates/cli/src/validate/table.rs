//! The answer for people.

use super::row::Row;

/// Lines for the rows of one benchmark, in columns.
pub fn lines(rows: &[Row]) -> Vec<String> {
    let head = ["run", "quantity", "obtained", "expected", "difference", "allowed"].map(str::to_string);
    let cells: Vec<[String; 6]> = std::iter::once(head).chain(rows.iter().map(cells)).collect();
    let widths: [usize; 6] =
        std::array::from_fn(|k| cells.iter().map(|row| row[k].chars().count()).max().unwrap_or(0));
    let verdicts =
        std::iter::once("").chain(rows.iter().map(|row| if row.holds { "holds" } else { "FAILS" }));
    let mut lines = Vec::new();
    for (i, (cells, verdict)) in cells.iter().zip(verdicts).enumerate() {
        let padded: Vec<String> =
            cells.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        lines.push(format!("  {}  {verdict}", padded.join("  ")).trim_end().to_string());
        if let Some(reason) = i.checked_sub(1).and_then(|row| rows[row].reason.as_ref()) {
            lines.push(format!("      no value: {reason}"));
        }
    }
    lines
}

fn cells(row: &Row) -> [String; 6] {
    let unit = if row.unit == "1" { String::new() } else { format!(" {}", row.unit) };
    let who = match (row.published, row.analytic) {
        (Some(_), _) => " published",
        (_, Some(_)) => " analytic",
        _ => "",
    };
    let expected = row.expected().map_or("-".to_string(), |value| format!("{}{who}", number(value)));
    let obtained = row.obtained.map_or("none".to_string(), |value| format!("{}{unit}", number(value)));
    let (difference, allowed) = match row.how {
        "relative" => (
            row.difference.map(|d| format!("{:+.2} %", 100.0 * d)),
            format!("{} %", number(100.0 * row.tolerance)),
        ),
        "absolute" => (
            row.difference.map(|d| format!("{}{unit}", number(d))),
            format!("{}{unit}", number(row.tolerance)),
        ),
        "below" => (None, format!("< {}", number(row.tolerance))),
        _ => (None, format!("> {}", number(row.tolerance))),
    };
    let difference = difference.unwrap_or_else(|| "-".to_string());
    [row.run.clone(), row.quantity.clone(), obtained, expected, difference, allowed]
}

/// Four significant digits, without trailing noise.
fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    let digits = if size == 0.0 { 0 } else { (4 - size.log10().floor() as i32).clamp(0, 8) };
    let text = format!("{value:.*}", digits as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Row {
        Row {
            benchmark: "ul-plate-2d".into(),
            quantity: "period".into(),
            run: "res10".into(),
            formulation: "ul-non-hourglass".into(),
            settings: String::new(),
            published: Some(0.279),
            analytic: None,
            reference: None,
            obtained: Some(0.28897),
            unit: "s".into(),
            how: "relative",
            difference: Some(0.0357),
            tolerance: 0.02,
            holds: false,
            source: String::new(),
            why: String::new(),
            reason: None,
            manifest: String::new(),
        }
    }

    #[test]
    fn columns_are_aligned_and_say_what_fails() {
        let bound = Row { how: "below", published: None, holds: true, tolerance: 0.5, ..row() };
        let none = Row { obtained: None, difference: None, reason: Some("too short".into()), ..row() };
        let text = lines(&[row(), bound, none]);
        assert_eq!(text.len(), 5);
        let at = text[0].find("expected").unwrap();
        assert_eq!(text[1].find("0.279 published"), Some(at));
        assert!(text[1].contains("0.28897 s") && text[1].contains("+3.57 %") && text[1].ends_with("FAILS"));
        assert!(text[2].contains("< 0.5") && text[2].ends_with("holds"));
        assert!(text[3].contains("none") && text[4].contains("too short"));
    }

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.27423, 2.0, 18.6543, 1e-13, -0.0015, 131.9469].map(number);
        assert_eq!(shown, ["0", "0.27423", "2", "18.654", "1.00e-13", "-0.0015", "131.95"]);
    }
}
