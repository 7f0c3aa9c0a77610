//! A small importer of both versions, of a library that is loaded as an importer loads it.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};

use fmi_component::c_api::{CallbackFunctions, Fmi2Log, Opaque, Status};
use fmi_component::{Causality, Kind, ModelType, StructuralParameters, Variable, token};
use libloading::Library;

/// One library, and what its model description would say.
pub struct Subject {
    pub library: Library,
    pub variables: Vec<Variable>,
    pub token: CString,
    pub events: bool,
}

/// Loads the library of an example of this package, which `cargo test` builds.
pub fn subject(name: &str, model: &ModelType) -> Subject {
    let file = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let tests = std::env::current_exe().unwrap();
    let path = tests.parent().unwrap().with_file_name("examples").join(file);
    let library = unsafe { Library::new(&path) };
    let library = library.unwrap_or_else(|error| panic!("{error}. Build it: cargo test -p reference-models --no-run"));
    let structure = StructuralParameters::defaults(&(model.info)());
    let variables = (model.variables)(&structure);
    let token = token::write(&(model.info)(), &structure, &variables, false);
    Subject {
        library,
        variables,
        token: CString::new(token).unwrap(),
        events: model.events,
    }
}

/// Calls a function of the library by the name and the arguments of the standard.
macro_rules! call {
    ($subject:expr, $name:ident($($argument:expr => $kind:ty),* $(,)?) -> $result:ty) => {{
        let function = unsafe {
            $subject.library.get::<unsafe extern "C" fn($($kind),*) -> $result>(stringify!($name).as_bytes())
        };
        unsafe { function.unwrap()($($argument),*) }
    }};
}
pub(crate) use call;

unsafe extern "C" fn ignore3(_: Opaque, _: c_int, _: *const c_char, message: *const c_char) {
    assert!(unsafe { CStr::from_ptr(message) }.to_str().unwrap().len() > 10);
}

/// Stable Rust defines no variadic function; the log passes no further argument.
unsafe extern "C" fn ignore2(_: Opaque, _: *const c_char, _: c_int, _: *const c_char, message: *const c_char) {
    assert!(unsafe { CStr::from_ptr(message) }.to_str().unwrap().len() > 10);
}

/// An instance, freed when dropped.
pub struct Client<'a> {
    pub subject: &'a Subject,
    pub pointer: Opaque,
    pub three: bool,
    _callbacks: Box<CallbackFunctions>,
}

impl<'a> Client<'a> {
    pub fn new(subject: &'a Subject, three: bool) -> Self {
        let client = Self::make(subject, three, c"name".as_ptr(), subject.token.as_ptr());
        assert!(!client.pointer.is_null());
        client
    }

    /// The pointer is null if the library refuses.
    pub fn make(subject: &'a Subject, three: bool, name: *const c_char, token: *const c_char) -> Self {
        type Plain = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
        let callbacks = Box::new(CallbackFunctions {
            logger: Some(unsafe { std::mem::transmute::<Plain, Fmi2Log>(ignore2) }),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: null_mut(),
        });
        type Log = unsafe extern "C" fn(Opaque, c_int, *const c_char, *const c_char);
        let pointer = match three {
            true => call!(subject, fmi3InstantiateCoSimulation(
                name => *const c_char, token => *const c_char, null() => *const c_char, 0 => u8, 1 => u8, 0 => u8, 0 => u8,
                null() => *const u32, 0 => usize, null_mut() => Opaque, Some(ignore3) => Option<Log>, None => Option<Log>,
            ) -> Opaque),
            false => call!(subject, fmi2Instantiate(
                name => *const c_char, 1 => c_int, token => *const c_char, null() => *const c_char,
                &*callbacks => *const CallbackFunctions, 0 => c_int, 1 => c_int,
            ) -> Opaque),
        };
        Self {
            subject,
            pointer,
            three,
            _callbacks: callbacks,
        }
    }

    pub fn ready(self) -> Self {
        assert_eq!((self.enter(), self.exit()), (Status::Ok, Status::Ok));
        self
    }

    pub fn enter(&self) -> Status {
        self.enter_until(0.0, None)
    }

