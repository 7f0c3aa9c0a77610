//! The table of all functions of both versions, each with the roles of its arguments, and the few calls that are more than
//! one line. Whoever includes this file says in `super::library` which library is called.

use std::ptr::{null, null_mut};
use std::sync::LazyLock;

use jostle::fmi::abi::common::{Opaque, Status};

use super::fmi::{CALL_BACK, Importer, Slot, Subject, check, log3};
use super::hand::*;
use super::library::fmi2::*;
use super::library::fmi3::*;
use super::library::{LONGEST_STEP, Scene, choices};

/// An argument of a call.
trait Role {
    type Argument;
    fn draw(importer: &mut Importer) -> Self::Argument;
}

impl<D: Draw> Role for D {
    type Argument = D::Argument;
    fn draw(importer: &mut Importer) -> D::Argument {
        D::draw(&mut importer.hand)
    }
}

struct Instance;
impl Role for Instance {
    type Argument = Opaque;
    fn draw(importer: &mut Importer) -> Opaque {
        importer.instance()
    }
}

struct State;
impl Role for State {
    type Argument = Opaque;
    fn draw(importer: &mut Importer) -> Opaque {
        importer.state()
    }
}

struct StateSlot;
impl Role for StateSlot {
    type Argument = *mut Opaque;
    fn draw(importer: &mut Importer) -> *mut Opaque {
        importer.state_slot()
    }
}

struct Step;
impl Role for Step {
    type Argument = f64;
    fn draw(importer: &mut Importer) -> f64 {
        importer.step()
    }
}

type Call = fn(&mut Importer);

macro_rules! table {
    ($($name:ident($($role:ident),*);)*) => {
        const TABLE: &[Call] = &[$(|importer| {
            // SAFETY: instances are null, alive or memory that is none; pointers are as `Hand` promises.
            check(unsafe { $name($(<$role as Role>::draw(importer)),*) });
        }),*];
    };
}

