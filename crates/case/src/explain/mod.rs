//! A case in plain words.

mod measures;

use crate::{
    Boundary, Case, Constraint, Course, Damping, Family, FieldExpression, Fill, Formulation, Kernel, Load,
    LoadKind, March, Model, Monitor, Plane, Probe, Quantity, ShapeSpec, Site, Spot, Stepping, Tool,
    VectorField,
};
use measures::measure;
use std::fmt::Write as _;

/// Says what a case does: bodies and sizes, materials, what holds and moves them, how long, what is recorded.
#[must_use]
pub fn explain(case: &Case) -> String {
    let mut text = format!("{} ({})\n", case.title, case.name);
    let space = match case.plane {
        None => "In three dimensions".to_string(),
        Some(Plane::Strain) => "In two dimensions (plane strain)".to_string(),
        Some(Plane::Stress) => "In two dimensions (plane stress)".to_string(),
        Some(Plane::Papers) => "In two dimensions (as the papers' benchmarks)".to_string(),
    };
    let _ = writeln!(text, "{space}, with particles {} apart.", length(case.spacing));
    paragraph(&mut text, "Materials", case.materials.iter().map(|m| material(case, &m.name)));
    paragraph(&mut text, "Bodies", (0..case.bodies.len()).map(|i| body(case, i)));
    paragraph(&mut text, "Tools", case.tools.iter().map(|t| tool(case, t)));
    paragraph(&mut text, "Contact", touching(case).into_iter());
    let held = case.boundaries.iter().map(|b| boundary(case, b));
    let pulled = case.gravity.iter().map(|g| {
        let on = on(case, g.body, g.region.as_ref());
        format!("{on} is pulled by a body force of {} m/s^2", vector(&g.acceleration, case.dimension))
    });
    let started = case.initial.iter().map(|i| {
        let on = on(case, i.body, Some(&i.region));
        format!("{on} starts at {} m/s", vector(&i.velocity, case.dimension))
    });
    let loaded = case.loads.iter().map(|l| load(case, l));
    paragraph(&mut text, "What holds, moves and pulls", held.chain(started).chain(pulled).chain(loaded));
    paragraph(&mut text, "Time", times(case).into_iter());
    paragraph(&mut text, "Recorded", recorded(case).into_iter());
    text
}

fn paragraph(text: &mut String, title: &str, lines: impl Iterator<Item = String>) {
    let mut lines = lines.peekable();
    if lines.peek().is_some() {
        let _ = writeln!(text, "\n{title}");
        for line in lines {
            let _ = writeln!(text, "  - {line}.");
        }
    }
}

fn material(case: &Case, name: &str) -> String {
    let Some(m) = case.materials.iter().find(|m| m.name == name) else { return String::new() };
    let e = &m.elastic;
    let law = match m.model {
        Model::NeoHookean => "a neo-Hookean rubber",
        Model::NeoHookeanLog => "a neo-Hookean rubber (logarithmic volume part)",
        Model::SaintVenantKirchhoff => "Saint Venant-Kirchhoff",
        Model::LinearElastic => "linear elastic",
    };
    format!(
        "{name} is {law}: density {} kg/m^3, Young's modulus {}, Poisson's ratio {:.4}, bulk modulus {}, shear modulus {}; waves run at {:.4} m/s (shear waves at {:.4} m/s)",
        m.density,
        pressure(e.youngs_modulus),
        e.poisson_ratio,
        pressure(e.bulk_modulus),
        pressure(e.shear_modulus),
        m.wave_speed(),
        (e.shear_modulus / m.density).sqrt()
    )
}

