//! An instance of a loaded library, by the functions that an importer calls most: alike for both versions.

use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};

use fmi_component::c_api::{CallbackFunctions, Fmi2Log, Opaque, Status};
use fmi_component::{ModelType, StructuralParameters, token};
use libloading::Library;

/// The calls, each a function pointer of the library.
pub trait Calls: Sized {
    const VERSION: &'static str;
    /// An instance in step mode at time 0, with the inputs `u` (value references 1 to 10) set before.
    fn ready(library: &Library, token: &str, u: &[f64]) -> Self;
    fn step(&self, time: f64, step: f64) -> Status;
    fn get(&self, references: &[u32], values: &mut [f64]) -> Status;
    fn set(&self, references: &[u32], values: &[f64]) -> Status;
    fn save(&self, state: &mut Opaque) -> Status;
    fn restore(&self, state: Opaque) -> Status;
    fn forget(&self, state: &mut Opaque) -> Status;
}

pub fn open(path: &Path) -> Library {
    // SAFETY: both libraries do nothing when they are loaded.
    unsafe { Library::new(path) }.unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A function of the library; its type is that of the standard's header.
macro_rules! function {
    ($library:expr, $name:literal) => {{
        // SAFETY: the type is that of the header, and the library stays loaded until the end.
        let symbol = unsafe { $library.get(concat!($name, "\0").as_bytes()) };
        *symbol.unwrap_or_else(|error| panic!("{}: {error}", $name))
    }};
}

/// Ends with the status of a call of such a function.
macro_rules! call {
    ($function:expr, $($argument:expr),*) => {
        // SAFETY: a living instance, and arrays of the lengths given.
        unsafe { ($function)($($argument),*) }
    };
}

pub const INPUTS: [u32; 10] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
pub const OUTPUTS: [u32; 10] = [11, 12, 13, 14, 15, 16, 17, 18, 19, 20];

type Plain = unsafe extern "C" fn(Opaque) -> Status;
type WithState = unsafe extern "C" fn(Opaque, Opaque) -> Status;
type WithStatePlace = unsafe extern "C" fn(Opaque, *mut Opaque) -> Status;

/// FMI 2.0.
pub struct Two {
    pointer: Opaque,
    free: unsafe extern "C" fn(Opaque),
    step: unsafe extern "C" fn(Opaque, f64, f64, c_int) -> Status,
    get: unsafe extern "C" fn(Opaque, *const u32, usize, *mut f64) -> Status,
    set: unsafe extern "C" fn(Opaque, *const u32, usize, *const f64) -> Status,
    save: WithStatePlace,
    restore: WithState,
    forget: WithStatePlace,
    _callbacks: Box<CallbackFunctions>,
}

/// Stable Rust defines no variadic function; the log is never used here.
unsafe extern "C" fn log2(_: *mut c_void, _: *const c_char, _: c_int, _: *const c_char, _: *const c_char) {}

impl Calls for Two {
    const VERSION: &'static str = "2.0";

    fn ready(library: &Library, token: &str, u: &[f64]) -> Self {
        type SetUp = unsafe extern "C" fn(Opaque, c_int, f64, f64, c_int, f64) -> Status;
        type Log = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            c_int,
            *const c_char,
            *const c_char,
            *const CallbackFunctions,
            c_int,
            c_int,
        ) -> Opaque;
        let callbacks = Box::new(CallbackFunctions {
            // SAFETY: a function that takes fewer arguments is called alike.
            logger: Some(unsafe { std::mem::transmute::<Log, Fmi2Log>(log2) }),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: null_mut(),
        });
        let token = CString::new(token).expect("no zero byte");
        let instantiate: Instantiate = function!(library, "fmi2Instantiate");
        let pointer = call!(
            instantiate,
            c"name".as_ptr(),
            1,
            token.as_ptr(),
            null(),
            &*callbacks,
            0,
            0
        );
        assert!(!pointer.is_null(), "the token is right");
        let made = Self {
            pointer,
            free: function!(library, "fmi2FreeInstance"),
            step: function!(library, "fmi2DoStep"),
            get: function!(library, "fmi2GetReal"),
            set: function!(library, "fmi2SetReal"),
            save: function!(library, "fmi2GetFMUstate"),
            restore: function!(library, "fmi2SetFMUstate"),
            forget: function!(library, "fmi2FreeFMUstate"),
            _callbacks: callbacks,
        };
        let set_up: SetUp = function!(library, "fmi2SetupExperiment");
        let enter: Plain = function!(library, "fmi2EnterInitializationMode");
        let exit: Plain = function!(library, "fmi2ExitInitializationMode");
        let statuses = [
            call!(set_up, pointer, 0, 0.0, 0.0, 0, 0.0),
            call!(enter, pointer),
            made.set(&INPUTS, u),
            call!(exit, pointer),
        ];
        assert_eq!(statuses, [Status::Ok; 4]);
        made
    }

    fn step(&self, time: f64, step: f64) -> Status {
        call!(self.step, self.pointer, time, step, 1)
    }

    fn get(&self, references: &[u32], values: &mut [f64]) -> Status {
        assert_eq!(references.len(), values.len());
        call!(
            self.get,
            self.pointer,
            references.as_ptr(),
            references.len(),
            values.as_mut_ptr()
        )
    }

    fn set(&self, references: &[u32], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        call!(
            self.set,
            self.pointer,
            references.as_ptr(),
            references.len(),
            values.as_ptr()
        )
    }

    fn save(&self, state: &mut Opaque) -> Status {
        call!(self.save, self.pointer, state)
    }

    fn restore(&self, state: Opaque) -> Status {
        call!(self.restore, self.pointer, state)
    }

    fn forget(&self, state: &mut Opaque) -> Status {
        call!(self.forget, self.pointer, state)
    }
}

