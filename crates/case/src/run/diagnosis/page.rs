//! `diagnosis.md`.

use super::Evidence;
use super::facts::Facts;
use super::likely::{Sign, signs};
use super::tries;
use std::fmt::Write as _;
use taut::simulation::Step;

/// Steps that the page shows; the first remembered one and the last ones.
const SHOWN: usize = 16;

/// Files that may be there.
pub struct Kept {
    /// Whether there is a `culprit.vtp`.
    pub pictured: bool,
    /// The last checkpoint.
    pub checkpoint: Option<String>,
}

/// The page.
pub fn page(evidence: &Evidence<'_>, facts: &Facts, files: &Kept) -> String {
    let mut page = String::new();
    head(&mut page, evidence, facts);
    let signs = signs(evidence, facts);
    likely(&mut page, evidence, &signs);
    attempts(&mut page, evidence, &signs);
    steps(&mut page, evidence);
    energies(&mut page, evidence);
    kept(&mut page, evidence, files);
    page
}

/// Six digits.
fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let plain = rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) || !rounded.is_finite();
    if plain { format!("{rounded}") } else { format!("{rounded:e}") }
}

fn place(x: [f64; 3], dimension: usize) -> String {
    let parts: Vec<String> = x.iter().take(dimension).map(|c| format!("{c:.5}")).collect();
    format!("({}) m", parts.join(", "))
}

fn row(page: &mut String, name: &str, value: &str) {
    let _ = writeln!(page, "| {name} | {value} |");
}

fn head(page: &mut String, e: &Evidence<'_>, facts: &Facts) {
    let d = e.diverged;
    let body = e.case.bodies.get(d.body).map_or("", |body| body.name.as_str());
    let _ = writeln!(page, "# Why `{}` stopped\n", e.case.name);
    let when =
        if facts.at_start { "before the first step".to_string() } else { format!("at t = {:.6e} s", d.time) };
    let _ = writeln!(
        page,
        "**The run stopped {when}: {} of particle {} is {}.**\n",
        d.field,
        d.particle,
        number(d.value)
    );
    page.push_str("| | |\n|---|---|\n");
    row(page, "what must hold", d.cause.criterion());
    row(page, "value", &format!("{} = {}", d.field, number(d.value)));
    let bound = if d.bound.is_nan() { "any finite number".to_string() } else { number(d.bound) };
    row(page, "bound", &bound);
    row(page, "particle", &format!("{}, of body `{body}`", d.particle));
    row(page, "where it was undeformed", &place(d.position, e.case.dimension));
    let share = if e.case.time.end > 0.0 { 100.0 * d.time / e.case.time.end } else { 0.0 };
    row(
        page,
        "when",
        &format!("t = {:.6e} s, step {}, {share:.1} % of the way to {} s", d.time, d.step, e.case.time.end),
    );
    let known = |value: f64| value.is_finite();
    if known(facts.speed) && facts.wave_speed > 0.0 {
        let ratio = facts.speed / facts.wave_speed;
        row(
            page,
            "its speed",
            &format!("{} m/s, {ratio:.3} of the wave speed sqrt(K/rho0)", number(facts.speed)),
        );
    }
    if let Some(neighbours) = facts.neighbours {
        row(page, "its neighbours", &neighbours.to_string());
    }
    if let Some(formulation) = facts.formulation {
        row(page, "formulation", formulation.name());
    }
    page.push('\n');
}

fn likely(page: &mut String, e: &Evidence<'_>, signs: &[Sign]) {
    page.push_str("## Likely cause\n\n");
    match signs {
        [] => {
            let hint = e.diverged.cause.hint();
            let _ = writeln!(page, "Nothing in the case or in the run stands out. In general: {hint}.\n");
        }
        [first, rest @ ..] => {
            let _ = writeln!(page, "{}\n", first.says);
            if !rest.is_empty() {
                page.push_str("What may have to do with it, too:\n\n");
                rest.iter().for_each(|sign| {
                    let _ = writeln!(page, "- {}", sign.says);
                });
                page.push('\n');
            }
        }
    }
}

fn attempts(page: &mut String, e: &Evidence<'_>, signs: &[Sign]) {
    page.push_str("## What to try\n\n");
    let mut all: Vec<tries::Try> = Vec::new();
    let general = [tries::closer_look(e.case, e.diverged.time)];
    for attempt in signs.iter().flat_map(|sign| &sign.tries).chain(&general) {
        if !all.contains(attempt) {
            all.push(attempt.clone());
        }
    }
    page.push_str("One at a time, in this order; each goes behind `taut run CASE --out NEW-DIRECTORY`.\n\n");
    for attempt in &all {
        let _ = writeln!(page, "- `{}`: {}", attempt.arguments, attempt.does);
    }
    page.push('\n');
}

fn steps(page: &mut String, e: &Evidence<'_>) {
    let history = e.simulation.history().steps();
    let Some(first) = history.clone().next() else { return };
    page.push_str("## The time step\n\n");
    page.push_str("What bounded the last steps. The last one is that which failed, or would have come next. The particle at the bound is looked for when the step falls by a tenth, and every 256 steps (64 if all were alike).\n\n");
    page.push_str("| step | begins at, s | dt, s | bound | c, m/s | largest speed, m/s | largest acceleration, m/s^2 | particle |\n|---|---|---|---|---|---|---|---|\n");
    let skipped = history.len().saturating_sub(SHOWN);
    let earlier = (skipped > 0).then_some(first);
    for step in earlier.into_iter().chain(history.skip(skipped)) {
        page.push_str(&step_row(e, step));
    }
    page.push('\n');
}

fn step_row(e: &Evidence<'_>, step: &Step) -> String {
    let first: usize = e.simulation.solvers()[..step.solver].iter().map(|s| s.len()).sum();
    let particle = step.particle.map_or("all alike".to_string(), |id| (first + id as usize).to_string());
    let b = &step.bounding;
    format!(
        "| {} | {:.6e} | {:.4e} | {} | {:.3} | {:.4e} | {:.4e} | {particle} |\n",
        step.number,
        step.time,
        step.dt,
        b.criterion.formula(),
        b.wave_speed,
        b.speed,
        b.acceleration
    )
}

fn energies(page: &mut String, e: &Evidence<'_>) {
    let history = e.writer.audit.history();
    if history.is_empty() {
        return;
    }
    page.push_str("## Energies\n\nThe last measurements before it (all of them are in `audit.csv`).\n\n");
    page.push_str("| t, s | kinetic, J | strain, J | together, J |\n|---|---|---|---|\n");
    for [time, kinetic, strain, both] in history.iter().skip(history.len().saturating_sub(6)) {
        let _ = writeln!(page, "| {time:.6e} | {kinetic:.5e} | {strain:.5e} | {both:.5e} |");
    }
    page.push('\n');
}

fn kept(page: &mut String, e: &Evidence<'_>, files: &Kept) {
    page.push_str("## What was kept\n\n");
    if let Some((frames, time)) = e.writer.last_frame() {
        let _ = writeln!(
            page,
            "- `particles/particles.pvd`: {frames} good frame{}; the last is of t = {time:.6e} s.",
            if frames == 1 { "" } else { "s" }
        );
    }
    if let Some(path) = &files.checkpoint {
        let _ = writeln!(page, "- `{path}`: the last checkpoint, a whole state from before.");
    }
    if files.pictured {
        page.push_str("- `culprit.vtp`: the particle (`IsCulprit`) and what is within three supports of it as the run stopped, with every field that the solver carries and the number of neighbours.\n");
    }
    page.push_str("- `audit.csv`, the tables of probes and `summary.json`, up to where it stopped.\n");
}
