//! The keys of a case file: each stands once, with its kind, unit, default and meaning. What the reader accepts, the
//! JSON schema for editors and the manual's reference page are all made from these tables.

pub(crate) mod load;
mod page;
mod parts;
mod schema;
mod shapes;
mod statics;
mod top;
mod touch;

pub(crate) use parts::{body, boundary, gravity, initial, measure, probe};
pub(crate) use shapes::{fill, shape};
pub(crate) use statics::{damping, quasi_static};
pub(crate) use top::{case, material, monitor, region, time};
pub(crate) use touch::{contact, tool};

use crate::units::Dimension;

/// One key of a table.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// As it is written.
    pub name: &'static str,
    /// What its value has to be.
    pub kind: Kind,
    /// Whether it has to be there, and what it means when it is not.
    pub need: Need,
    /// What it is for; a sentence or two.
    pub doc: &'static str,
}

/// What a value has to be.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// Any text.
    Text,
    /// A name that the case gives: letters, digits, `-` and `_`.
    Name,
    /// The name of a part: of a `body`, a `material`, a `probe`.
    NameOf(&'static str),
    /// A list of one or two such names.
    NamesOf(&'static str),
    /// `true`.
    True,
    /// `true` or `false`.
    Flag,
    /// One of these whole numbers.
    OneOf(&'static [i64]),
    /// A whole number from 1 on.
    Count,
    /// A number, a text with a unit, or an expression of the parameters.
    Number(Dimension, Range),
    /// A number in the unit of what the probe records.
    OfProbe,
    /// One such number per axis.
    Vector(Dimension),
    /// Two such numbers.
    Pair(Dimension),
    /// A list of at least three pairs.
    Pairs(Dimension),
    /// One expression of the reference position x, y, z per axis.
    Place(Dimension),
    /// One expression of the reference position x, y, z and the time t.
    Scalar(Dimension),
    /// A factor over time: pairs of time and number, or the name of a file of them.
    History,
    /// One expression of the reference position x, y, z and the time t per axis.
    Field(Dimension),
    /// One expression of the time t per axis.
    OfTime(Dimension),
    /// An angle, as an expression of the time t.
    AngleOfTime,
    /// One expression of place and time, or "free" for an axis that is left alone.
    FieldOrFree(Dimension),
    /// One of these words.
    Choice(fn() -> Vec<Choice>),
    /// A list of axes.
    Axes,
    /// A shape, or the name of a region.
    Shape,
    /// A list of shapes.
    Shapes,
    /// How particles fill a body.
    Fill,
    /// Numbers by name, which may be expressions of one another.
    Parameters,
    /// A table.
    Table(&'static Table),
    /// A table of tables, each under a name: `[key.NAME]`.
    Named(&'static Table),
    /// A list of tables: `[[key]]`.
    List(&'static Table),
}

/// Which numbers are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// All.
    Any,
    /// Those greater than zero.
    Positive,
    /// Those from zero on.
    NotNegative,
    /// Those greater than zero, up to 1.
    Share,
    /// Between -1 and 0.5, exclusive.
    Poisson,
    /// From 0.6 to 4: with less nobody has neighbours enough, with more everybody has thousands.
    Smoothing,
}

impl Kind {
    /// What its numbers are, if it has some.
    pub(crate) fn dimension(self) -> Option<Dimension> {
        match self {
            Self::Number(d, _) | Self::Vector(d) | Self::Pair(d) | Self::Pairs(d) => Some(d),
            Self::Place(d) | Self::Scalar(d) | Self::Field(d) | Self::FieldOrFree(d) | Self::OfTime(d) => {
                Some(d)
            }
            Self::AngleOfTime => Some(Dimension::NUMBER),
            _ => None,
        }
    }
}

impl Range {
    /// What a person calls it; the empty text for all numbers.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Any => "",
            Self::Positive => "> 0",
            Self::NotNegative => ">= 0",
            Self::Share => "> 0, at most 1",
            Self::Poisson => "between -1 and 0.5",
            Self::Smoothing => "0.6 to 4",
        }
    }
}

/// Whether a key has to be there.
#[derive(Debug, Clone, Copy)]
pub enum Need {
    /// It has to.
    Required,
    /// It need not; what holds then.
    Default(&'static str),
    /// It need not; nothing holds then.
    Optional,
}

/// A word that a value may be.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// The word.
    pub name: &'static str,
    /// What it means.
    pub doc: &'static str,
}

/// A set of words with what they stand for.
pub(crate) trait Words: Copy + 'static {
    /// The word, what it stands for, what it means.
    const WORDS: &'static [(&'static str, Self, &'static str)];

    /// The words alone, for tables of keys.
    fn choices() -> Vec<Choice> {
        Self::WORDS.iter().map(|&(name, _, doc)| Choice { name, doc }).collect()
    }
}

/// A table of the case file.
#[derive(Debug)]
pub struct Table {
    /// As its header is written: `[time]`, `[[body]]`.
    pub header: &'static str,
    /// What it is for.
    pub doc: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
    /// A small example that is right.
    pub example: &'static str,
}

/// The whole case file, as the table of its top level.
#[must_use]
pub fn all() -> &'static Table {
    &case::TABLE
}

/// Shapes by name, each with the keys of its table; those made of a list of shapes have none.
#[must_use]
pub fn shapes() -> &'static [(&'static str, &'static str, &'static [Key])] {
    shape::KINDS
}

pub use page::page;
pub use schema::schema;

impl Key {
    const fn new(name: &'static str, kind: Kind, need: Need, doc: &'static str) -> Self {
        Self { name, kind, need, doc }
    }

    /// Its name, for messages.
    pub(crate) fn quoted(&self) -> String {
        format!("`{}`", self.name)
    }
}

/// The names of keys.
pub(crate) fn names(keys: &[Key]) -> Vec<&'static str> {
    keys.iter().map(|key| key.name).collect()
}
