//! One line of the answer. The names are a contract with whoever reads the JSON.

use super::accept::{Accept, Check, Expected, Run, Target, Tolerance};
use super::evidence::Evidence;
use serde::Serialize;

/// A check and how it came out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name of the benchmark.
    pub benchmark: String,
    /// What was looked at.
    pub quantity: String,
    /// Name of the run in `accept.toml`.
    pub run: String,
    /// Formulation of the run.
    pub formulation: String,
    /// What the run overrides of the case.
    pub settings: String,
    /// The value that a paper gives.
    pub published: Option<f64>,
    /// The value of a formula.
    pub analytic: Option<f64>,
    /// The value of another computation, or one that needs no source.
    pub reference: Option<f64>,
    /// What the run gave; `None` has its `reason`.
    pub obtained: Option<f64>,
    /// Unit of the quantity.
    pub unit: String,
    /// `relative`, `absolute`, `below` or `above`.
    pub how: &'static str,
    /// Obtained less expected (over expected, if relative); for a bound, obtained less the bound.
    pub difference: Option<f64>,
    /// How large the difference may be; for a bound, the bound.
    pub tolerance: f64,
    /// Whether it holds.
    pub holds: bool,
    /// Where the expectation comes from.
    pub source: String,
    /// Why this is looked at, and why this tolerance.
    pub why: String,
    /// Why nothing was obtained.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Hash of the manifest of the run.
    pub manifest: String,
}

impl Row {
    /// Judges a check of a benchmark; `evidence` finds the runs that it needs.
    pub fn new<'a>(
        benchmark: &str,
        (accept, check): (&Accept, &Check),
        evidence: impl Fn(usize) -> &'a Evidence,
    ) -> Self {
        let run: &Run = &accept.runs[check.run];
        let mine = evidence(check.run);
        let obtained = obtain(check, &evidence);
        let (expected, how, tolerance) = spoken(check.target);
        let of = |wanted: fn(Expected) -> Option<f64>| expected.and_then(wanted);
        let judged = obtained.as_ref().ok().map(|&value| judge(check.target, value));
        Self {
            benchmark: benchmark.to_string(),
            quantity: check.quantity.clone(),
            run: run.name.clone(),
            formulation: mine.summary.formulation.clone(),
            settings: settings(run, mine),
            published: of(|e| if let Expected::Published(value) = e { Some(value) } else { None }),
            analytic: of(|e| if let Expected::Analytic(value) = e { Some(value) } else { None }),
            reference: of(|e| if let Expected::Reference(value) = e { Some(value) } else { None }),
            obtained: obtained.as_ref().ok().copied(),
            unit: check.unit.clone(),
            how,
            difference: judged.map(|(difference, _)| difference),
            tolerance,
            holds: judged.is_some_and(|(_, holds)| holds),
            source: check.source.clone(),
            why: check.why.clone(),
            reason: obtained.err(),
            manifest: mine.manifest.clone(),
        }
    }

    /// The expected value, if there is one.
    pub fn expected(&self) -> Option<f64> {
        self.published.or(self.analytic).or(self.reference)
    }
}

/// What a run was told besides its formulation; double precision goes without saying.
fn settings(run: &Run, evidence: &Evidence) -> String {
    let single = (evidence.summary.precision == "single").then_some("precision=single");
    run.set.iter().map(String::as_str).chain(single).collect::<Vec<_>>().join(", ")
}

/// The number of a check, or why there is none.
fn obtain<'a>(check: &Check, evidence: impl Fn(usize) -> &'a Evidence) -> Result<f64, String> {
    let value = evidence(check.run).number(&check.value)?;
    let over = match &check.over {
        Some((run, path)) => evidence(*run).number(path)?,
        None => 1.0,
    };
    let obtained = value / over * check.scale;
    if obtained.is_finite() { Ok(obtained) } else { Err(format!("{value} / {over} is no number")) }
}

