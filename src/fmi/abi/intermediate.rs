//! `fmi3DoStep`, and what it tells of events on its way: intermediate update (FMI 3.0 section 4.2).
//!
//! While the importer is told, nothing of the instance is borrowed and its lock is open, so that it may read values; the
//! state table refuses all else, and freeing is ignored.
//!
//! ```text
//! fmi3DoStep: enter, to the event, leave -> callback -> come back, to the next event, leave -> ... -> the end of the step
//! ```
//!
//! An importer that handles events in event mode is told by where its steps end, and by nothing else.

use super::common::{Inner, Opaque, Status, come_back, enter};
use super::fmi3::{Boolean, FALSE, IntermediateUpdate, TRUE};
use super::memory;
use crate::error::Result;
use crate::fmi::instance::Part;
use crate::fmi::life_cycle::Version::Three;
use crate::scene::{Reached, Scene};

const DO_STEP: &str = "fmi3DoStep";

/// Whom to tell of events.
#[derive(Clone, Copy)]
pub struct Listener {
    update: IntermediateUpdate,
    environment: Opaque,
    early_return: bool,
}

/// An event inside of a step, to be told.
struct Update {
    listener: Listener,
    time: f64,
}

/// Where `fmi3DoStep` says how far it came. The pointers are null or may be written.
struct Results {
    event_handling_needed: *mut Boolean,
    terminate_simulation: *mut Boolean,
    early_return: *mut Boolean,
    last_successful_time: *mut f64,
    end: f64,
}

/// `fmi3DoStep`.
///
/// # Safety
/// As for [`enter`]; the pointers are null or may be written.
pub unsafe fn do_step<S: Scene>(
    pointer: Opaque,
    asked: (f64, f64),
    [event_handling_needed, terminate_simulation, early_return]: [*mut Boolean; 3],
    last_successful_time: *mut f64,
) -> Status {
    let results = Results {
        event_handling_needed,
        terminate_simulation,
        early_return,
        last_successful_time,
        end: asked.0 + asked.1,
    };
    let mut update = None;
    // SAFETY: passed on.
    let mut status = unsafe {
        enter::<S>(pointer, Three, DO_STEP, |inner| {
            results.clear(inner.instance.time())?;
            update = inner.begin_step(asked, &results)?;
            Ok(())
        })
    };
    while let Some(event) = update.take() {
        let early_return = event.tell();
        // SAFETY: nobody can have freed the instance: `common::free` leaves those alone that are inside of a step.
        status = unsafe {
            come_back::<S>(pointer, DO_STEP, |inner| {
                update = inner.go_on(asked, event.listener, early_return, &results)?;
                Ok(())
            })
        };
    }
    status
}

impl<S: Scene> Inner<S> {
    /// Does a step, or the part of it up to an event that is to be told.
    ///
    /// # Safety
    /// The pointers in `results` are null or may be written.
    ///
    /// # Errors
    /// As [`Inner::do_step`].
    unsafe fn begin_step(&mut self, asked: (f64, f64), results: &Results) -> Result<Option<Update>> {
        let (current, step) = asked;
        let Some(listener) = self.listener else {
            let reached = self.do_step(current, step)?;
            // SAFETY: by the caller's promise.
            return unsafe { results.write(reached) }.map(|()| None);
        };
        let part = self.instance.begin_step(current, step);
        // SAFETY: by the caller's promise.
        unsafe { self.end_part(asked, part, listener, results) }
    }

    /// Goes on after an event that was told.
    ///
    /// # Safety
    /// The pointers in `results` are null or may be written.
    ///
    /// # Errors
    /// As [`Inner::do_step`].
    unsafe fn go_on(
        &mut self,
        asked: (f64, f64),
        listener: Listener,
        early_return: Option<f64>,
        results: &Results,
    ) -> Result<Option<Update>> {
        let part = self.instance.go_on(early_return);
        // SAFETY: by the caller's promise.
        unsafe { self.end_part(asked, part, listener, results) }
    }

    /// # Safety
    /// The pointers in `results` are null or may be written.
    unsafe fn end_part(
        &mut self,
        asked: (f64, f64),
        part: Result<Part>,
        listener: Listener,
        results: &Results,
    ) -> Result<Option<Update>> {
        let reached = match part {
            // How the step ends is not known yet.
            Ok(Part::Event(time)) => return Ok(Some(Update { listener, time })),
            Ok(Part::Done(reached)) => Ok(reached),
            Err(error) => Err(error),
        };
        let reached = self.note(asked, reached)?;
        // SAFETY: by the caller's promise.
        unsafe { results.write(reached) }.map(|()| None)
    }
}

impl Listener {
    /// The importer's callback with its environment; `early_return`: it lets steps end early.
    pub fn new(update: IntermediateUpdate, environment: Opaque, early_return: bool) -> Self {
        Self {
            update,
            environment,
            early_return,
        }
    }
}

impl Update {
    /// Tells the importer. Gives the time at which it wants the step to end, if it wants that and may; a wish that it was
    /// told to be in vain (`canReturnEarly` false) is none.
    fn tell(&self) -> Option<f64> {
        let Listener {
            update,
            environment,
            early_return,
        } = self.listener;
        let (mut wanted, mut until) = (FALSE, self.time);
        // SAFETY: the importer's own callback with its own environment; the pointers are to values that outlive the call.
        unsafe {
            update(
                environment,
                self.time,
                FALSE, // no input is asked for: those of the step hold to its end
                TRUE,
                TRUE,
                Boolean::from(early_return),
                &mut wanted,
                &mut until,
            );
        }
        (early_return && wanted != FALSE).then_some(until)
    }
}

impl Results {
    /// Written before the step, so that a bad pointer cannot hide a step that was done.
    ///
    /// # Safety
    /// The pointers are null or may be written.
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
    /// The pointers are null or may be written.
    unsafe fn write(&self, reached: Reached) -> Result<()> {
        // SAFETY: by the caller's promise.
        unsafe {
            memory::write(self.last_successful_time, reached.time, "lastSuccessfulTime")?;
            if reached.event {
                memory::write(self.event_handling_needed, TRUE, "eventHandlingNeeded")?;
            }
            if reached.time < self.end {
                memory::write(self.early_return, TRUE, "earlyReturn")?;
            }
        }
        Ok(())
    }
}