fn body(case: &Case, index: usize) -> String {
    let body = &case.bodies[index];
    let scheme = &body.scheme;
    let family = match scheme.formulation.family() {
        Family::Total if scheme.formulation == Formulation::SmallStrain => "small strain",
        Family::Total => "total Lagrangian",
        Family::Updated => "updated Lagrangian",
    };
    let fill = match &body.fill {
        Fill::Lattice { .. } => "on a lattice".to_string(),
        Fill::Concentric => "in layers around its centre".to_string(),
        Fill::Polar { .. } => "in rings of as many particles".to_string(),
        Fill::Fitted => "with particles that fit its surface".to_string(),
        Fill::Saved(saved) => format!("with the particles of {}", saved.file),
    };
    let start = match still(&body.velocity) {
        true => "starts at rest".to_string(),
        false => format!("starts at {} m/s", vector(&body.velocity, case.dimension)),
    };
    let kernel = match case.kernel {
        Kernel::WendlandC2 => "Wendland's C2 kernel",
        Kernel::CubicSpline => "the cubic spline kernel",
        Kernel::Gaussian => "a Gaussian kernel",
    };
    format!(
        "{} is {}, {}, made of {}, filled {fill}; it {start}; solved by {} ({family}), with {kernel} and h = {} spacings",
        body.name,
        shape(&body.shape),
        size(case, &body.shape),
        body.material,
        scheme.formulation.name(),
        scheme.smoothing
    )
}

fn tool(case: &Case, tool: &Tool) -> String {
    let moves = match &tool.course {
        Course::Displacement(field) | Course::Velocity(field) if still(field) => "stays".to_string(),
        Course::Displacement(field) => format!("is moved by {} m", vector(field, case.dimension)),
        Course::Velocity(field) => format!("moves at {} m/s", vector(field, case.dimension)),
    };
    let turns = tool
        .turn
        .as_ref()
        .map_or(String::new(), |turn| format!(" and is turned by {} rad", component(&turn.angle)));
    format!("{} is rigid: {}, {}; it {moves}{turns}", tool.name, shape(&tool.shape), size(case, &tool.shape))
}

/// Who touches whom.
fn touching(case: &Case) -> Vec<String> {
    let said = case.contacts.iter().map(|contact| {
        let [one, other] = contact.bodies.map(|body| case.name_of(body));
        match contact.friction {
            None if contact.penalty.is_some() => {
                format!("{one} and {other} push each other by pairs of particles")
            }
            None => format!("{one} and {other} pass through each other"),
            Some(mu) if one == other => format!("{one} touches itself, {}", rubbing(mu)),
            Some(mu) => format!("{one} and {other} touch, {}", rubbing(mu)),
        }
    });
    let mut lines: Vec<String> = said.collect();
    if case.bodies.len() + case.tools.len() > 1 {
        let who = if lines.is_empty() { "all bodies and tools" } else { "all others" };
        lines.push(format!("{who} touch each other without friction"));
    }
    lines
}

fn rubbing(friction: f64) -> String {
    if friction > 0.0 { format!("with friction {}", short(friction)) } else { "without friction".to_string() }
}

/// A load in words.
fn load(case: &Case, load: &Load) -> String {
    let history = if load.history.is_some() { ", times a factor over time" } else { "" };
    let (on, d) = match &load.site {
        Site::Point(at) => (format!("{} around {at:?} m", on(case, load.body, None)), case.dimension),
        Site::Region(region) => (on(case, load.body, Some(region)), case.dimension),
    };
    match &load.kind {
        LoadKind::Force(field) => format!("{on} feels a total force of {} N{history}", vector(field, d)),
        LoadKind::Traction(field) => {
            format!("the surface of {on} feels {} Pa of its undeformed area{history}", vector(field, d))
        }
        LoadKind::Pressure(field) => {
            format!("a pressure of {} Pa follows the surface of {on}{history}", field.text())
        }
    }
}

/// Lengths of the box around a shape.
fn size(case: &Case, spec: &ShapeSpec) -> String {
    let extent = crate::build::bounds(spec);
    let edges: Vec<String> = extent.iter().take(case.dimension).map(|edge| length(*edge)).collect();
    edges.join(" x ")
}

