//! Which values the ends of the colours stand for.

/// Share of the values beyond either end of the colours: what a few particles do must not flatten all others.
const BEYOND: f64 = 0.005;

/// What is less than this share of the larger end is as good as zero.
const SIDE: f64 = 0.1;

/// Values at the ends of the colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The ends.
    pub ends: [f64; 2],
    /// Whether some values are beyond them.
    pub cut: bool,
}

impl Range {
    /// The range of the values that are numbers, without the outermost 0.5 % at either end; 0 and 0 if there are none.
    pub(crate) fn typical(values: &[f64]) -> Self {
        let mut finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        let Some(last) = finite.len().checked_sub(1) else { return Self { ends: [0.0; 2], cut: false } };
        let beyond = (finite.len() as f64 * BEYOND) as usize;
        let low = *finite.select_nth_unstable_by(beyond, f64::total_cmp).1;
        let high = *finite.select_nth_unstable_by(last - beyond, f64::total_cmp).1;
        Self { ends: [low, high], cut: beyond > 0 }
    }

    /// The smallest range that holds both.
    pub fn union(self, other: Self) -> Self {
        let [low, high] = [0, 1].map(|end| (self.ends[end], other.ends[end]));
        Self { ends: [low.0.min(low.1), high.0.max(high.1)], cut: self.cut || other.cut }
    }

    /// Symmetric about zero if there is something to see on both sides of it; from zero on if it begins just above.
    pub(crate) fn rounded(self) -> Self {
        let [low, high] = self.ends;
        let most = low.abs().max(high.abs());
        let ends = if low < -SIDE * most && high > SIDE * most {
            [-most, most]
        } else if low > 0.0 && low < SIDE * high {
            [0.0, high]
        } else {
            [low, high]
        };
        Self { ends, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outliers_do_not_flatten_the_colours() {
        let mut values: Vec<f64> = (0..1000).map(f64::from).collect();
        values.extend([1e30, -1e30, f64::NAN]);
        // 0.5 % of 1002 numbers is 5 at either end.
        assert_eq!(Range::typical(&values), Range { ends: [4.0, 995.0], cut: true });
        assert_eq!(Range::typical(&[f64::NAN]).ends, [0.0; 2]);
        assert_eq!(Range::typical(&[3.0, 1.0, 2.0]), Range { ends: [1.0, 3.0], cut: false });
    }

    #[test]
    fn what_has_a_sign_is_symmetric_about_zero() {
        let range = |low, high| Range { ends: [low, high], cut: false };
        assert_eq!(range(-1.0, 3.0).rounded(), range(-3.0, 3.0));
        assert_eq!(range(0.1, 3.0).rounded(), range(0.0, 3.0));
        assert_eq!(range(-0.1, 3.0).rounded(), range(-0.1, 3.0));
        assert_eq!(range(-5.0, -3.0).rounded(), range(-5.0, -3.0));
        assert_eq!(range(-1.0, 1.0).union(range(0.0, 2.0)), range(-1.0, 2.0));
    }
}
