//! The 75 functions of FMI 3.0 with the signatures of `fmi3FunctionTypes.h`, in the order of `fmi3Functions.h`; those
//! that are no calls of an instance with a status come first.

/// Exports a model as the functions of FMI 3.0. Used by [`export_fmu!`](crate::export_fmu).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi3 {
    ($model:expr) => {
        /// FMI 3.0.
        #[allow(unsafe_code, non_snake_case, missing_docs, unused_unsafe)] // names and signatures are the standard's
        #[allow(clippy::missing_safety_doc, clippy::too_many_arguments)]
        pub mod fmi3 {
            use super::*;
            use std::ffi::c_char;

            use $crate::Instance;
            use $crate::c_api::calls::{self, NO_DERIVATIVES, NO_MODEL_EXCHANGE, no_such_type, unsupported};
            use $crate::c_api::fmi3::{self, Instantiation, NO_CLOCKS, NO_CONFIGURATION, NO_DEPENDENCIES, StepResults};
            use $crate::c_api::values::{self, Arrays};
            use $crate::c_api::{
                Boolean, ClockUpdate, Enumeration, Fmi3Log, IntermediateUpdate, Opaque, Preemption, Status, contents,
                free, states,
            };
            use $crate::instance::Access;
            use $crate::life_cycle::Version::Three;

            static MODEL: &$crate::ModelType = $model;

            $crate::__fmi_functions! {
                fn fmi3GetVersion() -> *const c_char = c"3.0".as_ptr();
                fn fmi3InstantiateModelExchange(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, environment: Opaque, log: Option<Fmi3Log>,
                ) -> Opaque = fmi3::refuse_instance("fmi3InstantiateModelExchange", environment, log);
                fn fmi3InstantiateCoSimulation(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, event_mode_used: Boolean, early_return_allowed: Boolean,
                    required_intermediate_variables: *const u32, required_count: usize, environment: Opaque,
                    log: Option<Fmi3Log>, intermediate_update: Option<IntermediateUpdate>,
                ) -> Opaque =
                    fmi3::instantiate(MODEL, Instantiation {
                        name, token, logging_on, event_mode_used, early_return_allowed,
                        required_intermediate_variables, required_count, environment, log, intermediate_update,
                    });
                fn fmi3InstantiateScheduledExecution(
                    name: *const c_char, token: *const c_char, resource_path: *const c_char, visible: Boolean,
                    logging_on: Boolean, environment: Opaque, log: Option<Fmi3Log>, clock_update: Option<ClockUpdate>,
                    lock_preemption: Option<Preemption>, unlock_preemption: Option<Preemption>,
                ) -> Opaque = fmi3::refuse_instance("fmi3InstantiateScheduledExecution", environment, log);
                fn fmi3FreeInstance(pointer: Opaque) = free(pointer, Three);
            }

            $crate::__fmi_calls! {
                Three;
                fn fmi3SetDebugLogging(logging_on: Boolean, count: usize, categories: *const *const c_char) =
                    calls::set_debug_logging(logging_on != 0, categories, count);
                fn fmi3EnterInitializationMode(
                    tolerance_defined: Boolean, tolerance: f64, start: f64, stop_defined: Boolean, stop: f64,
                ) =
                    fmi3::enter_initialization_mode(
                        (tolerance_defined != 0).then_some(tolerance), start, (stop_defined != 0).then_some(stop)
                    );
                fn fmi3ExitInitializationMode() = calls::transition(Instance::exit_initialization);
                fn fmi3EnterEventMode() = calls::transition(Instance::enter_event_mode);
                fn fmi3Terminate() = calls::transition(Instance::terminate);
                fn fmi3Reset() = calls::reset();
                fn fmi3GetFloat32(references: *const u32, count: usize, values: *mut f32, length: usize) =
                    values::get_single(Arrays { references, count, values, length });
                fn fmi3GetFloat64(references: *const u32, count: usize, values: *mut f64, length: usize) =
                    values::get_real(Arrays { references, count, values, length });
                fn fmi3GetInt8(references: *const u32, count: usize, values: *mut i8, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::Int8);
                fn fmi3GetUInt8(references: *const u32, count: usize, values: *mut u8, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::UInt8);
                fn fmi3GetInt16(references: *const u32, count: usize, values: *mut i16, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::Int16);
                fn fmi3GetUInt16(references: *const u32, count: usize, values: *mut u16, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::UInt16);
                fn fmi3GetInt32(references: *const u32, count: usize, values: *mut i32, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::Integer);
                fn fmi3GetUInt32(references: *const u32, count: usize, values: *mut u32, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::UInt32);
                fn fmi3GetInt64(references: *const u32, count: usize, values: *mut i64, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::Long);
                fn fmi3GetUInt64(references: *const u32, count: usize, values: *mut u64, length: usize) =
                    values::get_whole(Arrays { references, count, values, length }, Access::UInt64);
                fn fmi3GetBoolean(references: *const u32, count: usize, values: *mut Boolean, length: usize) =
                    values::get_boolean(Arrays { references, count, values, length });
                fn fmi3GetString(references: *const u32, count: usize, values: *mut *const c_char, length: usize) =
                    contents::get_text(Arrays { references, count, values, length });
                fn fmi3GetBinary(
                    references: *const u32, count: usize, value_sizes: *mut usize, values: *mut *const u8,
                    length: usize,
                ) = contents::get_binary(value_sizes, Arrays { references, count, values, length });
                fn fmi3GetClock(references: *const u32, count: usize, values: *mut Boolean) = no_such_type(count);
                fn fmi3SetFloat32(references: *const u32, count: usize, values: *const f32, length: usize) =
                    values::set_single(Arrays { references, count, values, length });
                fn fmi3SetFloat64(references: *const u32, count: usize, values: *const f64, length: usize) =
                    values::set_real(Arrays { references, count, values, length });
                fn fmi3SetInt8(references: *const u32, count: usize, values: *const i8, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::Int8);
                fn fmi3SetUInt8(references: *const u32, count: usize, values: *const u8, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::UInt8);
                fn fmi3SetInt16(references: *const u32, count: usize, values: *const i16, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::Int16);
                fn fmi3SetUInt16(references: *const u32, count: usize, values: *const u16, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::UInt16);
                fn fmi3SetInt32(references: *const u32, count: usize, values: *const i32, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::Integer);
                fn fmi3SetUInt32(references: *const u32, count: usize, values: *const u32, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::UInt32);
                fn fmi3SetInt64(references: *const u32, count: usize, values: *const i64, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::Long);
                fn fmi3SetUInt64(references: *const u32, count: usize, values: *const u64, length: usize) =
                    values::set_whole(Arrays { references, count, values, length }, Access::UInt64);
                fn fmi3SetBoolean(references: *const u32, count: usize, values: *const Boolean, length: usize) =
                    values::set_boolean(Arrays { references, count, values, length });
                fn fmi3SetString(references: *const u32, count: usize, values: *const *const c_char, length: usize) =
                    contents::set_text(Arrays { references, count, values, length });
                fn fmi3SetBinary(
                    references: *const u32, count: usize, value_sizes: *const usize, values: *const *const u8,
                    length: usize,
                ) = contents::set_binary(value_sizes, Arrays { references, count, values, length });
                fn fmi3SetClock(references: *const u32, count: usize, values: *const Boolean) = no_such_type(count);
                fn fmi3GetNumberOfVariableDependencies(reference: u32, count: *mut usize) =
                    unsupported(NO_DEPENDENCIES);
                fn fmi3GetVariableDependencies(
                    dependent: u32, element_indices_of_dependent: *mut usize, independents: *mut u32,
                    element_indices_of_independents: *mut usize, dependency_kinds: *mut Enumeration, count: usize,
                ) = unsupported(NO_DEPENDENCIES);
                fn fmi3GetFMUState(state: *mut Opaque) = states::get(state);
                fn fmi3SetFMUState(state: Opaque) = states::set(state);
                fn fmi3FreeFMUState(state: *mut Opaque) = states::free(state);
                fn fmi3SerializedFMUStateSize(state: Opaque, size: *mut usize) = states::size(state, size);
                fn fmi3SerializeFMUState(state: Opaque, bytes: *mut u8, size: usize) =
                    states::serialize(state, bytes, size);
                fn fmi3DeserializeFMUState(bytes: *const u8, size: usize, state: *mut Opaque) =
                    states::deserialize(bytes, size, state);
                fn fmi3GetDirectionalDerivative(
                    unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
                    seed: *const f64, n_seed: usize, sensitivity: *mut f64, n_sensitivity: usize,
                ) = unsupported(NO_DERIVATIVES);
                fn fmi3GetAdjointDerivative(
                    unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
                    seed: *const f64, n_seed: usize, sensitivity: *mut f64, n_sensitivity: usize,
                ) = unsupported(NO_DERIVATIVES);
                fn fmi3EnterConfigurationMode() = unsupported(NO_CONFIGURATION);
                fn fmi3ExitConfigurationMode() = unsupported(NO_CONFIGURATION);
                fn fmi3GetIntervalDecimal(
                    references: *const u32, count: usize, intervals: *mut f64, qualifiers: *mut Enumeration,
                ) = unsupported(NO_CLOCKS);
                fn fmi3GetIntervalFraction(
                    references: *const u32, count: usize, counters: *mut u64, resolutions: *mut u64,
                    qualifiers: *mut Enumeration,
                ) = unsupported(NO_CLOCKS);
                fn fmi3GetShiftDecimal(references: *const u32, count: usize, shifts: *mut f64) = unsupported(NO_CLOCKS);
                fn fmi3GetShiftFraction(
                    references: *const u32, count: usize, counters: *mut u64, resolutions: *mut u64,
                ) = unsupported(NO_CLOCKS);
                fn fmi3SetIntervalDecimal(references: *const u32, count: usize, intervals: *const f64) =
                    unsupported(NO_CLOCKS);
                fn fmi3SetIntervalFraction(
                    references: *const u32, count: usize, counters: *const u64, resolutions: *const u64,
                ) = unsupported(NO_CLOCKS);
                fn fmi3SetShiftDecimal(references: *const u32, count: usize, shifts: *const f64) =
                    unsupported(NO_CLOCKS);
                fn fmi3SetShiftFraction(
                    references: *const u32, count: usize, counters: *const u64, resolutions: *const u64,
                ) = unsupported(NO_CLOCKS);
                fn fmi3EvaluateDiscreteStates() = unsupported(NO_CLOCKS);
                fn fmi3UpdateDiscreteStates(
                    discrete_states_need_update: *mut Boolean, terminate_simulation: *mut Boolean,
                    nominals_of_continuous_states_changed: *mut Boolean,
                    values_of_continuous_states_changed: *mut Boolean, next_event_time_defined: *mut Boolean,
                    next_event_time: *mut f64,
                ) =
                    fmi3::update_discrete_states([
                        (discrete_states_need_update, "discreteStatesNeedUpdate"),
                        (terminate_simulation, "terminateSimulation"),
                        (nominals_of_continuous_states_changed, "nominalsOfContinuousStatesChanged"),
                        (values_of_continuous_states_changed, "valuesOfContinuousStatesChanged"),
                        (next_event_time_defined, "nextEventTimeDefined"),
                    ], next_event_time);
                fn fmi3EnterContinuousTimeMode() = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3CompletedIntegratorStep(
                    keep: Boolean, enter_event_mode: *mut Boolean, terminate_simulation: *mut Boolean,
                ) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3SetTime(time: f64) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3SetContinuousStates(continuous_states: *const f64, count: usize) =
                    unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetContinuousStateDerivatives(derivatives: *mut f64, count: usize) =
                    unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetEventIndicators(event_indicators: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetContinuousStates(continuous_states: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetNominalsOfContinuousStates(nominals: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetNumberOfEventIndicators(count: *mut usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3GetNumberOfContinuousStates(count: *mut usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi3EnterStepMode() = calls::transition(Instance::enter_step_mode);
                fn fmi3GetOutputDerivatives(
                    references: *const u32, count: usize, orders: *const i32, values: *mut f64, length: usize,
                ) = values::get_output_derivatives(orders, Arrays { references, count, values, length });
                fn fmi3DoStep(
                    current: f64, step: f64, keep: Boolean, event_handling_needed: *mut Boolean,
                    terminate_simulation: *mut Boolean, early_return: *mut Boolean, last_successful_time: *mut f64,
                ) =
                    fmi3::do_step(current, step, StepResults {
                        event_handling_needed, terminate_simulation, early_return, last_successful_time,
                    });
                fn fmi3ActivateModelPartition(clock_reference: u32, activation_time: f64) = unsupported(NO_CLOCKS);
            }
        }
    };
}
