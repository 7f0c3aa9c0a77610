//! FMI 3.0: what functions do that FMI 2.0 does not have or has otherwise. Names and arguments as in `fmi3Functions.h`.

use std::ffi::c_char;

use super::component::{self, Component, Entry};
use super::listener::Listener;
use super::logger::{Callback, Logger};
use super::types::{Boolean, FALSE, Fmi3Log, IntermediateUpdate, Opaque, Status, TRUE};
use crate::dynamic::ModelType;
use crate::error::{Error, Result};
use crate::instance::{Importer, Instance, Part};
use crate::life_cycle::Version::Three;
use crate::memory;
use crate::model::Reached;

/// Why dependencies by element are refused.
pub const NO_DEPENDENCIES: &str = "dependencies by element are not offered (providesPerElementDependencies = false)";
/// Why configuration mode is refused.
pub const NO_CONFIGURATION: &str = "there are no structural parameters, so there is no configuration mode";
/// Why clocks are refused.
pub const NO_CLOCKS: &str = "there are no clocks and no scheduled execution";

/// Arguments of `fmi3InstantiateCoSimulation` that are used. Strings are null or zero-terminated;
/// `required_intermediate_variables` is null or has `required_count` elements.
pub struct Instantiation {
    /// `instanceName`.
    pub name: *const c_char,
    /// `instantiationToken`.
    pub token: *const c_char,
    /// `loggingOn`.
    pub logging_on: Boolean,
    /// `eventModeUsed`.
    pub event_mode_used: Boolean,
    /// `earlyReturnAllowed`.
    pub early_return_allowed: Boolean,
    /// `requiredIntermediateVariables`.
    pub required_intermediate_variables: *const u32,
    /// `nRequiredIntermediateVariables`.
    pub required_count: usize,
    /// `instanceEnvironment`.
    pub environment: Opaque,
    /// `logMessage`.
    pub log: Option<Fmi3Log>,
    /// `intermediateUpdate`.
    pub intermediate_update: Option<IntermediateUpdate>,
}

/// Where `fmi3DoStep` says how far it came. The pointers are null or may be written.
pub struct StepResults {
    /// `eventHandlingNeeded`.
    pub event_handling_needed: *mut Boolean,
    /// `terminateSimulation`.
    pub terminate_simulation: *mut Boolean,
    /// `earlyReturn`.
    pub early_return: *mut Boolean,
    /// `lastSuccessfulTime`.
    pub last_successful_time: *mut f64,
}

/// `fmi3InstantiateCoSimulation`.
///
/// # Safety
/// As for [`Instantiation`].
pub unsafe fn instantiate(model: &ModelType, asked: Instantiation) -> Opaque {
    let Instantiation { environment, log, .. } = asked;
    let logger = Logger::new(Callback::Three { log, environment }, asked.logging_on != FALSE);
    component::instantiate(Three, "fmi3InstantiateCoSimulation", logger, || {
        // SAFETY: by the caller's promise.
        let (name, token) = unsafe {
            (
                memory::text(asked.name, "instanceName")?,
                memory::text(asked.token, "instantiationToken")?,
            )
        };
        if name.is_empty() {
            return Err(Error::call("instanceName is empty", "Name the instance."));
        }
        let importer = Importer {
            event_mode: asked.event_mode_used != FALSE,
            early_return: asked.early_return_allowed != FALSE,
        };
        let mut instance = Instance::new(model, &token, importer)?;
        let (required, count) = (asked.required_intermediate_variables, asked.required_count);
        // SAFETY: by the caller's promise.
        let required = unsafe { memory::slice(required, count, "requiredIntermediateVariables") }?;
        check_required(&instance, model, required, asked.intermediate_update.is_some())?;
        let inputs = model.input_parts > 0
            && !importer.stops_at_events()
            && required.iter().any(|reference| instance.is_input(*reference));
        if inputs {
            instance.offer_inputs(model.input_parts);
        }
        let listens = inputs || model.events && !importer.stops_at_events();
        let listener = asked.intermediate_update.filter(|_| listens).map(|update| Listener {
            update,
            environment,
            early_return: importer.early_return,
            inputs,
        });
        Ok((instance, listener))
    })
}

