//! `[[contact]]`: how bodies meet.

use super::body::Body;
use super::choices::Family;
use super::names::find;
use super::scope::Scope;
use super::tool::Tool;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::contact as keys;
use crate::source::Place;
use crate::written::{Node, Section, Table, Value};

/// How two bodies meet, by their numbers: bodies in the order of the file, then tools.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The bodies, the smaller number first; twice the same for a body that touches itself.
    pub bodies: [usize; 2],
    /// Coefficient of friction; `None` if they pass through each other, or push each other by a penalty.
    pub friction: Option<f64>,
    /// Strength (N m) and reach (m) of a penalty on pairs of particles.
    pub penalty: Option<[f64; 2]>,
    /// Its header in the case file.
    pub place: Place,
}

/// All meetings that the case speaks of.
pub(crate) fn read(
    sections: &[Section<'_>],
    scope: &Scope,
    names: &[Option<&str>],
    problems: &mut Problems,
) -> Vec<Contact> {
    let mut all: Vec<Contact> = Vec::new();
    for section in sections {
        section.only(keys::TABLE.keys, problems);
        let bodies = problems.keep(section.need(keys::BODIES.name).and_then(|node| pair(node, names)));
        let friction = problems.keep(friction(section, scope));
        let penalty = problems.keep(penalty(section, scope));
        let (Some(bodies), Some(friction), Some(penalty)) = (bodies, friction, penalty) else { continue };
        let friction = friction.filter(|_| penalty.is_none());
        if all.iter().any(|other| other.bodies == bodies) {
            problems
                .0
                .push(Diagnostic::at(section.place, "these bodies meet in another [[contact]] already"));
        }
        all.push(Contact { bodies, friction, penalty, place: section.place });
    }
    all
}

/// Refuses increments of load where bodies rub or push each other by pairs: neither is a matter of equilibrium alone.
pub(crate) fn refuse_statics(root: &Table, contacts: &[Contact], problems: &mut Problems) {
    let Some(node) = root.get("quasi_static") else { return };
    let rubs = |contact: &Contact| contact.friction.is_some_and(|mu| mu > 0.0) || contact.penalty.is_some();
    if contacts.iter().any(rubs) {
        problems.0.push(
            Diagnostic::at(node.place, "increments that are held until forces balance know contact without friction only, and bodies or tools of this case rub, or push each other by pairs")
                .help("leave friction and penalty out of [[contact]]; or move the tools slowly, with [damping] if it rings"),
        );
    }
}

fn pair(node: &Node, names: &[Option<&str>]) -> Result<[usize; 2], Diagnostic> {
    let wrong = || {
        Diagnostic::at(
            node.place,
            format!("`bodies` has to be a list of one or two names, found {}", node.found()),
        )
        .help("for example bodies = [\"strip\", \"punch\"]; one body alone touches itself")
    };
    let Value::Array(items) = &node.value else { return Err(wrong()) };
    let numbers =
        items.iter().map(|item| find(item, "body or tool", names)).collect::<Result<Vec<_>, _>>()?;
    match numbers.as_slice() {
        [one] => Ok([*one, *one]),
        [one, other] if one == other => {
            Err(Diagnostic::at(node.place, "a body that touches itself is named once"))
        }
        [one, other] => Ok([*one.min(other), *one.max(other)]),
        _ => Err(wrong()),
    }
}

fn friction(section: &Section<'_>, scope: &Scope) -> Result<Option<f64>, Diagnostic> {
    let friction = scope.get(section, &keys::FRICTION)?;
    match section.get(keys::IGNORE.name) {
        None => Ok(Some(friction.unwrap_or(0.0))),
        Some(Node { value: Value::Bool(true), place, .. }) => match friction {
            None => Ok(None),
            Some(_) => Err(Diagnostic::at(*place, "bodies that pass through each other have no `friction`")),
        },
        Some(node) => {
            Err(Diagnostic::at(node.place, format!("`ignore` has to be `true`, found {}", node.found())))
        }
    }
}

/// Strength and reach of a penalty, which come together and exclude everything else.
fn penalty(section: &Section<'_>, scope: &Scope) -> Result<Option<[f64; 2]>, Diagnostic> {
    let (strength, reach) = (scope.get(section, &keys::PENALTY)?, scope.get(section, &keys::REACH)?);
    let place = |key: &str| section.get(key).map_or(section.place, |node| node.place);
    match (strength, reach) {
        (None, None) => Ok(None),
        (Some(_), None) => Err(Diagnostic::at(place(keys::PENALTY.name), "a `penalty` needs its `reach`")
            .help("for example reach = \"2*dp\": the distance from which on particles push each other")),
        (None, Some(_)) => Err(Diagnostic::at(place(keys::REACH.name), "`reach` belongs to a `penalty`")),
        (Some(strength), Some(reach)) => {
            let other = section.get(keys::FRICTION.name).or_else(|| section.get(keys::IGNORE.name));
            match other {
                Some(node) => Err(Diagnostic::at(
                    node.place,
                    "a contact by `penalty` has no friction, and is none that is ignored",
                )
                .help("give either `penalty` and `reach`, or `friction`, or `ignore`")),
                None => Ok(Some([strength, reach])),
            }
        }
    }
}

/// Refuses meetings that contact cannot arrange.
pub(crate) fn check(contacts: &[Contact], bodies: &[Body], tools: &[Tool], problems: &mut Problems) {
    let updated = |i: usize| bodies.get(i).is_some_and(|b| b.scheme.formulation.family() == Family::Updated);
    let name = |i: usize| match bodies.get(i) {
        Some(body) => body.name.as_str(),
        None => tools.get(i - bodies.len()).map_or("", |tool| tool.name.as_str()),
    };
    for contact in contacts {
        let [one, other] = contact.bodies;
        let rigid = |i: usize| i >= bodies.len();
        let message = if rigid(one) && one == other {
            format!("`{}` is rigid: it cannot touch itself", name(one))
        } else if rigid(one) && rigid(other) {
            format!("`{}` and `{}` are rigid: there is no force between them", name(one), name(other))
        } else if one == other && contact.penalty.is_some() {
            format!("`{}` cannot push itself by a penalty, which acts between two bodies", name(one))
        } else if updated(one) && one == other {
            format!("`{}` is updated Lagrangian: it touches itself by its own pairs", name(one))
        } else if updated(one) && updated(other) {
            let (one, other) = (name(one), name(other));
            format!(
                "`{one}` and `{other}` are updated Lagrangian: they touch by ordinary pairs, without friction"
            )
        } else {
            continue;
        };
        problems.0.push(Diagnostic::at(contact.place, message).help("remove this [[contact]]"));
    }
}
