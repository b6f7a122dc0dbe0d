//! What a case means when it does not say: every default, and why it is so.

use super::choices::{Calibration, Family, Formulation, Kernel, Normalisation, Plane, StepRule, Stepping};

/// Total Lagrangian: cheapest for elastic solids, and free of tensile instability; this one is free of
/// hourglass modes as well.
pub(crate) const FORMULATION: Formulation = Formulation::TlHourglassFree;

/// True plane strain, because that is what two dimensions mean to an engineer; the papers' own setting is for
/// their benchmarks.
pub(crate) const PLANE: Plane = Plane::Strain;

/// The kernel of both papers' results; it does not let particles pair.
pub(crate) const KERNEL: Kernel = Kernel::WendlandC2;

/// Smoothing length over spacing, as in the papers: a fixed lattice needs few neighbours (1.15), a changing
/// neighbourhood some more (1.3).
pub(crate) fn smoothing(formulation: Formulation) -> f64 {
    match formulation.family() {
        Family::Total => 1.15,
        Family::Updated => 1.3,
    }
}

/// The largest stable fraction that the papers use: 0.6 total Lagrangian, 0.4 for acoustic steps. Of small strain the bound is the limit of
/// stability itself, which a linear body never leaves. With Ganzenmueller's control the twisted and the folded column gain energy at 0.6, not at 0.4.
pub(crate) fn cfl(formulation: Formulation) -> f64 {
    match formulation.family() {
        Family::Total if formulation == Formulation::SmallStrain => 0.8,
        Family::Total if formulation == Formulation::TlGanzenmueller => 0.4,
        Family::Total => 0.6,
        Family::Updated => 0.4,
    }
}

/// Dual where frozen neighbours do no harm (1.7 times faster); the nested forms tear when they are frozen.
pub(crate) fn stepping(formulation: Formulation) -> Stepping {
    if formulation.is_updated_nested() { Stepping::Single } else { Stepping::Dual }
}

/// Safe at any stretch. At rest it looks at the longitudinal wave, where the paper's rule looks at sqrt(K/rho0).
pub(crate) const STEP: StepRule = StepRule::Stretch;

/// No floor, in m/s: right for impacts, which never come to rest.
pub(crate) const REFERENCE_SPEED: f64 = 0.0;

/// The strength of Ganzenmueller's control that tames the paper's cases.
pub(crate) const ALPHA: f64 = 10.0;

/// The artificial stress of Gray et al.
pub(crate) const ARTIFICIAL_STRESS: f64 = 0.3;

/// The damping of the paper.
pub(crate) const KELVIN_VOIGT: f64 = 1.0;

/// What the paper's figures were made with.
pub(crate) const CALIBRATION: Calibration = Calibration::Paper;

/// The one that conserves momentum and energy.
pub(crate) const NORMALISATION: Normalisation = Normalisation::Adjoint;

/// Share of the steps in which splitting damping acts: the paper's method with what worked in trials.
pub(crate) const PROBABILITY: f64 = 0.2;

/// The first of many.
pub(crate) const SEED: u64 = 1;

/// Enough to see a curve.
pub(crate) const INCREMENTS: u64 = 10;

/// Stresses right to a thousandth.
pub(crate) const TOLERANCE: f64 = 1e-3;

/// Far more than an increment takes that comes to rest at all.
pub(crate) const MAX_STEPS: u64 = 100_000;

/// Frames of a run, when no interval is given: enough for a smooth film of moderate size.
pub(crate) const FRAMES: f64 = 50.0;

/// Steps from one of these frames to the next, at least, since a frame costs as much as two to five steps, uncompressed or not (docs/performance.md).
pub(crate) const FRAME_STEPS: u64 = 500;

/// But so many frames there are even in a short run.
pub(crate) const FEWEST_FRAMES: f64 = 5.0;

/// Time steps between two measurements of disorder, when no interval is given: one costs as much as two to eight
/// steps, so that all together stay below 1 per cent of the run.
pub(crate) const DISORDER_STEPS: u64 = 1000;

/// Seconds between two samples of a probe; 0 is every step, so that no turning point is missed.
pub(crate) const PROBE_INTERVAL: f64 = 0.0;

