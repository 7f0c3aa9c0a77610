//! A small importer of both versions that keeps the log.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};

use fmi_component::Importer;
use fmi_component::c_api::CallbackFunctions;
use fmi_component::c_api::{Opaque, Status};
use fmi_component::{ModelType, StructuralParameters, Variable, token, value_reference};
use oscillators::Oscillators;
use oscillators::fmi2::*;
use oscillators::fmi3::*;

pub const MODEL: ModelType = ModelType::of::<Oscillators>();
pub type Log = RefCell<Vec<(c_int, String, String)>>;

pub fn variables() -> Vec<Variable> {
    (MODEL.variables)(&StructuralParameters::defaults(&(MODEL.info)()))
}

pub fn token() -> CString {
    token_of(&MODEL, false)
}

pub fn token_of(model: &ModelType, arrays: bool) -> CString {
    let info = (model.info)();
    let structure = StructuralParameters::defaults(&info);
    CString::new(token::write(&info, &structure, &(model.variables)(&structure), arrays)).unwrap()
}

pub fn reference(name: &str) -> u32 {
    let position = variables().iter().position(|row| row.name == name).unwrap();
    value_reference(position)
}

unsafe fn keep(environment: *mut c_void, status: c_int, category: *const c_char, message: *const c_char) {
    let text = |pointer| unsafe { CStr::from_ptr(pointer) }.to_str().unwrap().to_owned();
    let log = unsafe { &*environment.cast::<Log>() };
    log.borrow_mut().push((status, text(category), text(message)));
}

pub unsafe extern "C" fn log3(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    unsafe { keep(environment, status, category, message) }
}

/// Stable Rust cannot define a variadic function; the log passes no further argument, so that this one is called alike.
unsafe extern "C" fn log2(
    environment: *mut c_void,
    name: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    assert_eq!(unsafe { CStr::from_ptr(name) }, c"oscillators");
    unsafe { keep(environment, status, category, message) }
}

pub fn callbacks2(log: &Log) -> CallbackFunctions {
    type Plain = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
    CallbackFunctions {
        logger: Some(unsafe { std::mem::transmute::<Plain, fmi_component::c_api::Fmi2Log>(log2) }),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: std::ptr::from_ref(log).cast_mut().cast(),
    }
}

/// One instance of FMI 3.0 (or 2.0), freed when dropped.
pub struct Client {
    pub pointer: Opaque,
    pub three: bool,
    pub log: Box<Log>,
    _callbacks: Option<Box<CallbackFunctions>>,
}

impl Client {
    pub fn three() -> Self {
        Self::three_with(&token(), Importer::default())
    }

    /// With logging on for errors.
    pub fn three_with(token: &CStr, importer: Importer) -> Self {
        let client = Self::silent(token, importer);
        let categories = [c"logStatusError".as_ptr(), c"logStatusDiscard".as_ptr()];
        unsafe { fmi3SetDebugLogging(client.pointer, 1, 2, categories.as_ptr()) };
        client
    }

    /// As instantiated without logging.
    pub fn silent(token: &CStr, importer: Importer) -> Self {
        let log = Box::new(Log::default());
        let environment = std::ptr::from_ref(&*log).cast_mut().cast();
        let pointer = unsafe {
            fmi3InstantiateCoSimulation(
                c"oscillators".as_ptr(),
                token.as_ptr(),
                null(),
                0,
                0,
                u8::from(importer.event_mode),
                u8::from(importer.early_return),
                null(),
                0,
                environment,
                Some(log3),
                None,
            )
        };
        Self {
            pointer,
            three: true,
            log,
            _callbacks: None,
        }
    }

    /// Of an instance of FMI 3.0 that was made elsewhere, with a log of its own.
    pub fn of(pointer: Opaque) -> Self {
        Self {
            pointer,
            three: true,
            log: Box::default(),
            _callbacks: None,
        }
    }

    pub fn two() -> Self {
        let log = Box::new(Log::default());
        let callbacks = Box::new(callbacks2(&log));
        let pointer =
            unsafe { fmi2Instantiate(c"oscillators".as_ptr(), 1, token().as_ptr(), null(), &*callbacks, 0, 0) };
        Self {
            pointer,
            three: false,
            log,
            _callbacks: Some(callbacks),
        }
    }

    /// Instantiated, set to `parameters`, initialised at time 0.
    pub fn ready(self, parameters: &[(&str, f64)]) -> Self {
        assert!(!self.pointer.is_null(), "{:?}", self.log);
        for (name, value) in parameters {
            assert_eq!(self.set(name, *value), Status::Ok, "{:?}", self.log);
        }
        assert_eq!(self.enter(), Status::Ok);
        assert_eq!(self.exit(), Status::Ok, "{:?}", self.log);
        self
    }

    pub fn enter(&self) -> Status {
        match self.three {
            true => unsafe { fmi3EnterInitializationMode(self.pointer, 0, 0.0, 0.0, 0, 0.0) },
            false => unsafe {
                assert_eq!(fmi2SetupExperiment(self.pointer, 0, 0.0, 0.0, 0, 0.0), Status::Ok);
                fmi2EnterInitializationMode(self.pointer)
            },
        }
    }

