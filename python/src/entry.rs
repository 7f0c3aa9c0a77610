//! How every call enters a simulation: locked without waiting, the interpreter free, panics caught.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, TryLockError};

use fmi_component::handle::describe;
use jostle::engine::interruptible;
use jostle::scene::DynSimulation;
use jostle::{Error, Result};
use pyo3::prelude::*;

use crate::refusal;

/// A simulation, and whether a panic has shown a defect in it.
pub struct Held {
    pub simulation: Box<dyn DynSimulation>,
    failed: bool,
}

/// What a call wants.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// Allowed after a failure.
    Read,
    /// Refused after a failure.
    Change,
    /// Ends a failure if it is done.
    Restore,
}

impl Held {
    pub fn new(simulation: Box<dyn DynSimulation>) -> Mutex<Self> {
        Mutex::new(Self {
            simulation,
            failed: false,
        })
    }

    fn run<T>(&mut self, access: Access, work: impl FnOnce(&mut dyn DynSimulation) -> Result<T>) -> Outcome<T> {
        if self.failed && access == Access::Change {
            return Outcome::Panicked("this simulation has failed. Restore a saved state, or make it anew.".into());
        }
        match catch_unwind(AssertUnwindSafe(|| work(&mut *self.simulation))) {
            Ok(Ok(value)) => {
                self.failed &= access != Access::Restore;
                Outcome::Done(value)
            }
            Ok(Err(error)) => Outcome::Refused(error),
            Err(panic) => {
                self.failed = true;
                Outcome::Panicked(format!("{}. This simulation has failed", describe(&*panic)))
            }
        }
    }
}

enum Outcome<T> {
    Done(T),
    Refused(Error),
    Panicked(String),
}

thread_local! {
    /// What Python's signals raised inside of a step.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// Whether a signal such as Ctrl-C has raised an exception; only the main thread has signals.
fn is_signalled() -> bool {
    let raised = Python::attach(|py| py.check_signals().err());
    let is_raised = raised.is_some();
    RAISED.set(raised);
    is_raised
}

/// Does `work` in the simulation, while other threads of Python run.
///
/// # Errors
/// The refusal of `work`, another thread in the simulation, a defect, or what a signal raised: the step is then not done.
pub fn enter<T: Send>(
    py: Python<'_>,
    held: &Mutex<Held>,
    access: Access,
    work: impl FnOnce(&mut dyn DynSimulation) -> Result<T> + Send,
) -> PyResult<T> {
    let run = |held: &mut Held| {
        let (outcome, interrupted) = interruptible(is_signalled, || held.run(access, work));
        (outcome, interrupted.then(|| RAISED.take()).flatten())
    };
    let outcome = py.detach(|| match held.try_lock() {
        Ok(mut guard) => Some(run(&mut guard)),
        Err(TryLockError::Poisoned(poisoned)) => Some(run(&mut poisoned.into_inner())),
        Err(TryLockError::WouldBlock) => None,
    });
    let outcome = match outcome {
        Some((_, Some(raised))) => return Err(raised),
        Some((outcome, None)) => Some(outcome),
        None => None,
    };
    match outcome {
        Some(Outcome::Done(value)) => Ok(value),
        Some(Outcome::Refused(error)) => Err(refusal::exception(py, &error)),
        Some(Outcome::Panicked(message)) => Err(refusal::defect(py, &message)),
        None => Err(refusal::busy(py)),
    }
}
