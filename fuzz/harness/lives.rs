//! What a careful importer does in its order: instances made, initialised, stepped, carried over and freed, and what their
//! callbacks do. `super::library` says which library is called.

use std::ptr::{null, null_mut};

use super::fmi::{Importer, Slot, check, log3, update3};
use super::hand::*;
use super::library::fmi2::*;
use super::library::fmi3::*;
use super::library::{IntermediateUpdate, Opaque, Status};

type Call = fn(&mut Importer);

/// Variables to be reported in intermediate updates.
const REQUIRED: [u32; 1] = [1];

/// Calls that must come in an order to get anywhere, more often than each single one.
pub const LIVES: &[Call] = &[
    instantiate,
    initialize,
    begin,
    begin,
    walk,
    walk,
    walk,
    walk,
    walk,
    carry,
    refuse,
    free,
    set_up,
    set_up,
];

/// From inside a callback.
pub unsafe fn call_back(slot: &Slot) -> Status {
    count_inside();
    // SAFETY: the instance is alive, since it calls.
    unsafe {
        if slot.three.get() {
            fmi3FreeInstance(slot.pointer.get());
            fmi3Reset(slot.pointer.get())
        } else {
            fmi2FreeInstance(slot.pointer.get());
            fmi2Reset(slot.pointer.get())
        }
    }
}

/// From inside an intermediate update: values may be read, anything else is refused.
pub unsafe fn observe_inside(slot: &Slot, time: f64) {
    let pointer = slot.pointer.get();
    let (mut value, mut state, mut flags) = (f64::NAN, null_mut(), [0_u8; 3]);
    let [event, terminate, early] = &mut flags;
    // SAFETY: the instance is alive, since it calls, and cannot be freed now; one reference, one value.
    unsafe {
        count_inside();
        let refused = match slot.draw(9) {
            0 => {
                fmi3FreeInstance(pointer);
                return;
            }
            1 => fmi3Reset(pointer),
            2 => fmi3DoStep(pointer, time, 1e-3, 0, event, terminate, early, &mut value),
            3 => fmi3GetFMUState(pointer, &mut state),
            4 => fmi3SetFMUState(pointer, slot.draw(8) as Opaque),
            5 => fmi3SetFloat64(pointer, &(slot.draw(40) as u32), 1, &0.1, 1),
            6 => fmi3Terminate(pointer),
            7 => {
                let reference = slot.draw(40) as u32;
                check(fmi3GetFloat64(pointer, &reference, 1, &mut value, 1));
                return check(fmi3GetOutputDerivatives(pointer, &reference, 1, &1, &mut value, 1));
            }
            _ => {
                check(fmi3GetFloat64(pointer, &0, 1, &mut value, 1));
                return assert_eq!(value, time, "the time of an intermediate update");
            }
        };
        assert_eq!(refused, Status::Error, "inside of an intermediate update");
    }
}

pub fn release(slot: &Slot, as_three: bool) {
    count();
    let pointer = slot.pointer.get();
    // The other version's function leaves the instance alone.
    if as_three == slot.three.get() {
        slot.pointer.set(null_mut());
    }
    // SAFETY: null or alive.
    unsafe {
        if as_three {
            fmi3FreeInstance(pointer)
        } else {
            fmi2FreeInstance(pointer)
        }
    }
}

fn free(importer: &mut Importer) {
    let (index, as_three) = (importer.hand.below(3), importer.hand.rarely(2));
    release(&importer.slots[index], as_three);
}

/// Makes an instance where there is none.
fn instantiate(importer: &mut Importer) {
    count();
    let (index, kind) = (importer.hand.below(3), importer.hand.below(16));
    if !importer.slots[index].pointer.get().is_null() {
        return;
    }
    let token = if importer.hand.rarely(16) {
        importer.hand.text()
    } else {
        importer.token()
    };
    let name = if importer.hand.rarely(16) {
        importer.hand.text()
    } else {
        c"name".as_ptr()
    };
    // One bit of each says yes or no; the others say whether the instance reports events, and what is done then.
    let [logs, events, early] = [(); 3].map(|()| importer.hand.byte());
    let wanted = usize::from(importer.hand.rarely(16));
    let references = if early & 2 == 0 { null() } else { REQUIRED.as_ptr() };
    let update = (logs & 2 != 0).then_some(update3 as IntermediateUpdate);
    let slot = &importer.slots[index];
    slot.three.set(kind >= 6);
    slot.mood.set(u64::from_be_bytes([0, 0, 0, 0, 0, logs, events, early]));
    let environment = slot.environment();
    // SAFETY: texts are null or end with a zero byte; callbacks and environment outlive the instance.
    let pointer = unsafe {
        match kind {
            0 => fmi2Instantiate(name, 0, token, null(), slot.callbacks(), 0, 1),
            1 => fmi2Instantiate(name, 1, token, null(), null(), 0, 1),
            2..6 => fmi2Instantiate(name, 1, token, null(), slot.callbacks(), 0, i32::from(logs & 1)),
            6 => fmi3InstantiateModelExchange(name, token, null(), 0, 1, environment, Some(log3)),
            7 => fmi3InstantiateScheduledExecution(name, token, null(), 0, 1, environment, None, None, None, None),
            _ => fmi3InstantiateCoSimulation(
                name,
                token,
                null(),
                0,
                logs & 1,
                events & 1,
                early & 1,
                references,
                wanted,
                environment,
                Some(log3),
                update,
            ),
        }
    };
    slot.pointer.set(pointer);
}

