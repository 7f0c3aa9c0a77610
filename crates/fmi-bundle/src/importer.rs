//! The other side: a library that was taken out of an FMU, loaded and driven through FMI 3.0.
//!
//! The only unsafe code of this crate: C functions of a library that is known at run time alone. The rest of the crate calls
//! the safe methods here, which keep each pointer alive for as long as the library may use it.

#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::path::PathBuf;
use std::ptr::{null, null_mut};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

use fmi_component::{Error, Result, Unit};

/// `fmi3Instance`.
type Opaque = *mut c_void;
/// `fmi3Boolean`, as a byte: other bytes than 0 and 1 are no defect of ours.
type Boolean = u8;
/// `fmi3OK`.
const OK: c_int = 0;
/// Remedy for an FMU whose parts do not fit.
pub const MAKE_ANEW: &str = "Write the FMU anew.";

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
type Set = unsafe extern "C" fn(Opaque, *const u32, usize, *const f64, usize) -> c_int;
type Get = unsafe extern "C" fn(Opaque, *const u32, usize, *mut f64, usize) -> c_int;
type DoStep =
    unsafe extern "C" fn(Opaque, f64, f64, Boolean, *mut Boolean, *mut Boolean, *mut Boolean, *mut f64) -> c_int;

/// A library in a file of its own, which goes when the value goes.
pub struct Library {
    library: Option<libloading::Library>,
    path: PathBuf,
}

/// An instance with the last thing that it logged.
pub struct Instance {
    library: Library,
    pointer: Opaque,
    log: Box<Mutex<String>>,
}

impl Library {
    /// Loads the bytes of a shared library.
    ///
    /// # Errors
    /// It cannot be written to the folder for temporary files, or is no library for this platform. Here and below an
    /// [`Error::Call`] does not name the file that the bytes are from: the caller knows it.
    pub fn load(bytes: &[u8]) -> Result<Self> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("fmu-{}-{number}{}", std::process::id(), std::env::consts::DLL_SUFFIX);
        let path = std::env::temp_dir().join(name);
        let variable = if cfg!(windows) { "TMP" } else { "TMPDIR" };
        fs::write(&path, bytes)
            .map_err(|error| Error::file(&path, error, format!("Make room, or set {variable} to another folder.")))?;
        let mut loaded = Self { library: None, path };
        // SAFETY: loading runs the initialisers of the library: the user named this FMU to be run.
        let library = unsafe { libloading::Library::new(&loaded.path) };
        let unfit = |error| {
            Error::call(
                format!("its library is not loaded: {error}"),
                "Is it for this platform?",
            )
        };
        let library = library.map_err(unfit)?;
        loaded.library = Some(library);
        Ok(loaded)
    }

    /// An instance for co-simulation.
    ///
    /// # Errors
    /// The library refuses the token or lacks a function.
    pub fn instantiate(self, token: &str) -> Result<Instance> {
        let log = Box::new(Mutex::new(String::new()));
        let environment = std::ptr::from_ref(&*log).cast_mut().cast();
        let token =
            CString::new(token).map_err(|_| Error::call("its instantiation token holds a zero byte", MAKE_ANEW))?;
        let make = self.symbol::<Instantiate>(c"fmi3InstantiateCoSimulation")?;
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
        let instance = Instance {
            library: self,
            pointer,
            log,
        };
        match pointer.is_null() {
            true => Err(instance.refused("fmi3InstantiateCoSimulation")),
            false => Ok(instance),
        }
    }

    fn symbol<T: Copy>(&self, name: &CStr) -> Result<T> {
        let missing = || {
            Error::call(
                format!("its library has no function {}", name.to_string_lossy()),
                "Name an FMU that this crate wrote.",
            )
        };
        let library = self.library.as_ref().ok_or_else(missing)?;
        // SAFETY: the callers name the standard's type of the function.
        let symbol = unsafe { library.get::<T>(name.to_bytes_with_nul()) };
        symbol.map(|symbol| *symbol).map_err(|_| missing())
    }
}

impl Drop for Library {
    fn drop(&mut self) {
        self.library = None; // before its file goes
        let _ = fs::remove_file(&self.path);
    }
}

impl Instance {
    /// Initialises with start values at `start` \[s\].
    ///
    /// # Errors
    /// The library refuses.
    pub fn initialize(&mut self, start: f64, inputs: &[(u32, Vec<f64>)]) -> Result<()> {
        let enter = self.library.symbol::<Enter>(c"fmi3EnterInitializationMode")?;
        let exit = self.library.symbol::<Plain>(c"fmi3ExitInitializationMode")?;
        // SAFETY: the signatures are those of the standard, the pointer is that of a living instance.
        let entered = unsafe { enter(self.pointer, 0, 0.0, start, 0, 0.0) };
        self.check("fmi3EnterInitializationMode", entered)?;
        for (reference, values) in inputs {
            self.set(*reference, values)?;
        }
        // SAFETY: as above.
        let left = unsafe { exit(self.pointer) };
        self.check("fmi3ExitInitializationMode", left)
    }

    /// Sets all elements of a real variable.
    ///
    /// # Errors
    /// The library refuses.
    pub fn set(&mut self, reference: u32, values: &[f64]) -> Result<()> {
        let set = self.library.symbol::<Set>(c"fmi3SetFloat64")?;
        // SAFETY: the signature is that of the standard; the arrays have the lengths given.
        let status = unsafe { set(self.pointer, &reference, 1, values.as_ptr(), values.len()) };
        self.check("fmi3SetFloat64", status)
    }

    /// Reads the `span` elements of a variable as reals.
    ///
    /// # Errors
    /// The library refuses.
    pub fn get(&mut self, reference: u32, span: usize) -> Result<Vec<f64>> {
        let get = self.library.symbol::<Get>(c"fmi3GetFloat64")?;
        let mut values = vec![f64::NAN; span];
        // SAFETY: the signature is that of the standard; the arrays have the lengths given.
        let status = unsafe { get(self.pointer, &reference, 1, values.as_mut_ptr(), span) };
        self.check("fmi3GetFloat64", status).map(|()| values)
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

    fn check(&self, function: &str, status: c_int) -> Result<()> {
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
    // SAFETY: the environment is the log of `Library::instantiate`, which outlives the instance; the message is a string.
    let (log, message) = unsafe { (&*environment.cast::<Mutex<String>>(), CStr::from_ptr(message)) };
    if let Ok(mut log) = log.lock() {
        *log = message.to_string_lossy().into_owned();
    }
}
