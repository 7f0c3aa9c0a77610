//! The states that an importer holds, each under a number that looks like a pointer to it.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::types::Opaque;
use crate::error::{Error, Result};
use crate::instance::{Instance, Snapshot};

/// Saved states of one instance by their number.
#[derive(Default)]
pub struct SavedStates {
    states: HashMap<usize, Saved>,
}

struct Saved {
    snapshot: Snapshot,
    bytes: Option<Vec<u8>>,
}

impl SavedStates {
    /// Keeps a state under `previous`, if that is one of these, or under a new number.
    pub fn keep(&mut self, snapshot: Snapshot, previous: Opaque) -> Opaque {
        let number = match previous.addr() {
            known if self.states.contains_key(&known) => known,
            _ => next_number(),
        };
        self.states.insert(number, Saved { snapshot, bytes: None });
        std::ptr::without_provenance_mut(number)
    }

    /// A kept state.
    ///
    /// # Errors
    /// Unknown state.
    pub fn get(&self, state: Opaque) -> Result<&Snapshot> {
        match self.states.get(&state.addr()) {
            Some(saved) => Ok(&saved.snapshot),
            None => Err(unknown_state()),
        }
    }

    /// Forgets a state. Null is ignored, as both standards ask.
    ///
    /// # Errors
    /// Unknown state.
    pub fn forget(&mut self, state: Opaque) -> Result<()> {
        match self.states.remove(&state.addr()) {
            None if !state.is_null() => Err(unknown_state()),
            _ => Ok(()),
        }
    }

    /// Bytes of a state of `instance`; written once, since importers ask for the size first.
    ///
    /// # Errors
    /// Unknown state.
    pub fn bytes(&mut self, state: Opaque, instance: &Instance) -> Result<&[u8]> {
        let saved = self.states.get_mut(&state.addr()).ok_or_else(unknown_state)?;
        if saved.bytes.is_none() {
            saved.bytes = Some(instance.snapshot_to_bytes(&saved.snapshot)?);
        }
        Ok(saved.bytes.as_deref().unwrap_or_default())
    }
}

/// Numbers are never used twice in a process, so that no state of one instance passes for one of another.
fn next_number() -> usize {
    static NEXT: AtomicUsize = AtomicUsize::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

fn unknown_state() -> Error {
    Error::call(
        "this FMU state is not one of this instance: never saved here, or freed",
        "Pass a state that this instance saved or deserialized and did not free.",
    )
}
