//! Whether a saved state brings back the same answers, wherever a run of random calls has left the instances.
//!
//! The instance itself is the oracle: after it has gone back, by the state and by its bytes, it must have the same bytes, answer with the
//! same numbers, and take the same step to the same bytes. The bytes hold all that the model remembers, texts included. These calls are not counted: the
//! random ones are.

use std::ptr::null_mut;

use super::fmi::{CALL_BACK, Importer, Slot, check_uncounted as check};
use super::library::fmi2::*;
use super::library::fmi3::*;
use super::library::{Opaque, Status};

/// What can be seen of an instance: the bytes of its state, none after a panic of the model, and each real, or the status that was given
/// instead.
#[derive(Debug, PartialEq)]
struct Seen {
    bytes: Option<Vec<u8>>,
    reals: Vec<Result<u64, Status>>,
}

/// Saves each instance, steps, goes back and steps again; `step` \[s\] is what is asked for.
pub fn rewind(importer: &mut Importer, variables: u32) {
    CALL_BACK.set(None); // the log is read, and nothing called from there
    let step = importer.step();
    for slot in importer.slots.iter().filter(|slot| !slot.pointer.get().is_null()) {
        if let Some(state) = save(slot) {
            there_and_back(slot, state, step, variables);
            forget(slot, state);
        }
    }
}

fn there_and_back(slot: &Slot, state: Opaque, step: f64, variables: u32) {
    let mood = slot.mood.get();
    let before = see(slot, variables);
    let (first, after) = (advance(slot, step), see(slot, variables));
    let copy = from_bytes(slot, before.bytes.as_deref().expect("it was saved before"));
    for state in [state, copy] {
        assert_eq!(restore(slot, state), Status::Ok, "a state of this instance");
        slot.mood.set(mood);
        assert_eq!(see(slot, variables), before, "back to {state:?}");
        assert_eq!(restore(slot, state), Status::Ok, "a state of this instance");
        assert_eq!(advance(slot, step), first, "the same step of {step} s again");
        assert_eq!(see(slot, variables), after, "after the same step of {step} s again");
    }
    forget(slot, copy);
}

/// The state first, since reading in initialization mode may build a model.
fn see(slot: &Slot, variables: u32) -> Seen {
    let bytes = save(slot).map(|state| {
        let bytes = to_bytes(slot, state);
        forget(slot, state);
        bytes
    });
    let reals = (0..=variables).map(|reference| read(slot, reference)).collect();
    Seen { bytes, reals }
}

fn read(slot: &Slot, reference: u32) -> Result<u64, Status> {
    let (pointer, mut value) = (slot.pointer.get(), f64::NAN);
    // SAFETY: alive; one reference, one value.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3GetFloat64(pointer, &reference, 1, &mut value, 1),
            false => fmi2GetReal(pointer, &reference, 1, &mut value),
        }
    };
    check(status);
    match status {
        Status::Ok => Ok(value.to_bits()),
        refused => Err(refused),
    }
}

/// Whether a step from the present time is done, and what it reports. (One that is refused is an error, and not discarded, if it was refused
/// before; going back forgets that.)
fn advance(slot: &Slot, step: f64) -> (bool, [u8; 3], u64) {
    let (pointer, mut flags, mut reached) = (slot.pointer.get(), [0_u8; 3], 0.0);
    let now = read(slot, 0).map_or(0.0, f64::from_bits);
    let [event, terminate, early] = &mut flags;
    // SAFETY: alive; living flags.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3DoStep(pointer, now, step, 0, event, terminate, early, &mut reached),
            false => fmi2DoStep(pointer, now, step, 0),
        }
    };
    check(status);
    (status == Status::Ok, flags, reached.to_bits())
}

fn save(slot: &Slot) -> Option<Opaque> {
    let (pointer, mut state) = (slot.pointer.get(), null_mut());
    // SAFETY: alive; room for a state.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3GetFMUState(pointer, &mut state),
            false => fmi2GetFMUstate(pointer, &mut state),
        }
    };
    check(status);
    (status == Status::Ok).then_some(state)
}

fn restore(slot: &Slot, state: Opaque) -> Status {
    let pointer = slot.pointer.get();
    // SAFETY: alive.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3SetFMUState(pointer, state),
            false => fmi2SetFMUstate(pointer, state),
        }
    };
    check(status);
    status
}

fn forget(slot: &Slot, mut state: Opaque) {
    let pointer = slot.pointer.get();
    // SAFETY: alive; a state that it saved.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3FreeFMUState(pointer, &mut state),
            false => fmi2FreeFMUstate(pointer, &mut state),
        }
    };
    check(status);
    assert_eq!((status, state), (Status::Ok, null_mut()), "a state that is freed");
}

fn to_bytes(slot: &Slot, state: Opaque) -> Vec<u8> {
    let (pointer, three, mut size) = (slot.pointer.get(), slot.three.get(), 0);
    // SAFETY: alive; the bytes are as many as said.
    unsafe {
        let sized = match three {
            true => fmi3SerializedFMUStateSize(pointer, state, &mut size),
            false => fmi2SerializedFMUstateSize(pointer, state, &mut size),
        };
        check(sized);
        let mut bytes = vec![0; size];
        let written = match three {
            true => fmi3SerializeFMUState(pointer, state, bytes.as_mut_ptr(), size),
            false => fmi2SerializeFMUstate(pointer, state, bytes.as_mut_ptr(), size),
        };
        check(written);
        assert_eq!((sized, written), (Status::Ok, Status::Ok), "the bytes of a state");
        bytes
    }
}

fn from_bytes(slot: &Slot, bytes: &[u8]) -> Opaque {
    let (pointer, mut state) = (slot.pointer.get(), null_mut());
    // SAFETY: alive; the bytes are as many as said.
    let status = unsafe {
        match slot.three.get() {
            true => fmi3DeserializeFMUState(pointer, bytes.as_ptr(), bytes.len(), &mut state),
            false => fmi2DeSerializeFMUstate(pointer, bytes.as_ptr(), bytes.len(), &mut state),
        }
    };
    check(status);
    assert_eq!(status, Status::Ok, "bytes that this instance wrote");
    state
}
