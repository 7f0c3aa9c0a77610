//! What a simulation's pointer points to, and the way in and out of every call.

use std::any::Any;
use std::cell::UnsafeCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use jostle::scene::AnySimulation;
use jostle::{Error, Result};

use crate::listing::Listing;
use crate::text;

/// How a call ended. Unless it is JOSTLE_STATUS_OK, `jostle_error_text` says what was wrong and what to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum JostleStatus {
    /// Done.
    Ok = 0,
    /// The step cannot be done. The simulation is as before the call: try a shorter step or other inputs.
    StepRefused = 1,
    /// Refused: an argument is wrong. Nothing has changed.
    Error = 2,
    /// A defect of the library showed. This simulation can only be read, restored and freed; others are not touched.
    Failed = 3,
    /// Another thread is at work in this simulation. Nothing has changed and no text was written.
    Busy = 4,
    /// The pointer is null or no simulation (any more). No text was written.
    NoSimulation = 5,
}

/// Tells a simulation from a pointer to something else, and from one that was freed (as far as that can be).
const ALIVE: u64 = 0x6a6f_7374_6c65_4321;

/// A simulation. Made by `jostle_new` or `jostle_new_from_toml`, ended by `jostle_free`.
pub struct JostleSimulation {
    magic: AtomicU64,
    /// A call is under way. A second thread is refused instead of aliasing `inner`.
    busy: AtomicBool,
    inner: UnsafeCell<Inner>,
}

/// A simulation with what its C callers need.
pub struct Inner {
    /// The simulation.
    pub simulation: AnySimulation,
    /// The texts of its variables, made when they are first asked for.
    pub listing: Option<Listing>,
    /// A panic has shown a defect: what the scene holds may be in pieces.
    pub failed: bool,
    error: String,
}

/// What a call wants of a simulation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// Legal after a failure.
    Read,
    /// Refused after a failure.
    Change,
    /// Ends a failure if it is done.
    Restore,
}

/// Gives a simulation to the caller.
pub fn hand_out(simulation: AnySimulation) -> *mut JostleSimulation {
    Box::into_raw(Box::new(JostleSimulation {
        magic: AtomicU64::new(ALIVE),
        busy: AtomicBool::new(false),
        inner: UnsafeCell::new(Inner {
            simulation,
            listing: None,
            failed: false,
            error: String::new(),
        }),
    }))
}

/// Frees a simulation. Null is ignored, and so is a simulation in which a thread is at work.
///
/// # Safety
/// `pointer` is null or a simulation that was not freed.
pub unsafe fn free(pointer: *mut JostleSimulation) {
    // SAFETY: by the caller's promise.
    let Some(handle) = (unsafe { alive(pointer) }) else {
        return;
    };
    if handle.busy.swap(true, Ordering::Acquire) {
        return;
    }
    handle.magic.store(0, Ordering::Relaxed);
    // SAFETY: made by `Box::into_raw` in `hand_out` and, by the caller's promise, not freed before.
    let boxed = unsafe { Box::from_raw(pointer) };
    // A scene that panics when it is dropped has nobody left to tell.
    let _ = catch_unwind(AssertUnwindSafe(|| drop(boxed)));
}

/// The way into a simulation: checks the pointer, keeps others out, catches panics, keeps the text of what went wrong.
///
/// # Safety
/// `pointer` is null or a simulation that was not freed.
pub unsafe fn enter(
    pointer: *const JostleSimulation,
    access: Access,
    work: impl FnOnce(&mut Inner) -> Result<()>,
) -> JostleStatus {
    // SAFETY: by the caller's promise.
    let Some(handle) = (unsafe { alive(pointer) }) else {
        return JostleStatus::NoSimulation;
    };
    if handle.busy.swap(true, Ordering::Acquire) {
        return JostleStatus::Busy;
    }
    // SAFETY: `busy` was taken, so this is the only reference into the handle until it is given back below.
    let inner = unsafe { &mut *handle.inner.get() };
    let status = inner.run(access, work);
    handle.busy.store(false, Ordering::Release);
    status
}

/// # Safety
/// `pointer` is null or a simulation that was not freed.
unsafe fn alive<'a>(pointer: *const JostleSimulation) -> Option<&'a JostleSimulation> {
    if pointer.is_null() || !pointer.is_aligned() {
        return None;
    }
    // SAFETY: not null, aligned (checked) and alive by the caller's promise. A shared reference is enough: what changes
    // is in atomics and in the cell.
    let handle = unsafe { &*pointer };
    (handle.magic.load(Ordering::Relaxed) == ALIVE).then_some(handle)
}

impl Inner {
    fn run(&mut self, access: Access, work: impl FnOnce(&mut Self) -> Result<()>) -> JostleStatus {
        if self.failed && access == Access::Change {
            self.error = "this simulation has failed. Restore a saved state or free it".into();
            return JostleStatus::Failed;
        }
        match catch_unwind(AssertUnwindSafe(|| work(self))) {
            Ok(Ok(())) => {
                if access == Access::Restore {
                    self.failed = false;
                }
                JostleStatus::Ok
            }
            Ok(Err(error)) => {
                self.error = error.to_string();
                match error {
                    Error::Step { .. } => JostleStatus::StepRefused,
                    _ => JostleStatus::Error,
                }
            }
            Err(panic) => {
                self.failed = true;
                self.error = format!("{}. This simulation has failed", describe(&*panic));
                JostleStatus::Failed
            }
        }
    }
}

/// The text of a panic, for the caller to report.
pub fn describe(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    format!(
        "internal defect, please report it: {}",
        text.unwrap_or("panic without a message")
    )
}

/// Copies the text of the last refusal in this simulation, empty if there was none: what was wrong, its value, what is
/// allowed, what to do. At most `size` bytes are written, a zero byte at the end included. Returns the size of the whole
/// text with its zero byte; 0 if the pointer is no simulation or another thread is at work in it.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `text` is null or has `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_error_text(
    simulation: *const JostleSimulation,
    text: *mut c_char,
    size: usize,
) -> usize {
    let mut needed = 0;
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            needed = text::write(&inner.error, text, size);
            Ok(())
        });
    }
    needed
}
