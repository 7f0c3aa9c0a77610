//! Refusals as Python exceptions, which `jostle.errors` defines.

use jostle::Error;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The exception of a refusal: its class by what was refused, its text whole, its parts as attributes.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let text = error.to_string();
    let made = match error {
        Error::Parameter {
            name,
            value,
            allowed,
            remedy,
        } => build(py, "ParameterError", (text.as_str(), name, value, allowed, remedy)),
        Error::Step { time, remedy, .. } => build(py, "StepError", (text.as_str(), *time, remedy)),
        Error::State { remedy, .. } => build(py, "StateError", (text.as_str(), remedy)),
        Error::File { remedy, .. } | Error::Call { remedy, .. } => build(py, "CallError", (text.as_str(), remedy)),
    };
    made.unwrap_or_else(|_| PyRuntimeError::new_err(text))
}

/// Another thread is at work in the simulation.
pub fn busy(py: Python<'_>) -> PyErr {
    let remedy = "Give each thread a simulation of its own, or a lock.";
    let text = format!("another thread is at work in this simulation. {remedy}");
    build(py, "CallError", (text.as_str(), remedy)).unwrap_or_else(|_| PyRuntimeError::new_err(text))
}

/// A panic: a defect of jostle.
pub fn defect(py: Python<'_>, message: &str) -> PyErr {
    build(py, "DefectError", (message,)).unwrap_or_else(|_| PyRuntimeError::new_err(message.to_owned()))
}

fn build<'py>(py: Python<'py>, class: &str, parts: impl pyo3::call::PyCallArgs<'py>) -> PyResult<PyErr> {
    let made = py.import("jostle.errors")?.getattr(class)?.call1(parts)?;
    Ok(PyErr::from_value(made))
}
