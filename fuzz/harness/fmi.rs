//! Random calls of all functions of both versions of FMI, on a few instances at once.
//!
//! Bytes in, calls out. What is checked beyond what sanitizers see: a call from inside a callback is refused, but for reading
//! inside of an intermediate update; statuses are OK, Discard or Error; an instance that a careless caller has ruined is as
//! a new one after a reset.

use std::cell::Cell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::null_mut;

use super::hand::{Hand, count, report_defects};
use super::library::{Boolean, CallbackFunctions, Fmi2Log, Opaque, Status};

/// An instance as its importer sees it: given to the library as the environment of its callbacks.
pub struct Slot {
    pub pointer: Cell<Opaque>,
    pub three: Cell<bool>,
    /// What its intermediate updates draw from.
    pub mood: Cell<u64>,
    callbacks: Cell<*mut CallbackFunctions>,
}

/// What a run has at hand besides numbers.
pub struct Importer<'a> {
    pub hand: Hand<'a>,
    tokens: &'a [CString],
    /// Each at an address of its own: components keep pointers to them.
    #[allow(clippy::vec_box)]
    pub slots: Vec<Box<Slot>>,
    pub states: [Opaque; 6],
    pub saved: Vec<u8>,
    /// Longest step that is still done in little time \[s\]; longer ones only if the model refuses them at once.
    pub longest_step: f64,
}

/// What a library may be given: the tokens of its model, good and bad texts, and how many variables there are at most.
pub struct Subject {
    tokens: Vec<CString>,
    texts: Vec<CString>,
    pub variables: u32,
}

impl Subject {
    /// A library that takes these tokens.
    pub fn new(tokens: &[String], variables: usize) -> Self {
        let text = |bytes: &[u8]| CString::new(bytes).expect("no zero byte");
        let tokens: Vec<_> = tokens.iter().map(|token| text(token.as_bytes())).collect();
        let words = ["name", "", "logStatusError", "logEvents", "jostle:"].map(|word| text(word.as_bytes()));
        let mut texts = vec![tokens[0].clone(), text(&[0xff, 0xfe])];
        texts.extend(words);
        Self {
            tokens,
            texts,
            variables: variables as u32,
        }
    }
}

impl<'a> Importer<'a> {
    pub fn new(bytes: &'a [u8], subject: &'a Subject, longest_step: f64) -> Self {
        report_defects();
        let slot = || {
            Box::new(Slot {
                pointer: Cell::new(null_mut()),
                three: Cell::new(false),
                mood: Cell::new(0),
                callbacks: Cell::new(null_mut()),
            })
        };
        Self {
            hand: Hand::new(bytes, subject.variables, &subject.texts),
            tokens: &subject.tokens,
            slots: (0..3).map(|_| slot()).collect(),
            states: [null_mut(); 6],
            saved: Vec::new(),
            longest_step,
        }
    }

    /// A token that is right.
    pub fn token(&mut self) -> *const c_char {
        self.tokens[self.hand.below(self.tokens.len())].as_ptr()
    }

    /// One of the instances, or null, or memory that is no instance.
    pub fn instance(&mut self) -> Opaque {
        static NOTHING: [u64; 64] = [0; 64];
        match self.hand.below(32) {
            0 => null_mut(),
            1 => NOTHING.as_ptr().cast_mut().cast(),
            2 => self.slots[0]
                .pointer
                .get()
                .wrapping_byte_add(usize::from(!self.slots[0].pointer.get().is_null())),
            index => self.slots[index % 3].pointer.get(),
        }
    }

    /// A slot with an instance, if there is one.
    pub fn live_slot(&mut self) -> usize {
        let drawn = self.hand.below(3);
        let mut slots = (0..3).map(|offset| (drawn + offset) % 3);
        slots
            .find(|slot| !self.slots[*slot].pointer.get().is_null())
            .unwrap_or(drawn)
    }

    /// A state, stale or foreign ones among them, or a number that is none.
    pub fn state(&mut self) -> Opaque {
        match self.hand.below(8) {
            index if index < 6 => self.states[index],
            6 => std::ptr::without_provenance_mut(self.hand.word() as usize),
            _ => null_mut(),
        }
    }

    /// A step, mostly short.
    pub fn step(&mut self) -> f64 {
        self.hand.duration(self.longest_step)
    }

    pub fn state_slot(&mut self) -> *mut Opaque {
        let index = self.hand.below(6);
        let pointer = &raw mut self.states[index];
        self.hand.spoil(pointer)
    }
}

