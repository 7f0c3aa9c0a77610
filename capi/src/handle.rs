//! What a simulation's pointer points to, and how every call enters and leaves it.

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use fmi_component::handle::{Barred, Handle, describe};
use jostle::scene::AnySimulation;
use jostle::{Error, Result};

use crate::text;
use crate::texts::VariableTexts;

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

/// A simulation. Made by `jostle_new` or `jostle_new_from_toml`, ended by `jostle_free`.
pub struct JostleSimulation {
    _handle: Held,
}

/// What it is behind its C name.
type Held = Handle<Inner, 0x6a6f_7374_6c65_4321>;

/// A simulation with what its C callers need.
pub struct Inner {
    /// The simulation.
    pub simulation: AnySimulation,
    /// The texts of its variables, made when they are first asked for.
    pub texts: Option<VariableTexts>,
    /// A panic has shown a defect: what the scene holds may be inconsistent.
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
    let inner = Inner {
        simulation,
        texts: None,
        failed: false,
        error: String::new(),
    };
    Held::hand_out(inner).cast()
}

/// Frees a simulation. Null is ignored, and so is a simulation in which a thread is at work.
///
/// # Safety
/// `pointer` is null or a simulation that was not freed.
pub unsafe fn free(pointer: *mut JostleSimulation) {
    // SAFETY: by the caller's promise.
    let _ = unsafe { Held::free(pointer.cast(), |_| true) };
}

/// Enters a simulation: checks the pointer, locks it, catches panics, keeps the text of what went wrong.
///
/// # Safety
/// `pointer` is null or a simulation that was not freed.
pub unsafe fn enter(
    pointer: *const JostleSimulation,
    access: Access,
    work: impl FnOnce(&mut Inner) -> Result<()>,
) -> JostleStatus {
    // SAFETY: by the caller's promise.
    match unsafe { Held::enter(pointer.cast(), |inner| inner.run(access, work)) } {
        Ok(status) => status,
        Err(Barred::NoHandle) => JostleStatus::NoSimulation,
        Err(Barred::Busy) => JostleStatus::Busy,
    }
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
