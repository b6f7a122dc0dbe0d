//! State taken off a simulation and put back, bit by bit: named columns of numbers.
//!
//! Whoever has state of its own between steps hands it out as [`Part`]s and takes it back from a [`Shelf`]; neither knows of files.
//! What can be made again identically (a list in the reference configuration, buffers) is no state.

use std::borrow::Cow;

/// A column of numbers, in the precision in which it is right.
#[derive(Clone, Debug, PartialEq)]
pub enum Values<'a> {
    /// Double precision.
    Double(Cow<'a, [f64]>),
    /// Single precision.
    Single(Cow<'a, [f32]>),
    /// Whole numbers.
    Whole(Cow<'a, [u32]>),
}

/// A column with its name.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    /// The name, unique in what it belongs to; `/` separates levels.
    pub name: String,
    /// The numbers.
    pub values: Values<'a>,
}

impl<'a> Part<'a> {
    /// A few numbers of their own, such as the time.
    #[must_use]
    pub fn numbers(name: &str, values: &[f64]) -> Self {
        Self { name: name.to_string(), values: Values::Double(Cow::Owned(values.to_vec())) }
    }

    /// A column that stands elsewhere.
    #[must_use]
    pub fn column(name: String, values: &'a [f64]) -> Self {
        Self { name, values: Values::Double(Cow::Borrowed(values)) }
    }

    /// The same part on a level further down.
    #[must_use]
    pub fn within(self, level: &str) -> Self {
        Self { name: format!("{level}/{}", self.name), ..self }
    }
}

/// Why a state cannot be put back.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RestoreError {
    /// A part cannot be had.
    #[error("`{name}`: {reason}")]
    Missing {
        /// Name of the part.
        name: String,
        /// Why.
        reason: String,
    },
    /// A part is not of the kind or the length that belongs here.
    #[error("`{name}` does not fit: {reason}")]
    Unfit {
        /// Name of the part.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The bodies are not those that the state was taken from.
    #[error("it belongs to other particles: {0}")]
    Foreign(&'static str),
}

/// Where parts are taken from: a name and how many numbers there should be, at most.
pub type Source<'a> = dyn FnMut(&str, usize) -> Result<Values<'static>, String> + 'a;

/// Parts to be put back, seen from one level.
pub struct Shelf<'a> {
    source: &'a mut Source<'a>,
    level: String,
}

impl<'a> Shelf<'a> {
    /// All parts of `source`.
    pub fn new(source: &'a mut Source<'a>) -> Self {
        Self { source, level: String::new() }
    }

    /// Looks at the level of this name (such as `solver-0`) from now on; the empty name is the top.
    pub fn enter(&mut self, level: &str) {
        self.level = if level.is_empty() { String::new() } else { format!("{level}/") };
    }

    /// A part of exactly `len` numbers.
    ///
    /// # Errors
    /// If it is not there, or has another length.
    pub fn take(&mut self, name: &str, len: usize) -> Result<Values<'static>, RestoreError> {
        let name = format!("{}{name}", self.level);
        let values = match (self.source)(&name, len) {
            Ok(values) => values,
            Err(reason) => return Err(RestoreError::Missing { name, reason }),
        };
        let found = match &values {
            Values::Double(v) => v.len(),
            Values::Single(v) => v.len(),
            Values::Whole(v) => v.len(),
        };
        if found == len {
            return Ok(values);
        }
        Err(RestoreError::Unfit { name, reason: format!("{found} numbers instead of {len}") })
    }

    /// A part of exactly `len` numbers in double precision.
    ///
    /// # Errors
    /// As [`Shelf::take`], and if it is of another kind.
    pub fn doubles(&mut self, name: &str, len: usize) -> Result<Cow<'static, [f64]>, RestoreError> {
        match self.take(name, len)? {
            Values::Double(values) => Ok(values),
            _ => Err(self.unfit(name, "not in double precision")),
        }
    }

    /// `N` numbers, as [`Part::numbers`] wrote them.
    ///
    /// # Errors
    /// As [`Shelf::doubles`].
    pub fn numbers<const N: usize>(&mut self, name: &str) -> Result<[f64; N], RestoreError> {
        let values = self.doubles(name, N)?;
        Ok(std::array::from_fn(|i| values[i]))
    }

    /// A number of a part as a count.
    ///
    /// # Errors
    /// If it is none: negative, broken, or beyond what a number can count.
    pub fn count(&self, name: &str, number: f64) -> Result<u64, RestoreError> {
        const BEYOND: f64 = (1_u64 << 53) as f64;
        let whole = (0.0..BEYOND).contains(&number) && number.fract() == 0.0;
        if whole { Ok(number as u64) } else { Err(self.unfit(name, "no count")) }
    }

    /// A permutation of the numbers below `len`.
    ///
    /// # Errors
    /// As [`Shelf::take`], and if it is none.
    pub fn permutation(&mut self, name: &str, len: usize) -> Result<Cow<'static, [u32]>, RestoreError> {
        let Values::Whole(values) = self.take(name, len)? else {
            return Err(self.unfit(name, "no whole numbers"));
        };
        let mut seen = vec![false; len];
        for &value in values.iter() {
            match seen.get_mut(value as usize) {
                Some(seen) if !*seen => *seen = true,
                _ => return Err(self.unfit(name, "no permutation")),
            }
        }
        Ok(values)
    }

    /// The error of a part that does not fit.
    #[must_use]
    pub fn unfit(&self, name: &str, reason: &str) -> RestoreError {
        RestoreError::Unfit { name: format!("{}{name}", self.level), reason: reason.to_string() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shelf(name: &str, _: usize) -> Result<Values<'static>, String> {
        match name {
            "a/order" => Ok(Values::Whole(vec![2, 0, 1].into())),
            "a/twice" => Ok(Values::Whole(vec![2, 2, 1].into())),
            "a/beyond" => Ok(Values::Whole(vec![0, 1, 3].into())),
            "clock" => Ok(Values::Double(vec![0.5, -0.0].into())),
            _ => Err("not there".to_string()),
        }
    }

    #[test]
    fn parts_come_back_by_level_and_are_held_to_kind_and_length() {
        let mut source = shelf;
        let mut shelf = Shelf::new(&mut source);
        assert_eq!(
            shelf.numbers::<2>("clock").expect("there").map(f64::to_bits),
            [0.5_f64.to_bits(), 1 << 63]
        );
        assert!(shelf.numbers::<3>("clock").is_err_and(|e| e.to_string().contains("2 numbers instead of 3")));
        assert!(shelf.count("clock", 0.5).is_err() && shelf.count("clock", 1e300).is_err());
        shelf.enter("a");
        assert_eq!(*shelf.permutation("order", 3).expect("one"), [2, 0, 1]);
        for wrong in ["twice", "beyond"] {
            let error = shelf.permutation(wrong, 3).expect_err("no permutation");
            assert!(error.to_string().contains(&format!("a/{wrong}")), "{error}");
        }
        assert!(shelf.doubles("order", 3).is_err_and(|e| e.to_string().contains("double")));
        assert!(shelf.take("clock", 2).is_err_and(|e| e.to_string().contains("not there")));
    }
}