/// An instance from its making to its first step, with up to three parameters set, as a careful importer does it.
pub fn begin(importer: &mut Importer) {
    instantiate(importer);
    for _ in 0..importer.hand.below(4) {
        set_up(importer);
    }
    initialize(importer);
}

/// Changes a parameter or an input of one instance by a factor, so that it is still valid for the most part.
fn set_up(importer: &mut Importer) {
    const FACTORS: [f64; 8] = [1.1, 0.9, 1.01, 0.5, 2.0, 0.0, -1.0, 1e3];
    let slot = importer.live_slot();
    let (reference, factor) = (importer.hand.reference(), FACTORS[importer.hand.below(FACTORS.len())]);
    let (pointer, three) = (importer.slots[slot].pointer.get(), importer.slots[slot].three.get());
    let mut value = 0.0;
    // SAFETY: null or alive; one reference, one value.
    unsafe {
        if three {
            check(fmi3GetFloat64(pointer, &reference, 1, &mut value, 1));
            check(fmi3SetFloat64(pointer, &reference, 1, &(factor * value), 1));
        } else {
            check(fmi2GetReal(pointer, &reference, 1, &mut value));
            check(fmi2SetReal(pointer, &reference, 1, &(factor * value)));
        }
    }
}

fn initialize(importer: &mut Importer) {
    let slot = importer.live_slot();
    let start = if importer.hand.rarely(4) {
        importer.hand.real()
    } else {
        0.0
    };
    let (pointer, three) = (importer.slots[slot].pointer.get(), importer.slots[slot].three.get());
    // SAFETY: null or alive.
    unsafe {
        if three {
            check(fmi3EnterInitializationMode(pointer, 0, 0.0, start, 0, 0.0));
            check(fmi3ExitInitializationMode(pointer));
            check(fmi3EnterStepMode(pointer));
        } else {
            check(fmi2SetupExperiment(pointer, 0, 0.0, start, 0, 0.0));
            check(fmi2EnterInitializationMode(pointer));
            check(fmi2ExitInitializationMode(pointer));
        }
    }
}

/// Steps on from where an instance is, through event mode if there was an event. (FMI 2.0 reports the time by the independent variable as well.)
fn walk(importer: &mut Importer) {
    let (slot, step) = (importer.live_slot(), importer.step());
    let (pointer, three) = (importer.slots[slot].pointer.get(), importer.slots[slot].three.get());
    let (mut now, mut reached, mut flags) = (0.0, 0.0, [0_u8; 3]);
    let [event, terminate, early] = &mut flags;
    // SAFETY: null or alive; one reference, one value.
    unsafe {
        if three {
            check(fmi3GetFloat64(pointer, &0, 1, &mut now, 1));
            let status = fmi3DoStep(pointer, now, step, 0, event, terminate, early, &mut reached);
            check(status);
            count_step(status == Status::Ok);
            if flags[0] != 0 {
                let [mut update, mut end, mut nominals, mut states, mut next] = [0_u8; 5];
                check(fmi3EnterEventMode(pointer));
                check(fmi3UpdateDiscreteStates(
                    pointer,
                    &mut update,
                    &mut end,
                    &mut nominals,
                    &mut states,
                    &mut next,
                    &mut reached,
                ));
                check(fmi3EnterStepMode(pointer));
            }
        } else {
            check(fmi2GetReal(pointer, &0, 1, &mut now));
            let status = fmi2DoStep(pointer, now, step, 0);
            check(status);
            count_step(status == Status::Ok);
        }
    }
}

/// Saves one instance as bytes, damages them, brings them to another.
fn carry(importer: &mut Importer) {
    let (from, to) = (importer.instance(), importer.instance());
    let (mut state, mut size) = (null_mut(), 0);
    // SAFETY: null, alive or memory that is none; the bytes are as many as said.
    unsafe {
        check(fmi3GetFMUState(from, &mut state));
        check(fmi3SerializedFMUStateSize(from, state, &mut size));
        if size > 0 {
            importer.saved = vec![0; size];
            check(fmi3SerializeFMUState(from, state, importer.saved.as_mut_ptr(), size));
        }
        check(fmi3FreeFMUState(from, &mut state));
        let mut bytes = importer.saved.clone();
        importer.hand.damage(&mut bytes);
        let mut state = null_mut();
        check(fmi3DeserializeFMUState(to, bytes.as_ptr(), bytes.len(), &mut state));
        check(fmi3SetFMUState(to, state));
        check(fmi3FreeFMUState(to, &mut state));
    }
}

/// Functions that answer without an instance.
fn refuse(importer: &mut Importer) {
    count();
    let three = importer.hand.rarely(2);
    // SAFETY: the texts are the library's own.
    let text = unsafe {
        let _ = fmi2GetTypesPlatform();
        std::ffi::CStr::from_ptr(if three { fmi3GetVersion() } else { fmi2GetVersion() })
    };
    assert_eq!(text.to_bytes(), if three { b"3.0" } else { b"2.0" });
}
