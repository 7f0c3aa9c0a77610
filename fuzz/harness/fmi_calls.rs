//! The table of all functions of both versions, each with the roles of its arguments, and the loop that draws from it and from
//! `lives`. What includes this file says in `super::library` which library is called.

use std::sync::LazyLock;

use super::fmi::{CALL_BACK, Importer, OBSERVE_INSIDE, Subject, check};
use super::hand::*;
use super::library::fmi2::*;
use super::library::fmi3::*;
use super::library::{LONGEST_STEP, Opaque, Status, tokens};
use super::lives::{LIVES, begin, call_back, observe_inside, release};

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

struct Statuses;
impl Role for Statuses {
    type Argument = *mut Status;
    fn draw(importer: &mut Importer) -> *mut Status {
        <Zeros as Draw>::draw(&mut importer.hand).cast()
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
    fmi3GetBinary(Instance, References, Length, Sizes, Binaries, Length);
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
    fmi3SetBinary(Instance, References, Length, BinarySizes, Binaries, Length);
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

/// Makes the calls that `bytes` ask for.
#[allow(dead_code)] // what goes on at the end calls `run_and`
pub fn run(bytes: &[u8]) {
    run_and(bytes, |_, _| {});
}

/// As [`run`], and what `end` does with the instances as they are then; it is told how many variables there are at most.
pub fn run_and(bytes: &[u8], end: fn(&mut Importer, u32)) {
    static SUBJECT: LazyLock<Subject> = LazyLock::new(|| {
        let (tokens, variables) = tokens();
        Subject::new(&tokens, variables)
    });
    CALL_BACK.set(Some(call_back));
    OBSERVE_INSIDE.set(Some(observe_inside));
    let mut importer = Importer::new(bytes, &SUBJECT, LONGEST_STEP);
    begin(&mut importer);
    while !importer.hand.is_empty() {
        let index = usize::from(importer.hand.byte());
        match LIVES.get(index % 32) {
            Some(call) => call(&mut importer),
            None => TABLE[index * TABLE.len() / 256](&mut importer),
        }
    }
    end(&mut importer, SUBJECT.variables);
    for slot in std::mem::take(&mut importer.slots) {
        release(&slot, slot.three.get());
        slot.drop_callbacks();
    }
}
