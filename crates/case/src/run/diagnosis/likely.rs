//! The likely cause, chosen from what is known.

use super::Evidence;
use super::facts::Facts;
use super::tries::{self, Try};
use crate::{Formulation, March, StepRule};
use taut::integrator::Cause;

/// Something that speaks for a cause.
#[derive(Clone, Debug, PartialEq)]
pub struct Sign {
    /// What is seen, and what it means.
    pub says: String,
    /// What to try.
    pub tries: Vec<Try>,
}

/// Zigzag, in spacings, beyond which zero-energy modes have taken over: what no healthy published case exceeds.
const ZIGZAG: f64 = 0.06;
/// Zigzag that says something if it has grown tenfold: more than noise.
const NOTICED: f64 = 0.004;

/// Everything that speaks for a cause, the likeliest first.
pub fn signs(evidence: &Evidence<'_>, facts: &Facts) -> Vec<Sign> {
    let rules: [fn(&Evidence<'_>, &Facts) -> Option<Sign>; 13] = [
        nothing_to_start_from,
        senseless_load,
        impossible_speed,
        long_steps,
        given_steps,
        stretched_beyond_the_step,
        zigzag,
        torn,
        faster_than_sound,
        led_too_fast,
        corner,
        incompressible,
        thin,
    ];
    rules.iter().filter_map(|rule| rule(evidence, facts)).collect()
}

fn sign(says: String, tries: Vec<Try>) -> Option<Sign> {
    Some(Sign { says, tries })
}

fn nothing_to_start_from(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if !(facts.at_start && e.diverged.cause == Cause::NotFinite) {
        return None;
    }
    sign(
        "The initial state itself is not made of numbers: an expression of the case divides by zero, or takes the root or logarithm of a negative number, at this place.".to_string(),
        vec![],
    )
}

fn senseless_load(_: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let load = facts.senseless?;
    sign(
        format!(
            "The {load} on this particle is not a number: an expression of the case divides by zero, or takes the root or logarithm of a negative number, from this time on."
        ),
        vec![],
    )
}

fn impossible_speed(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if !(facts.at_start && e.diverged.cause == Cause::Speed) {
        return None;
    }
    sign(
        format!(
            "The case starts it at {:.4} m/s, {:.1} times the wave speed sqrt(K/rho0) = {:.4} m/s of its material. No solid follows that: is the unit right?",
            facts.speed,
            facts.speed / facts.wave_speed,
            facts.wave_speed
        ),
        tries::slower(e.case),
    )
}

fn long_steps(_: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let (cfl, default) = facts.cfl;
    if cfl <= default || facts.at_start {
        return None;
    }
    sign(
        format!(
            "The time steps are longer than is known to be stable: [time] cfl is {cfl}, and {default} is the most that is."
        ),
        vec![tries::smaller_cfl(cfl, default)],
    )
}

/// A linear body has one way to diverge: steps that are too long.
fn given_steps(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let March::Small { dt: Some(dt), .. } = e.case.bodies.get(e.diverged.body)?.scheme.march else {
        return None;
    };
    if facts.at_start {
        return None;
    }
    sign(
        format!(
            "[time] dt is {dt} s, and small strain is unstable beyond 2/omega of its highest frequency (and earlier where contact is stiff): `taut stability` tells that limit; without dt the step is 0.8 of it."
        ),
        vec![tries::shorter_steps(dt)],
    )
}

fn stretched_beyond_the_step(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let body = e.case.bodies.get(e.diverged.body)?;
    let paper = matches!(body.scheme.march, March::Total { step: StepRule::Paper, .. });
    if !paper || facts.at_start {
        return None;
    }
    let stretch =
        facts.stretch.map_or(String::new(), |s| format!(" (the norm of F at the particle is {s:.3})"));
    sign(
        format!(
            "[time] step = \"paper\" takes sqrt(K/rho0) for the wave speed, whatever the stretch{stretch}: beyond about 130 % it turns particles inside out."
        ),
        vec![tries::stretch_step()],
    )
}

fn zigzag(_: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let (first, last, time) = facts.zigzag?;
    let grown = last > NOTICED && last > 10.0 * first;
    if !(last > ZIGZAG || (facts.is_nested() && grown)) {
        return None;
    }
    let (form, tries) = match facts.formulation {
        Some(Formulation::TlNested) => {
            (" (a nested form is blind to them)", vec![tries::formulation(Formulation::TlHourglassFree)])
        }
        Some(form) if form.is_updated_nested() => {
            (" (a nested form is blind to them)", vec![tries::formulation(Formulation::UlNonHourglass)])
        }
        _ => ("", vec![tries::smaller_cfl(facts.cfl.0, facts.cfl.1)]),
    };
    sign(
        format!(
            "Zigzag modes have grown: {first:.2e} spacings (root mean square) at the start, {last:.2e} at t = {time:.4e} s{form}."
        ),
        tries,
    )
}

fn torn(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if !matches!(e.diverged.cause, Cause::Density | Cause::Lost) || facts.is_total() || facts.at_start {
        return None;
    }
    let nested = facts.formulation.filter(|f| f.is_updated_nested());
    let mut tries = match nested {
        Some(_) => vec![tries::formulation(Formulation::UlNonHourglass)],
        None => vec![],
    };
    tries.extend(tries::slower(e.case));
    let how = match nested {
        Some(form) => format!(
            "{} is unstable in tension: particles clump and tear even where the material would not.",
            form.name()
        ),
        None => "Particles were pressed together or torn apart.".to_string(),
    };
    sign(how, tries)
}

fn faster_than_sound(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if facts.fastest <= facts.wave_speed || facts.at_start {
        return None;
    }
    sign(
        format!(
            "Something moved at {:.4} m/s, faster than waves do ({:.4} m/s): a shock, or an instability that had begun before.",
            facts.fastest, facts.wave_speed
        ),
        tries::slower(e.case),
    )
}

fn led_too_fast(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if facts.led <= 0.1 * facts.wave_speed {
        return None;
    }
    sign(
        format!(
            "A boundary moves at {:.4} m/s, {:.2} of the wave speed: the load arrives as a shock.",
            facts.led,
            facts.led / facts.wave_speed
        ),
        tries::slower(e.case),
    )
}

fn corner(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    // Neighbours of what is held: within the support of the kernel, 2.6 spacings at most.
    let held = facts.held.filter(|&d| d < 2.6)?;
    let where_ = if held == 0.0 {
        "is held itself".to_string()
    } else {
        format!("is {held:.1} spacings from a held one")
    };
    sign(
        format!(
            "The particle {where_}: stress concentrates at the edge of a support, the more the finer the particles."
        ),
        vec![tries::finer(e.case)],
    )
}

fn incompressible(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    if facts.poisson <= 0.49 {
        return None;
    }
    sign(
        format!(
            "Poisson's ratio {:.4} makes the material nearly incompressible: small changes of volume are large pressures.",
            facts.poisson
        ),
        tries::compressible(e.case, e.diverged.body).into_iter().collect(),
    )
}

fn thin(e: &Evidence<'_>, facts: &Facts) -> Option<Sign> {
    let across = facts.across.filter(|&n| n < 4)?;
    sign(
        format!("Its body is {across} particles thick at its thinnest; 4 are the least that carry bending."),
        vec![tries::finer(e.case)],
    )
}
