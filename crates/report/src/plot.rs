//! A probe table as a chart.

use std::ops::Range;
use std::path::Path;

use output::{Column, Reference, Table};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::ReportError;
use crate::corner;
use crate::scale::Scale;

const SIZE: (u32, u32) = (960, 540);

/// Colours that readers with any colour vision tell apart (Okabe and Ito 2008), dark ones first.
const LINES: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

/// Most points that a line gets; more would not be seen but make large files.
const MOST_POINTS: usize = 2000;

/// Draws the columns of `table` over time into the SVG file `path`, and the curves of a reference that go with them, dashed, as far as
/// the table goes.
///
/// Values that are not finite leave gaps; a single sample is a dot; a table without samples gives empty
/// axes. Long tables are thinned so that every extremum stays.
///
/// # Errors
/// [`ReportError::Write`] if the file cannot be written.
pub fn plot_probe(
    title: &str,
    table: &Table,
    reference: Option<&Reference>,
    path: &Path,
) -> Result<(), ReportError> {
    plot((title, TIME), table, reference, path)
}

/// The axis of most plots.
const TIME: (&str, &str) = ("time", "s");

/// Draws the columns of `table` as [`plot_probe`] does, over what is called `over`, with its unit, and stands where times would.
///
/// # Errors
/// [`ReportError::Write`] if the file cannot be written.
pub fn plot_over(title: &str, over: (&str, &str), table: &Table, path: &Path) -> Result<(), ReportError> {
    plot((title, over), table, None, path)
}

fn plot(
    (title, over): (&str, (&str, &str)),
    table: &Table,
    reference: Option<&Reference>,
    path: &Path,
) -> Result<(), ReportError> {
    let curves: Vec<Curve> =
        table.columns.iter().enumerate().flat_map(|c| curves(c, table, reference)).collect();
    let mut svg = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        chart((title, over, reference), table, &curves, &area)
            .and_then(|()| Ok(area.present()?))
            .map_err(|cause| cause.to_string())
    };
    drawn.map_err(|cause| ReportError::Draw { what: path.display().to_string(), cause })?;
    Ok(output::write_atomically(path, svg.as_bytes())?)
}

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type Drawn = Result<(), Box<dyn std::error::Error>>;

/// A line of the plot.
struct Curve {
    /// What the legend says.
    label: String,
    colour: RGBColor,
    /// Reference curves are dashed.
    dashed: bool,
    /// Time and value, SI, without what cannot be drawn.
    parts: Vec<Vec<(f64, f64)>>,
}

/// A column, and what goes with it.
fn curves<'a>(
    (index, column): (usize, &'a Column),
    table: &'a Table,
    reference: Option<&'a Reference>,
) -> impl Iterator<Item = Curve> + 'a {
    let colour = LINES[index % LINES.len()];
    let label = legend(column, &table.columns);
    let own = Curve { label, colour, dashed: false, parts: parts(&table.times, &column.values) };
    let end = table.times.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let others = reference.into_iter().flat_map(move |reference| {
        reference.curves(&column.name).enumerate().map(move |(n, curve)| {
            let seen = reference
                .table
                .times
                .iter()
                .take_while(|&&time| time <= end || end == f64::NEG_INFINITY)
                .count();
            let values = &curve.values[..seen.min(curve.values.len())];
            Curve {
                label: format!("{}, reference", curve.name),
                // The first belongs to its column by its colour, the others have their own.
                colour: match n {
                    0 => RGBColor(colour.0 / 2, colour.1 / 2, colour.2 / 2),
                    n => LINES[(index + table.columns.len() + n - 1) % LINES.len()],
                },
                dashed: true,
                parts: parts(&reference.table.times[..values.len()], values),
            }
        })
    });
    std::iter::once(own).chain(others)
}

/// One chart of all columns of a table.
pub(crate) fn chart_of(title: &str, table: &Table, area: &Area) -> Drawn {
    let curves: Vec<Curve> = table.columns.iter().enumerate().flat_map(|c| curves(c, table, None)).collect();
    chart((title, TIME, None), table, &curves, area)
}

fn chart(
    (title, over, reference): (&str, (&str, &str), Option<&Reference>),
    table: &Table,
    curves: &[Curve],
    area: &Area,
) -> Drawn {
    let all = || curves.iter().flat_map(|curve| curve.parts.iter().flatten());
    let time = Axis::new(over.0, over.1, all().map(|point| point.0));
    let value = value_axis(&table.columns, all().map(|point| point.1));
    area.fill(&WHITE)?;
    if let Some(source) =
        reference.map(|reference| reference.source.as_str()).filter(|source| !source.is_empty())
    {
        let text = format!("reference: {}", shortened(source));
        area.draw(&Text::new(
            text,
            (100, SIZE.1 as i32 - 20),
            ("sans-serif", 14).into_font().color(&BLACK.mix(0.6)),
        ))?;
    }
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 24))
        .margin(16)
        .margin_bottom(24)
        .x_label_area_size(52)
        .y_label_area_size(84)
        .build_cartesian_2d(time.range.clone(), value.range.clone())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .axis_desc_style(("sans-serif", 18))
        .label_style(("sans-serif", 16))
        .x_desc(&time.name)
        .y_desc(&value.name)
        .x_label_formatter(&|x| time.label(*x))
        .y_label_formatter(&|y| value.label(*y))
        .draw()?;
    for curve in curves {
        let shown =
            |part: &Vec<(f64, f64)>| part.iter().map(|&(x, y)| (time.shown(x), value.shown(y))).collect();
        let parts: Vec<Vec<(f64, f64)>> = curve.parts.iter().map(shown).collect();
        draw(&mut chart, curve, parts)?;
    }
    if curves.len() > 1 {
        chart
            .configure_series_labels()
            .position(corner::emptiest(all().map(|&(x, y)| (time.part(x), value.part(y)))))
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 16))
            .draw()?;
    }
    Ok(())
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

