//! Calls that are alike in both versions: along the life cycle, the log, and what is not offered.

use std::ffi::c_char;

use super::component::Entry;
use super::types::Status;
use crate::error::{Error, Result};
use crate::instance::Instance;
use crate::memory;

/// Why a function of model exchange is refused.
pub const NO_MODEL_EXCHANGE: &str = "model exchange is not offered, only co-simulation";
/// Why partial derivatives are refused.
pub const NO_DERIVATIVES: &str = "partial derivatives are not offered";

/// A call that only moves the instance along its life cycle.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn transition(entry: Entry, change: fn(&mut Instance) -> Result<()>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            change(&mut component.instance)?;
            component.log_phase(entry.function);
            Ok(())
        })
    }
}

/// `fmi2ExitInitializationMode`, `fmi3ExitInitializationMode`: the parameters are frozen, and what is doubtful of them is logged.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn exit_initialization(entry: Entry) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            component.instance.exit_initialization()?;
            component.log_phase(entry.function);
            component.log_warnings(entry.function);
            Ok(())
        })
    }
}

/// `fmi2Reset`, `fmi3Reset`.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn reset(entry: Entry) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            component.reset();
            component.log_phase(entry.function);
            Ok(())
        })
    }
}

/// `fmi2SetDebugLogging`, `fmi3SetDebugLogging`.
///
/// # Safety
/// As for [`Entry::change`]; `categories` is null or has `count` strings.
pub unsafe fn set_debug_logging(entry: Entry, on: bool, categories: *const *const c_char, count: usize) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let pointers = memory::slice(categories, count, "the array of categories")?;
            let names: Result<Vec<_>> = pointers.iter().map(|name| memory::text(*name, "a category")).collect();
            component.logger.switch(on, &names?)
        })
    }
}

/// A function that this component does not have: refused with the reason, never a crash.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn unsupported(entry: Entry, why: &str) -> Status {
    // SAFETY: passed on.
    unsafe { entry.change(|_| Err(Error::call(why, "See the capability flags in modelDescription.xml."))) }
}

/// A getter or setter of a type that no variable has: legal for no variables, refused otherwise.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn no_such_type(entry: Entry, count: usize) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.read(|_| match count {
            0 => Ok(()),
            _ => Err(Error::call(
                "no variable is of this type",
                "Take the types from modelDescription.xml.",
            )),
        })
    }
}
