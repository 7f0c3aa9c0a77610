//! Saved states as bytes.

use fmi_component::memory;
use jostle::{Error, Result};

use crate::handle::{Access, JostleSimulation, JostleStatus, enter};

/// Saves everything as bytes without pointers, for a file or another process. `size` becomes their number. With `bytes`
/// null nothing else happens; otherwise `capacity` bytes may be written to `bytes`, and fewer than `size` are refused.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `bytes` is null or has `capacity` bytes; `size` is null or may be
/// written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_save(
    simulation: *const JostleSimulation,
    bytes: *mut u8,
    capacity: usize,
    size: *mut usize,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Change, |inner| {
            let saved = inner.simulation.to_bytes()?;
            memory::write(size, saved.len(), "size")?;
            if bytes.is_null() {
                return Ok(());
            }
            copy(&saved, bytes, capacity)
        })
    }
}

/// Goes to a state that a simulation of the same scene, engine, drive, number of disks and version of the library saved;
/// parameters and inputs come back too. If the bytes are refused, nothing has changed.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `bytes` is null or has `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_restore(
    simulation: *mut JostleSimulation,
    bytes: *const u8,
    size: usize,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Restore, |inner| {
            let bytes = memory::slice(bytes, size, "bytes")?;
            if inner.failed {
                inner.simulation.restore_bytes_anew(bytes)
            } else {
                inner.simulation.restore_bytes(bytes)
            }
        })
    }
}

/// # Safety
/// `bytes` has `capacity` bytes.
unsafe fn copy(saved: &[u8], bytes: *mut u8, capacity: usize) -> Result<()> {
    if capacity < saved.len() {
        return Err(Error::parameter(
            "capacity",
            capacity,
            format!("at least {}, the size of the state", saved.len()),
            "Ask for the size with bytes = NULL first.",
        ));
    }
    // SAFETY: by the caller's promise.
    let mut output = unsafe { memory::Output::new(bytes, capacity, "bytes") }?;
    for (index, byte) in saved.iter().enumerate() {
        output.write(index, *byte);
    }
    Ok(())
}