    pub fn exit(&self) -> Status {
        match self.three {
            true => unsafe { fmi3ExitInitializationMode(self.pointer) },
            false => unsafe { fmi2ExitInitializationMode(self.pointer) },
        }
    }

    pub fn set(&self, name: &str, value: f64) -> Status {
        match self.three {
            true => unsafe { fmi3SetFloat64(self.pointer, &reference(name), 1, &value, 1) },
            false => unsafe { fmi2SetReal(self.pointer, &reference(name), 1, &value) },
        }
    }

    pub fn get(&self, name: &str) -> (Status, f64) {
        let mut value = f64::NAN;
        let status = match self.three {
            true => unsafe { fmi3GetFloat64(self.pointer, &reference(name), 1, &mut value, 1) },
            false => unsafe { fmi2GetReal(self.pointer, &reference(name), 1, &mut value) },
        };
        (status, value)
    }

    pub fn step(&self, current: f64, step: f64) -> Status {
        let (mut flags, mut time) = ([7_u8; 3], f64::NAN);
        let [event, terminate, early] = &mut flags;
        match self.three {
            true => {
                let status = unsafe { fmi3DoStep(self.pointer, current, step, 0, event, terminate, early, &mut time) };
                assert_eq!(flags, [0; 3], "every flag is set, whatever the status");
                assert!(time.is_finite());
                status
            }
            false => unsafe { fmi2DoStep(self.pointer, current, step, 0) },
        }
    }

    /// A step of FMI 3.0 that may end early: event handling needed, early return, last successful time.
    pub fn step_to_event(&self, current: f64, step: f64) -> (bool, bool, f64) {
        let (mut flags, mut time) = ([7_u8; 3], f64::NAN);
        let [event, terminate, early] = &mut flags;
        let status = unsafe { fmi3DoStep(self.pointer, current, step, 0, event, terminate, early, &mut time) };
        assert_eq!(status, Status::Ok, "{:?}", self.log);
        assert!(flags.iter().all(|flag| *flag <= 1) && flags[1] == 0, "{flags:?}");
        (flags[0] == 1, flags[2] == 1, time)
    }

    /// Steps `first..last` of length `step` with a base that moves; what it shows after each.
    pub fn run(&self, (first, last): (u32, u32), step: f64) -> Vec<u64> {
        (first..last)
            .flat_map(|index| {
                let time = f64::from(index) * step;
                assert_eq!(self.set("frame.position", 1e-3 * (30.0 * time).sin()), Status::Ok);
                assert_eq!(self.set("frame.velocity", 3e-2 * (30.0 * time).cos()), Status::Ok);
                assert_eq!(self.step(time, step), Status::Ok, "{:?}", self.log);
                self.outputs()
            })
            .collect()
    }

    /// Bits of all real outputs.
    pub fn outputs(&self) -> Vec<u64> {
        let names = [
            "frame.reaction_force",
            "body.position[1]",
            "body.position[2]",
            "body.position[3]",
        ];
        names
            .map(|name| self.get(name))
            .map(|(status, value)| {
                assert_eq!(status, Status::Ok, "{:?}", self.log);
                value.to_bits()
            })
            .into()
    }

    pub fn save(&self) -> Opaque {
        let mut state = null_mut();
        let status = match self.three {
            true => unsafe { fmi3GetFMUState(self.pointer, &mut state) },
            false => unsafe { fmi2GetFMUstate(self.pointer, &mut state) },
        };
        assert_eq!(status, Status::Ok, "{:?}", self.log);
        state
    }

    pub fn restore(&self, state: Opaque) -> Status {
        match self.three {
            true => unsafe { fmi3SetFMUState(self.pointer, state) },
            false => unsafe { fmi2SetFMUstate(self.pointer, state) },
        }
    }

    pub fn reset(&self) -> Status {
        match self.three {
            true => unsafe { fmi3Reset(self.pointer) },
            false => unsafe { fmi2Reset(self.pointer) },
        }
    }

    pub fn bytes(&self, state: Opaque) -> Vec<u8> {
        let mut size = 0;
        assert_eq!(
            unsafe { fmi3SerializedFMUStateSize(self.pointer, state, &mut size) },
            Status::Ok
        );
        let mut bytes = vec![0; size];
        assert_eq!(
            unsafe { fmi3SerializeFMUState(self.pointer, state, bytes.as_mut_ptr(), size) },
            Status::Ok
        );
        bytes
    }

    pub fn deserialize(&self, bytes: &[u8]) -> (Status, Opaque) {
        let mut state = null_mut();
        let status = unsafe { fmi3DeserializeFMUState(self.pointer, bytes.as_ptr(), bytes.len(), &mut state) };
        (status, state)
    }

    pub fn last_message(&self) -> String {
        self.log
            .borrow()
            .last()
            .map(|(_, _, message)| message.clone())
            .unwrap_or_default()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        match self.three {
            true => unsafe { fmi3FreeInstance(self.pointer) },
            false => unsafe { fmi2FreeInstance(self.pointer) },
        }
    }
}
