//! Saved states, alike in both versions but for the names of the functions.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::common::{Inner, Opaque, Status, enter};
use super::memory;
use crate::error::{Error, Result};
use crate::fmi::life_cycle::Version;
use crate::fmi::snapshot::Snapshot;
use crate::scene::Scene;

/// A state that the importer holds by its number.
pub struct Saved<S: Scene> {
    snapshot: Snapshot<S::State>,
    bytes: Option<Vec<u8>>,
}

impl<S: Scene> Inner<S> {
    /// Saves the state under `previous`, if that is one of ours, or under a new number.
    ///
    /// # Errors
    /// The instance has failed.
    pub fn save(&mut self, previous: Opaque) -> Result<Opaque> {
        let snapshot = self.instance.save()?;
        let number = match previous.addr() {
            known if self.states.contains_key(&known) => known,
            _ => next_number(),
        };
        Ok(self.keep(number, snapshot))
    }

    fn keep(&mut self, number: usize, snapshot: Snapshot<S::State>) -> Opaque {
        self.states.insert(number, Saved { snapshot, bytes: None });
        std::ptr::without_provenance_mut(number)
    }

    /// Goes back to a saved state.
    ///
    /// # Errors
    /// Unknown state, or one that does not fit.
    pub fn restore(&mut self, state: Opaque) -> Result<()> {
        let saved = self.states.get(&state.addr()).ok_or_else(unknown_state)?;
        self.instance.restore(&saved.snapshot)
    }

    /// Forgets a saved state. Null is ignored, as both standards ask.
    ///
    /// # Errors
    /// Unknown state.
    pub fn forget(&mut self, state: Opaque) -> Result<()> {
        match self.states.remove(&state.addr()) {
            None if !state.is_null() => Err(unknown_state()),
            _ => Ok(()),
        }
    }

    /// Bytes of a saved state; written once, since importers ask for the size first.
    ///
    /// # Errors
    /// Unknown state.
    pub fn bytes(&mut self, state: Opaque) -> Result<&[u8]> {
        let saved = self.states.get_mut(&state.addr()).ok_or_else(unknown_state)?;
        if saved.bytes.is_none() {
            saved.bytes = Some(saved.snapshot.to_bytes(self.instance.token())?);
        }
        Ok(saved.bytes.as_deref().unwrap_or_default())
    }

    /// Makes a saved state of bytes.
    ///
    /// # Errors
    /// Damaged or foreign bytes.
    pub fn read_bytes(&mut self, bytes: &[u8]) -> Result<Opaque> {
        let snapshot = self.instance.read_snapshot(bytes)?;
        Ok(self.keep(next_number(), snapshot))
    }
}

/// `fmi2GetFMUstate`, `fmi3GetFMUState`.
///
/// # Safety
/// As for [`enter`]; `state` is null or may be read and written.
pub unsafe fn get<S: Scene>(pointer: Opaque, version: Version, function: &str, state: *mut Opaque) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            let previous = memory::read(state, "the pointer to the FMU state")?;
            let saved = inner.save(previous)?;
            memory::write(state, saved, "the pointer to the FMU state")
        })
    }
}

/// `fmi2SetFMUstate`, `fmi3SetFMUState`.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn set<S: Scene>(pointer: Opaque, version: Version, function: &str, state: Opaque) -> Status {
    // SAFETY: passed on.
    unsafe { enter::<S>(pointer, version, function, |inner| inner.restore(state)) }
}

/// `fmi2FreeFMUstate`, `fmi3FreeFMUState`.
///
/// # Safety
/// As for [`enter`]; `state` is null or may be read and written.
pub unsafe fn free<S: Scene>(pointer: Opaque, version: Version, function: &str, state: *mut Opaque) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            if state.is_null() {
                return Ok(()); // both standards ignore it
            }
            inner.forget(memory::read(state, "the pointer to the FMU state")?)?;
            memory::write(state, std::ptr::null_mut(), "the pointer to the FMU state")
        })
    }
}

/// `fmi2SerializedFMUstateSize`, `fmi3SerializedFMUStateSize`.
///
/// # Safety
/// As for [`enter`]; `size` is null or may be written.
pub unsafe fn size<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    state: Opaque,
    size: *mut usize,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            let length = inner.bytes(state)?.len();
            memory::write(size, length, "size")
        })
    }
}

/// `fmi2SerializeFMUstate`, `fmi3SerializeFMUState`.
///
/// # Safety
/// As for [`enter`]; `bytes` is null or has `size` bytes that may be written.
pub unsafe fn serialize<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    state: Opaque,
    (bytes, size): (*mut u8, usize),
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            let written = inner.bytes(state)?;
            if size < written.len() {
                return Err(Error::call(
                    format!("{size} bytes are too few, the state takes {}", written.len()),
                    "Ask for the size first.",
                ));
            }
            let mut output = memory::Output::new(bytes, size, "serializedState")?;
            for (index, byte) in written.iter().enumerate() {
                output.write(index, *byte);
            }
            Ok(())
        })
    }
}

/// `fmi2DeSerializeFMUstate`, `fmi3DeserializeFMUState`.
///
/// # Safety
/// As for [`enter`]; `bytes` is null or has `size` bytes; `state` is null or may be written.
pub unsafe fn deserialize<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    (bytes, size): (*const u8, usize),
    state: *mut Opaque,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            memory::read(state, "the pointer to the FMU state")?; // refused before anything is kept
            let bytes = memory::slice(bytes, size, "serializedState")?;
            let saved = inner.read_bytes(bytes)?;
            memory::write(state, saved, "the pointer to the FMU state")
        })
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
