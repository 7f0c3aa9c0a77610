//! What both versions share: the handle behind `fmi2Component` and `fmi3Instance`, the way in and out of every call.

use std::collections::HashMap;
use std::ffi::{c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;

use super::handle::{self, describe};
use super::intermediate::Listener;
use super::logger::{Category, Logger};
use super::memory;
use super::states::Saved;
use crate::error::{Error, Result};
use crate::fmi::instance::Instance;
use crate::fmi::life_cycle::Version;
use crate::scene::{Reached, Scene};

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

/// What an instance pointer points to.
type Handle<S> = handle::Handle<Inner<S>, 0x6a6f_7374_6c65_464d>;

/// An instance with what it needs to talk to its importer.
pub struct Inner<S: Scene> {
    /// The component.
    pub instance: Instance<S>,
    /// The importer's log.
    pub logger: Logger,
    /// How the last step ended, for `fmi2GetStatus`.
    pub last_step: Status,
    /// Communication point and step size that were refused last.
    refused: Option<(f64, f64)>,
    version: Version,
    /// Whom to tell of events inside of a step.
    pub(super) listener: Option<Listener>,
    /// What it saved, under the numbers that the importer holds.
    pub(super) states: HashMap<usize, Saved<S>>,
}

/// Makes an instance. Null, after a log message, when `make` refuses or panics.
pub fn instantiate<S: Scene>(
    version: Version,
    function: &str,
    mut logger: Logger,
    make: impl FnOnce() -> Result<(Instance<S>, Option<Listener>)>,
) -> Opaque {
    match catch_unwind(AssertUnwindSafe(make)) {
        Ok(Ok((instance, listener))) => {
            logger.log(
                Status::Ok,
                Category::Events,
                &format!("{function}: {}", instance.token()),
            );
            let inner = Inner {
                instance,
                logger,
                last_step: Status::Ok,
                refused: None,
                version,
                listener,
                states: HashMap::new(),
            };
            Handle::<S>::hand_out(inner).cast()
        }
        Ok(Err(error)) => {
            logger.refuse(&format!("{function}: {error}"));
            null_mut()
        }
        Err(panic) => {
            logger.refuse(&format!("{function}: {}", describe(&*panic)));
            null_mut()
        }
    }
}

/// Frees an instance with all its states. Null is ignored, as both standards ask, and so is an instance of the other version
/// or one that is at work, such as from inside a callback of this very instance or while it tells of an intermediate update.
///
/// # Safety
/// `pointer` is null or an instance of this library that was not freed before.
pub unsafe fn free<S: Scene>(pointer: Opaque, version: Version) {
    // SAFETY: by the caller's promise.
    let _ = unsafe {
        Handle::<S>::free(pointer.cast(), |inner| {
            inner.version == version && !inner.instance.is_stepping()
        })
    };
}

/// The way into an instance: checks the pointer, keeps others out, catches panics, logs what went wrong. Shut inside of an
/// intermediate update.
///
/// # Safety
/// `pointer` is null or an instance of this library that was not freed.
pub unsafe fn enter<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    work: impl FnOnce(&mut Inner<S>) -> Result<()>,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter_to_read::<S>(pointer, version, function, |inner| {
            inner.instance.check_change()?;
            work(inner)
        })
    }
}

/// The way in for who only reads values, which is allowed inside of an intermediate update.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn enter_to_read<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    work: impl FnOnce(&mut Inner<S>) -> Result<()>,
) -> Status {
    let run = |inner: &mut Inner<S>| match inner.version == version {
        true => inner.run(function, work),
        false => Status::Error,
    };
    // SAFETY: by the caller's promise.
    unsafe { Handle::<S>::enter(pointer.cast_const().cast(), run) }.unwrap_or(Status::Error)
}

/// The way back in for a step that was left for an intermediate update.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn come_back<S: Scene>(
    pointer: Opaque,
    function: &str,
    work: impl FnOnce(&mut Inner<S>) -> Result<()>,
) -> Status {
    let run = |inner: &mut Inner<S>| inner.run(function, work);
    // SAFETY: by the caller's promise.
    unsafe { Handle::<S>::come_back(pointer.cast_const().cast(), run) }.unwrap_or(Status::Error)
}

