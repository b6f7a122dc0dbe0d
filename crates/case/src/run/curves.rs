//! What is read off a curve: crossings, extrema, turning points.

/// A curve: times and values.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    /// Times, s, ascending.
    pub times: &'a [f64],
    /// Values.
    pub values: &'a [f64],
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time, s.
    pub time: f64,
    /// Value.
    pub value: f64,
}

impl Curve<'_> {
    fn points(&self) -> impl DoubleEndedIterator<Item = Point> + '_ {
        self.times.iter().zip(self.values).map(|(&time, &value)| Point { time, value })
    }

    /// Time of the `n`-th zero crossing after the start (from 1), linear between samples. A curve that starts at zero has not
    /// crossed yet; one that touches zero and turns back has not either.
    pub fn crossing(&self, n: usize) -> Option<f64> {
        let nonzero: Vec<Point> = self.points().filter(|p| p.value != 0.0).collect();
        nonzero
            .windows(2)
            .filter(|w| (w[0].value < 0.0) != (w[1].value < 0.0))
            .map(|w| w[0].time + (w[1].time - w[0].time) * w[0].value / (w[0].value - w[1].value))
            .nth(n.checked_sub(1)?)
    }

    /// The largest value.
    pub fn maximum(&self) -> Option<Point> {
        self.points().max_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// The smallest value.
    pub fn minimum(&self) -> Option<Point> {
        self.points().min_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// For how long the curve is above half of its largest value, from the first time it rises through that to the last
    /// time it falls, linear between samples.
    pub fn duration(&self) -> Option<f64> {
        let half = 0.5 * self.maximum()?.value;
        let cross = |i: usize| {
            let (v0, v1) = (self.values[i - 1] - half, self.values[i] - half);
            self.times[i - 1] + (self.times[i] - self.times[i - 1]) * v0 / (v0 - v1)
        };
        let up = (1..self.values.len()).find(|&i| self.values[i - 1] < half && self.values[i] >= half)?;
        let down = (1..self.values.len()).rfind(|&i| self.values[i - 1] >= half && self.values[i] < half)?;
        (down > up).then(|| cross(down) - cross(up))
    }

    /// The value at a time, linear between samples.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.times.iter().position(|&t| t >= time)?;
        if after == 0 {
            return (self.times[0] == time).then(|| self.values[0]);
        }
        let (t0, t1) = (self.times[after - 1], self.times[after]);
        let (v0, v1) = (self.values[after - 1], self.values[after]);
        Some(v0 + (v1 - v0) * (time - t0) / (t1 - t0))
    }

    /// Turning points that the curve leaves by at least `prominence` on both sides: maxima and minima in turn. The ends
    /// of the curve are none.
    pub fn turning_points(&self, prominence: f64) -> Vec<(Point, bool)> {
        let mut found = Vec::new();
        let Some(first) = self.points().next() else { return found };
        let (mut low, mut high) = (first, first);
        // Whether the curve was last seen rising: `None` until it has moved by the prominence.
        let mut rising: Option<bool> = None;
        for p in self.points() {
            if p.value > high.value {
                high = p;
            }
            if p.value < low.value {
                low = p;
            }
            if rising != Some(true) && p.value - low.value >= prominence {
                if rising == Some(false) {
                    found.push((low, false));
                }
                (rising, high) = (Some(true), p);
            } else if rising != Some(false) && high.value - p.value >= prominence {
                if rising == Some(true) {
                    found.push((high, true));
                }
                (rising, low) = (Some(false), p);
            }
            match rising {
                Some(true) => low = p,
                Some(false) => high = p,
                None => {}
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        (0..=1000).map(|i| f64::from(i) * 0.01).map(|t| (t, f(t))).unzip()
    }

    #[test]
    fn crossings_of_a_sine_skip_the_start() {
        let (times, values) = sampled(f64::sin);
        let curve = Curve { times: &times, values: &values };
        // Linear interpolation of a sine at step 0.01: error below step^3.
        assert!((curve.crossing(1).unwrap_or(0.0) - std::f64::consts::PI).abs() < 1e-6);
        assert!((curve.crossing(2).unwrap_or(0.0) - std::f64::consts::TAU).abs() < 1e-6);
        assert_eq!(curve.crossing(4), None, "the curve is too short");
    }

    #[test]
    fn turning_points_need_their_prominence() {
        let (times, values) = sampled(|t| t.sin() + 0.05 * (20.0 * t).sin());
        let curve = Curve { times: &times, values: &values };
        let points = curve.turning_points(0.5);
        assert_eq!(points.iter().map(|p| p.1).collect::<Vec<_>>(), [true, false, true]);
        assert!((points[1].0.time - 1.5 * std::f64::consts::PI).abs() < 0.2);
        assert!(points[1].0.value < -1.0);
        assert!(curve.turning_points(3.0).is_empty());
    }

    #[test]
    fn a_blow_lasts_from_half_to_half() {
        let (times, values) = sampled(|t| (2.0 - (t - 5.0).abs()).max(0.0));
        let curve = Curve { times: &times, values: &values };
        // The triangle of half width 2 is above half of its height over a width of 2.
        assert!((curve.duration().unwrap_or(0.0) - 2.0).abs() < 1e-12);
        assert_eq!(Curve { times: &times[..500], values: &values[..500] }.duration(), None, "still rising");
    }

    #[test]
    fn values_between_samples_and_extrema() {
        let curve = Curve { times: &[0.0, 1.0, 3.0], values: &[1.0, 2.0, -2.0] };
        assert_eq!((curve.at(2.0), curve.at(4.0)), (Some(0.0), None));
        assert_eq!(curve.maximum(), Some(Point { time: 1.0, value: 2.0 }));
        assert_eq!(curve.minimum(), Some(Point { time: 3.0, value: -2.0 }));
    }
}
