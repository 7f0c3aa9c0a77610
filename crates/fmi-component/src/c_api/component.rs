//! What `fmi2Component` and `fmi3Instance` point to, and how every call enters and leaves it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;

use super::listener::Listener;
use super::logger::{Category, Logger};
use super::saved_states::SavedStates;
use super::types::{Opaque, Status};
use crate::error::{Error, Result};
use crate::handle::{self, Barred, describe};
use crate::instance::Instance;
use crate::life_cycle::Version;
use crate::unit::Unit;
use crate::value::Value;

/// What an instance pointer points to.
type Handle = handle::Handle<Component, 0x464d_4943_4f4d_5054>;

/// An instance with what it needs to talk to its importer.
pub struct Component {
    /// The instance.
    pub instance: Instance,
    /// The importer's log.
    pub logger: Logger,
    /// How the last step ended, for `fmi2GetStatus`.
    pub last_step: Status,
    /// The step that was refused last.
    refused: Option<RefusedStep>,
    version: Version,
    /// To whom events inside of a step are reported.
    pub listener: Option<Listener>,
    /// What it saved.
    pub states: SavedStates,
    /// Topics of the warnings that were told.
    warned: Vec<&'static str>,
    /// Values on their way to the importer, with room for all of them.
    pub reals: Vec<f64>,
    /// Texts and bytes that the importer was handed pointers to: they live until the next call that hands out some.
    pub lent: Vec<Vec<u8>>,
}

/// A step that the model could not do: asked for again, it is refused again.
#[derive(PartialEq)]
struct RefusedStep {
    /// Communication point and step size.
    asked: (f64, f64),
    /// Inputs and parameters. With others it is another step.
    values: Vec<Value>,
    /// Contents of texts and binary variables among them.
    bytes: Vec<Vec<u8>>,
}

/// A call of an importer.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The instance, as the importer passes it.
    pub pointer: Opaque,
    /// The standard whose function is called.
    pub version: Version,
    /// Name of the function, for messages.
    pub function: &'static str,
}

/// Makes an instance. Null, after a log message, when `make` refuses or panics.
pub fn instantiate(
    version: Version,
    function: &str,
    mut logger: Logger,
    make: impl FnOnce() -> Result<(Instance, Option<Listener>)>,
) -> Opaque {
    let refusal = match catch_unwind(AssertUnwindSafe(make)) {
        Ok(Ok((instance, listener))) => {
            let message = format!("{function}: {}", instance.token());
            logger.log(Status::Ok, Category::Events, &message);
            let component = Component {
                reals: Vec::with_capacity(instance.scalars()),
                instance,
                logger,
                last_step: Status::Ok,
                refused: None,
                version,
                listener,
                states: SavedStates::default(),
                warned: Vec::new(),
                lent: Vec::new(),
            };
            return Handle::hand_out(component).cast();
        }
        Ok(Err(error)) => error.to_string(),
        Err(panic) => describe(&*panic),
    };
    logger.refuse(&format!("{function}: {refusal}"));
    null_mut()
}

/// Frees an instance with all its states. Null is ignored, as both standards ask, and so is an instance of the other version
/// or one that is at work, such as from inside a callback of this very instance or while it reports an intermediate update.
///
/// # Safety
/// `pointer` is null or an instance of this library that was not freed before.
pub unsafe fn free(pointer: Opaque, version: Version) {
    // SAFETY: by the caller's promise.
    let _ = unsafe {
        Handle::free(pointer.cast(), |component| {
            component.version == version && !component.instance.is_stepping()
        })
    };
}

impl Entry {
    /// Enters an instance: checks the pointer, locks it, catches panics, logs what went wrong. Shut inside of
    /// an intermediate update.
    ///
    /// # Safety
    /// The pointer is null or an instance of this library that was not freed.
    pub unsafe fn change(self, work: impl FnOnce(&mut Component) -> Result<()>) -> Status {
        let checked = |component: &mut Component| {
            component.instance.check_change()?;
            work(component)
        };
        // SAFETY: by the caller's promise.
        unsafe { self.read(checked) }
    }

