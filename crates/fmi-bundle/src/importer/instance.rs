//! An instance of a library, driven through FMI 3.0.
#![allow(unsafe_code)] // C functions of a library that is known at run time alone

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::{Arc, Mutex};

use fmi_component::{Error, Result, Unit};

use super::library::{Library, MAKE_ANEW};

/// `fmi3Instance`.
type Opaque = *mut c_void;
/// `fmi3Boolean`, as a byte: other bytes than 0 and 1 are no defect of ours.
type Boolean = u8;
/// `fmi3OK`.
const OK: c_int = 0;

type Log = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);
/// `fmi3IntermediateUpdateCallback`, of which none is passed.
type IntermediateUpdate = unsafe extern "C" fn();
type Instantiate = unsafe extern "C" fn(
    *const c_char,
    *const c_char,
    *const c_char,
    Boolean,
    Boolean,
    Boolean,
    Boolean,
    *const u32,
    usize,
    Opaque,
    Option<Log>,
    Option<IntermediateUpdate>,
) -> Opaque;
type Enter = unsafe extern "C" fn(Opaque, Boolean, f64, f64, Boolean, f64) -> c_int;
type Plain = unsafe extern "C" fn(Opaque) -> c_int;
type Free = unsafe extern "C" fn(Opaque);
type DoStep =
    unsafe extern "C" fn(Opaque, f64, f64, Boolean, *mut Boolean, *mut Boolean, *mut Boolean, *mut f64) -> c_int;

/// An instance with the last thing that it logged.
pub struct Instance {
    pub(super) library: Arc<Library>,
    pub(super) pointer: Opaque,
    log: Box<Mutex<String>>,
}

impl Instance {
    /// An instance for co-simulation.
    ///
    /// # Errors
    /// The library refuses the token or lacks a function.
    pub fn new(library: Arc<Library>, token: &str) -> Result<Self> {
        let log = Box::new(Mutex::new(String::new()));
        let environment = std::ptr::from_ref(&*log).cast_mut().cast();
        let token =
            CString::new(token).map_err(|_| Error::call("its instantiation token holds a zero byte", MAKE_ANEW))?;
        let make = library.symbol::<Instantiate>(c"fmi3InstantiateCoSimulation")?;
        // SAFETY: the signature is that of the standard; the strings outlive the call and the log the instance.
        let pointer = unsafe {
            make(
                c"replay".as_ptr(),
                token.as_ptr(),
                null(),
                0,
                1,
                0,
                0,
                null(),
                0,
                environment,
                Some(keep),
                None,
            )
        };
        let instance = Self { library, pointer, log };
        match pointer.is_null() {
            true => Err(instance.refused("fmi3InstantiateCoSimulation")),
            false => Ok(instance),
        }
    }

    /// Enters initialization mode at `start` \[s\].
    ///
    /// # Errors
    /// The library refuses.
    pub fn enter_initialization(&mut self, start: f64) -> Result<()> {
        let enter = self.library.symbol::<Enter>(c"fmi3EnterInitializationMode")?;
        // SAFETY: the signature is that of the standard, the pointer is that of a living instance.
        let entered = unsafe { enter(self.pointer, 0, 0.0, start, 0, 0.0) };
        self.check("fmi3EnterInitializationMode", entered)
    }

    /// Leaves initialization mode.
    ///
    /// # Errors
    /// The library refuses.
    pub fn exit_initialization(&mut self) -> Result<()> {
        self.plain(c"fmi3ExitInitializationMode")
    }

    /// Becomes as a new one.
    ///
    /// # Errors
    /// The library refuses.
    pub fn reset(&mut self) -> Result<()> {
        self.plain(c"fmi3Reset")
    }

    fn plain(&mut self, name: &CStr) -> Result<()> {
        let function = self.library.symbol::<Plain>(name)?;
        // SAFETY: the signature is that of the standard, the pointer is that of a living instance.
        let status = unsafe { function(self.pointer) };
        self.check(&name.to_string_lossy(), status)
    }

    /// The last message that the library logged, without the name of the function that it was about.
    pub fn last_message(&self) -> String {
        let message = self.log.lock().map(|message| message.clone()).unwrap_or_default();
        match message.split_once(": ") {
            Some((function, rest)) if function.starts_with("fmi") => rest.into(),
            _ => message,
        }
    }

    /// A step from `current` by `step` that must end at `end` (all \[s\]), as far as rounding lets it.
    ///
    /// # Errors
    /// The library refuses, or stops somewhere else.
    pub fn step(&mut self, current: f64, step: f64, end: f64) -> Result<()> {
        let go = self.library.symbol::<DoStep>(c"fmi3DoStep")?;
        let (mut flags, mut reached) = ([0; 3], f64::NAN);
        let [event, terminate, early] = &mut flags;
        // SAFETY: the signature is that of the standard; the pointers are to living values.
        let status = unsafe { go(self.pointer, current, step, 1, event, terminate, early, &mut reached) };
        self.check("fmi3DoStep", status)?;
        if (reached - end).abs() <= 1e-9 * step {
            return Ok(());
        }
        let (end, reached) = (Unit::SECOND.format(end), Unit::SECOND.format(reached));
        Err(Error::call(
            format!("its library ended the step to {end} at {reached}"),
            MAKE_ANEW,
        ))
    }

    pub(super) fn check(&self, function: &str, status: c_int) -> Result<()> {
        match status == OK {
            true => Ok(()),
            false => Err(self.refused(function)),
        }
    }

    fn refused(&self, function: &str) -> Error {
        let message = self.log.lock().map(|message| message.clone()).unwrap_or_default();
        let said = match message.trim_end_matches('.') {
            "" => "without a message",
            said => said,
        };
        Error::call(format!("its library refuses {function}: {said}"), MAKE_ANEW)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if let Ok(free) = self.library.symbol::<Free>(c"fmi3FreeInstance") {
            // SAFETY: made by this library and freed once; null is legal.
            unsafe { free(self.pointer) };
        }
        self.pointer = null_mut();
    }
}

/// The log callback: keeps the last message.
unsafe extern "C" fn keep(environment: *mut c_void, _: c_int, _: *const c_char, message: *const c_char) {
    // SAFETY: the environment is the log of `Instance::new`, which outlives the instance; the message is a string.
    let (log, message) = unsafe { (&*environment.cast::<Mutex<String>>(), CStr::from_ptr(message)) };
    if let Ok(mut log) = log.lock() {
        *log = message.to_string_lossy().into_owned();
    }
}