    /// With a stop time.
    pub fn enter_until(&self, start: f64, stop: Option<f64>) -> Status {
        let (defined, stop) = (stop.is_some(), stop.unwrap_or_default());
        if self.three {
            return call!(self.subject, fmi3EnterInitializationMode(
                self.pointer => Opaque, 0 => u8, 0.0 => f64, start => f64, u8::from(defined) => u8, stop => f64,
            ) -> Status);
        }
        let status = call!(self.subject, fmi2SetupExperiment(
            self.pointer => Opaque, 0 => c_int, 0.0 => f64, start => f64, c_int::from(defined) => c_int, stop => f64,
        ) -> Status);
        match status {
            Status::Ok => call!(self.subject, fmi2EnterInitializationMode(self.pointer => Opaque) -> Status),
            refused => refused,
        }
    }

    pub fn exit(&self) -> Status {
        self.plain("ExitInitializationMode")
    }

    /// A function that takes the instance alone.
    pub fn plain(&self, name: &str) -> Status {
        let name = format!("fmi{}{name}", if self.three { 3 } else { 2 });
        let function = unsafe {
            self.subject
                .library
                .get::<unsafe extern "C" fn(Opaque) -> Status>(name.as_bytes())
        };
        unsafe { function.unwrap()(self.pointer) }
    }

    pub fn step(&self, current: f64, step: f64) -> Status {
        let (mut flags, mut time) = ([7_u8; 3], f64::NAN);
        let [event, terminate, early] = &mut flags;
        match self.three {
            true => call!(self.subject, fmi3DoStep(
                self.pointer => Opaque, current => f64, step => f64, 0 => u8, event => *mut u8, terminate => *mut u8,
                early => *mut u8, &mut time => *mut f64,
            ) -> Status),
            false => call!(self.subject, fmi2DoStep(
                self.pointer => Opaque, current => f64, step => f64, 0 => c_int,
            ) -> Status),
        }
    }

    pub fn get_real(&self, references: *const u32, count: usize, values: *mut f64, length: usize) -> Status {
        match self.three {
            true => call!(self.subject, fmi3GetFloat64(
                self.pointer => Opaque, references => *const u32, count => usize, values => *mut f64, length => usize,
            ) -> Status),
            false => call!(self.subject, fmi2GetReal(
                self.pointer => Opaque, references => *const u32, count => usize, values => *mut f64,
            ) -> Status),
        }
    }

    pub fn set_real(&self, reference: u32, value: f64) -> Status {
        match self.three {
            true => call!(self.subject, fmi3SetFloat64(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &value => *const f64, 1 => usize,
            ) -> Status),
            false => call!(self.subject, fmi2SetReal(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &value => *const f64,
            ) -> Status),
        }
    }

    pub fn set_text(&self, reference: u32, text: *const c_char) -> Status {
        match self.three {
            true => call!(self.subject, fmi3SetString(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &text => *const *const c_char, 1 => usize,
            ) -> Status),
            false => call!(self.subject, fmi2SetString(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &text => *const *const c_char,
            ) -> Status),
        }
    }

    pub fn text(&self, reference: u32) -> String {
        let mut text: *const c_char = null();
        let status = match self.three {
            true => call!(self.subject, fmi3GetString(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &mut text => *mut *const c_char, 1 => usize,
            ) -> Status),
            false => call!(self.subject, fmi2GetString(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &mut text => *mut *const c_char,
            ) -> Status),
        };
        assert_eq!(status, Status::Ok);
        unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned()
    }

    fn whole(&self, reference: u32, long: bool) -> i64 {
        let (mut narrow, mut wide) = (0_i32, 0_i64);
        let status = match (self.three, long) {
            (true, true) => call!(self.subject, fmi3GetInt64(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &mut wide => *mut i64, 1 => usize,
            ) -> Status),
            (true, false) => call!(self.subject, fmi3GetInt32(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &mut narrow => *mut i32, 1 => usize,
            ) -> Status),
            (false, _) => call!(self.subject, fmi2GetInteger(
                self.pointer => Opaque, &reference => *const u32, 1 => usize, &mut narrow => *mut i32,
            ) -> Status),
        };
        assert_eq!(status, Status::Ok);
        wide + i64::from(narrow)
    }

