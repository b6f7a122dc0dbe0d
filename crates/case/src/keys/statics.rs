//! The tables that bring bodies to rest.

/// `[damping]`.
pub(crate) mod damping {
    use super::super::{Key, Kind, Need, Range, Table};
    use crate::units::Dimension;

    pub(crate) const VISCOSITY: Key = Key::new(
        "viscosity",
        Kind::Number(Dimension::VISCOSITY, Range::Positive),
        Need::Default("sqrt(density*youngs_modulus)*L/4, L the longest side of the body"),
        "Viscosity of the damping: with more, fast motion dies out sooner and slow motion later.",
    );
    pub(crate) const PROBABILITY: Key = Key::new(
        "probability",
        Kind::Number(Dimension::NUMBER, Range::Share),
        Need::Default("0.2"),
        "Share of the steps in which it acts, each time as strongly as if it acted in all.",
    );
    pub(crate) const SEED: Key = Key::new(
        "seed",
        Kind::Count,
        Need::Default("1"),
        "Which random choice of steps; the same seed repeats a run bit by bit.",
    );
    pub(crate) const RATE: Key = Key::new(
        "rate",
        Kind::Number(Dimension::new(0, 0, -1), Range::Positive),
        Need::Optional,
        "Instead of the others: viscous damping by -rate times the velocity, of rigid motion too. Twice the lowest circular frequency brings a body to rest soonest.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[damping]",
        doc: "Damping of all motion of total Lagrangian and small-strain bodies, by the splitting random-choice method of the total Lagrangian paper: for slow loads. Rigid motion is not damped, that of parts against each other is. With `rate` plain viscous damping instead.",
        keys: &[VISCOSITY, PROBABILITY, SEED, RATE],
        example: "[damping]\nprobability = 0.2",
    };
}

/// `[quasi_static]`.
pub(crate) mod quasi_static {
    use super::super::{Key, Kind, Need, Range, Table};
    use crate::units::Dimension;

    pub(crate) const INCREMENTS: Key = Key::new(
        "increments",
        Kind::Count,
        Need::Default("10"),
        "Into how many equal parts the time of the load is divided; at the end of each the bodies come to rest.",
    );
    pub(crate) const TOLERANCE: Key = Key::new(
        "tolerance",
        Kind::Number(Dimension::NUMBER, Range::Share),
        Need::Default("0.001"),
        "What counts as equilibrium: by what share unbalanced forces could still change the stress over the length of the bodies, L rms(rho a) / rms(stress), and the root of kinetic over elastic energy.",
    );
    pub(crate) const MAX_STEPS: Key = Key::new(
        "max_steps",
        Kind::Count,
        Need::Default("100000"),
        "Most steps that an increment is held; then the run goes on, with a warning.",
    );
    pub(crate) const TABLE: Table = Table {
        header: "[quasi_static]",
        doc: "Looks for equilibria instead of motion. The time `t` of loads and boundaries is then that of the load alone: it goes on as slowly as waves and grips need, and stops at the end of each increment until the unbalanced forces are small. By kinetic damping with scaled masses (as they are where something may touch), which has no parameter, or by `[damping]` if that is there. Frames and probes are written for equilibria. For total Lagrangian bodies; tools and contact without friction too.",
        keys: &[INCREMENTS, TOLERANCE, MAX_STEPS],
        example: "[quasi_static]\nincrements = 20",
    };
}