impl Drop for Two {
    fn drop(&mut self) {
        call!(self.free, self.pointer);
    }
}

/// FMI 3.0.
pub struct Three {
    pointer: Opaque,
    free: unsafe extern "C" fn(Opaque),
    step: unsafe extern "C" fn(Opaque, f64, f64, u8, *mut u8, *mut u8, *mut u8, *mut f64) -> Status,
    get: unsafe extern "C" fn(Opaque, *const u32, usize, *mut f64, usize) -> Status,
    set: unsafe extern "C" fn(Opaque, *const u32, usize, *const f64, usize) -> Status,
    save: WithStatePlace,
    restore: WithState,
    forget: WithStatePlace,
}

impl Calls for Three {
    const VERSION: &'static str = "3.0";

    fn ready(library: &Library, token: &str, u: &[f64]) -> Self {
        type Enter = unsafe extern "C" fn(Opaque, u8, f64, f64, u8, f64) -> Status;
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            *const c_char,
            *const c_char,
            u8,
            u8,
            u8,
            u8,
            *const u32,
            usize,
            Opaque,
            *const c_void,
            *const c_void,
        ) -> Opaque;
        let token = CString::new(token).expect("no zero byte");
        let instantiate: Instantiate = function!(library, "fmi3InstantiateCoSimulation");
        let (name, nothing) = (c"name".as_ptr(), null());
        let pointer = call!(
            instantiate,
            name,
            token.as_ptr(),
            null(),
            0,
            0,
            0,
            0,
            null(),
            0,
            null_mut(),
            nothing,
            nothing
        );
        assert!(!pointer.is_null(), "the token is right");
        let made = Self {
            pointer,
            free: function!(library, "fmi3FreeInstance"),
            step: function!(library, "fmi3DoStep"),
            get: function!(library, "fmi3GetFloat64"),
            set: function!(library, "fmi3SetFloat64"),
            save: function!(library, "fmi3GetFMUState"),
            restore: function!(library, "fmi3SetFMUState"),
            forget: function!(library, "fmi3FreeFMUState"),
        };
        let enter: Enter = function!(library, "fmi3EnterInitializationMode");
        let exit: Plain = function!(library, "fmi3ExitInitializationMode");
        let statuses = [
            call!(enter, pointer, 0, 0.0, 0.0, 0, 0.0),
            made.set(&INPUTS, u),
            call!(exit, pointer),
        ];
        assert_eq!(statuses, [Status::Ok; 3]);
        made
    }

    fn step(&self, time: f64, step: f64) -> Status {
        let (mut event, mut terminate, mut early, mut reached) = (0, 0, 0, 0.0);
        call!(
            self.step,
            self.pointer,
            time,
            step,
            1,
            &mut event,
            &mut terminate,
            &mut early,
            &mut reached
        )
    }

    fn get(&self, references: &[u32], values: &mut [f64]) -> Status {
        let (count, length) = (references.len(), values.len());
        call!(
            self.get,
            self.pointer,
            references.as_ptr(),
            count,
            values.as_mut_ptr(),
            length
        )
    }

    fn set(&self, references: &[u32], values: &[f64]) -> Status {
        let (count, length) = (references.len(), values.len());
        call!(
            self.set,
            self.pointer,
            references.as_ptr(),
            count,
            values.as_ptr(),
            length
        )
    }

    fn save(&self, state: &mut Opaque) -> Status {
        call!(self.save, self.pointer, state)
    }

    fn restore(&self, state: Opaque) -> Status {
        call!(self.restore, self.pointer, state)
    }

    fn forget(&self, state: &mut Opaque) -> Status {
        call!(self.forget, self.pointer, state)
    }
}

impl Drop for Three {
    fn drop(&mut self) {
        call!(self.free, self.pointer);
    }
}

/// Token that the model in Rust takes, as its model description would say it.
pub fn token(model: &ModelType) -> String {
    let info = (model.info)();
    let structure = StructuralParameters::defaults(&info);
    token::write(&info, &structure, &(model.variables)(&structure), false)
}

/// Token that the model in C takes.
pub const TOKEN_IN_C: &str = "{ten-reals}";