impl<S: Scene> Inner<S> {
    fn run(&mut self, function: &str, work: impl FnOnce(&mut Self) -> Result<()>) -> Status {
        match catch_unwind(AssertUnwindSafe(|| work(self))) {
            Ok(Ok(())) => Status::Ok,
            Ok(Err(error @ Error::Step { .. })) => {
                let message = format!("{function}: {error}");
                self.logger.log(Status::Discard, Category::Discard, &message);
                Status::Discard
            }
            Ok(Err(error)) => {
                self.logger
                    .log(Status::Error, Category::Error, &format!("{function}: {error}"));
                Status::Error
            }
            Err(panic) => {
                self.instance.fail();
                let message = format!("{function}: {}. This instance has failed", describe(&*panic));
                self.logger.log(Status::Error, Category::Error, &message);
                Status::Error
            }
        }
    }

    /// Advances in time.
    ///
    /// A step that the scene cannot do is discarded, so that the importer may try a shorter one. Asked for the very same
    /// step again, the answer is an error: there are importers that otherwise repeat a discarded step for ever.
    ///
    /// # Errors
    /// As [`Instance::do_step`], with [`Error::Call`] in the place of a repeated [`Error::Step`].
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<Reached> {
        let done = self.instance.do_step(current, step);
        self.note((current, step), done)
    }

    /// Notes how the step from `asked.0` by `asked.1` ended, and turns a repeated refusal into an error.
    ///
    /// # Errors
    /// As [`Inner::do_step`].
    pub(super) fn note<T>(&mut self, asked: (f64, f64), done: Result<T>) -> Result<T> {
        let done = done.map_err(|error| match error {
            Error::Step {
                scene,
                time,
                what,
                remedy,
            } if self.refused == Some(asked) => Error::call(
                format!("{scene}: the same step refused again at t = {time} s: {what}"),
                remedy,
            ),
            other => other,
        });
        self.last_step = match &done {
            Ok(_) => Status::Ok,
            Err(Error::Step { .. }) => Status::Discard,
            Err(_) => Status::Error,
        };
        match self.last_step {
            Status::Ok => self.refused = None,
            Status::Discard => self.refused = Some(asked),
            _ => {}
        }
        done
    }

    /// Becomes as a new instance. Saved states stay: the importer frees them.
    pub fn reset(&mut self) {
        self.instance.reset();
        self.last_step = Status::Ok;
        self.refused = None;
    }

    /// Tells a change in the life of the instance.
    pub fn tell(&self, function: &str) {
        let (phase, time) = (self.instance.phase().name(), self.instance.time());
        self.logger.log(
            Status::Ok,
            Category::Events,
            &format!("{function}: {phase} at t = {time} s"),
        );
    }
}

/// A call that only moves the instance along its life cycle.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn transition<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    change: impl FnOnce(&mut Instance<S>) -> Result<()>,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            change(&mut inner.instance)?;
            inner.tell(function);
            Ok(())
        })
    }
}

/// `fmi2Reset`, `fmi3Reset`.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn reset<S: Scene>(pointer: Opaque, version: Version, function: &str) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            inner.reset();
            inner.tell(function);
            Ok(())
        })
    }
}

/// `fmi2SetDebugLogging`, `fmi3SetDebugLogging`.
///
/// # Safety
/// As for [`enter`]; `categories` is null or has `count` strings.
pub unsafe fn set_debug_logging<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    on: bool,
    (categories, count): (*const *const c_char, usize),
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            let pointers = memory::slice(categories, count, "the array of categories")?;
            let names: Result<Vec<_>> = pointers.iter().map(|name| memory::text(*name, "a category")).collect();
            inner.logger.switch(on, &names?)
        })
    }
}

/// A function that this component does not have: refused with the reason, never a crash.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn unsupported<S: Scene>(pointer: Opaque, version: Version, function: &str, why: &str) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |_| {
            Err(Error::call(why, "See the capability flags in modelDescription.xml."))
        })
    }
}

/// A getter or setter of a type that no variable has: legal for no variables, refused otherwise.
///
/// # Safety
/// As for [`enter`].
pub unsafe fn no_such_type<S: Scene>(pointer: Opaque, version: Version, function: &str, count: usize) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter_to_read::<S>(pointer, version, function, |_| match count {
            0 => Ok(()),
            _ => Err(Error::call(
                "no variable is of this type",
                "Take the types from modelDescription.xml.",
            )),
        })
    }
}
