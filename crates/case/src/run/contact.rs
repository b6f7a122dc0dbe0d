//! The first touch of two bodies.

/// When the gap of two bodies falls below the support of the kernel, linear between samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact {
    support: f64,
    last: Option<(f64, f64)>,
    /// When it was, s.
    pub time: Option<f64>,
}

impl Contact {
    /// No touch yet; bodies touch when they are closer than `support` (m).
    pub fn new(support: f64) -> Self {
        Self { support, last: None, time: None }
    }

    /// As numbers, to be kept; what is not known is no number.
    pub fn saved(&self) -> [f64; 3] {
        let (time, gap) = self.last.unwrap_or((f64::NAN, f64::NAN));
        [time, gap, self.time.unwrap_or(f64::NAN)]
    }

    /// The same reach with what was kept; `None` if these are not its numbers.
    pub fn restored(self, numbers: &[f64]) -> Option<Self> {
        let &[time, gap, touch] = numbers else { return None };
        Some(Self {
            last: (!time.is_nan()).then_some((time, gap)),
            time: (!touch.is_nan()).then_some(touch),
            ..self
        })
    }

    /// Whether the gap is still of interest.
    pub fn is_awaited(&self) -> bool {
        self.time.is_none()
    }

    /// Takes note of the gap (m) at a time, s.
    pub fn look(&mut self, time: f64, gap: Option<f64>) {
        let Some(gap) = gap.filter(|_| self.is_awaited()) else { return };
        if gap < self.support {
            let between = |(t, before): (f64, f64)| t + (time - t) * (before - self.support) / (before - gap);
            self.time = Some(self.last.map_or(time, between));
        }
        self.last = Some((time, gap));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_touch_is_between_the_samples() {
        let mut contact = Contact::new(1.0);
        for (time, gap) in
            [(0.0, None), (1.0, Some(3.0)), (2.0, Some(2.0)), (3.0, Some(0.0)), (4.0, Some(0.5))]
        {
            contact.look(time, gap);
        }
        assert_eq!(contact.time, Some(2.5));
        for kept in [contact, Contact::new(1.0)] {
            let again = Contact::new(1.0).restored(&kept.saved()).expect("three numbers");
            assert_eq!((again.last, again.time), (kept.last, kept.time));
        }
        let mut touching = Contact::new(1.0);
        touching.look(0.0, Some(0.5));
        assert_eq!(touching.time, Some(0.0));
    }
}