/// Whether a status is one that this library gives.
pub fn check(status: Status) {
    count();
    check_uncounted(status);
}

/// As [`check`], of a call that is none of the random ones.
pub fn check_uncounted(status: Status) {
    assert!(
        matches!(status, Status::Ok | Status::Discard | Status::Error),
        "{status:?}"
    );
}

/// Reads a log message and calls back from inside the call, which must be refused.
unsafe fn listen(environment: *mut c_void, category: *const c_char, message: *const c_char, three: bool) {
    // SAFETY: the library passes texts and the environment that it was given.
    unsafe {
        assert!(
            CStr::from_ptr(category)
                .to_str()
                .is_ok_and(|text| text.starts_with("log"))
        );
        assert!(CStr::from_ptr(message).to_str().is_ok_and(|text| text.len() > 10));
        let slot = &*environment.cast::<Slot>();
        if slot.pointer.get().is_null() || slot.three.get() != three {
            return; // instantiation is still under way, or this slot has been given to another instance
        }
        CALL_BACK.with(|call| {
            if let Some(call) = call.get() {
                assert_eq!(call(slot), Status::Error, "a call from inside a callback");
            }
        });
    }
}

/// What a callback calls back.
type CallBack = unsafe fn(&Slot) -> Status;

/// What an intermediate update does with an instance and the reported time.
type LookInside = unsafe fn(&Slot, f64);

thread_local! {
    pub static CALL_BACK: Cell<Option<CallBack>> = const { Cell::new(None) };
    pub static OBSERVE_INSIDE: Cell<Option<LookInside>> = const { Cell::new(None) };
}

/// Observes an event inside of a step, and may want to end the step, at odd times too.
pub unsafe extern "C" fn update3(
    environment: *mut c_void,
    time: f64,
    set: Boolean,
    get: Boolean,
    finished: Boolean,
    early: Boolean,
    wanted: *mut Boolean,
    until: *mut f64,
) {
    // SAFETY: the library passes the environment that it was given, and two values to be written.
    let (slot, wanted, until) = unsafe { (&*environment.cast::<Slot>(), &mut *wanted, &mut *until) };
    assert_eq!((set, get, finished, *wanted, *until), (0, 1, 1, 0, time));
    assert!(time.is_finite() && early <= 1);
    OBSERVE_INSIDE.with(|observe| {
        if let Some(observe) = observe.get() {
            // SAFETY: the instance is alive, since it calls.
            unsafe { observe(slot, time) };
        }
    });
    let odd = [
        0.0,
        time,
        time.next_up(),
        time + 1e-4,
        1e300,
        -1e300,
        f64::NAN,
        f64::INFINITY,
    ];
    *until = odd[slot.draw(odd.len())];
    *wanted = [0, 0, 0, 0, 1, 255][slot.draw(6)];
}

pub unsafe extern "C" fn log3(environment: *mut c_void, _: c_int, category: *const c_char, message: *const c_char) {
    // SAFETY: passed on.
    unsafe { listen(environment, category, message, true) }
}

unsafe extern "C" fn log2(
    environment: *mut c_void,
    name: *const c_char,
    _: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: passed on.
    unsafe {
        assert!(CStr::from_ptr(name).to_str().is_ok());
        listen(environment, category, message, false);
    }
}

impl Slot {
    /// A number below `end`: the bytes of the input are not at hand inside of a call.
    pub fn draw(&self, end: usize) -> usize {
        let next = self.mood.get().wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        self.mood.set(next);
        (next >> 33) as usize % end
    }

    pub fn environment(&self) -> Opaque {
        std::ptr::from_ref(self).cast_mut().cast()
    }

    /// Callbacks of FMI 2.0, alive as long as the instance.
    pub fn callbacks(&self) -> *mut CallbackFunctions {
        type Plain = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
        self.drop_callbacks();
        let callbacks = Box::new(CallbackFunctions {
            // SAFETY: the library passes no further argument, so that a variadic function is called alike.
            logger: Some(unsafe { std::mem::transmute::<Plain, Fmi2Log>(log2) }),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: self.environment(),
        });
        self.callbacks.set(Box::into_raw(callbacks));
        self.callbacks.get()
    }

    pub fn drop_callbacks(&self) {
        let old = self.callbacks.replace(null_mut());
        if !old.is_null() {
            // SAFETY: made by `Box::into_raw` above.
            drop(unsafe { Box::from_raw(old) });
        }
    }
}