fn draw<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, curve: &Curve, parts: Vec<Vec<(f64, f64)>>) -> Drawn {
    let Curve { label, colour, dashed, .. } = curve;
    let (colour, dashed) = (*colour, *dashed);
    let (dots, lines): (Vec<_>, Vec<_>) = parts.into_iter().partition(|part| part.len() == 1);
    chart.draw_series(dots.into_iter().flatten().map(|dot| Circle::new(dot, 4, colour.filled())))?;
    if dashed {
        for line in lines {
            chart.draw_series(DashedLineSeries::new(line, 7, 5, colour.stroke_width(2)))?;
        }
        let stroke = colour.stroke_width(2);
        let dashes = move |at| {
            let dash = |from, to| PathElement::new(vec![(from, 0), (to, 0)], stroke);
            EmptyElement::at(at) + dash(0, 8) + dash(14, 22)
        };
        chart.draw_series(std::iter::empty::<PathElement<(f64, f64)>>())?.label(label).legend(dashes);
        return Ok(());
    }
    chart
        .draw_series(lines.into_iter().map(|line| PathElement::new(line, colour.stroke_width(2))))?
        .label(label)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(3)));
    Ok(())
}

/// As much of a text as has room below the axis.
fn shortened(text: &str) -> String {
    const ROOM: usize = 110;
    if text.chars().count() <= ROOM {
        text.to_string()
    } else {
        text.chars().take(ROOM - 3).chain("...".chars()).collect()
    }
}

/// The unit of all columns, if they have the same.
fn common_unit(columns: &[Column]) -> Option<&str> {
    let first = columns.first()?;
    columns.iter().all(|column| column.unit == first.unit).then_some(&first.unit)
}

/// What the legend says of a column: the unit only where the axis cannot.
fn legend(column: &Column, all: &[Column]) -> String {
    match common_unit(all) {
        Some(_) => column.name.clone(),
        None => format!("{} [{}]", column.name, column.unit),
    }
}

/// The axis of the values: its unit is that of the columns, if they agree.
fn value_axis(columns: &[Column], values: impl Iterator<Item = f64>) -> Axis {
    let unit = common_unit(columns).unwrap_or("");
    let name = if let [only] = columns { only.name.as_str() } else { "value" };
    Axis::new(name, unit, values)
}

/// One axis: its name with the unit, its range in that unit.
struct Axis {
    name: String,
    scale: Scale,
    range: Range<f64>,
}

impl Axis {
    /// Holds all `values` that can be drawn, with some air; never empty.
    fn new(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| drawable(*value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let scale = Scale::new(low.abs().max(high.abs()), unit);
        let (low, high) = (low / scale.divisor, high / scale.divisor);
        // Values that differ by rounding only count as constant, and still get an axis with a height.
        let constant = high - low <= 1e-12 * low.abs().max(high.abs());
        let air = if constant { 0.1 * high.abs().max(f64::MIN_POSITIVE.sqrt()) } else { 0.04 * (high - low) };
        let air = if constant && high == 0.0 { 1.0 } else { air };
        Self { name: format!("{name}{}", scale.brackets()), scale, range: low - air..high + air }
    }

    /// `value` in the unit of the axis.
    fn shown(&self, value: f64) -> f64 {
        value / self.scale.divisor
    }

    /// Where `value` lies between the ends of the axis, 0 to 1.
    fn part(&self, value: f64) -> f64 {
        (self.shown(value) - self.range.start) / (self.range.end - self.range.start)
    }

    /// The number at a tick, `shown` being in the unit of the axis.
    fn label(&self, shown: f64) -> String {
        let step = (self.range.end - self.range.start) / 10.0;
        Scale { divisor: 1.0, unit: String::new() }.label(shown, 5.0 * step)
    }
}

/// Numbers whose differences do not overflow.
fn drawable(value: f64) -> bool {
    value.abs() < 1e300
}

/// The samples cut at values that cannot be drawn, each part thinned.
fn parts(times: &[f64], values: &[f64]) -> Vec<Vec<(f64, f64)>> {
    let samples: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).collect();
    samples
        .split(|&(time, value)| !(drawable(time) && drawable(value)))
        .filter(|part| !part.is_empty())
        .map(thinned)
        .collect()
}

