//! What to try: arguments for the command line that exist in this case.

use crate::{Case, Formulation};

/// Something to try.
#[derive(Clone, Debug, PartialEq)]
pub struct Try {
    /// What to add to the command line.
    pub arguments: String,
    /// What it does.
    pub does: String,
}

impl Try {
    fn new(arguments: impl Into<String>, does: impl Into<String>) -> Self {
        Self { arguments: arguments.into(), does: does.into() }
    }
}

/// A number as a user would write it.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

fn parameter(case: &Case, name: &str) -> Option<f64> {
    case.parameters.iter().find(|(other, _)| other == name).map(|(_, value)| *value)
}

/// A smaller Courant number.
pub fn smaller_cfl(cfl: f64, default: f64) -> Try {
    let to = if cfl > default { default } else { 0.5 * cfl };
    Try::new(
        format!("--set time.cfl={}", short(to)),
        format!("shorter time steps ({} of the stable one instead of {})", short(to), short(cfl)),
    )
}

/// A shorter given step.
pub fn shorter_steps(dt: f64) -> Try {
    Try::new(format!("--set time.dt={}", short(0.5 * dt)), "half of the given step")
}

/// The step that looks at the stretched material.
pub fn stretch_step() -> Try {
    Try::new(
        "--set time.step=stretch",
        "time steps that follow the stretch of the material; the paper's do not",
    )
}

/// Another formulation.
pub fn formulation(to: Formulation) -> Try {
    Try::new(format!("--formulation {}", to.name()), "the form of the same family that resists zigzag modes")
}

/// Twice the resolution, by whatever the case has for it.
pub fn finer(case: &Case) -> Try {
    let does = "twice as many particles along every axis";
    match (parameter(case, "resolution"), parameter(case, "dp")) {
        (Some(resolution), _) => {
            Try::new(format!("--set parameters.resolution={}", short(2.0 * resolution)), does)
        }
        (None, Some(dp)) => Try::new(format!("--set parameters.dp={}", short(0.5 * dp)), does),
        (None, None) => Try::new(format!("--set spacing={}", short(0.5 * case.spacing)), does),
    }
}

/// Whether a name stands anywhere but where it is defined.
fn is_used(text: &str, name: &str) -> bool {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    text.split(|c: char| !word(c)).filter(|found| *found == name).count() > 1
}

/// Half of every speed that the case has a parameter for.
pub fn slower(case: &Case) -> Vec<Try> {
    let speeds = case.parameters.iter().filter(|(name, value)| {
        let named = ["v", "omega", "speed", "load", "rate"].iter().any(|start| name.starts_with(start));
        named && *value != 0.0 && is_used(case.case_text_as_run(), name)
    });
    let half = |(name, value): &(String, f64)| {
        Try::new(
            format!("--set parameters.{name}={}", short(0.5 * value)),
            "half as fast: what is carried then?",
        )
    };
    speeds.map(half).collect()
}

/// A softer answer to compression.
pub fn compressible(case: &Case, body: usize) -> Option<Try> {
    let does = "a material that is less nearly incompressible: does it run then?";
    if parameter(case, "nu").is_some() {
        return Some(Try::new("--set parameters.nu=0.45", does));
    }
    let material = case.material_of(case.bodies.get(body)?)?;
    let given = case.case_text_as_run().contains("poisson_ratio");
    given.then(|| Try::new(format!("--set material.{}.poisson_ratio=0.45", material.name), does))
}

/// More frames before it happens.
pub fn closer_look(case: &Case, time: f64) -> Try {
    let end = if time > 0.0 { 1.05 * time } else { case.time.end };
    Try::new(
        format!("--set time.end={} --set time.output={}", short(end), short(end / 50.0)),
        "the same run with fifty frames up to where it stopped, to see it coming",
    )
}
