//! A shared library from its bytes, and what it tells of its model.
#![allow(unsafe_code)] // symbols of a library that is known at run time alone

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use fmi_component::c_api::description::{DESCRIBED, REFUSED, Take};
use fmi_component::description::Description;
use fmi_component::{Error, Result};

/// Remedy for an FMU whose parts do not fit.
pub const MAKE_ANEW: &str = "Write the FMU anew.";

type Describe = unsafe extern "C" fn(*const c_char, *mut c_void, Option<Take>) -> c_int;

/// A library in a file of its own, which goes when the value goes.
pub struct Library {
    library: Option<libloading::Library>,
    path: PathBuf,
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
        // SAFETY: loading runs the initialisers of the library: the user named this FMU or built this crate to be run.
        let library = unsafe { libloading::Library::new(&loaded.path) };
        let unfit = |error| {
            Error::call(
                format!("its library is not loaded: {error}"),
                "Is it for this platform?",
            )
        };
        loaded.library = Some(library.map_err(unfit)?);
        Ok(loaded)
    }

    /// What the library says of its model, for the structural parameters in `choices`, which are lines `NAME=NUMBER`.
    ///
    /// # Errors
    /// It exports no such function, a choice that the model does not take, a panic of the model, a description of another format.
    pub fn describe(&self, choices: &str) -> Result<Description> {
        let function = self.find::<Describe>(c"fmi_component_describe").ok_or_else(|| {
            Error::call(
                "the library does not tell what its model is: it has no function fmi_component_describe",
                "Write fmi_component::export_fmu!(MyModel); in the file src/lib.rs of its crate, with a fmi-component of the \
                 version of this program, and build it anew.",
            )
        })?;
        let choices = CString::new(choices)
            .map_err(|_| Error::call("a structural parameter holds a zero byte", "Leave it out."))?;
        let mut bytes = Vec::new();
        let environment = std::ptr::from_mut(&mut bytes).cast();
        // SAFETY: the signature is that of fmi_component::c_api::description; the vector outlives the call, in which alone it is used.
        let status = unsafe { function(choices.as_ptr(), environment, Some(take)) };
        match status {
            DESCRIBED => Description::read(bytes.leak()),
            REFUSED => {
                let said = String::from_utf8_lossy(&bytes).into_owned();
                let (what, remedy) = match said.split_once(". ") {
                    Some((what, remedy)) => (what.into(), remedy.into()),
                    None => (said, "The model has to be mended.".to_string()),
                };
                Err(Error::call(what, remedy))
            }
            other => Err(Error::call(
                format!("fmi_component_describe returned {other}"),
                "Build the library anew.",
            )),
        }
    }

    /// The function called `name`, of type `T`.
    ///
    /// # Errors
    /// The library has none.
    pub(super) fn symbol<T: Copy>(&self, name: &CStr) -> Result<T> {
        self.find(name).ok_or_else(|| {
            Error::call(
                format!("its library has no function {}", name.to_string_lossy()),
                "Name an FMU that this crate wrote.",
            )
        })
    }

    fn find<T: Copy>(&self, name: &CStr) -> Option<T> {
        let library = self.library.as_ref()?;
        // SAFETY: the callers name the type that the standard, or `fmi_component::c_api`, gives the function.
        let symbol = unsafe { library.get::<T>(name.to_bytes_with_nul()) };
        symbol.map(|symbol| *symbol).ok()
    }
}

impl Drop for Library {
    fn drop(&mut self) {
        self.library = None; // before its file goes
        let _ = fs::remove_file(&self.path);
    }
}

/// Copies the bytes into the vector that is the environment.
unsafe extern "C" fn take(environment: *mut c_void, bytes: *const u8, count: usize) {
    // SAFETY: the environment is the vector of `Library::describe`, and `bytes` leads to `count` bytes, by the function's contract.
    let (held, bytes) = unsafe {
        (
            &mut *environment.cast::<Vec<u8>>(),
            std::slice::from_raw_parts(bytes, count),
        )
    };
    held.extend_from_slice(bytes);
}
