//! An importer that listens: what intermediate updates report to it, and what it does then.

use std::cell::{Cell, RefCell};
use std::ffi::c_char;
use std::ptr::null;

use fmi_component::Importer;
use fmi_component::TIME_REFERENCE;
use fmi_component::c_api::Opaque;
use fmi_component::c_api::Status::{self, Ok};
use fmi_component::c_api::{Boolean, IntermediateUpdate};
use oscillators::fmi3::*;

use crate::client::{Client, Log, log3, reference, token};

/// Raised by m g / k, so that body 1 swings about height zero.
pub const RAISED: &[(&str, f64)] = &[("frame.position", 9.8e-3)];
pub const EARLY: Importer = Importer {
    event_mode: false,
    early_return: true,
};

pub type React = Box<dyn Fn(&Listener, f64) -> Option<f64>>;

/// What the callback does with a time: it may ask for the step to end at another.
#[derive(Default)]
pub struct Listener {
    pub pointer: Cell<Opaque>,
    react: Option<React>,
    pub reported: RefCell<Vec<(f64, bool)>>,
    pub log: Log,
}

/// An instance that reports its events, in step mode unless it uses event mode.
pub struct ListeningClient {
    pub client: Client,
    pub listener: Box<Listener>,
}

pub unsafe extern "C" fn update(
    environment: Opaque,
    time: f64,
    set: Boolean,
    get: Boolean,
    finished: Boolean,
    can_return_early: Boolean,
    early_return: *mut Boolean,
    until: *mut f64,
) {
    let listener = unsafe { &*environment.cast::<Listener>() };
    assert_eq!((set, get, finished), (0, 1, 1));
    unsafe { assert_eq!((*early_return, *until), (0, time)) };
    listener.reported.borrow_mut().push((time, can_return_early == 1));
    if let Some(wanted) = listener.react.as_ref().and_then(|react| react(listener, time)) {
        unsafe { (*early_return, *until) = (1, wanted) };
    }
}

pub fn instantiate(
    listener: &Listener,
    importer: Importer,
    required: (*const u32, usize),
    callback: Option<IntermediateUpdate>,
) -> Opaque {
    let (events, early) = (u8::from(importer.event_mode), u8::from(importer.early_return));
    let environment = std::ptr::from_ref(listener).cast_mut().cast();
    let (references, count) = required;
    unsafe {
        fmi3InstantiateCoSimulation(
            c"oscillators".as_ptr(),
            token().as_ptr(),
            null(),
            0,
            1,
            events,
            early,
            references,
            count,
            environment,
            Some(keep),
            callback,
        )
    }
}

pub unsafe extern "C" fn keep(environment: Opaque, status: i32, category: *const c_char, message: *const c_char) {
    let listener = unsafe { &*environment.cast::<Listener>() };
    let log = std::ptr::from_ref(&listener.log).cast_mut().cast();
    unsafe { log3(log, status, category, message) };
}

impl Listener {
    pub fn last_message(&self) -> String {
        self.log
            .borrow()
            .last()
            .map(|entry| entry.2.clone())
            .unwrap_or_default()
    }

    pub fn times(&self) -> Vec<f64> {
        self.reported.borrow().iter().map(|(time, _)| *time).collect()
    }

    pub fn real(&self, reference: u32) -> (Status, f64) {
        let mut value = f64::NAN;
        (
            unsafe { fmi3GetFloat64(self.pointer.get(), &reference, 1, &mut value, 1) },
            value,
        )
    }
}

impl ListeningClient {
    pub fn new(importer: Importer, parameters: &[(&str, f64)], react: Option<React>) -> Self {
        let listener = Box::new(Listener {
            react,
            ..Listener::default()
        });
        let required = [reference("frame.reaction_force"), TIME_REFERENCE];
        let pointer = instantiate(&listener, importer, (required.as_ptr(), 2), Some(update));
        listener.pointer.set(pointer);
        let client = Client::of(pointer).ready(&[RAISED, parameters].concat());
        Self { client, listener }
    }

    pub fn reacting(react: impl Fn(&Listener, f64) -> Option<f64> + 'static) -> Self {
        Self::new(EARLY, &[], Some(Box::new(react)))
    }
}

/// Times of the events until `end`, by event mode.
pub fn events(end: f64) -> Vec<f64> {
    let importer = Importer {
        event_mode: true,
        ..EARLY
    };
    let client = Client::three_with(&token(), importer).ready(RAISED);
    let (mut time, mut times) = (0.0, Vec::new());
    while time < end {
        assert_eq!(unsafe { fmi3EnterStepMode(client.pointer) }, Ok);
        let (event, _, reached) = client.step_to_event(time, end - time);
        times.extend(event.then_some(reached));
        assert_eq!(unsafe { fmi3EnterEventMode(client.pointer) }, Ok);
        time = reached;
    }
    times
}
