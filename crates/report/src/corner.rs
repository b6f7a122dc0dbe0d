//! Where a legend hides least.

use plotters::prelude::SeriesLabelPosition;

/// The part of a chart that a legend takes, along each axis.
const TAKES: (f64, f64) = (0.33, 0.33);

/// The place at the upper or lower edge of a chart with the fewest points, these being from 0 to 1 along each axis; the upper right one of places
/// that are alike.
pub(crate) fn emptiest(points: impl Iterator<Item = (f64, f64)> + Clone) -> SeriesLabelPosition {
    let (low, high) = ((0.0, TAKES.1), (1.0 - TAKES.1, 1.0));
    let (left, middle, right) =
        ((0.0, TAKES.0), (0.5 - TAKES.0 / 2.0, 0.5 + TAKES.0 / 2.0), (1.0 - TAKES.0, 1.0));
    let places = [
        (SeriesLabelPosition::UpperRight, right, high),
        (SeriesLabelPosition::UpperLeft, left, high),
        (SeriesLabelPosition::LowerRight, right, low),
        (SeriesLabelPosition::LowerLeft, left, low),
        (SeriesLabelPosition::UpperMiddle, middle, high),
        (SeriesLabelPosition::LowerMiddle, middle, low),
    ];
    let within = |x: f64, (from, to): (f64, f64)| from <= x && x <= to;
    let hidden = |across, up| points.clone().filter(|&(x, y)| within(x, across) && within(y, up)).count();
    let least = places.into_iter().min_by_key(|&(_, across, up)| hidden(across, up));
    least.map_or(SeriesLabelPosition::UpperRight, |(position, ..)| position)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_not_covered() {
        let name = |points: &[(f64, f64)]| format!("{:?}", emptiest(points.iter().copied()));
        assert_eq!(name(&[]), "UpperRight");
        assert_eq!(name(&[(0.9, 0.9)]), "UpperLeft");
        assert_eq!(name(&[(0.9, 0.9), (0.1, 0.8)]), "LowerRight");
        assert_eq!(name(&[(0.9, 0.9), (0.1, 0.8), (0.8, 0.1), (0.5, 0.5)]), "LowerLeft");
        assert_eq!(name(&[(0.9, 0.9), (0.1, 0.8), (0.8, 0.1), (0.1, 0.1)]), "UpperMiddle");
        assert_eq!(name(&[(0.9, 0.9), (0.1, 0.8), (0.8, 0.1), (0.1, 0.1), (0.5, 0.9)]), "LowerMiddle");
    }
}