/// At most about [`MOST_POINTS`] of the samples: the least and the greatest value of each stretch.
fn thinned(samples: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if samples.len() <= MOST_POINTS {
        return samples.to_vec();
    }
    let stretch = samples.len().div_ceil(MOST_POINTS / 2);
    let mut kept = vec![samples[0]];
    for part in samples.chunks(stretch) {
        let by_value = |a: &usize, b: &usize| part[*a].1.total_cmp(&part[*b].1);
        let least = (0..part.len()).min_by(by_value).unwrap_or(0);
        let greatest = (0..part.len()).max_by(by_value).unwrap_or(0);
        kept.push(part[least.min(greatest)]);
        kept.push(part[least.max(greatest)]);
    }
    kept.extend(samples.last());
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_every_extremum_and_the_ends() {
        let mut samples: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), f64::from(i).sin())).collect();
        samples[54_321].1 = 9.0;
        samples[777].1 = -9.0;
        let kept = thinned(&samples);
        assert!(kept.len() <= MOST_POINTS + 2);
        assert!(kept.contains(&(54_321.0, 9.0)) && kept.contains(&(777.0, -9.0)));
        assert_eq!((kept[0], kept.last()), (samples[0], samples.last()));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn gaps_stay_gaps() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0];
        let found = parts(&times, &[1.0, f64::NAN, 2.0, 3.0, f64::INFINITY]);
        assert_eq!(found, [vec![(0.0, 1.0)], vec![(2.0, 2.0), (3.0, 3.0)]]);
    }

    #[test]
    fn axes_always_have_a_length() {
        for values in [vec![], vec![0.0], vec![5e-7; 3], vec![-3e12], vec![1.0, 1.0 + 1e-15], vec![f64::NAN]]
        {
            let axis = Axis::new("y", "m", values.iter().copied());
            assert!(axis.range.end > axis.range.start, "{values:?}: {:?}", axis.range);
            assert!(axis.range.end.is_finite() && axis.range.start.is_finite());
        }
    }

    #[test]
    fn broken_tables_are_plotted_too() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("probe.svg");
        let column = |values: Vec<f64>| Column { name: "a<b".to_string(), unit: "m".to_string(), values };
        let nan = f64::NAN;
        for (times, values) in [
            (vec![], vec![]),
            (vec![0.0], vec![1.0]),
            (vec![0.0, 1.0], vec![2.0, 2.0]),
            (vec![0.0, 1.0, 2.0], vec![nan, 1.0, nan]),
            (vec![nan, nan], vec![nan, nan]),
            (vec![0.0, f64::MAX], vec![f64::MAX, f64::MIN]),
            (vec![1e-300, 2e-300], vec![1e-300, 3e-300]),
            (vec![0.0, 1.0], vec![1.0]),
        ] {
            let table = Table { times, columns: vec![column(values.clone()), column(values)] };
            plot_probe("tip", &table, None, &path).unwrap();
            let svg = std::fs::read_to_string(&path).unwrap();
            assert!(svg.starts_with("<svg") && svg.contains("a&lt;b") && !svg.contains("NaN"), "{table:?}");
        }
        plot_probe("nothing", &Table::default(), None, &path).unwrap();
    }

    #[test]
    fn reference_curves_are_dashed_and_end_with_the_table() {
        let reference =
            Reference::parse("# a paper\ntime [s],y [m],y fine [m],z [m]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n")
                .unwrap();
        let columns = ["x", "y"].map(|name| Column {
            name: name.to_string(),
            unit: "m".to_string(),
            values: vec![0.0, 1.0],
        });
        let table = Table { times: vec![0.0, 1.5], columns: columns.to_vec() };
        let found: Vec<Curve> =
            table.columns.iter().enumerate().flat_map(|c| curves(c, &table, Some(&reference))).collect();
        let seen: Vec<_> = found.iter().map(|curve| (curve.label.as_str(), curve.dashed)).collect();
        assert_eq!(seen, [("x", false), ("y", false), ("y, reference", true), ("y fine, reference", true)]);
        assert_eq!(found[3].parts, [vec![(0.0, 2.0), (1.0, 2.0)]]);
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("probe.svg");
        plot_probe("tip", &table, Some(&reference), &path).unwrap();
        let svg = std::fs::read_to_string(&path).unwrap();
        assert!(svg.contains("y fine, reference") && svg.contains("reference: a paper"));
        // Nothing sampled yet: the reference is still there.
        plot_probe("tip", &Table { times: vec![], ..table }, Some(&reference), &path).unwrap();
    }

    #[test]
    fn units_stand_at_the_axis_or_in_the_legend() {
        let column =
            |unit: &str| Column { name: "q".to_string(), unit: unit.to_string(), values: vec![0.02] };
        let (same, mixed) = ([column("m"), column("m")], [column("m"), column("N")]);
        let axis = |columns: &[Column]| value_axis(columns, [0.02].into_iter()).name;
        assert_eq!((axis(&same).as_str(), legend(&same[0], &same).as_str()), ("value [mm]", "q"));
        assert_eq!((axis(&mixed).as_str(), legend(&mixed[1], &mixed).as_str()), ("value", "q [N]"));
    }
}
