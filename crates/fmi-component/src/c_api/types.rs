//! Types of the C headers of both standards.
//!
//! `fmi3Boolean` is C's `bool`. Arguments of that type are taken as a byte, since an importer may pass any byte and
//! Rust's `bool` allows two only.

use std::ffi::{c_char, c_int, c_void};

/// `fmi2Component`, `fmi3Instance`, `fmi2FMUstate` or `fmi3FMUState`: opaque to the importer.
pub type Opaque = *mut c_void;

/// `fmi2Status` and `fmi3Status`, which agree where both have a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// Done, with a remark.
    Warning = 1,
    /// A step that could not be done; the state is the one before it.
    Discard = 2,
    /// Refused; nothing has changed, unless a message says that the instance has failed.
    Error = 3,
    /// Never returned: it would condemn the other instances too.
    Fatal = 4,
    /// Never returned: there are no asynchronous steps.
    Pending = 5,
}

/// `fmi2CallbackLogger`.
pub type Fmi2Log = unsafe extern "C" fn(Opaque, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`. Memory is our own and steps are synchronous, so that only the logger is called.
#[repr(C)]
pub struct CallbackFunctions {
    /// `logger`.
    pub logger: Option<Fmi2Log>,
    /// `allocateMemory`, unused.
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> Opaque>,
    /// `freeMemory`, unused.
    pub free_memory: Option<unsafe extern "C" fn(Opaque)>,
    /// `stepFinished`, unused.
    pub step_finished: Option<unsafe extern "C" fn(Opaque, c_int)>,
    /// `componentEnvironment`.
    pub component_environment: Opaque,
}

/// `fmi3Boolean` and `fmi3Clock`.
pub type Boolean = u8;
/// `fmi3False`.
pub(super) const FALSE: Boolean = 0;
/// `fmi3True`.
pub(super) const TRUE: Boolean = 1;
/// `fmi3IntervalQualifier` and `fmi3DependencyKind`.
pub type Enumeration = c_int;
/// `fmi3LogMessageCallback`.
pub type Fmi3Log = unsafe extern "C" fn(Opaque, c_int, *const c_char, *const c_char);
/// `fmi3IntermediateUpdateCallback`, called at events inside of a step.
pub type IntermediateUpdate =
    unsafe extern "C" fn(Opaque, f64, Boolean, Boolean, Boolean, Boolean, *mut Boolean, *mut f64);
/// `fmi3ClockUpdateCallback`, never called.
pub type ClockUpdate = unsafe extern "C" fn(Opaque);
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`, never called.
pub type Preemption = unsafe extern "C" fn();
