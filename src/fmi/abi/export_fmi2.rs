//! The 44 functions of FMI 2.0 with the signatures of `fmi2FunctionTypes.h`, in the order of `fmi2Functions.h`.

/// Exports a scene as the functions of FMI 2.0. Used by [`export_fmu!`](crate::export_fmu).
#[doc(hidden)]
#[macro_export]
macro_rules! export_fmi2 {
    ($scene:ty) => {
        /// FMI 2.0.
        #[allow(unsafe_code, non_snake_case, missing_docs, unused_unsafe)] // names and signatures are the standard's
        #[allow(clippy::missing_safety_doc, clippy::too_many_arguments)]
        pub mod fmi2 {
            use super::*;
            use std::ffi::{c_char, c_int, c_void};

            use $crate::fmi::Instance;
            use $crate::fmi::Version::Two;
            use $crate::fmi::abi::common::{self, Opaque, Status};
            use $crate::fmi::abi::fmi2::{self, CallbackFunctions, NO_DERIVATIVES, NO_MODEL_EXCHANGE, SYNCHRONOUS};
            use $crate::fmi::abi::{states, values};
            use $crate::fmi::instance::Access::AnyInteger;

            $crate::__fmi_functions! {
                fn fmi2GetTypesPlatform() -> *const c_char =
                    c"default".as_ptr();
                fn fmi2GetVersion() -> *const c_char =
                    c"2.0".as_ptr();
                fn fmi2SetDebugLogging(
                    pointer: Opaque, logging_on: c_int, count: usize, categories: *const *const c_char,
                ) -> Status =
                    common::set_debug_logging::<$scene>(
                        pointer, Two, "fmi2SetDebugLogging", logging_on != 0, (categories, count)
                    );
                fn fmi2Instantiate(
                    name: *const c_char, kind: c_int, guid: *const c_char, fmu_resource_location: *const c_char,
                    functions: *const CallbackFunctions, visible: c_int, logging_on: c_int,
                ) -> Opaque =
                    fmi2::instantiate::<$scene>(name, kind, guid, functions, logging_on);
                fn fmi2FreeInstance(pointer: Opaque) =
                    common::free::<$scene>(pointer, Two);
                fn fmi2SetupExperiment(
                    pointer: Opaque, tolerance_defined: c_int, tolerance: f64, start: f64, stop_defined: c_int,
                    stop: f64,
                ) -> Status =
                    fmi2::setup_experiment::<$scene>(
                        pointer, (tolerance_defined != 0).then_some(tolerance), start, stop_defined, stop
                    );
                fn fmi2EnterInitializationMode(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Two, "fmi2EnterInitializationMode", Instance::enter_initialization);
                fn fmi2ExitInitializationMode(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Two, "fmi2ExitInitializationMode", Instance::exit_initialization);
                fn fmi2Terminate(pointer: Opaque) -> Status =
                    common::transition::<$scene>(pointer, Two, "fmi2Terminate", Instance::terminate);
                fn fmi2Reset(pointer: Opaque) -> Status =
                    common::reset::<$scene>(pointer, Two, "fmi2Reset");
                fn fmi2GetReal(pointer: Opaque, references: *const u32, count: usize, values: *mut f64) -> Status =
                    values::get_real::<$scene>(pointer, Two, "fmi2GetReal", (references, count, values, count));
                fn fmi2GetInteger(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut c_int,
                ) -> Status =
                    values::get_whole::<$scene, _>(
                        pointer, Two, "fmi2GetInteger", (references, count, values, count), AnyInteger
                    );
                fn fmi2GetBoolean(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut c_int,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Two, "fmi2GetBoolean", count);
                fn fmi2GetString(
                    pointer: Opaque, references: *const u32, count: usize, values: *mut *const c_char,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Two, "fmi2GetString", count);
                fn fmi2SetReal(pointer: Opaque, references: *const u32, count: usize, values: *const f64) -> Status =
                    values::set_real::<$scene>(pointer, Two, "fmi2SetReal", (references, count, values, count));
                fn fmi2SetInteger(
                    pointer: Opaque, references: *const u32, count: usize, values: *const c_int,
                ) -> Status =
                    values::set_whole::<$scene, _>(
                        pointer, Two, "fmi2SetInteger", (references, count, values, count), AnyInteger
                    );
                fn fmi2SetBoolean(
                    pointer: Opaque, references: *const u32, count: usize, values: *const c_int,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Two, "fmi2SetBoolean", count);
                fn fmi2SetString(
                    pointer: Opaque, references: *const u32, count: usize, values: *const *const c_char,
                ) -> Status =
                    common::no_such_type::<$scene>(pointer, Two, "fmi2SetString", count);
                fn fmi2GetFMUstate(pointer: Opaque, state: *mut Opaque) -> Status =
                    states::get::<$scene>(pointer, Two, "fmi2GetFMUstate", state);
                fn fmi2SetFMUstate(pointer: Opaque, state: Opaque) -> Status =
                    states::set::<$scene>(pointer, Two, "fmi2SetFMUstate", state);
                fn fmi2FreeFMUstate(pointer: Opaque, state: *mut Opaque) -> Status =
                    states::free::<$scene>(pointer, Two, "fmi2FreeFMUstate", state);
                fn fmi2SerializedFMUstateSize(pointer: Opaque, state: Opaque, size: *mut usize) -> Status =
                    states::size::<$scene>(pointer, Two, "fmi2SerializedFMUstateSize", state, size);
                fn fmi2SerializeFMUstate(pointer: Opaque, state: Opaque, bytes: *mut u8, size: usize) -> Status =
                    states::serialize::<$scene>(pointer, Two, "fmi2SerializeFMUstate", state, (bytes, size));
                fn fmi2DeSerializeFMUstate(
                    pointer: Opaque, bytes: *const u8, size: usize, state: *mut Opaque,
                ) -> Status =
                    states::deserialize::<$scene>(pointer, Two, "fmi2DeSerializeFMUstate", (bytes, size), state);
                fn fmi2GetDirectionalDerivative(
                    pointer: Opaque, unknowns: *const u32, unknown_count: usize, knowns: *const u32,
                    known_count: usize, seed: *const f64, sensitivity: *mut f64,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2GetDirectionalDerivative", NO_DERIVATIVES);
                fn fmi2EnterEventMode(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2EnterEventMode", NO_MODEL_EXCHANGE);
                fn fmi2NewDiscreteStates(pointer: Opaque, event_info: *mut c_void) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2NewDiscreteStates", NO_MODEL_EXCHANGE);
                fn fmi2EnterContinuousTimeMode(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2EnterContinuousTimeMode", NO_MODEL_EXCHANGE);
                fn fmi2CompletedIntegratorStep(
                    pointer: Opaque, keep: c_int, enter_event_mode: *mut c_int, terminate_simulation: *mut c_int,
                ) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2CompletedIntegratorStep", NO_MODEL_EXCHANGE);
                fn fmi2SetTime(pointer: Opaque, time: f64) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2SetTime", NO_MODEL_EXCHANGE);
                fn fmi2SetContinuousStates(pointer: Opaque, x: *const f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2SetContinuousStates", NO_MODEL_EXCHANGE);
                fn fmi2GetDerivatives(pointer: Opaque, derivatives: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2GetDerivatives", NO_MODEL_EXCHANGE);
                fn fmi2GetEventIndicators(pointer: Opaque, event_indicators: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2GetEventIndicators", NO_MODEL_EXCHANGE);
                fn fmi2GetContinuousStates(pointer: Opaque, x: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2GetContinuousStates", NO_MODEL_EXCHANGE);
                fn fmi2GetNominalsOfContinuousStates(pointer: Opaque, x_nominal: *mut f64, count: usize) -> Status =
                    common::unsupported::<$scene>(
                        pointer, Two, "fmi2GetNominalsOfContinuousStates", NO_MODEL_EXCHANGE
                    );
                fn fmi2SetRealInputDerivatives(
                    pointer: Opaque, references: *const u32, count: usize, order: *const c_int,
                    values: *const f64,
                ) -> Status =
                    values::set_input_derivatives::<$scene>(
                        pointer, "fmi2SetRealInputDerivatives", order, (references, values, count)
                    );
                fn fmi2GetRealOutputDerivatives(
                    pointer: Opaque, references: *const u32, count: usize, order: *const c_int, values: *mut f64,
                ) -> Status =
                    values::get_output_derivatives::<$scene>(
                        pointer, Two, "fmi2GetRealOutputDerivatives", order, (references, count, values, count)
                    );
                fn fmi2DoStep(pointer: Opaque, current: f64, step: f64, keep: c_int) -> Status =
                    fmi2::do_step::<$scene>(pointer, current, step);
                fn fmi2CancelStep(pointer: Opaque) -> Status =
                    common::unsupported::<$scene>(pointer, Two, "fmi2CancelStep", SYNCHRONOUS);
                fn fmi2GetStatus(pointer: Opaque, kind: c_int, values: *mut Status) -> Status =
                    fmi2::get_status::<$scene>(pointer, kind, values);
                fn fmi2GetRealStatus(pointer: Opaque, kind: c_int, values: *mut f64) -> Status =
                    fmi2::get_real_status::<$scene>(pointer, kind, values);
                fn fmi2GetIntegerStatus(pointer: Opaque, kind: c_int, values: *mut c_int) -> Status =
                    fmi2::no_status::<$scene>(pointer, "fmi2GetIntegerStatus", kind);
                fn fmi2GetBooleanStatus(pointer: Opaque, kind: c_int, values: *mut c_int) -> Status =
                    fmi2::get_boolean_status::<$scene>(pointer, kind, values);
                fn fmi2GetStringStatus(pointer: Opaque, kind: c_int, values: *mut *const c_char) -> Status =
                    fmi2::no_status::<$scene>(pointer, "fmi2GetStringStatus", kind);
            }
        }
    };
}
