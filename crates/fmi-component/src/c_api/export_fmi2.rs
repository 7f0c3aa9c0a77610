//! The 44 functions of FMI 2.0 with the signatures of `fmi2FunctionTypes.h`, in the order of `fmi2Functions.h`; those
//! that are no calls of an instance with a status come first.

/// Exports a model as the functions of FMI 2.0. Used by [`export_fmu!`](crate::export_fmu).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi2 {
    ($model:expr) => {
        /// FMI 2.0.
        #[allow(unsafe_code, non_snake_case, missing_docs, unused_unsafe)] // names and signatures are the standard's
        #[allow(clippy::missing_safety_doc, clippy::too_many_arguments)]
        pub mod fmi2 {
            use super::*;
            use std::ffi::{c_char, c_int, c_void};

            use $crate::Instance;
            use $crate::c_api::calls::{self, NO_DERIVATIVES, NO_MODEL_EXCHANGE, unsupported};
            use $crate::c_api::fmi2::{self, SYNCHRONOUS};
            use $crate::c_api::values::{self, Arrays};
            use $crate::c_api::{CallbackFunctions, Opaque, Status, contents, free, states};
            use $crate::instance::Access::AnyInteger;
            use $crate::life_cycle::Version::Two;

            static MODEL: &$crate::ModelType = $model;

            $crate::__fmi_functions! {
                fn fmi2GetTypesPlatform() -> *const c_char = c"default".as_ptr();
                fn fmi2GetVersion() -> *const c_char = c"2.0".as_ptr();
                fn fmi2Instantiate(
                    name: *const c_char, kind: c_int, guid: *const c_char, fmu_resource_location: *const c_char,
                    functions: *const CallbackFunctions, visible: c_int, logging_on: c_int,
                ) -> Opaque = fmi2::instantiate(MODEL, name, kind, guid, functions, logging_on);
                fn fmi2FreeInstance(pointer: Opaque) = free(pointer, Two);
            }

            $crate::__fmi_calls! {
                Two;
                fn fmi2SetDebugLogging(logging_on: c_int, count: usize, categories: *const *const c_char) =
                    calls::set_debug_logging(logging_on != 0, categories, count);
                fn fmi2SetupExperiment(
                    tolerance_defined: c_int, tolerance: f64, start: f64, stop_defined: c_int, stop: f64,
                ) =
                    fmi2::setup_experiment(
                        (tolerance_defined != 0).then_some(tolerance), start, (stop_defined != 0).then_some(stop)
                    );
                fn fmi2EnterInitializationMode() = calls::transition(Instance::enter_initialization);
                fn fmi2ExitInitializationMode() = calls::transition(Instance::exit_initialization);
                fn fmi2Terminate() = calls::transition(Instance::terminate);
                fn fmi2Reset() = calls::reset();
                fn fmi2GetReal(references: *const u32, count: usize, values: *mut f64) =
                    values::get_real(Arrays { references, count, values, length: count });
                fn fmi2GetInteger(references: *const u32, count: usize, values: *mut c_int) =
                    values::get_whole(Arrays { references, count, values, length: count }, AnyInteger);
                fn fmi2GetBoolean(references: *const u32, count: usize, values: *mut c_int) =
                    values::get_boolean(Arrays { references, count, values, length: count });
                fn fmi2GetString(references: *const u32, count: usize, values: *mut *const c_char) =
                    contents::get_text(Arrays { references, count, values, length: count });
                fn fmi2SetReal(references: *const u32, count: usize, values: *const f64) =
                    values::set_real(Arrays { references, count, values, length: count });
                fn fmi2SetInteger(references: *const u32, count: usize, values: *const c_int) =
                    values::set_whole(Arrays { references, count, values, length: count }, AnyInteger);
                fn fmi2SetBoolean(references: *const u32, count: usize, values: *const c_int) =
                    values::set_boolean(Arrays { references, count, values, length: count });
                fn fmi2SetString(references: *const u32, count: usize, values: *const *const c_char) =
                    contents::set_text(Arrays { references, count, values, length: count });
                fn fmi2GetFMUstate(state: *mut Opaque) = states::get(state);
                fn fmi2SetFMUstate(state: Opaque) = states::set(state);
                fn fmi2FreeFMUstate(state: *mut Opaque) = states::free(state);
                fn fmi2SerializedFMUstateSize(state: Opaque, size: *mut usize) = states::size(state, size);
                fn fmi2SerializeFMUstate(state: Opaque, bytes: *mut u8, size: usize) =
                    states::serialize(state, bytes, size);
                fn fmi2DeSerializeFMUstate(bytes: *const u8, size: usize, state: *mut Opaque) =
                    states::deserialize(bytes, size, state);
                fn fmi2GetDirectionalDerivative(
                    unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
                    seed: *const f64, sensitivity: *mut f64,
                ) = unsupported(NO_DERIVATIVES);
                fn fmi2EnterEventMode() = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2NewDiscreteStates(event_info: *mut c_void) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2EnterContinuousTimeMode() = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2CompletedIntegratorStep(
                    keep: c_int, enter_event_mode: *mut c_int, terminate_simulation: *mut c_int,
                ) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2SetTime(time: f64) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2SetContinuousStates(x: *const f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2GetDerivatives(derivatives: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2GetEventIndicators(event_indicators: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2GetContinuousStates(x: *mut f64, count: usize) = unsupported(NO_MODEL_EXCHANGE);
                fn fmi2GetNominalsOfContinuousStates(x_nominal: *mut f64, count: usize) =
                    unsupported(NO_MODEL_EXCHANGE);
                fn fmi2SetRealInputDerivatives(
                    references: *const u32, count: usize, order: *const c_int, values: *const f64,
                ) = values::set_input_derivatives(order, Arrays { references, count, values, length: count });
                fn fmi2GetRealOutputDerivatives(
                    references: *const u32, count: usize, order: *const c_int, values: *mut f64,
                ) = values::get_output_derivatives(order, Arrays { references, count, values, length: count });
                fn fmi2DoStep(current: f64, step: f64, keep: c_int) = fmi2::do_step(current, step);
                fn fmi2CancelStep() = unsupported(SYNCHRONOUS);
                fn fmi2GetStatus(kind: c_int, values: *mut Status) = fmi2::get_status(kind, values);
                fn fmi2GetRealStatus(kind: c_int, values: *mut f64) = fmi2::get_real_status(kind, values);
                fn fmi2GetIntegerStatus(kind: c_int, values: *mut c_int) = fmi2::no_status(kind);
                fn fmi2GetBooleanStatus(kind: c_int, values: *mut c_int) = fmi2::get_boolean_status(kind, values);
                fn fmi2GetStringStatus(kind: c_int, values: *mut *const c_char) = fmi2::no_status(kind);
            }
        }
    };
}
