//! What the run and its writer remember, as numbers of a checkpoint.

use crate::run::contact::Contact;
use crate::run::history::DisorderHistory;
use crate::run::recorder::Due;
use output::Mark;
use output::checkpoint::{Checkpoint, Draft};
use serde::{Deserialize, Serialize};
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
    /// Time, kinetic, strain and total energy.
    pub energies: Vec<[f64; 4]>,
    /// Measures of disorder.
    pub disorder: DisorderHistory,
    /// The first touch.
    pub contact: Contact,
}

/// Names in the file.
const FRAMES: &str = "books/frames";
const ENERGIES: &str = "books/energies";
const DISORDER: &str = "books/disorder";
const CONTACT: &str = "books/contact";
const DUE: &str = "recorder/due";
const START: &str = "recorder/start";

impl Books {
    /// Adds them to a draft.
    pub fn add(
        draft: &mut Draft,
        frames: &[f64],
        energies: &[[f64; 4]],
        (disorder, contact): (&DisorderHistory, &Contact),
    ) {
        draft.add(FRAMES, frames);
        draft.add(ENERGIES, energies.as_flattened());
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
        let energies = numbers(ENERGIES)?;
        let (rows, rest) = energies.as_chunks::<4>();
        let energies = if rest.is_empty() { rows.to_vec() } else { return Err(unfit(ENERGIES)) };
        Ok(Self {
            frames: numbers(FRAMES)?,
            energies,
            disorder: DisorderHistory::restored(&numbers(DISORDER)?).ok_or_else(|| unfit(DISORDER))?,
            contact: contact.restored(&numbers(CONTACT)?).ok_or_else(|| unfit(CONTACT))?,
        })
    }
}

/// Adds what the recorder remembers to a draft.
pub fn remember(draft: &mut Draft, due: &Due, start: &Totals) {
    draft.add(DUE, &due.saved());
    let energies = [start.kinetic, start.strain, start.dissipated, start.external_work];
    draft.add(START, &[&energies[..], &start.momentum, &start.angular_momentum].concat());
}

/// Reads it.
///
/// # Errors
/// If something is not there or does not fit.
pub fn remembered(checkpoint: &Checkpoint) -> Result<(Due, Totals), String> {
    let due = Due::restored(&checkpoint.numbers(DUE).map_err(|reason| format!("`{DUE}`: {reason}"))?);
    let due = due.ok_or_else(|| format!("`{DUE}` has another length"))?;
    let start = checkpoint.numbers(START).map_err(|reason| format!("`{START}`: {reason}"))?;
    let &[kinetic, strain, dissipated, external_work, px, py, pz, lx, ly, lz] = start.as_slice() else {
        return Err(format!("`{START}` has another length"));
    };
    let (momentum, angular_momentum) = ([px, py, pz], [lx, ly, lz]);
    Ok((due, Totals { kinetic, strain, dissipated, external_work, momentum, angular_momentum }))
}
