//! Which bodies touch.

/// Two bodies that touch, or one that touches itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Their numbers.
    pub bodies: [u32; 2],
    /// k, Pa.
    pub stiffness: f64,
    /// Coefficient of Coulomb friction.
    pub friction: f64,
}

/// All meetings, by the numbers of both bodies.
#[derive(Clone, Debug)]
pub struct Meetings(Vec<Vec<Option<Meeting>>>);

impl Meetings {
    /// A table of meetings.
    #[must_use]
    pub fn new(meetings: &[Meeting]) -> Self {
        let bodies = meetings.iter().flat_map(|m| m.bodies).max().map_or(0, |last| last as usize + 1);
        let mut table = vec![vec![None; bodies]; bodies];
        for meeting in meetings {
            let [a, b] = meeting.bodies.map(|b| b as usize);
            (table[a][b], table[b][a]) = (Some(*meeting), Some(*meeting));
        }
        Self(table)
    }

    /// How two bodies meet; `None` if they pass through each other.
    #[must_use]
    pub fn of(&self, one: u32, other: u32) -> Option<&Meeting> {
        self.0.get(one as usize)?.get(other as usize)?.as_ref()
    }

    /// Whether anybody rubs.
    #[must_use]
    pub fn rub(&self) -> bool {
        self.0.iter().flatten().flatten().any(|meeting| meeting.friction > 0.0)
    }
}
