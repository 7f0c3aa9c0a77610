//! A library of an FMU, loaded and driven through the C functions of FMI 3.0 as an importer does it.
//!
//! Functions are looked up once, and a call allocates nothing, so that a measurement shows the library and not its importer.
#![allow(unsafe_code)] // plays the importer

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::null;
use std::sync::Mutex;

use anyhow::{Context, Result, bail};

/// `fmi3Instance`.
type Opaque = *mut c_void;
type Log = unsafe extern "C" fn(Opaque, c_int, *const c_char, *const c_char);
type Instantiate = unsafe extern "C" fn(
    *const c_char,
    *const c_char,
    *const c_char,
    bool,
    bool,
    bool,
    bool,
    *const u32,
    usize,
    Opaque,
    Option<Log>,
    Option<unsafe extern "C" fn()>,
) -> Opaque;
type Enter = unsafe extern "C" fn(Opaque, bool, f64, f64, bool, f64) -> c_int;
type Plain = unsafe extern "C" fn(Opaque) -> c_int;
type Free = unsafe extern "C" fn(Opaque);
type Set = unsafe extern "C" fn(Opaque, *const u32, usize, *const f64, usize) -> c_int;
type Get = unsafe extern "C" fn(Opaque, *const u32, usize, *mut f64, usize) -> c_int;
type DoStep = unsafe extern "C" fn(Opaque, f64, f64, bool, *mut bool, *mut bool, *mut bool, *mut f64) -> c_int;

/// An initialised instance of the model in a library.
pub struct Instance {
    pointer: Opaque,
    set: Set,
    get: Get,
    step: DoStep,
    free: Free,
    /// The last message.
    log: Box<Mutex<String>>,
    /// Goes last: the functions are in it.
    _library: libloading::Library,
}

impl Instance {
    /// Loads the library, and makes and initialises an instance at time 0.
    ///
    /// # Errors
    /// No such library, or it refuses the token or the initialisation.
    pub fn new(path: &Path, token: &str) -> Result<Self> {
        let cannot = || format!("{} cannot be loaded", path.display());
        // SAFETY: the libraries of this workspace have no initialisers of their own.
        let library = unsafe { libloading::Library::new(path) }.with_context(cannot)?;
        let make: Instantiate = symbol(&library, c"fmi3InstantiateCoSimulation")?;
        let enter: Enter = symbol(&library, c"fmi3EnterInitializationMode")?;
        let leave: Plain = symbol(&library, c"fmi3ExitInitializationMode")?;
        let set: Set = symbol(&library, c"fmi3SetFloat64")?;
        let get: Get = symbol(&library, c"fmi3GetFloat64")?;
        let step: DoStep = symbol(&library, c"fmi3DoStep")?;
        let free: Free = symbol(&library, c"fmi3FreeInstance")?;
        let log = Box::new(Mutex::new(String::new()));
        let environment = std::ptr::from_ref(&*log).cast_mut().cast();
        let (name, token) = (c"real-time", CString::new(token)?);
        // SAFETY: the signature is that of the standard; the strings outlive the call and the log the instance.
        let pointer = unsafe {
            make(
                name.as_ptr(),
                token.as_ptr(),
                null(),
                false,
                true,
                false,
                false,
                null(),
                0,
                environment,
                Some(keep),
                None,
            )
        };
        let instance = Self {
            pointer,
            set,
            get,
            step,
            free,
            log,
            _library: library,
        };
        if pointer.is_null() {
            bail!("{}", instance.message());
        }
        // SAFETY: the signature is that of the standard; the instance lives.
        instance.check(unsafe { enter(pointer, false, 0.0, 0.0, false, 0.0) })?;
        // SAFETY: as above.
        instance.check(unsafe { leave(pointer) })?;
        Ok(instance)
    }

    /// Sets inputs.
    ///
    /// # Errors
    /// The library refuses.
    pub fn set(&self, references: &[u32], values: &[f64]) -> Result<()> {
        let count = references.len().min(values.len());
        // SAFETY: the signature is that of the standard; the arrays have that many elements.
        self.check(unsafe { (self.set)(self.pointer, references.as_ptr(), count, values.as_ptr(), count) })
    }

    /// Reads outputs.
    ///
    /// # Errors
    /// The library refuses.
    pub fn get(&self, references: &[u32], values: &mut [f64]) -> Result<()> {
        let count = references.len().min(values.len());
        // SAFETY: the signature is that of the standard; the arrays have that many elements.
        self.check(unsafe { (self.get)(self.pointer, references.as_ptr(), count, values.as_mut_ptr(), count) })
    }

    /// `fmi3DoStep` from `current` by `step` \[s\], and nothing else: the status is to be checked afterwards.
    #[inline]
    pub fn step(&self, current: f64, step: f64) -> c_int {
        let (mut flags, mut reached) = ([false; 3], 0.0);
        let [event, terminate, early] = &mut flags;
        // SAFETY: the signature is that of the standard; the pointers are to living values.
        unsafe { (self.step)(self.pointer, current, step, true, event, terminate, early, &mut reached) }
    }

    /// The message that came with a status, if that is not OK.
    ///
    /// # Errors
    /// That status.
    pub fn check(&self, status: c_int) -> Result<()> {
        if status != 0 {
            bail!("{}", self.message());
        }
        Ok(())
    }

    fn message(&self) -> String {
        self.log.lock().map(|message| message.clone()).unwrap_or_default()
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: made by this library and freed once; null is legal.
        unsafe { (self.free)(self.pointer) };
    }
}

fn symbol<T: Copy>(library: &libloading::Library, name: &CStr) -> Result<T> {
    // SAFETY: the callers name the standard's type of the function.
    let found = unsafe { library.get::<T>(name.to_bytes_with_nul()) };
    Ok(*found.with_context(|| format!("the library has no function {}", name.to_string_lossy()))?)
}

/// The log callback: keeps the last message.
unsafe extern "C" fn keep(environment: Opaque, _: c_int, _: *const c_char, message: *const c_char) {
    // SAFETY: the environment is the log of the instance, which outlives it; the message is a string.
    let (log, message) = unsafe { (&*environment.cast::<Mutex<String>>(), CStr::from_ptr(message)) };
    if let Ok(mut log) = log.lock() {
        *log = message.to_string_lossy().into_owned();
    }
}
