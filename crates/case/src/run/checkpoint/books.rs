//! What the run and its writer remember, as numbers of a checkpoint.

use crate::run::contact::Contact;
use crate::run::history::DisorderHistory;
use crate::run::reactions::Meter;
use crate::run::recorder::{Due, Remembered};
use output::Mark;
use output::checkpoint::{Checkpoint, Draft};
use serde::{Deserialize, Serialize};
use taut::integrator::Impulse;
use taut::simulation::Totals;

/// What a checkpoint holds in words.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Notes {
    /// How long the table of each probe was, in the order of the case.
    pub tables: Vec<Mark>,
    /// What was doubtful.
    pub warnings: Vec<String>,
    /// Steps taken at the last frame.
    pub framed: Option<u64>,
    /// How long the tables of the audit were: energies and momenta, and reactions if there are any.
    pub audit: Vec<Mark>,
    /// Thresholds of disorder that have been crossed.
    pub crossed: [bool; 3],
}

impl Notes {
    /// For the head of a checkpoint.
    pub fn in_words(&self) -> serde_json::Value {
        // Texts and whole numbers can always be written.
        serde_json::to_value(self).unwrap_or_default()
    }

    /// Of a checkpoint.
    ///
    /// # Errors
    /// If they are something else.
    pub fn of(checkpoint: &Checkpoint) -> Result<Self, String> {
        serde_json::from_value(checkpoint.notes.clone()).map_err(|error| format!("its notes: {error}"))
    }
}

/// What a checkpoint holds of the writer's books.
#[derive(Clone, Debug, Default)]
pub struct Books {
    /// Times of the frames, s.
    pub frames: Vec<f64>,
    /// The books of energy and momentum.
    pub audit: Vec<f64>,
    /// Measures of disorder.
    pub disorder: DisorderHistory,
    /// The first touch.
    pub contact: Contact,
}

/// Names in the file.
const FRAMES: &str = "books/frames";
const AUDIT: &str = "books/audit";
const DISORDER: &str = "books/disorder";
const CONTACT: &str = "books/contact";
const DUE: &str = "recorder/due";
const START: &str = "recorder/start";
const STATICS: &str = "quasi-static/state";
const INCREMENTS: &str = "quasi-static/increments";
const METERS: [&str; 2] = ["recorder/probes", "recorder/boundaries"];

impl Books {
    /// Adds them to a draft.
    pub fn add(
        draft: &mut Draft,
        frames: &[f64],
        audit: &[f64],
        (disorder, contact): (&DisorderHistory, &Contact),
    ) {
        draft.add(FRAMES, frames);
        draft.add(AUDIT, audit);
        draft.add(DISORDER, &disorder.saved());
        draft.add(CONTACT, &contact.saved());
    }

    /// Reads them; `contact` knows the reach.
    ///
    /// # Errors
    /// If something is not there or does not fit.
    pub fn of(checkpoint: &Checkpoint, contact: Contact) -> Result<Self, String> {
        let numbers = |name: &str| checkpoint.numbers(name).map_err(|reason| format!("`{name}`: {reason}"));
        let unfit = |name: &str| format!("`{name}` has another length");
        Ok(Self {
            frames: numbers(FRAMES)?,
            audit: numbers(AUDIT)?,
            disorder: DisorderHistory::restored(&numbers(DISORDER)?).ok_or_else(|| unfit(DISORDER))?,
            contact: contact.restored(&numbers(CONTACT)?).ok_or_else(|| unfit(CONTACT))?,
        })
    }
}

/// Adds what the recorder remembers to a draft.
pub fn remember(draft: &mut Draft, (due, meters): (&Due, &[Vec<Meter>; 2]), start: &Totals) {
    draft.add(DUE, &due.saved());
    draft.add(START, &of_totals(start));
    for (name, meters) in METERS.iter().zip(meters) {
        let numbers: Vec<f64> = meters.iter().flat_map(Meter::saved).collect();
        draft.add(name, &numbers);
    }
}

/// Reads it.
///
/// # Errors
/// If something is not there or does not fit.
pub fn remembered(checkpoint: &Checkpoint) -> Result<Remembered, String> {
    let numbers = |name: &str| checkpoint.numbers(name).map_err(|reason| format!("`{name}`: {reason}"));
    let unfit = |name: &str| format!("`{name}` has another length");
    let due = Due::restored(&numbers(DUE)?).ok_or_else(|| unfit(DUE))?;
    let start = totals(&numbers(START)?).ok_or_else(|| unfit(START))?;
    let meters = |name: &str| {
        let numbers = numbers(name)?;
        let (rows, rest) = numbers.as_chunks::<7>();
        if rest.is_empty() { Ok(rows.iter().map(Meter::restored).collect()) } else { Err(unfit(name)) }
    };
    Ok(Remembered { due, meters: [meters(METERS[0])?, meters(METERS[1])?], start })
}

/// Where a quasi-static run stands.
#[derive(Clone, Debug)]
pub struct Settling {
    /// What the march from equilibrium to equilibrium remembers.
    pub state: [f64; 5],
    /// The increments so far.
    pub increments: Vec<f64>,
}

impl Settling {
    /// Adds it to a draft.
    pub fn add(&self, draft: &mut Draft) {
        draft.add(STATICS, &self.state);
        draft.add(INCREMENTS, &self.increments);
    }

    /// Reads it.
    ///
    /// # Errors
    /// If something is not there or does not fit.
    pub fn of(checkpoint: &Checkpoint) -> Result<Self, String> {
        let numbers = |name: &str| checkpoint.numbers(name).map_err(|reason| format!("`{name}`: {reason}"));
        let unfit = |name: &str| format!("`{name}` has another length");
        let state = numbers(STATICS)?.try_into().map_err(|_| unfit(STATICS))?;
        let increments = numbers(INCREMENTS)?;
        let whole = increments.len().is_multiple_of(6);
        whole.then_some(Self { state, increments }).ok_or_else(|| unfit(INCREMENTS))
    }
}

/// How many numbers [`of_totals`] are.
pub const TOTALS: usize = 23;

/// Energies, momenta and impulses as numbers.
pub fn of_totals(t: &Totals) -> Vec<f64> {
    let energies = [t.kinetic, t.strain, t.dissipated, t.external_work, t.contact];
    let vectors = [t.momentum, t.angular_momentum, t.impulse.linear, t.impulse.angular, t.couple];
    [&energies, vectors.as_flattened(), &t.motion, &[t.couples]].concat()
}

/// The other way round.
pub fn totals(numbers: &[f64]) -> Option<Totals> {
    let (&[kinetic, strain, dissipated, external_work, contact], rest) = numbers.split_first_chunk()?;
    let (vectors, motion) = rest.split_first_chunk::<15>()?;
    let vector = |index: usize| std::array::from_fn(|i| vectors[3 * index + i]);
    let [linear, angular, couples] = motion.try_into().ok()?;
    let (momentum, angular_momentum) = (vector(0), vector(1));
    let impulse = Impulse { linear: vector(2), angular: vector(3) };
    Some(Totals {
        kinetic,
        strain,
        dissipated,
        external_work,
        contact,
        momentum,
        angular_momentum,
        impulse,
        motion: [linear, angular],
        couple: vector(4),
        couples,
    })
}