table! {
    fmi2SetDebugLogging(Instance, Whole, Length, Texts);
    fmi2SetupExperiment(Instance, Whole, Real, Real, Whole, Real);
    fmi2EnterInitializationMode(Instance);
    fmi2ExitInitializationMode(Instance);
    fmi2Terminate(Instance);
    fmi2Reset(Instance);
    fmi2GetReal(Instance, References, Length, Reals);
    fmi2GetInteger(Instance, References, Length, Wholes);
    fmi2GetBoolean(Instance, References, Length, Wholes);
    fmi2GetString(Instance, References, Length, Texts);
    fmi2SetReal(Instance, References, Length, Reals);
    fmi2SetInteger(Instance, References, Length, Wholes);
    fmi2SetBoolean(Instance, References, Length, Wholes);
    fmi2SetString(Instance, References, Length, Texts);
    fmi2GetFMUstate(Instance, StateSlot);
    fmi2SetFMUstate(Instance, State);
    fmi2FreeFMUstate(Instance, StateSlot);
    fmi2SerializedFMUstateSize(Instance, State, Sizes);
    fmi2SerializeFMUstate(Instance, State, Bytes, Length);
    fmi2DeSerializeFMUstate(Instance, Bytes, Length, StateSlot);
    fmi2GetDirectionalDerivative(Instance, References, Length, References, Length, Reals, Reals);
    fmi2EnterEventMode(Instance);
    fmi2NewDiscreteStates(Instance, Nothing);
    fmi2EnterContinuousTimeMode(Instance);
    fmi2CompletedIntegratorStep(Instance, Whole, Wholes, Wholes);
    fmi2SetTime(Instance, Real);
    fmi2SetContinuousStates(Instance, Reals, Length);
    fmi2GetDerivatives(Instance, Reals, Length);
    fmi2GetEventIndicators(Instance, Reals, Length);
    fmi2GetContinuousStates(Instance, Reals, Length);
    fmi2GetNominalsOfContinuousStates(Instance, Reals, Length);
    fmi2SetRealInputDerivatives(Instance, References, Length, Wholes, Reals);
    fmi2GetRealOutputDerivatives(Instance, References, Length, Wholes, Reals);
    fmi2DoStep(Instance, Real, Step, Whole);
    fmi2CancelStep(Instance);
    fmi2GetStatus(Instance, Whole, Statuses);
    fmi2GetRealStatus(Instance, Whole, Reals);
    fmi2GetIntegerStatus(Instance, Whole, Wholes);
    fmi2GetBooleanStatus(Instance, Whole, Wholes);
    fmi2GetStringStatus(Instance, Whole, Texts);
    fmi3SetDebugLogging(Instance, Flag, Length, Texts);
    fmi3EnterInitializationMode(Instance, Flag, Real, Real, Flag, Real);
    fmi3ExitInitializationMode(Instance);
    fmi3EnterEventMode(Instance);
    fmi3Terminate(Instance);
    fmi3Reset(Instance);
    fmi3GetFloat32(Instance, References, Length, Singles, Length);
    fmi3GetFloat64(Instance, References, Length, Reals, Length);
    fmi3GetInt8(Instance, References, Length, Tiny, Length);
    fmi3GetUInt8(Instance, References, Length, Bytes, Length);
    fmi3GetInt16(Instance, References, Length, Short, Length);
    fmi3GetUInt16(Instance, References, Length, UnsignedShort, Length);
    fmi3GetInt32(Instance, References, Length, Wholes, Length);
    fmi3GetUInt32(Instance, References, Length, References, Length);
    fmi3GetInt64(Instance, References, Length, Longs, Length);
    fmi3GetUInt64(Instance, References, Length, UnsignedLongs, Length);
    fmi3GetBoolean(Instance, References, Length, Bytes, Length);
    fmi3GetString(Instance, References, Length, Texts, Length);
    fmi3GetBinary(Instance, References, Length, Sizes, NoBinaries, Length);
    fmi3GetClock(Instance, References, Length, Bytes);
    fmi3SetFloat32(Instance, References, Length, Singles, Length);
    fmi3SetFloat64(Instance, References, Length, Reals, Length);
    fmi3SetInt8(Instance, References, Length, Tiny, Length);
    fmi3SetUInt8(Instance, References, Length, Bytes, Length);
    fmi3SetInt16(Instance, References, Length, Short, Length);
    fmi3SetUInt16(Instance, References, Length, UnsignedShort, Length);
    fmi3SetInt32(Instance, References, Length, Wholes, Length);
    fmi3SetUInt32(Instance, References, Length, References, Length);
    fmi3SetInt64(Instance, References, Length, Longs, Length);
    fmi3SetUInt64(Instance, References, Length, UnsignedLongs, Length);
    fmi3SetBoolean(Instance, References, Length, Bytes, Length);
    fmi3SetString(Instance, References, Length, Texts, Length);
    fmi3SetBinary(Instance, References, Length, Sizes, NoBinaries, Length);
    fmi3SetClock(Instance, References, Length, Bytes);
    fmi3GetNumberOfVariableDependencies(Instance, Reference, Sizes);
    fmi3GetVariableDependencies(Instance, Reference, Sizes, References, Sizes, Wholes, Length);
    fmi3GetFMUState(Instance, StateSlot);
    fmi3SetFMUState(Instance, State);
    fmi3FreeFMUState(Instance, StateSlot);
    fmi3SerializedFMUStateSize(Instance, State, Sizes);
    fmi3SerializeFMUState(Instance, State, Bytes, Length);
    fmi3DeserializeFMUState(Instance, Bytes, Length, StateSlot);
    fmi3GetDirectionalDerivative(Instance, References, Length, References, Length, Reals, Length, Reals, Length);
    fmi3GetAdjointDerivative(Instance, References, Length, References, Length, Reals, Length, Reals, Length);
    fmi3EnterConfigurationMode(Instance);
    fmi3ExitConfigurationMode(Instance);
    fmi3GetIntervalDecimal(Instance, References, Length, Reals, Wholes);
    fmi3GetIntervalFraction(Instance, References, Length, UnsignedLongs, UnsignedLongs, Wholes);
    fmi3GetShiftDecimal(Instance, References, Length, Reals);
    fmi3GetShiftFraction(Instance, References, Length, UnsignedLongs, UnsignedLongs);
    fmi3SetIntervalDecimal(Instance, References, Length, Reals);
    fmi3SetIntervalFraction(Instance, References, Length, UnsignedLongs, UnsignedLongs);
    fmi3SetShiftDecimal(Instance, References, Length, Reals);
    fmi3SetShiftFraction(Instance, References, Length, UnsignedLongs, UnsignedLongs);
    fmi3EvaluateDiscreteStates(Instance);
    fmi3UpdateDiscreteStates(Instance, Bytes, Bytes, Bytes, Bytes, Bytes, Reals);
    fmi3EnterContinuousTimeMode(Instance);
    fmi3CompletedIntegratorStep(Instance, Flag, Bytes, Bytes);
    fmi3SetTime(Instance, Real);
    fmi3SetContinuousStates(Instance, Reals, Length);
    fmi3GetContinuousStateDerivatives(Instance, Reals, Length);
    fmi3GetEventIndicators(Instance, Reals, Length);
    fmi3GetContinuousStates(Instance, Reals, Length);
    fmi3GetNominalsOfContinuousStates(Instance, Reals, Length);
    fmi3GetNumberOfEventIndicators(Instance, Sizes);
    fmi3GetNumberOfContinuousStates(Instance, Sizes);
    fmi3EnterStepMode(Instance);
    fmi3GetOutputDerivatives(Instance, References, Length, Wholes, Reals, Length);
    fmi3DoStep(Instance, Real, Step, Flag, Bytes, Bytes, Bytes, Reals);
    fmi3ActivateModelPartition(Instance, Reference, Real);
}

/// Calls that must come in an order to get anywhere, more often than each single one.
const LIVES: &[Call] = &[
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

pub fn run(bytes: &[u8]) {
    static SUBJECT: LazyLock<Subject> = LazyLock::new(|| Subject::new::<Scene>(&choices()));
    CALL_BACK.set(Some(call_back));
    let mut importer = Importer::new(bytes, &SUBJECT, LONGEST_STEP);
    begin(&mut importer);
    while !importer.hand.is_empty() {
        let index = usize::from(importer.hand.byte());
        match LIVES.get(index % 32) {
            Some(call) => call(&mut importer),
            None => TABLE[index * TABLE.len() / 256](&mut importer),
        }
    }
    for slot in std::mem::take(&mut importer.slots) {
        release(&slot, slot.three.get());
        slot.drop_callbacks();
    }
}

/// From inside a callback.
unsafe fn call_back(slot: &Slot) -> Status {
    count();
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

fn release(slot: &Slot, as_three: bool) {
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
    let (logs, events) = (importer.hand.byte(), importer.hand.byte() & 1);
    let (early, wanted) = (importer.hand.byte() & 1, usize::from(importer.hand.rarely(16)));
    let slot = &importer.slots[index];
    slot.three.set(kind >= 6);
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
                events,
                early,
                null(),
                wanted,
                environment,
                Some(log3),
                None,
            ),
        }
    };
    slot.pointer.set(pointer);
}

/// An instance from its making to its first step, with up to three parameters set, as a careful importer does it.
fn begin(importer: &mut Importer) {
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

/// Steps on from where an instance is, through event mode if there was an event. (FMI 2.0 tells the time by the independent variable as well.)
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
