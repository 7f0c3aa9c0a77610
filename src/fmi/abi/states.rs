//! Saved states, alike in both versions but for the names of the functions.

use super::common::{Opaque, Status, enter};
use super::memory;
use crate::error::Error;
use crate::fmi::life_cycle::Version;
use crate::scene::Scene;

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
