//! FMI 2.0: what the exported functions do. Names and arguments as in `fmi2Functions.h`.

use std::ffi::{CString, c_char, c_int};

use super::common::{self, Opaque, Status, enter};
use super::logger::{Callback, Fmi2Log, Logger};
use super::memory;
use crate::error::Error;
use crate::fmi::instance::{Importer, Instance};
use crate::fmi::life_cycle::Version::Two;
use crate::scene::Scene;

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

/// Why a function of model exchange is refused.
pub const NO_MODEL_EXCHANGE: &str = "model exchange is not offered, only co-simulation";
/// Why partial derivatives are refused.
pub const NO_DERIVATIVES: &str = "partial derivatives are not offered: collisions have none";
/// Why a step cannot be cancelled.
pub const SYNCHRONOUS: &str = "steps are synchronous, there is none to cancel";

const CO_SIMULATION: c_int = 1;
const DO_STEP_STATUS: c_int = 0;
const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;

/// `fmi2Instantiate`.
///
/// # Safety
/// Strings are null or zero-terminated; `functions` is null or points to the callbacks.
pub unsafe fn instantiate<S: Scene>(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    functions: *const CallbackFunctions,
    logging_on: c_int,
) -> Opaque {
    if functions.is_null() || !functions.is_aligned() {
        return std::ptr::null_mut();
    }
    // SAFETY: not null, aligned (checked) and readable by the caller's promise.
    let functions = unsafe { &*functions };
    // SAFETY: by the caller's promise.
    let name = unsafe { memory::text(name, "instanceName") };
    let callback = Callback::Two {
        log: functions.logger,
        environment: functions.component_environment,
        name: CString::new(name.clone().unwrap_or_default()).unwrap_or_default(),
    };
    let logger = Logger::new(callback, logging_on != 0);
    common::instantiate(Two, "fmi2Instantiate", logger, || {
        if name?.is_empty() {
            return Err(Error::call("instanceName is empty", "Name the instance."));
        }
        if kind != CO_SIMULATION {
            return Err(Error::call(
                format!("fmuType {kind} is not offered"),
                "Instantiate for co-simulation (fmi2CoSimulation = 1).",
            ));
        }
        // SAFETY: by the caller's promise.
        let guid = unsafe { memory::text(guid, "fmuGUID") }?;
        Ok((Instance::<S>::new(&guid, Importer::default())?, None))
    })
}

/// `fmi2SetupExperiment`.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn setup_experiment<S: Scene>(
    pointer: Opaque,
    tolerance: Option<f64>,
    start: f64,
    stop_defined: c_int,
    stop: f64,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Two, "fmi2SetupExperiment", |inner| {
            inner
                .instance
                .set_up_within(tolerance, start, (stop_defined != 0).then_some(stop))
        })
    }
}

/// `fmi2DoStep`.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn do_step<S: Scene>(pointer: Opaque, current: f64, step: f64) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Two, "fmi2DoStep", |inner| {
            inner.do_step(current, step).map(|_| ())
        })
    }
}

/// `fmi2GetStatus`.
///
/// # Safety
/// As for [`enter`]; `value` is null or may be written.
pub unsafe fn get_status<S: Scene>(pointer: Opaque, kind: c_int, value: *mut Status) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Two, "fmi2GetStatus", |inner| match kind {
            DO_STEP_STATUS => memory::write(value, inner.last_step, "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetRealStatus`.
///
/// # Safety
/// As for [`enter`]; `value` is null or may be written.
pub unsafe fn get_real_status<S: Scene>(pointer: Opaque, kind: c_int, value: *mut f64) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Two, "fmi2GetRealStatus", |inner| match kind {
            LAST_SUCCESSFUL_TIME => memory::write(value, inner.instance.time(), "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetBooleanStatus`.
///
/// # Safety
/// As for [`enter`]; `value` is null or may be written.
pub unsafe fn get_boolean_status<S: Scene>(pointer: Opaque, kind: c_int, value: *mut c_int) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Two, "fmi2GetBooleanStatus", |_| match kind {
            TERMINATED => memory::write(value, 0, "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetIntegerStatus` and `fmi2GetStringStatus`: there is nothing to ask for.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn no_status<S: Scene>(pointer: Opaque, function: &str, kind: c_int) -> Status {
    // SAFETY: passed on.
    unsafe { enter::<S>(pointer, Two, function, |_| Err(wrong_status(kind))) }
}

fn wrong_status(kind: c_int) -> Error {
    Error::call(
        format!("status kind {kind} is not offered by this function"),
        "Steps are synchronous: ask for fmi2DoStepStatus, fmi2LastSuccessfulTime or fmi2Terminated.",
    )
}
