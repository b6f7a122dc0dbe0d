//! The observer, shared between the run and its writer.

use super::Observer;
use std::sync::{Mutex, PoisonError};

/// An observer that both threads may call, one at a time.
pub struct Watcher<'a>(Mutex<&'a mut dyn Observer>);

impl<'a> Watcher<'a> {
    /// Shares an observer.
    pub fn new(observer: &'a mut dyn Observer) -> Self {
        Self(Mutex::new(observer))
    }

    /// Calls it.
    pub fn with(&self, call: impl FnOnce(&mut dyn Observer)) {
        call(&mut **self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}
