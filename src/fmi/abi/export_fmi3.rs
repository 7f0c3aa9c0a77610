//! The 75 functions of FMI 3.0 with the signatures of `fmi3FunctionTypes.h`, in the order of `fmi3Functions.h`.

/// Exports a scene as the functions of FMI 3.0. Used by [`export_fmu!`](crate::export_fmu).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi3 {
    ($scene:ty) => {
        /// FMI 3.0.
        #[allow(unsafe_code, non_snake_case, missing_docs, unused_unsafe)] // names and signatures are the standard's
        #[allow(clippy::missing_safety_doc, clippy::too_many_arguments)]
        pub mod fmi3 {
            use super::*;
            use std::ffi::c_char;

            use $crate::fmi::Instance;
            use $crate::fmi::Version::Three;
            use $crate::fmi::abi::common::{self, Opaque, Status};
            use $crate::fmi::abi::fmi3::{
                self, Boolean, ClockUpdate, Enumeration, IntermediateUpdate, NO_CLOCKS, NO_CONFIGURATION,
                NO_DEPENDENCIES, NO_DERIVATIVES, NO_MODEL_EXCHANGE, Preemption,
            };
            use $crate::fmi::abi::logger::Fmi3Log;
            use $crate::fmi::abi::{intermediate, states, values};
            use $crate::fmi::instance::Access;

            $crate::__fmi_functions! {
                fn fmi3GetVersion() -> *const c_char =
                    c"3.0".as_ptr();
                fn fmi3SetDebugLogging(
                    pointer: Opaque, logging_on: Boolean, count: usize, categories: *const *const c_char,
                ) -> Status =
                    common::set_debug_logging::<$scene>(
                        pointer, Three, "fmi3SetDebugLogging", logging_on != 0, (categories, count)
                    );
                fn fmi3InstantiateModelExchange(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, environment: Opaque, log: Option<Fmi3Log>,
                ) -> Opaque =
                    fmi3::refuse_instance::<$scene>("fmi3InstantiateModelExchange", environment, log);
                fn fmi3InstantiateCoSimulation(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, event_mode_used: Boolean, early_return_allowed: Boolean,
                    required_intermediate_variables: *const u32, required_count: usize, environment: Opaque,
                    log: Option<Fmi3Log>, intermediate_update: Option<IntermediateUpdate>,
                ) -> Opaque =
                    fmi3::instantiate::<$scene>(
                        (name, token), logging_on, (event_mode_used, early_return_allowed),
                        (required_intermediate_variables, required_count), (environment, log, intermediate_update)
                    );
                fn fmi3InstantiateScheduledExecution(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, environment: Opaque, log: Option<Fmi3Log>,
                    clock_update: Option<ClockUpdate>, lock_preemption: Option<Preemption>,
                    unlock_preemption: Option<Preemption>,
                ) -> Opaque =
                    fmi3::refuse_instance::<$scene>("fmi3InstantiateScheduledExecution", environment, log);
                fn fmi3FreeInstance(pointer: Opaque) =
                    common::free::<$scene>(pointer, Three);
                fn fmi3EnterInitializationMode(
                    pointer: Opaque, tolerance_defined: Boolean, tolerance: f64, start: f64,
                    stop_defined: Boolean, stop: f64,
                ) -> Status =
                    fmi3::enter_initialization_mode::<$scene>(
                        pointer, (tolerance_defined != 0).then_some(tolerance), start, stop_defined, stop
                    );
                fn fmi3ExitInitializationMode(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Three, "fmi3ExitInitializationMode", Instance::exit_initialization);
                fn fmi3EnterEventMode(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Three, "fmi3EnterEventMode", Instance::enter_event_mode);
                fn fmi3Terminate(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Three, "fmi3Terminate", Instance::terminate);
                fn fmi3Reset(pointer: Opaque) -> Status =
                    common::reset::<$scene>(pointer, Three, "fmi3Reset");
                fn fmi3GetFloat32(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut f32, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetFloat32", count);
                fn fmi3GetFloat64(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut f64, length: usize,
                ) -> Status =
                    values::get_real::<$scene>(pointer, Three, "fmi3GetFloat64", (references, count, values, length));
                fn fmi3GetInt8(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut i8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetInt8", count);
                fn fmi3GetUInt8(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut u8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetUInt8", count);
                fn fmi3GetInt16(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut i16, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetInt16", count);
                fn fmi3GetUInt16(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut u16, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetUInt16", count);
                fn fmi3GetInt32(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut i32, length: usize,
                ) -> Status =
                    values::get_whole::<$scene, _>(
                        pointer, Three, "fmi3GetInt32", (references, count, values, length), Access::Integer
                    );
                fn fmi3GetUInt32(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut u32, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetUInt32", count);
                fn fmi3GetInt64(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut i64, length: usize,
                ) -> Status =
                    values::get_whole::<$scene, _>(
                        pointer, Three, "fmi3GetInt64", (references, count, values, length), Access::Long
                    );
                fn fmi3GetUInt64(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut u64, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetUInt64", count);
                fn fmi3GetBoolean(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut Boolean, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetBoolean", count);
                fn fmi3GetString(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut *const c_char,
                    length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetString", count);
                fn fmi3GetBinary(
                    pointer: Opaque, references: *const u32, count: usize, value_sizes: *mut usize,
                    values: *mut *const u8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetBinary", count);
                fn fmi3GetClock(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut Boolean,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3GetClock", count);
                fn fmi3SetFloat32(
                    pointer: Opaque, references: *const u32, count: usize, values: *const f32, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetFloat32", count);
                fn fmi3SetFloat64(
                    pointer: Opaque, references: *const u32, count: usize, values: *const f64, length: usize,
                ) -> Status =
                    values::set_real::<$scene>(pointer, Three, "fmi3SetFloat64", (references, count, values, length));
                fn fmi3SetInt8(
                    pointer: Opaque, references: *const u32, count: usize, values: *const i8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetInt8", count);
                fn fmi3SetUInt8(
                    pointer: Opaque, references: *const u32, count: usize, values: *const u8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetUInt8", count);
                fn fmi3SetInt16(
                    pointer: Opaque, references: *const u32, count: usize, values: *const i16, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetInt16", count);
                fn fmi3SetUInt16(
                    pointer: Opaque, references: *const u32, count: usize, values: *const u16, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetUInt16", count);
                fn fmi3SetInt32(
                    pointer: Opaque, references: *const u32, count: usize, values: *const i32, length: usize,
                ) -> Status =
                    values::set_whole::<$scene, _>(
                        pointer, Three, "fmi3SetInt32", (references, count, values, length), Access::Integer
                    );
                fn fmi3SetUInt32(
                    pointer: Opaque, references: *const u32, count: usize, values: *const u32, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetUInt32", count);
                fn fmi3SetInt64(
                    pointer: Opaque, references: *const u32, count: usize, values: *const i64, length: usize,
                ) -> Status =
                    values::set_whole::<$scene, _>(
                        pointer, Three, "fmi3SetInt64", (references, count, values, length), Access::Long
                    );
                fn fmi3SetUInt64(
                    pointer: Opaque, references: *const u32, count: usize, values: *const u64, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetUInt64", count);
                fn fmi3SetBoolean(
                    pointer: Opaque, references: *const u32, count: usize, values: *const Boolean, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetBoolean", count);
                fn fmi3SetString(
                    pointer: Opaque, references: *const u32, count: usize, values: *const *const c_char,
                    length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetString", count);
                fn fmi3SetBinary(
                    pointer: Opaque, references: *const u32, count: usize, value_sizes: *const usize,
                    values: *const *const u8, length: usize,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetBinary", count);
                fn fmi3SetClock(
                    pointer: Opaque, references: *const u32, count: usize, values: *const Boolean,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Three, "fmi3SetClock", count);
                fn fmi3GetNumberOfVariableDependencies(pointer: Opaque, reference: u32, count: *mut usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Three, "fmi3GetNumberOfVariableDependencies", NO_DEPENDENCIES
                    );
                fn fmi3GetVariableDependencies(
                    pointer: Opaque, dependent: u32, element_indices_of_dependent: *mut usize,
                    independents: *mut u32, element_indices_of_independents: *mut usize,
                    dependency_kinds: *mut Enumeration, count: usize,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetVariableDependencies", NO_DEPENDENCIES);
                fn fmi3GetFMUState(pointer: Opaque, state: *mut Opaque) -> Status =
                    states::get::<$scene>(pointer, Three, "fmi3GetFMUState", state);
                fn fmi3SetFMUState(pointer: Opaque, state: Opaque) -> Status =
                    states::set::<$scene>(pointer, Three, "fmi3SetFMUState", state);
                fn fmi3FreeFMUState(pointer: Opaque, state: *mut Opaque) -> Status =
                    states::free::<$scene>(pointer, Three, "fmi3FreeFMUState", state);
                fn fmi3SerializedFMUStateSize(pointer: Opaque, state: Opaque, size: *mut usize) -> Status =
                    states::size::<$scene>(pointer, Three, "fmi3SerializedFMUStateSize", state, size);
                fn fmi3SerializeFMUState(pointer: Opaque, state: Opaque, bytes: *mut u8, size: usize) -> Status =
                    states::serialize::<$scene>(pointer, Three, "fmi3SerializeFMUState", state, (bytes, size));
                fn fmi3DeserializeFMUState(
                    pointer: Opaque, bytes: *const u8, size: usize, state: *mut Opaque,
                ) -> Status =
                    states::deserialize::<$scene>(pointer, Three, "fmi3DeserializeFMUState", (bytes, size), state);
                fn fmi3GetDirectionalDerivative(
                    pointer: Opaque, unknowns: *const u32, unknown_count: usize, knowns: *const u32,
                    known_count: usize, seed: *const f64, n_seed: usize, sensitivity: *mut f64,
                    n_sensitivity: usize,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetDirectionalDerivative", NO_DERIVATIVES);
                fn fmi3GetAdjointDerivative(
                    pointer: Opaque, unknowns: *const u32, unknown_count: usize, knowns: *const u32,
                    known_count: usize, seed: *const f64, n_seed: usize, sensitivity: *mut f64,
                    n_sensitivity: usize,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetAdjointDerivative", NO_DERIVATIVES);
                fn fmi3EnterConfigurationMode(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3EnterConfigurationMode", NO_CONFIGURATION);
                fn fmi3ExitConfigurationMode(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3ExitConfigurationMode", NO_CONFIGURATION);
                fn fmi3GetIntervalDecimal(
                    pointer: Opaque, references: *const u32, count: usize, intervals: *mut f64,
                    qualifiers: *mut Enumeration,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetIntervalDecimal", NO_CLOCKS);
                fn fmi3GetIntervalFraction(
                    pointer: Opaque, references: *const u32, count: usize, counters: *mut u64,
                    resolutions: *mut u64, qualifiers: *mut Enumeration,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetIntervalFraction", NO_CLOCKS);
                fn fmi3GetShiftDecimal(
                    pointer: Opaque, references: *const u32, count: usize, shifts: *mut f64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetShiftDecimal", NO_CLOCKS);
                fn fmi3GetShiftFraction(
                    pointer: Opaque, references: *const u32, count: usize, counters: *mut u64,
                    resolutions: *mut u64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetShiftFraction", NO_CLOCKS);
                fn fmi3SetIntervalDecimal(
                    pointer: Opaque, references: *const u32, count: usize, intervals: *const f64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetIntervalDecimal", NO_CLOCKS);
                fn fmi3SetIntervalFraction(
                    pointer: Opaque, references: *const u32, count: usize, counters: *const u64,
                    resolutions: *const u64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetIntervalFraction", NO_CLOCKS);
                fn fmi3SetShiftDecimal(
                    pointer: Opaque, references: *const u32, count: usize, shifts: *const f64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetShiftDecimal", NO_CLOCKS);
                fn fmi3SetShiftFraction(
                    pointer: Opaque, references: *const u32, count: usize, counters: *const u64,
                    resolutions: *const u64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetShiftFraction", NO_CLOCKS);
                fn fmi3EvaluateDiscreteStates(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3EvaluateDiscreteStates", NO_CLOCKS);
                fn fmi3UpdateDiscreteStates(
                    pointer: Opaque, discrete_states_need_update: *mut Boolean,
                    terminate_simulation: *mut Boolean, nominals_of_continuous_states_changed: *mut Boolean,
                    values_of_continuous_states_changed: *mut Boolean, next_event_time_defined: *mut Boolean,
                    next_event_time: *mut f64,
                ) -> Status =
                    fmi3::update_discrete_states::<$scene>(pointer, [
                        (discrete_states_need_update, "discreteStatesNeedUpdate"),
                        (terminate_simulation, "terminateSimulation"),
                        (nominals_of_continuous_states_changed, "nominalsOfContinuousStatesChanged"),
                        (values_of_continuous_states_changed, "valuesOfContinuousStatesChanged"),
                        (next_event_time_defined, "nextEventTimeDefined"),
                    ], next_event_time);
                fn fmi3EnterContinuousTimeMode(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3EnterContinuousTimeMode", NO_MODEL_EXCHANGE);
                fn fmi3CompletedIntegratorStep(
                    pointer: Opaque, keep: Boolean, enter_event_mode: *mut Boolean,
                    terminate_simulation: *mut Boolean,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3CompletedIntegratorStep", NO_MODEL_EXCHANGE);
                fn fmi3SetTime(pointer: Opaque, time: f64) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetTime", NO_MODEL_EXCHANGE);
                fn fmi3SetContinuousStates(pointer: Opaque, continuous_states: *const f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3SetContinuousStates", NO_MODEL_EXCHANGE);
                fn fmi3GetContinuousStateDerivatives(pointer: Opaque, derivatives: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Three, "fmi3GetContinuousStateDerivatives", NO_MODEL_EXCHANGE
                    );
                fn fmi3GetEventIndicators(pointer: Opaque, event_indicators: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetEventIndicators", NO_MODEL_EXCHANGE);
                fn fmi3GetContinuousStates(pointer: Opaque, continuous_states: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3GetContinuousStates", NO_MODEL_EXCHANGE);
                fn fmi3GetNominalsOfContinuousStates(pointer: Opaque, nominals: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Three, "fmi3GetNominalsOfContinuousStates", NO_MODEL_EXCHANGE
                    );
                fn fmi3GetNumberOfEventIndicators(pointer: Opaque, count: *mut usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Three, "fmi3GetNumberOfEventIndicators", NO_MODEL_EXCHANGE
                    );
                fn fmi3GetNumberOfContinuousStates(pointer: Opaque, count: *mut usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Three, "fmi3GetNumberOfContinuousStates", NO_MODEL_EXCHANGE
                    );
                fn fmi3EnterStepMode(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Three, "fmi3EnterStepMode", Instance::enter_step_mode);
                fn fmi3GetOutputDerivatives(
                    pointer: Opaque, references: *const u32, count: usize, orders: *const i32, values: *mut f64,
                    length: usize,
                ) -> Status =
                    values::get_output_derivatives::<$scene>(
                        pointer, Three, "fmi3GetOutputDerivatives", orders, (references, count, values, length)
                    );
                fn fmi3DoStep(
                    pointer: Opaque, current: f64, step: f64, keep: Boolean, event_handling_needed: *mut Boolean,
                    terminate_simulation: *mut Boolean, early_return: *mut Boolean,
                    last_successful_time: *mut f64,
                ) -> Status =
                    intermediate::do_step::<$scene>(
                        pointer, (current, step), [event_handling_needed, terminate_simulation, early_return],
                        last_successful_time
                    );
                fn fmi3ActivateModelPartition(pointer: Opaque, clock_reference: u32, activation_time: f64) -> Status =
                    common::unsupported::<$scene>(pointer, Three, "fmi3ActivateModelPartition", NO_CLOCKS);
            }
        }
    };
}
