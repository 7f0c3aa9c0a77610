//! FMI 3.0: what the exported functions do. Names and arguments as in `fmi3Functions.h`.
//!
//! `fmi3Boolean` is C's `bool`. Arguments of that type are taken as a byte, since an importer may pass any byte and
//! Rust's `bool` allows two only.

use std::ffi::{c_char, c_int};

use super::common::{self, Opaque, Status, enter};
use super::intermediate::Listener;
use super::logger::{Callback, Fmi3Log, Logger};
use super::memory;
use crate::error::{Error, Result};
use crate::fmi::instance::{Importer, Instance};
use crate::fmi::life_cycle::Version::Three;
use crate::scene::Scene;

/// `fmi3Boolean` and `fmi3Clock`.
pub type Boolean = u8;
/// `fmi3IntermediateUpdateCallback`, called at events inside of a step.
pub type IntermediateUpdate =
    unsafe extern "C" fn(Opaque, f64, Boolean, Boolean, Boolean, Boolean, *mut Boolean, *mut f64);
/// `fmi3ClockUpdateCallback`, never called.
pub type ClockUpdate = unsafe extern "C" fn(Opaque);
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`, never called.
pub type Preemption = unsafe extern "C" fn();

/// Why a function of model exchange is refused.
pub const NO_MODEL_EXCHANGE: &str = "model exchange is not offered, only co-simulation";
/// Why partial derivatives are refused.
pub const NO_DERIVATIVES: &str = "partial derivatives are not offered: collisions have none";
/// Why dependencies by element are refused.
pub const NO_DEPENDENCIES: &str = "dependencies by element are not offered (providesPerElementDependencies = false)";
/// Why configuration mode is refused.
pub const NO_CONFIGURATION: &str = "there are no structural parameters, so there is no configuration mode";
/// Why clocks are refused.
pub const NO_CLOCKS: &str = "there are no clocks and no scheduled execution";

pub(super) const FALSE: Boolean = 0;
pub(super) const TRUE: Boolean = 1;

/// `fmi3InstantiateCoSimulation`.
///
/// # Safety
/// Strings are null or zero-terminated; `required.0` is null or has `required.1` elements.
pub unsafe fn instantiate<S: Scene>(
    (name, token): (*const c_char, *const c_char),
    logging_on: Boolean,
    (event_mode_used, early_return_allowed): (Boolean, Boolean),
    required: (*const u32, usize),
    (environment, log, intermediate_update): (Opaque, Option<Fmi3Log>, Option<IntermediateUpdate>),
) -> Opaque {
    let logger = Logger::new(Callback::Three { log, environment }, logging_on != FALSE);
    common::instantiate(Three, "fmi3InstantiateCoSimulation", logger, || {
        // SAFETY: by the caller's promise.
        let (name, token) = unsafe {
            (
                memory::text(name, "instanceName")?,
                memory::text(token, "instantiationToken")?,
            )
        };
        if name.is_empty() {
            return Err(Error::call("instanceName is empty", "Name the instance."));
        }
        let importer = Importer {
            event_mode: event_mode_used != FALSE,
            early_return: early_return_allowed != FALSE,
        };
        let instance = Instance::<S>::new(&token, importer)?;
        // SAFETY: by the caller's promise.
        let required = unsafe { memory::slice(required.0, required.1, "requiredIntermediateVariables") }?;
        check_required(&instance, required, intermediate_update.is_some())?;
        let listens = S::EVENTS && !importer.stops_at_events();
        let listener = intermediate_update
            .filter(|_| listens)
            .map(|update| Listener::new(update, environment, importer.early_return));
        Ok((instance, listener))
    })
}

/// Whether the variables can be given that an importer wants in intermediate updates.
fn check_required<S: Scene>(instance: &Instance<S>, required: &[u32], listens: bool) -> Result<()> {
    if required.is_empty() {
        return Ok(());
    }
    let variables = required.len();
    if !S::EVENTS {
        return Err(Error::call(
            format!("{variables} intermediate variables are required, but providesIntermediateUpdate = false"),
            "Pass nRequiredIntermediateVariables = 0.",
        ));
    }
    if !listens {
        return Err(Error::call(
            format!("{variables} intermediate variables are required, but intermediateUpdate is null"),
            "Pass a callback, or nRequiredIntermediateVariables = 0.",
        ));
    }
    let unknown: Vec<u32> = required
        .iter()
        .copied()
        .filter(|reference| !instance.knows(*reference))
        .take(10)
        .collect();
    match unknown.is_empty() {
        true => Ok(()),
        false => Err(Error::call(
            format!("requiredIntermediateVariables has unknown value references: {unknown:?}"),
            "Take the value references from modelDescription.xml.",
        )),
    }
}

/// `fmi3InstantiateModelExchange` and `fmi3InstantiateScheduledExecution`: null with a message.
pub fn refuse_instance<S: Scene>(function: &str, environment: Opaque, log: Option<Fmi3Log>) -> Opaque {
    let logger = Logger::new(Callback::Three { log, environment }, false);
    common::instantiate::<S>(Three, function, logger, || {
        Err(Error::call(
            "this interface type is not offered",
            "Instantiate for co-simulation: fmi3InstantiateCoSimulation.",
        ))
    })
}

/// `fmi3EnterInitializationMode`.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn enter_initialization_mode<S: Scene>(
    pointer: Opaque,
    tolerance: Option<f64>,
    start: f64,
    stop_defined: Boolean,
    stop: f64,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        common::transition::<S>(pointer, Three, "fmi3EnterInitializationMode", |instance| {
            instance.set_up_within(tolerance, start, (stop_defined != FALSE).then_some(stop))?;
            instance.enter_initialization()
        })
    }
}

/// `fmi3UpdateDiscreteStates`: nothing to iterate on, and no event whose time is known ahead.
///
/// # Safety
/// As for [`enter`]; the pointers are null or may be written.
pub unsafe fn update_discrete_states<S: Scene>(
    pointer: Opaque,
    flags: [(*mut Boolean, &str); 5],
    next_event_time: *mut f64,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Three, "fmi3UpdateDiscreteStates", |inner| {
            inner.instance.update_discrete_states()?;
            for (flag, name) in flags {
                memory::write(flag, FALSE, name)?;
            }
            memory::write(next_event_time, 0.0, "nextEventTime")
        })
    }
}

/// `fmi3IntervalQualifier` and `fmi3DependencyKind`.
pub type Enumeration = c_int;