    /// Enters for calls that set values: shut inside of an intermediate update unless the importer is asked for inputs.
    ///
    /// # Safety
    /// As for [`Entry::change`].
    pub unsafe fn set(self, work: impl FnOnce(&mut Component) -> Result<()>) -> Status {
        let checked = |component: &mut Component| {
            component.instance.check_setting()?;
            work(component)?;
            if component.instance.is_stepping() {
                // Inputs inside of a step are forgotten when its rest is refused: the next one may get others.
                component.refused = None;
            }
            Ok(())
        };
        // SAFETY: by the caller's promise.
        unsafe { self.read(checked) }
    }

    /// Enters for calls that only read values, which are allowed inside of an intermediate update. A call that comes while another is
    /// under way cannot log: what it needs is lent to that one, which tells of it at its end.
    ///
    /// # Safety
    /// As for [`Entry::change`].
    pub unsafe fn read(self, work: impl FnOnce(&mut Component) -> Result<()>) -> Status {
        let pointer: *const Handle = self.pointer.cast_const().cast();
        // SAFETY: by the caller's promise.
        let entered = unsafe { Handle::enter(pointer, |component| component.answer_and_tell(self, work)) };
        entered.unwrap_or_else(|barred| {
            if barred == Barred::Busy {
                // SAFETY: by the caller's promise.
                unsafe { Handle::note_barred(pointer, self.function) };
            }
            Status::Error
        })
    }

    /// As [`Entry::read`], for functions that are called now and then: compiled once for all of them.
    ///
    /// # Safety
    /// As for [`Entry::change`].
    pub unsafe fn read_rarely(self, work: &mut dyn FnMut(&mut Component) -> Result<()>) -> Status {
        // SAFETY: passed on.
        unsafe { self.read(|component| work(component)) }
    }

    /// As [`Entry::set`], for functions that are called now and then: compiled once for all of them.
    ///
    /// # Safety
    /// As for [`Entry::change`].
    pub unsafe fn set_rarely(self, work: &mut dyn FnMut(&mut Component) -> Result<()>) -> Status {
        // SAFETY: passed on.
        unsafe { self.set(|component| work(component)) }
    }

    /// Enters again for a step that was left for an intermediate update.
    ///
    /// # Safety
    /// As for [`Entry::change`].
    pub unsafe fn resume(self, work: impl FnOnce(&mut Component) -> Result<()>) -> Status {
        // SAFETY: by the caller's promise.
        unsafe {
            Handle::resume(self.pointer.cast_const().cast(), |component| {
                component.answer_and_tell(self, work)
            })
        }
        .unwrap_or(Status::Error)
    }
}

impl Component {
    /// Answers, and tells of the calls that came meanwhile.
    ///
    /// # Safety
    /// The pointer of `entry` is to the handle of this component.
    unsafe fn answer_and_tell(&mut self, entry: Entry, work: impl FnOnce(&mut Self) -> Result<()>) -> Status {
        let status = self.answer(entry, work);
        let pointer: *const Handle = entry.pointer.cast_const().cast();
        // SAFETY: by the caller's promise.
        self.tell_barred(&unsafe { Handle::take_barred(pointer) });
        status
    }