fn shape(spec: &ShapeSpec) -> String {
    match spec {
        ShapeSpec::Box { .. } => "a box".into(),
        ShapeSpec::Ball { .. } => "a ball".into(),
        ShapeSpec::Ring { inner, .. } => format!("a ring (inner radius {})", length(*inner)),
        ShapeSpec::Cylinder { .. } => "a cylinder".into(),
        ShapeSpec::Polygon { points, .. } => format!("a polygon of {} corners", points.len()),
        ShapeSpec::Stent(s) => {
            format!("a stent ({} cells around, {} along, struts {} wide)", s.around, s.along, length(s.strut))
        }
        ShapeSpec::Mesh { file, mesh } => format!("the mesh {file} of {} triangles", mesh.faces().len()),
        ShapeSpec::Union(parts) => format!("the union of {}", shapes(parts)),
        ShapeSpec::Intersection(parts) => format!("what is common to {}", shapes(parts)),
        ShapeSpec::Difference(parts) => match parts.split_first() {
            Some((first, holes)) => format!("{} without {}", shape(first), shapes(holes)),
            None => "nothing".into(),
        },
        ShapeSpec::Translate { shape: inner, .. } => format!("{}, moved", shape(inner)),
        ShapeSpec::Rotate { angle, shape: inner, .. } => {
            format!("{}, turned by {:.4} degrees", shape(inner), angle.to_degrees())
        }
        ShapeSpec::Scale { factor, shape: inner, .. } => format!("{}, scaled by {factor}", shape(inner)),
    }
}

fn shapes(parts: &[ShapeSpec]) -> String {
    parts.iter().map(shape).collect::<Vec<_>>().join(" and ")
}

/// What a part of the case acts on.
fn on(case: &Case, body: Option<usize>, region: Option<&ShapeSpec>) -> String {
    let whom = body.and_then(|b| case.bodies.get(b)).map(|b| b.name.as_str());
    let everything = if case.bodies.len() == 1 { case.bodies[0].name.as_str() } else { "everything" };
    let Some(region) = region else { return whom.unwrap_or(everything).to_string() };
    let named =
        case.regions.iter().find(|(_, shape)| shape == region).map(|(name, _)| format!("region {name}"));
    format!("{} in {}", whom.unwrap_or(everything), named.unwrap_or_else(|| shape(region)))
}

fn boundary(case: &Case, boundary: &Boundary) -> String {
    let mut on = on(case, boundary.body, Some(&boundary.region));
    if boundary.except.is_some() {
        on += " (but for a part)";
    }
    match &boundary.constraint {
        Constraint::Fixed => format!("{on} is held fast"),
        Constraint::Fix(axes) => {
            let names: Vec<&str> =
                ["x", "y", "z"].into_iter().zip(axes).filter(|a| *a.1).map(|a| a.0).collect();
            format!("{on} cannot move along {}", names.join(" and "))
        }
        Constraint::Velocity(fields) => {
            format!("{on} is moved at {} m/s", free(fields, case.dimension))
        }
        Constraint::Displacement(fields) => {
            format!("{on} is displaced by {} m", free(fields, case.dimension))
        }
    }
}

fn times(case: &Case) -> Vec<String> {
    let frames = (case.time.end / case.time.output).ceil() + 1.0;
    let most = if case.time.apart.0 == 0 { "" } else { "at most " };
    let mut lines = vec![format!(
        "it runs for {}, with a frame every {} ({most}{frames:.0} frames)",
        time(case.time.end),
        time(case.time.output)
    )];
    if let Some(s) = case.quasi_static {
        lines = vec![format!(
            "loads grow in {} increments up to t = {}, each held until unbalanced forces are below {} of the stress; frames are written for equilibria, every {}",
            s.increments,
            time(case.time.end),
            s.tolerance,
            time(case.time.output)
        )];
    }
    if let Some(Damping::Splitting { probability, seed, .. }) = case.damping {
        lines.push(format!(
            "all motion is damped, in {probability} of the steps chosen at random (seed {seed})"
        ));
    } else if let Some(Damping::Viscous { rate }) = case.damping {
        lines.push(format!("all motion is damped by {rate} 1/s of its velocity"));
    } else if case.quasi_static.is_some() {
        lines.push("motion is stopped whenever the kinetic energy has passed a maximum, and stretched particles are made heavier".into());
    }
    let updated = case.bodies.iter().find_map(|body| match body.scheme.march {
        March::Updated { stepping, .. } => Some(stepping),
        March::Total { .. } | March::Small { .. } => None,
    });
    let damper = case.bodies.iter().find_map(|body| match body.scheme.march {
        March::Total { kelvin_voigt, .. } if kelvin_voigt != 1.0 => Some(kelvin_voigt),
        _ => None,
    });
    lines.extend(damper.map(|factor| match factor {
        0.0 => "no Kelvin-Voigt damping".into(),
        _ => format!("{factor} times the Kelvin-Voigt damping of the paper"),
    }));
    match updated {
        Some(Stepping::Dual) => {
            lines.push("neighbours are renewed once in several steps (dual stepping)".into());
        }
        Some(Stepping::Single) => lines.push("neighbours are renewed with every step".into()),
        None => {}
    }
    lines
}