/// Whether the variables can be given that an importer wants in intermediate updates.
fn check_required(instance: &Instance, model: &ModelType, required: &[u32], listens: bool) -> Result<()> {
    if required.is_empty() {
        return Ok(());
    }
    let variables = required.len();
    if !model.updates_inside_steps() {
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
pub fn refuse_instance(function: &str, environment: Opaque, log: Option<Fmi3Log>) -> Opaque {
    let logger = Logger::new(Callback::Three { log, environment }, false);
    component::instantiate(Three, function, logger, || {
        Err(Error::call(
            "this interface type is not offered",
            "Instantiate for co-simulation: fmi3InstantiateCoSimulation.",
        ))
    })
}

/// `fmi3EnterInitializationMode`.
///
/// # Safety
/// As for [`Entry::change`].
pub unsafe fn enter_initialization_mode(entry: Entry, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            component.instance.set_up_within(tolerance, start, stop)?;
            component.instance.enter_initialization()?;
            component.log_phase(entry.function);
            Ok(())
        })
    }
}

/// `fmi3UpdateDiscreteStates`: nothing to iterate on, and no event whose time is known ahead.
///
/// # Safety
/// As for [`Entry::change`]; the pointers are null or may be written.
pub unsafe fn update_discrete_states(
    entry: Entry,
    flags: [(*mut Boolean, &str); 5],
    next_event_time: *mut f64,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            component.instance.update_discrete_states()?;
            for (flag, name) in flags {
                memory::write(flag, FALSE, name)?;
            }
            memory::write(next_event_time, 0.0, "nextEventTime")
        })
    }
}

/// `fmi3DoStep`.
///
/// Events inside of the step, or the places where inputs may be renewed, are reported to a listener. Meanwhile nothing of the instance
/// is borrowed and its lock is open, so that the importer may read values and, if it offers inputs, set them; the state table refuses
/// all else, and freeing is ignored.
///
/// ```text
/// enter, to the event, leave -> callback -> resume, to the next event, leave -> ... -> the end of the step
/// ```
///
/// An importer that handles events in event mode learns of them by where its steps end, and by nothing else; it is not asked for inputs.
///
/// # Safety
/// As for [`Entry::change`] and [`StepResults`].
pub unsafe fn do_step(entry: Entry, current: f64, step: f64, results: StepResults) -> Status {
    let asked = (current, step);
    let mut event = None;
    // SAFETY: passed on.
    let mut status = unsafe {
        entry.change(|component| {
            results.clear(component.instance.time())?;
            let part = match component.listener {
                None => component.instance.do_step(current, step).map(Part::Done),
                Some(_) => component.instance.begin_step(current, step),
            };
            event = component.end_part(entry.function, asked, part, &results)?;
            Ok(())
        })
    };
    while let Some((listener, time)) = event.take() {
        let early_return = listener.report(time);
        // SAFETY: nobody can have freed the instance: `free` leaves those alone that are inside of a step.
        status = unsafe {
            entry.resume(|component| {
                let part = component.instance.resume_step(early_return);
                event = component.end_part(entry.function, asked, part, &results)?;
                Ok(())
            })
        };
    }
    status
}

impl Component {
    /// Notes how a part of a step ended: with an event to be reported to a listener, or with the step.
    ///
    /// # Safety
    /// As for [`StepResults`].
    unsafe fn end_part(
        &mut self,
        function: &str,
        asked: (f64, f64),
        part: Result<Part>,
        results: &StepResults,
    ) -> Result<Option<(Listener, f64)>> {
        let reached = match part {
            // How the step ends is not known yet.
            Ok(Part::Event(time)) => return Ok(self.listener.map(|listener| (listener, time))),
            Ok(Part::Done(reached)) => Ok(reached),
            Err(error) => Err(error),
        };
        let reached = self.note(function, asked, reached)?;
        // SAFETY: by the caller's promise.
        unsafe { results.write(reached, asked.0 + asked.1) }.map(|()| None)
    }
}

impl StepResults {
    /// Written before the step, so that a bad pointer cannot hide a step that was done.
    ///
    /// # Safety
    /// As for [`StepResults`].
    unsafe fn clear(&self, time: f64) -> Result<()> {
        // SAFETY: by the caller's promise.
        unsafe {
            memory::write(self.event_handling_needed, FALSE, "eventHandlingNeeded")?;
            memory::write(self.terminate_simulation, FALSE, "terminateSimulation")?;
            memory::write(self.early_return, FALSE, "earlyReturn")?;
            memory::write(self.last_successful_time, time, "lastSuccessfulTime")
        }
    }

    /// # Safety
    /// As for [`StepResults`].
    unsafe fn write(&self, reached: Reached, end: f64) -> Result<()> {
        // SAFETY: by the caller's promise.
        unsafe {
            memory::write(self.last_successful_time, reached.time, "lastSuccessfulTime")?;
            if reached.event {
                memory::write(self.event_handling_needed, TRUE, "eventHandlingNeeded")?;
            }
            if reached.time < end {
                memory::write(self.early_return, TRUE, "earlyReturn")?;
            }
        }
        Ok(())
    }
}
