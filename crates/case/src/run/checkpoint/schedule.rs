//! When the next checkpoint is due.

use super::INTERVAL;
use std::time::Duration;

/// Checkpoints take a part of this many of a run, at most, unless their interval was chosen.
const SHARE: u32 = 100;

/// Wall time of checkpoints.
#[derive(Clone, Copy, Debug)]
pub struct Schedule {
    chosen: Option<Duration>,
    due: Duration,
    /// How many were made.
    pub made: u64,
    /// How long they held up the run.
    pub took: Duration,
}

impl Schedule {
    /// The first is due after the interval that was chosen, or the usual one.
    #[must_use]
    pub fn new(chosen: Option<Duration>) -> Self {
        Self { chosen, due: chosen.unwrap_or(INTERVAL), made: 0, took: Duration::ZERO }
    }

    /// Whether one is due at this wall time since the start.
    #[must_use]
    pub fn is_due(&self, wall: Duration) -> bool {
        wall >= self.due
    }

    /// One was made that held up the run from `began` to `ended`. Unless the interval was chosen the next is later the longer that was.
    pub fn note(&mut self, began: Duration, ended: Duration) {
        let took = ended.saturating_sub(began);
        self.made += 1;
        self.took += took;
        let usual = INTERVAL.max(SHARE * took);
        self.due = ended.saturating_add(self.chosen.unwrap_or(usual));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checkpoints_take_a_hundredth_at_most() {
        let seconds = Duration::from_secs;
        let mut schedule = Schedule::new(None);
        assert!(!schedule.is_due(seconds(299)) && schedule.is_due(seconds(300)));
        schedule.note(seconds(300), seconds(302));
        assert!(!schedule.is_due(seconds(601)) && schedule.is_due(seconds(602)));
        schedule.note(seconds(602), seconds(612));
        assert!(!schedule.is_due(seconds(1611)) && schedule.is_due(seconds(1612)));
        assert_eq!((schedule.made, schedule.took), (2, seconds(12)));
        let mut often = Schedule::new(Some(Duration::ZERO));
        often.note(seconds(1), seconds(2));
        assert!(often.is_due(seconds(2)));
        let mut never = Schedule::new(Some(Duration::MAX));
        never.note(seconds(1), seconds(2));
        assert!(!never.is_due(seconds(1 << 40)));
    }
}