fn recorded(case: &Case) -> Vec<String> {
    let probes = case.probes.iter().map(|p| probe(case, p));
    let measures = case.measures.iter().map(|m| format!("{}: {}", m.name, measure(case, &m.kind)));
    let Monitor { zigzag, bond_min, broken, stop, .. } = case.monitor;
    let what = if stop { "an end" } else { "a warning" };
    let watch = std::iter::once(format!(
        "{what} if the zigzag of the particles exceeds {zigzag} spacings, neighbours come closer than {bond_min} spacings, or more than {broken} of the bonds break"
    ));
    probes.chain(measures).chain(watch).collect()
}

fn probe(case: &Case, probe: &Probe) -> String {
    let what = match probe.quantity {
        Quantity::Displacement => "displacement",
        Quantity::Position => "position",
        Quantity::Velocity => "velocity",
        Quantity::ContactForce => "contact force",
        Quantity::ContactMoment => "moment of the contact forces about the origin",
        Quantity::Reaction => "force",
        Quantity::Moment => "moment about the origin",
        Quantity::VonMises => "largest von Mises stress",
        Quantity::Gap => "smallest distance",
    };
    let spot = match &probe.spot {
        Spot::Point(at) => {
            format!("the point {:?} m of {}", &at[..case.dimension], case.bodies[probe.body].name)
        }
        Spot::Region(region) => {
            let over = if probe.quantity.is_scalar() { "" } else { "the mean over " };
            format!("{over}{}", on(case, Some(probe.body), Some(region)))
        }
        Spot::Contact { by: None } if probe.quantity == Quantity::Gap => {
            format!("{} to the others", case.name_of(probe.body))
        }
        Spot::Contact { by: Some(by) } if probe.quantity == Quantity::Gap => {
            format!("{} to {}", case.name_of(probe.body), case.name_of(*by))
        }
        Spot::Contact { by: None } => format!("{}, by all that touch it", case.name_of(probe.body)),
        Spot::Contact { by: Some(by) } => {
            format!("{}, by {}", case.name_of(probe.body), case.name_of(*by))
        }
        Spot::Boundary(index) => format!("boundary {} on what it holds", case.boundaries[*index].name),
    };
    let often =
        if probe.interval == 0.0 { "every step".into() } else { format!("every {}", time(probe.interval)) };
    format!("{}: the {what} of {spot}, {often}", probe.name)
}

fn still(field: &VectorField) -> bool {
    field.components.iter().all(|c| c.as_constant() == Some(0.0))
}

fn vector(field: &VectorField, dimension: usize) -> String {
    let parts: Vec<String> = field.components.iter().take(dimension).map(component).collect();
    format!("({})", parts.join(", "))
}

fn free(fields: &[Option<FieldExpression>; 3], dimension: usize) -> String {
    let part = |field: &Option<FieldExpression>| field.as_ref().map_or("free".to_string(), component);
    let parts: Vec<String> = fields.iter().take(dimension).map(part).collect();
    format!("({})", parts.join(", "))
}

fn component(field: &FieldExpression) -> String {
    field.as_constant().map_or_else(|| field.text().to_string(), short)
}

/// Four digits, without zeros at the end.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

fn scaled(value: f64, units: &[(f64, &str)]) -> String {
    let fits = units.iter().find(|(size, _)| value.abs() >= *size);
    let (size, unit) = fits.or(units.last()).copied().unwrap_or((1.0, ""));
    format!("{} {unit}", short(value / size))
}

fn length(value: f64) -> String {
    scaled(value, &[(1.0, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "um")])
}

fn time(value: f64) -> String {
    scaled(value, &[(1.0, "s"), (1e-3, "ms"), (1e-6, "us")])
}

fn pressure(value: f64) -> String {
    scaled(value, &[(1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")])
}
