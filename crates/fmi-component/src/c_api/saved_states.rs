//! The states that an importer holds, each under a number that looks like a pointer to it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::types::Opaque;
use crate::error::{Error, Result};
use crate::instance::{Instance, Snapshot};

/// Saved states of one instance by their number.
#[derive(Default)]
pub struct SavedStates {
    states: BTreeMap<usize, Saved>,
    /// The state that was forgotten last: memory for the next one.
    spare: Option<Snapshot>,
    /// Numbers that only this instance gives.
    numbers: Range<usize>,
}

struct Saved {
    snapshot: Snapshot,
    bytes: Option<Vec<u8>>,
}

impl SavedStates {
    /// Saves the state of `instance` under `previous`, if that is one of these, or under a new number.
    ///
    /// # Errors
    /// As [`Instance::save`]; all is as before then.
    pub fn save(&mut self, instance: &Instance, previous: Opaque) -> Result<Opaque> {
        if let Some(saved) = self.states.get_mut(&previous.addr()) {
            instance.save_over(&mut saved.snapshot)?;
            saved.bytes = None;
            return Ok(previous);
        }
        if let Some(spare) = &mut self.spare {
            instance.save_over(spare)?;
        }
        let snapshot = match self.spare.take() {
            Some(snapshot) => snapshot,
            None => instance.save()?,
        };
        Ok(self.keep(snapshot))
    }

    /// Keeps a state under a new number.
    pub fn keep(&mut self, snapshot: Snapshot) -> Opaque {
        let number = self.next_number();
        self.states.insert(number, Saved { snapshot, bytes: None });
        std::ptr::without_provenance_mut(number)
    }

    /// Numbers are never used twice in a process, so that no state of one instance passes for one of another.
    fn next_number(&mut self) -> usize {
        /// How many an instance takes at once.
        const MANY: usize = 256;
        static NEXT: AtomicUsize = AtomicUsize::new(1);
        if self.numbers.is_empty() {
            let first = NEXT.fetch_add(MANY, Ordering::Relaxed);
            self.numbers = first..first + MANY;
        }
        self.numbers.start += 1;
        self.numbers.start - 1
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
            None if !state.is_null() => return Err(unknown_state()),
            None => {}
            Some(saved) => self.spare = Some(saved.snapshot),
        }
        Ok(())
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

fn unknown_state() -> Error {
    Error::call(
        "this FMU state is not one of this instance: never saved here, or freed",
        "Pass a state that this instance saved or deserialized and did not free.",
    )
}