    /// Outputs of the types that both versions have, as texts with all digits.
    pub fn outputs(&self) -> Vec<String> {
        let outputs = self.subject.variables.iter().zip(1..);
        let outputs = outputs.filter(|(variable, _)| variable.causality == Causality::Output);
        outputs
            .filter_map(|(variable, reference)| match variable.kind {
                Kind::Real(_) => {
                    let mut value = f64::NAN;
                    assert_eq!(
                        self.get_real(&reference, 1, &mut value, 1),
                        Status::Ok,
                        "{}",
                        variable.name
                    );
                    Some(format!("{:016x}", value.to_bits()))
                }
                Kind::Integer { .. } => Some(self.whole(reference, false).to_string()),
                Kind::Long { .. } | Kind::Enumeration { .. } => Some(self.whole(reference, true).to_string()),
                Kind::Text { .. } => Some(self.text(reference)),
                _ => None,
            })
            .collect()
    }

    /// Three steps of 0.4 s from `time`, and what the model shows after each.
    pub fn run(&self, time: f64) -> Vec<Vec<String>> {
        let step = |index: u32| {
            assert_eq!(self.step(time + 0.4 * f64::from(index), 0.4), Status::Ok);
            self.outputs()
        };
        (0..3).map(step).collect()
    }

    /// Reference of the first variable that fits, 1 being the first of all.
    pub fn find(&self, fits: impl Fn(&Variable) -> bool) -> Option<u32> {
        self.subject
            .variables
            .iter()
            .zip(1..)
            .find(|(variable, _)| fits(variable))
            .map(|(_, reference)| reference)
    }

    pub fn save(&self) -> Opaque {
        let mut state = null_mut();
        assert_eq!(self.state_call("GetFMU", &mut state), Status::Ok);
        state
    }

    /// `fmi2GetFMUstate` and its like, which take the address of a state.
    pub fn state_call(&self, name: &str, state: *mut Opaque) -> Status {
        let name = match self.three {
            true => format!("fmi3{name}State"),
            false => format!("fmi2{name}state"),
        };
        type Call = unsafe extern "C" fn(Opaque, *mut Opaque) -> Status;
        let function = unsafe { self.subject.library.get::<Call>(name.as_bytes()) };
        unsafe { function.unwrap()(self.pointer, state) }
    }

    pub fn restore(&self, state: Opaque) -> Status {
        match self.three {
            true => call!(self.subject, fmi3SetFMUState(self.pointer => Opaque, state => Opaque) -> Status),
            false => call!(self.subject, fmi2SetFMUstate(self.pointer => Opaque, state => Opaque) -> Status),
        }
    }

    pub fn bytes(&self, state: Opaque) -> Vec<u8> {
        let mut size = 0;
        let (p, s) = (self.pointer, self.subject);
        let status = match self.three {
            true => {
                call!(s, fmi3SerializedFMUStateSize(p => Opaque, state => Opaque, &mut size => *mut usize) -> Status)
            }
            false => {
                call!(s, fmi2SerializedFMUstateSize(p => Opaque, state => Opaque, &mut size => *mut usize) -> Status)
            }
        };
        assert_eq!(status, Status::Ok);
        let mut bytes = vec![0; size];
        assert_eq!(self.serialize(state, &mut bytes), Status::Ok);
        bytes
    }

    pub fn serialize(&self, state: Opaque, bytes: &mut [u8]) -> Status {
        let (p, s, b, n) = (self.pointer, self.subject, bytes.as_mut_ptr(), bytes.len());
        match self.three {
            true => call!(s, fmi3SerializeFMUState(p => Opaque, state => Opaque, b => *mut u8, n => usize) -> Status),
            false => call!(s, fmi2SerializeFMUstate(p => Opaque, state => Opaque, b => *mut u8, n => usize) -> Status),
        }
    }

    pub fn deserialize(&self, bytes: &[u8]) -> (Status, Opaque) {
        let (p, s, b, n) = (self.pointer, self.subject, bytes.as_ptr(), bytes.len());
        let mut state = null_mut();
        let status = match self.three {
            true => call!(s, fmi3DeserializeFMUState(
                p => Opaque, b => *const u8, n => usize, &mut state => *mut Opaque,
            ) -> Status),
            false => call!(s, fmi2DeSerializeFMUstate(
                p => Opaque, b => *const u8, n => usize, &mut state => *mut Opaque,
            ) -> Status),
        };
        (status, state)
    }
}

impl Drop for Client<'_> {
    fn drop(&mut self) {
        match self.three {
            true => call!(self.subject, fmi3FreeInstance(self.pointer => Opaque) -> ()),
            false => call!(self.subject, fmi2FreeInstance(self.pointer => Opaque) -> ()),
        }
    }
}