fn spoken(target: Target) -> (Option<Expected>, &'static str, f64) {
    match target {
        Target::Near(expected, Tolerance::Relative(share)) => (Some(expected), "relative", share),
        Target::Near(expected, Tolerance::Absolute(distance)) => (Some(expected), "absolute", distance),
        Target::Below(limit) => (None, "below", limit),
        Target::Above(limit) => (None, "above", limit),
    }
}

/// Difference, and whether the target is met. A value that is not a number meets none.
fn judge(target: Target, obtained: f64) -> (f64, bool) {
    match target {
        Target::Near(expected, Tolerance::Relative(share)) => {
            let difference = (obtained - expected.value()) / expected.value().abs();
            (difference, difference.abs() <= share)
        }
        Target::Near(expected, Tolerance::Absolute(distance)) => {
            let difference = obtained - expected.value();
            (difference, difference.abs() <= distance)
        }
        Target::Below(limit) => (obtained - limit, obtained < limit),
        Target::Above(limit) => (obtained - limit, obtained > limit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use output::Summary;
    use output::summary::{Measured, Status};
    use std::path::PathBuf;

    const ACCEPT: &str = "
        case = 'ul-plate-2d'
        [[run]]
        name = 'a'
        set = ['parameters.v_f=0.05', 'time.end=0.3']
        [[run]]
        name = 'b'
        [[check]]
        quantity = 'period'
        runs = ['a']
        value = 'measured.period'
        unit = 's'
        published = 0.2
        relative = 0.01
        source = 'Table 1'
        why = 'convergence'
        [[check]]
        quantity = 'ratio'
        runs = ['b']
        value = 'measured.period'
        over_run = 'a'
        scale = 2
        above = 10
        source = ''
        why = ''
    ";

    fn rows(periods: [f64; 2]) -> Vec<Row> {
        let accept = Accept::parse(ACCEPT).unwrap();
        let runs = periods.map(|period| {
            let mut summary = Summary { status: Status::Done, ..Summary::default() };
            summary.measured.insert("period".to_string(), Measured::value(period, "s"));
            Evidence { directory: PathBuf::new(), summary, manifest: "f00d".to_string(), may_diverge: false }
        });
        accept.checks.iter().map(|check| Row::new("ul-plate-2d", (&accept, check), |i| &runs[i])).collect()
    }

    #[test]
    fn right_values_hold_and_wrong_ones_fail() {
        let holds = |periods| rows(periods).iter().map(|row| row.holds).collect::<Vec<_>>();
        assert_eq!(holds([0.2019, 1.2]), [true, true]);
        assert_eq!(holds([0.2021, 1.0]), [false, false]);
        assert_eq!(holds([0.1979, 1.0]), [false, true]);
        assert_eq!(holds([f64::NAN, 1.0]), [false, false]);
        assert_eq!(holds([0.0, 1.0]), [false, false], "a ratio over nothing holds nothing");
    }

    #[test]
    fn bounds_are_not_attained() {
        assert!(!judge(Target::Below(1.0), 1.0).1 && !judge(Target::Above(1.0), 1.0).1);
        let exactly = Target::Near(Expected::Reference(0.0), Tolerance::Absolute(0.0));
        assert!(judge(exactly, 0.0).1 && !judge(exactly, 1e-300).1);
    }

    #[test]
    fn the_names_of_the_contract_are_there() {
        let json = serde_json::to_value(rows([0.2, 0.2])).unwrap();
        for name in [
            "benchmark",
            "quantity",
            "formulation",
            "settings",
            "published",
            "analytic",
            "obtained",
            "unit",
            "difference",
            "tolerance",
            "holds",
            "source",
            "manifest",
        ] {
            assert!(json[0].get(name).is_some(), "{name}");
        }
        assert_eq!(json[0]["settings"], "parameters.v_f=0.05, time.end=0.3");
        assert_eq!((json[0]["published"].as_f64(), json[0]["analytic"].as_f64()), (Some(0.2), None));
        assert_eq!(json[0]["holds"], true);
        assert_eq!(json[0]["manifest"], "f00d");
    }
}
