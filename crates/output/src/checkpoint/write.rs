//! Putting a checkpoint together.

use super::column::Packed;
use super::{About, CHECK, Entry, FIXED, FORMAT, Head, MAGIC, Numbers};
use std::io::{self, Write};
use xxhash_rust::xxh3::Xxh3;

/// A checkpoint that is being put together.
#[derive(Debug, Clone, Default)]
pub struct Draft {
    columns: Vec<(String, Packed)>,
}

impl Draft {
    /// A draft of columns that are packed.
    #[must_use]
    pub fn new(columns: Vec<(String, Packed)>) -> Self {
        Self { columns }
    }

    /// Adds a few numbers.
    pub fn add(&mut self, name: &str, numbers: &[f64]) {
        self.columns.push((name.to_string(), Packed::plain(&Numbers::F64(numbers.into()))));
    }

    /// Writes the checkpoint; `notes` are whatever the caller wants to read back.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write(&self, about: &About, notes: &serde_json::Value, to: &mut impl Write) -> io::Result<()> {
        let entry = |(name, packed): &(String, Packed)| Entry {
            name: name.clone(),
            kind: packed.kind,
            count: packed.count as u64,
            planes: packed.planes,
            bytes: packed.bytes.len() as u64,
        };
        let columns: Vec<Entry> = self.columns.iter().map(entry).collect();
        let body: u64 = columns.iter().map(|column| column.bytes).sum();
        let head = serde_json::to_vec(&Head { about: about.clone(), notes: notes.clone(), columns })?;
        let length = (FIXED + head.len() + CHECK) as u64 + body;
        let mut to = Summing { to, sum: Xxh3::new() };
        to.write_all(&MAGIC)?;
        to.write_all(&FORMAT.to_le_bytes())?;
        to.write_all(&(head.len() as u32).to_le_bytes())?;
        to.write_all(&length.to_le_bytes())?;
        to.write_all(&head)?;
        for (_, packed) in &self.columns {
            to.write_all(&packed.bytes)?;
        }
        let sum = to.sum.digest128();
        to.to.write_all(&sum.to_le_bytes())
    }
}

/// A writer that keeps the checksum.
struct Summing<'a, W> {
    to: &'a mut W,
    sum: Xxh3,
}

impl<W: Write> Write for Summing<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}
