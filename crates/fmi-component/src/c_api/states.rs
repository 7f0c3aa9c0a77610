//! Saved states, alike in both versions but for the names of the functions.

use super::component::Entry;
use super::types::{Opaque, Status};
use crate::error::Error;
use crate::memory;

const STATE: &str = "the pointer to the FMU state";

/// `fmi2GetFMUstate`, `fmi3GetFMUState`.
///
/// # Safety
/// As for [`Entry::change`]; `state` is null or may be read and written.
pub unsafe fn get(entry: Entry, state: *mut Opaque) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let previous = memory::read(state, STATE)?;
            let kept = component.states.save(&component.instance, previous)?;
            memory::write(state, kept, STATE)
        })
    }
}

/// `fmi2SetFMUstate`, `fmi3SetFMUState`.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn set(entry: Entry, state: Opaque) -> Status {
    // SAFETY: passed on.
    unsafe { entry.change(|component| component.restore(state)) }
}

/// `fmi2FreeFMUstate`, `fmi3FreeFMUState`.
///
/// # Safety
/// As for [`Entry::change`]; `state` is null or may be read and written.
pub unsafe fn free(entry: Entry, state: *mut Opaque) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            if state.is_null() {
                return Ok(()); // both standards ignore it
            }
            component.states.forget(memory::read(state, STATE)?)?;
            memory::write(state, std::ptr::null_mut(), STATE)
        })
    }
}

/// `fmi2SerializedFMUstateSize`, `fmi3SerializedFMUStateSize`.
///
/// # Safety
/// As for [`Entry::change`]; `size` is null or may be written.
pub unsafe fn size(entry: Entry, state: Opaque, size: *mut usize) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let length = component.states.bytes(state, &component.instance)?.len();
            memory::write(size, length, "size")
        })
    }
}

/// `fmi2SerializeFMUstate`, `fmi3SerializeFMUState`.
///
/// # Safety
/// As for [`Entry::change`]; `bytes` is null or has `size` bytes that may be written.
pub unsafe fn serialize(entry: Entry, state: Opaque, bytes: *mut u8, size: usize) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let written = component.states.bytes(state, &component.instance)?;
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
/// As for [`Entry::change`]; `bytes` is null or has `size` bytes; `state` is null or may be written.
pub unsafe fn deserialize(entry: Entry, bytes: *const u8, size: usize, state: *mut Opaque) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            memory::read(state, STATE)?; // refused before anything is kept
            let bytes = memory::slice(bytes, size, "serializedState")?;
            let snapshot = component.instance.snapshot_from_bytes(bytes)?;
            memory::write(state, component.states.keep(snapshot), STATE)
        })
    }
}