/// Disorder beyond which a run warns: what no healthy run of the papers' cases shows (zigzag 0.06 in spacings, bonds of 0.3 of a
/// spacing, no broken ones but single ones at corners), and every torn one does.
pub(crate) const ZIGZAG: f64 = 0.06;
/// As [`ZIGZAG`].
pub(crate) const BOND_MIN: f64 = 0.3;
/// As [`ZIGZAG`].
pub(crate) const BROKEN: f64 = 0.01;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{Key, Need, Words, case, damping, monitor, probe, quasi_static, time};

    /// What holds by default, as the table of keys says it.
    fn said(key: &Key) -> &'static str {
        match key.need {
            Need::Default(text) => text,
            _ => "",
        }
    }

    fn word<T: Words + PartialEq>(thing: T) -> &'static str {
        super::super::choices::word(thing)
    }

    #[test]
    fn the_table_of_keys_says_the_same() {
        let (total, updated) = (Formulation::TlHourglassFree, Formulation::UlNonHourglass);
        let both = |of: fn(Formulation) -> f64| {
            format!("{} total Lagrangian, {} updated Lagrangian", of(total), of(updated))
        };
        assert_eq!(said(&case::SMOOTHING), both(smoothing));
        assert_eq!(
            said(&time::CFL),
            format!("{} and tl-ganzenmueller; {} for small-strain", both(cfl), cfl(Formulation::SmallStrain))
        );
        assert_eq!(cfl(Formulation::TlGanzenmueller), cfl(updated));
        assert_eq!(said(&case::NORMALISATION), word(NORMALISATION));
        assert_eq!(said(&case::FORMULATION), word(FORMULATION));
        assert_eq!(said(&case::PLANE), format!("{}, in 2D", word(PLANE)));
        assert_eq!(said(&case::KERNEL), word(KERNEL));
        assert_eq!(said(&time::STEP), word(STEP));
        assert_eq!(said(&case::REFERENCE_SPEED), REFERENCE_SPEED.to_string());
        assert_eq!(said(&damping::PROBABILITY), PROBABILITY.to_string());
        assert_eq!(said(&damping::SEED), SEED.to_string());
        assert_eq!(said(&quasi_static::INCREMENTS), INCREMENTS.to_string());
        assert_eq!(said(&quasi_static::TOLERANCE), TOLERANCE.to_string());
        assert_eq!(said(&quasi_static::MAX_STEPS), MAX_STEPS.to_string());
        assert_eq!(said(&case::ALPHA), ALPHA.to_string());
        assert_eq!(said(&case::ARTIFICIAL_STRESS), ARTIFICIAL_STRESS.to_string());
        assert_eq!(said(&case::KELVIN_VOIGT), KELVIN_VOIGT.to_string());
        assert_eq!(said(&case::CALIBRATION), word(CALIBRATION));
        assert_eq!(
            said(&time::OUTPUT),
            format!("end/{FRAMES}, but {FRAME_STEPS} steps or end/{FEWEST_FRAMES} apart")
        );
        assert_eq!(said(&probe::INTERVAL), PROBE_INTERVAL.to_string());
        let sparse = format!("as [time] output; disorder {DISORDER_STEPS} steps apart");
        assert_eq!(said(&monitor::INTERVAL), sparse);
        for (key, value) in
            [(&monitor::ZIGZAG, ZIGZAG), (&monitor::BOND_MIN, BOND_MIN), (&monitor::BROKEN, BROKEN)]
        {
            assert_eq!(said(key), value.to_string());
        }
        let nested = [
            Formulation::UlNested,
            Formulation::UlArtificialStress,
            Formulation::UlArtificialStressCorrected,
        ];
        let [first, second, third] = nested.map(word);
        let (usual, other) = (word(stepping(updated)), word(stepping(nested[0])));
        let stepped = format!("{usual}; {other} for {first}, {second} and {third}");
        assert!(nested.iter().all(|&form| stepping(form) == stepping(nested[0])));
        assert_eq!(said(&case::STEPPING), stepped);
    }
}