    fn answer(&mut self, entry: Entry, work: impl FnOnce(&mut Self) -> Result<()>) -> Status {
        if self.version != entry.version {
            let message = format!(
                "{}: this instance was made by the functions of the other version of FMI. Call those.",
                entry.function
            );
            self.logger.log(Status::Error, Category::Error, &message);
            return Status::Error;
        }
        let (status, category, message) = match catch_unwind(AssertUnwindSafe(|| work(self))) {
            Ok(Ok(())) => return Status::Ok,
            Ok(Err(error @ Error::Step { .. })) => (Status::Discard, Category::Discard, error.to_string()),
            Ok(Err(error)) => (Status::Error, Category::Error, error.to_string()),
            Err(panic) => {
                self.instance.fail();
                let message = format!("{}. This instance has failed", describe(&*panic));
                (Status::Error, Category::Error, message)
            }
        };
        let message = format!("{}: {message}", entry.function);
        self.logger.log(status, category, &message);
        status
    }

    #[inline]
    fn tell_barred(&self, calls: &[&str]) {
        for call in calls {
            let message = format!(
                "{call}: refused, since another call of this instance was under way. Call an instance from one thread at a time, \
                 and not from the function that it logs by."
            );
            self.logger.log(Status::Error, Category::Error, &message);
        }
    }

    /// Notes how the step from `asked.0` by `asked.1` ended, and logs what has become doubtful by it.
    ///
    /// A step that the model cannot do is discarded, so that the importer may try a shorter one, or the same with other
    /// inputs or from another state. Asked for the very same step again, the answer is an error: there are importers that otherwise
    /// repeat a discarded step without end.
    ///
    /// # Errors
    /// That of `done`, with [`Error::Call`] in the place of a repeated [`Error::Step`].
    pub fn note<T>(&mut self, function: &str, asked: (f64, f64), done: Result<T>) -> Result<T> {
        if done.is_ok() {
            self.last_step = Status::Ok;
            self.refused = None;
            self.warn(function);
        }
        done.map_err(|error| self.note_refusal(asked, error))
    }

    #[cold]
    fn note_refusal(&mut self, asked: (f64, f64), error: Error) -> Error {
        let same = |step: &RefusedStep| {
            step.asked == asked && step.values == self.instance.values() && step.bytes == self.instance.all_bytes()
        };
        let repeated = self.refused.as_ref().is_some_and(same);
        match error {
            Error::Step {
                model,
                time,
                what,
                remedy,
            } if repeated => {
                self.last_step = Status::Error;
                let time = Unit::SECOND.format(time);
                let what = format!("{model}: the same step refused again at t = {time}: {what}");
                Error::call(what, remedy)
            }
            Error::Step { .. } => {
                self.last_step = Status::Discard;
                let values = self.instance.values().to_vec();
                let bytes = self.instance.all_bytes().to_vec();
                self.refused = Some(RefusedStep { asked, values, bytes });
                error
            }
            _ => {
                self.last_step = Status::Error;
                error
            }
        }
    }

    /// Logs what has become doubtful, once for each topic.
    pub fn warn(&mut self, function: &str) {
        for warning in self.instance.warnings(&self.warned) {
            self.warned.push(warning.topic);
            let message = format!("{function}: {}", warning.text);
            self.logger.log(Status::Warning, Category::Warning, &message);
        }
    }

    /// Goes to a saved state, from which a step that was refused may be possible.
    ///
    /// # Errors
    /// Those of [`Instance::restore`]; no such state.
    pub fn restore(&mut self, state: Opaque) -> Result<()> {
        self.instance.restore(self.states.get(state)?)?;
        self.refused = None;
        Ok(())
    }

    /// Becomes as a new instance. Saved states stay: the importer frees them.
    pub fn reset(&mut self) {
        self.instance.reset();
        self.last_step = Status::Ok;
        self.refused = None;
        self.warned.clear();
    }

    /// Logs a change in the life of the instance.
    pub fn log_phase(&self, function: &str) {
        if !self.logger.is_on(Category::Events) {
            return; // without the memory of a message: event mode begins and ends within steps of the importer
        }
        let (phase, time) = (self.instance.phase().name(), Unit::SECOND.format(self.instance.time()));
        let message = format!("{function}: {phase} at t = {time}");
        self.logger.log(Status::Ok, Category::Events, &message);
    }
}
