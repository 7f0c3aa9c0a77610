//! FMI 2.0: what functions do that FMI 3.0 does not have or has otherwise. Names and arguments as in `fmi2Functions.h`.

use std::ffi::{CString, c_char, c_int};

use super::component::{self, Entry};
use super::logger::{Callback, Logger};
use super::types::{CallbackFunctions, Opaque, Status};
use crate::dynamic::ModelType;
use crate::error::Error;
use crate::instance::{Importer, Instance};
use crate::life_cycle::Version::Two;
use crate::memory;

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
pub unsafe fn instantiate(
    model: &ModelType,
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
    component::instantiate(Two, "fmi2Instantiate", logger, || {
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
        Ok((Instance::new(model, &guid, Importer::default())?, None))
    })
}

/// `fmi2SetupExperiment`.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn setup_experiment(entry: Entry, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
    // SAFETY: passed on.
    unsafe { entry.change(|component| component.instance.set_up_within(tolerance, start, stop)) }
}

/// `fmi2DoStep`.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn do_step(entry: Entry, current: f64, step: f64) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let done = component.instance.do_step(current, step);
            component.note(entry.function, (current, step), done).map(|_| ())
        })
    }
}

/// `fmi2GetStatus`.
///
/// # Safety
/// As for [`Entry::change`]; `value` is null or may be written.
pub unsafe fn get_status(entry: Entry, kind: c_int, value: *mut Status) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| match kind {
            DO_STEP_STATUS => memory::write(value, component.last_step, "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetRealStatus`.
///
/// # Safety
/// As for [`Entry::change`]; `value` is null or may be written.
pub unsafe fn get_real_status(entry: Entry, kind: c_int, value: *mut f64) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| match kind {
            LAST_SUCCESSFUL_TIME => memory::write(value, component.instance.time(), "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetBooleanStatus`.
///
/// # Safety
/// As for [`Entry::change`]; `value` is null or may be written.
pub unsafe fn get_boolean_status(entry: Entry, kind: c_int, value: *mut c_int) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|_| match kind {
            TERMINATED => memory::write(value, 0, "value"),
            _ => Err(wrong_status(kind)),
        })
    }
}

/// `fmi2GetIntegerStatus` and `fmi2GetStringStatus`: there is nothing to ask for.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn no_status(entry: Entry, kind: c_int) -> Status {
    // SAFETY: passed on.
    unsafe { entry.change(|_| Err(wrong_status(kind))) }
}

fn wrong_status(kind: c_int) -> Error {
    Error::call(
        format!("status kind {kind} is not offered by this function"),
        "Steps are synchronous: ask for fmi2DoStepStatus, fmi2LastSuccessfulTime or fmi2Terminated.",
    )
}
