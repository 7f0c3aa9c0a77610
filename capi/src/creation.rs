//! Making and ending simulations.

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;

use fmi_component::handle::describe;
use fmi_component::memory;
use jostle::Result;
use jostle::scene::{AnySimulation, Recipe, Selection};

use crate::handle::{self, JostleSimulation};
use crate::text;

/// A parameter, or an input at the start, and its value as a text: `{"drive.amplitude", "1e-4"}`, `{"seed", "7"}`,
/// `{"base.model", "moving"}`.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct JostleSetting {
    /// Name of the variable.
    pub name: *const c_char,
    /// Its value: digits with a point, or the name of an option.
    pub value: *const c_char,
}

/// Makes a simulation of a scene at time 0. `engine` and `drive` may be null and `disks` 0 for the scene's first;
/// `jostle_scenes` lists them. `settings` has `count` elements and holds what differs from the start values; it may be
/// null if `count` is 0. Returns null if anything is wrong, and then writes what it is to `error`, which has `error_size`
/// bytes or is null.
///
/// # Safety
/// Pointers are null or as said; texts end with a zero byte.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // a C function takes them one by one
pub unsafe extern "C" fn jostle_new(
    scene: *const c_char,
    engine: *const c_char,
    drive: *const c_char,
    disks: u32,
    settings: *const JostleSetting,
    count: usize,
    error: *mut c_char,
    error_size: usize,
) -> *mut JostleSimulation {
    let make = || {
        // SAFETY: by the caller's promise.
        let (scene, engine, drive, settings) = unsafe {
            (
                memory::text(scene, "scene")?,
                text::optional(engine, "engine")?,
                text::optional(drive, "drive")?,
                read(memory::slice(settings, count, "settings")?)?,
            )
        };
        let selection = Selection {
            scene: &scene,
            engine: engine.as_deref(),
            drive: drive.as_deref(),
            disks: (disks > 0).then_some(disks),
        };
        let given = settings.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        AnySimulation::new(selection, &given.collect::<Vec<_>>())
    };
    // SAFETY: passed on.
    unsafe { create(make, error, error_size) }
}

/// Makes a simulation from a TOML text at time 0: the keys `scene`, and if wanted `engine`, `drive`, `disks`, and a table
/// `parameters`. Returns null if anything is wrong, and then writes what it is to `error`, which has `error_size` bytes or
/// is null.
///
/// # Safety
/// Pointers are null or as said; `toml` ends with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_new_from_toml(
    toml: *const c_char,
    error: *mut c_char,
    error_size: usize,
) -> *mut JostleSimulation {
    let make = || {
        // SAFETY: by the caller's promise.
        let text = unsafe { memory::text(toml, "toml") }?;
        text.parse::<Recipe>()?.simulation()
    };
    // SAFETY: passed on.
    unsafe { create(make, error, error_size) }
}

/// Ends a simulation. Null is ignored.
///
/// # Safety
/// `simulation` is null or was made here and not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_free(simulation: *mut JostleSimulation) {
    // SAFETY: passed on.
    unsafe { handle::free(simulation) }
}

/// # Safety
/// The texts are null or end with a zero byte.
unsafe fn read(settings: &[JostleSetting]) -> Result<Vec<(String, String)>> {
    let both = settings.iter().enumerate().map(|(index, setting)| {
        // SAFETY: by the caller's promise.
        let text = |pointer, part| unsafe { memory::text(pointer, &format!("{part} of setting {index}")) };
        Ok((text(setting.name, "name")?, text(setting.value, "value")?))
    });
    both.collect()
}

/// # Safety
/// `error` is null or has `size` bytes.
unsafe fn create(
    make: impl FnOnce() -> Result<AnySimulation>,
    error: *mut c_char,
    size: usize,
) -> *mut JostleSimulation {
    let message = match catch_unwind(AssertUnwindSafe(make)) {
        Ok(Ok(simulation)) => return handle::hand_out(simulation),
        Ok(Err(refusal)) => refusal.to_string(),
        Err(panic) => describe(&*panic),
    };
    // SAFETY: passed on.
    unsafe { text::write(&message, error, size) };
    null_mut()
}
